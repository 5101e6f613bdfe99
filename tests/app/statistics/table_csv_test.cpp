// Tests of app/statistics/table_csv, csv_records and look_alike: what is read of a CSV file, and every fault told
// without a cell's content.
#include "app/statistics/table_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <ctime>

#include "app/statistics/csv_records.h"
#include "app/statistics/look_alike.h"
#include "sim/base/rng.h"

namespace seldinger::app {
namespace {

using Lines = std::vector<std::string>;

const TableColumns kScoreByGroup{{"score"}, "group", "", "", ""};

// Every fault that is told of a text.
Lines faults_in(const std::string& text, const TableColumns& columns = kScoreByGroup) {
  const auto read = table_in_csv(text, columns);
  if (read) return {};
  EXPECT_EQ(read.error().code, "bad_csv");
  Lines faults = {read.error().text};
  for (const auto& finding : read.error().findings) {
    EXPECT_EQ(finding.code, "bad_csv");
    faults.push_back(finding.text);
  }
  return faults;
}

std::vector<double> scores_in(const std::string& text) {
  const auto read = table_in_csv(text, {{"score"}, "", "", "", ""});
  EXPECT_TRUE(read) << (read ? "" : read.error().text);
  return read ? read->table.values.at(0).values : std::vector<double>();
}

TEST(TableCsv, TakesColumnsByNameWhateverStandsBeside) {
  const auto read = table_in_csv(
      "\xef\xbb\xbf\"who\",score,other,group,time,\"what,\n\"\"where\"\"\"\r\n"
      "ann, 1.5 ,?,\"a, \"\"b\"\"\",-3e2,x\r\n\r\nbob,+2,,\"c\nd\",.5,\"\"\r\n",
      {{"score", "time"}, "group", "who", "what,\n\"where\"", "score"});
  ASSERT_TRUE(read) << read.error().text;
  EXPECT_EQ(read->table.rows, 2U);
  EXPECT_EQ(read->table.values.at(0).name, "score");
  EXPECT_EQ(read->table.values.at(0).values, (std::vector{1.5, 2.0}));
  EXPECT_EQ(read->table.values.at(1).values, (std::vector{-300.0, 0.5}));
  EXPECT_EQ(read->table.group, (Lines{"a, \"b\"", "c\nd"}));
  EXPECT_EQ(read->table.subject, (Lines{"ann", "bob"}));
  EXPECT_EQ(read->table.rater, (Lines{"x", ""}));
  EXPECT_EQ(read->table.x, (std::vector{1.5, 2.0}));
  EXPECT_EQ(read->notes, Lines{});
}

TEST(TableCsv, EmptyNaAndNanAreMissing) {
  const auto read = table_in_csv("score,group\n,a\nNA,NA\nnan,na\nNaN,\n\"\",\"NA\"\n1,b\n", kScoreByGroup);
  ASSERT_TRUE(read) << read.error().text;
  const auto& scores = read->table.values.at(0).values;
  ASSERT_EQ(scores.size(), 6U);
  EXPECT_EQ(std::count_if(scores.begin(), scores.end(), [](double one) { return std::isnan(one); }), 5);
  EXPECT_EQ(scores.back(), 1.0);
  EXPECT_EQ(read->table.group, (Lines{"a", "", "", "", "", "b"}));
}

TEST(TableCsv, ALineIsTheSameHoweverItEnds) {
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    EXPECT_EQ(scores_in("score" + end + "1" + end + "2" + end), (std::vector{1.0, 2.0}));
    EXPECT_EQ(scores_in("score" + end + "1" + end + end + "  " + end + "2"), (std::vector{1.0, 2.0}));
  }
}

TEST(TableCsv, NothingButAHeaderOrNothingAtAllIsATableWithoutRows) {
  for (const char* text : {"", "\n\n", "\xef\xbb\xbf", "score,group", "score,group\n", " \r\n"}) {
    const auto read = table_in_csv(text, kScoreByGroup);
    ASSERT_TRUE(read) << read.error().text;
    EXPECT_EQ(read->table.rows, 0U);
    EXPECT_EQ(read->table.values.size(), 1U);
  }
}

TEST(TableCsv, SemicolonsAndTabsSeparateWhereTheHeaderLeavesNoDoubt) {
  EXPECT_EQ(scores_in("group;score\na;1.5\n\"b;c\";2\n"), (std::vector{1.5, 2.0}));
  EXPECT_EQ(scores_in("group\tscore\na, b\t1.5\n"), (std::vector{1.5}));
  EXPECT_EQ(scores_in("\"a,b\";score\nx;1\n"), (std::vector{1.0}));
  EXPECT_EQ(scores_in("score,a;b\n1,x;y\n"), (std::vector{1.0}));
  // Semicolons and tabs: neither is certain.
  EXPECT_EQ(faults_in("score;group\tx\n1;2\t3\n"),
            (Lines{"there is no column \"score\" among the 1 of the header",
                   "there is no column \"group\" among the 1 of the header"}));
}

TEST(TableCsv, NumbersOfEverySizeKeepTheirBits) {
  const std::vector<double> scores =
      scores_in("score\n0.1\n1e300\n-1e300\n4.9406564584124654e-324\n1e-320\n-0\n1.7976931348623157e308\n");
  EXPECT_EQ(scores,
            (std::vector{0.1, 1e300, -1e300, 4.9406564584124654e-324, 1e-320, -0.0, 1.7976931348623157e308}));
  EXPECT_TRUE(std::signbit(scores.at(5)));
}

TEST(TableCsv, TellsEveryFault) {
  EXPECT_EQ(faults_in("score,group,score\n1,2,3\n"), Lines{"column \"score\" occurs twice"});
  EXPECT_EQ(faults_in("a,b\n1,2\n"), (Lines{"there is no column \"score\" among the 2 of the header",
                                            "there is no column \"group\" among the 2 of the header"}));
  EXPECT_EQ(
      faults_in("score,group\n1\n1,a,b\nx,a\n1e999,a\ninf,a\n1 2,a\n0x10,a\nTRUE,a\n"),
      (Lines{"row 1 has 1 cells, the header 2", "row 2 has 3 cells, the header 2",
             "row 3, column \"score\" holds no finite number", "row 4, column \"score\" holds no finite number",
             "row 5, column \"score\" holds no finite number", "row 6, column \"score\" holds no finite number",
             "row 7, column \"score\" holds no finite number", "row 8, column \"score\" holds no finite number"}));
  EXPECT_EQ(faults_in("score;group\n1,5;a\n"), Lines{"row 1, column \"score\" has a decimal comma: use a point"});
  EXPECT_EQ(faults_in("score,group\n1,\"a\n2,b\n"), Lines{"after row 0, a quotation mark is not closed"});
  EXPECT_EQ(faults_in("score,group\n1,a\n2,\"a\"b\n"),
            Lines{"after row 1, there is something between a closing quotation mark and the end of its cell"});
  EXPECT_EQ(faults_in("score,group\n1,5'10\"\n"),
            Lines{"after row 0, there is a quotation mark within a cell that does not begin with one"});
  EXPECT_EQ(faults_in("\"score,group\n"), Lines{"in the header, a quotation mark is not closed"});
  for (const std::string& binary : {std::string("score,group\n1,\0\n", 16), std::string("score,group\n1,\xe9\n"),
                                    std::string("\xff\xfes\0c\0", 6), std::string("\x89PNG\r\n\x1a\n")})
    EXPECT_EQ(faults_in(binary), Lines{"it is not UTF-8 text"});
  std::string many = "score,group\n";
  for (int i = 0; i < 100; ++i) many += "?,?\n";
  EXPECT_EQ(faults_in(many).size(), 10U);
}

TEST(TableCsv, NoCellIsInAnError) {
  for (const char* text :
       {"score,group\nJaneDoe,a\n", "score,group\n1,a,JaneDoe\n", "JaneDoe,group\n1,a\n",
        "score,group\n1,\"JaneDoe\n", "score,group\n1,JaneDoe\"\n", "score;group\nJaneDoe,1;a\n"}) {
    const Lines faults = faults_in(text);
    EXPECT_FALSE(faults.empty()) << text;
    for (const std::string& one : faults) EXPECT_EQ(one.find("Jane"), std::string::npos) << one;
  }
}

TEST(TableCsv, LabelsThatLookAlikeAreToldAndKept) {
  const auto notes_of = [](const std::string& labels) {
    const auto read = table_in_csv("score,group\n" + labels, kScoreByGroup);
    EXPECT_TRUE(read) << labels;
    return read ? read->notes.size() : 99U;
  };
  EXPECT_EQ(notes_of("1,novice\n2,expert\n3,novice\n"), 0U);
  EXPECT_EQ(notes_of("1,novice\n2,Novice\n"), 1U);
  EXPECT_EQ(notes_of("1,novice\n2,\"novice \"\n"), 1U);
  EXPECT_EQ(notes_of("1,novice\n2,n\u043evice\n"), 1U);
  EXPECT_EQ(notes_of("1,novice\n2,novice\u200b\n"), 1U);
  EXPECT_EQ(notes_of("1,novice\n2,novice   \n"), 0U);  // blanks beside a cell are not of it
  EXPECT_EQ(as_seen(" \u0391\u0421e "), "ace");
}

TEST(TableCsv, ConditionsSideBySideAreStackedByPerson) {
  const auto read = table_in_csv("who,before,after\nann,1,2\nbob,,4\n", {{"before", "after"}, "", "who", "", ""});
  ASSERT_TRUE(read);
  const auto table = stacked(read->table);
  EXPECT_EQ(table.rows, 4U);
  EXPECT_EQ(table.values.at(0).values.at(0), 1.0);
  EXPECT_TRUE(std::isnan(table.values.at(0).values.at(1)));
  EXPECT_EQ(table.values.at(0).values.at(3), 4.0);
  EXPECT_EQ(table.group, (Lines{"before", "before", "after", "after"}));
  EXPECT_EQ(table.subject, (Lines{"ann", "bob", "ann", "bob"}));
  const auto nameless = table_in_csv("before,after\n1,2\n3,4\n", {{"before", "after"}, "", "", "", ""});
  ASSERT_TRUE(nameless);
  EXPECT_EQ(stacked(nameless->table).subject, (Lines{"1", "2", "1", "2"}));
}

TEST(TableCsv, NamesOfColumnsAreAHeadersCells) {
  EXPECT_EQ(column_names("a"), Lines{"a"});
  EXPECT_EQ(column_names("a, b c,\"d,e\""), (Lines{"a", "b c", "d,e"}));
  for (const char* wrong : {"", ",", "a,", "\"a", "a\nb"}) EXPECT_EQ(column_names(wrong), Lines{}) << wrong;
}

// Whatever the bytes are: read or refused, with as many numbers as rows.
TEST(TableCsv, BytesOfEveryKindAreReadOrRefused) {
  const std::string alphabet = "\"\",,;\t\n\r 1a.-eNAscore\xc3\xa9";
  base::Rng random(7);
  int read = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string text = i % 2 == 0 ? "score,group\n" : "";
    for (auto left = random.bits() % 24; left > 0; --left) text += alphabet[random.bits() % alphabet.size()];
    const auto table = table_in_csv(text, kScoreByGroup);
    if (!table) continue;
    ++read;
    ASSERT_EQ(table->table.values.at(0).values.size(), table->table.rows);
    ASSERT_TRUE(table->table.group.size() == table->table.rows);
  }
  EXPECT_GT(read, 1000);
  EXPECT_LT(read, 19000);
}

TEST(TableCsv, FourTimesTheRowsTakeFourTimesAsLongNotSixteen) {
  const auto processor_s = [](int rows) {
    std::string text = "score,group,person\n";
    for (int i = 0; i < rows; ++i)
      text += std::to_string(i * 0.37) + ",\"group " + std::to_string(i % 3) + "\",p" + std::to_string(i) + "\n";
    const std::clock_t begin = std::clock();
    const auto read = table_in_csv(text, {{"score"}, "group", "person", "", ""});
    const auto took = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    EXPECT_TRUE(read && read->table.rows == static_cast<std::size_t>(rows));
    return took;
  };
  processor_s(5000);  // what a first time costs
  const double few_s = processor_s(5000), many_s = processor_s(20000);
  EXPECT_LT(many_s, 8.0 * few_s) << many_s << " s of the processor, " << few_s << " for a quarter of the rows";
}

}  // namespace
}  // namespace seldinger::app
