// Paper typed twice: what is a file and what is none, and every place in which two entries differ.
#include "app/questionnaires/paper_csv.h"

#include <gtest/gtest.h>

#include "assessment/questionnaire/form.h"

namespace seldinger::app {
namespace {

assessment::questionnaire::Form short_form() {
  return *assessment::questionnaire::form_from_json(
      R"({"id": "short", "version": 2, "language": "en", "title": "Short",
          "scales": [{"id": "s", "points": [{"value": 1, "label": "no"}, {"value": 2}, {"value": 3, "label": "yes"}]}],
          "items": [{"id": "a", "text": "A", "kind": "scale", "scale": "s", "not_applicable": true},
                    {"id": "b", "text": "B", "kind": "number", "least": 0, "most": 9},
                    {"id": "c", "text": "C", "kind": "comment"}]})");
}

std::string refused(const std::string& csv) {
  const auto papers = paper_forms_in_csv(csv, short_form());
  EXPECT_FALSE(papers.has_value()) << csv;
  return papers ? "" : papers.error().code;
}

TEST(PaperCsv, IsReadAsSpreadsheetsWriteIt) {
  for (const char* csv : {"respondent,version,a,b,c\nP1,2,n/a,,\"good, \"\"very\"\"\"\n",
                          "\xEF\xBB\xBFrespondent;version;a;b;c\r\nP1;2;n/a;;\"good, \"\"very\"\"\"\r\n",
                          "c,b,a,version,respondent\n\"good, \"\"very\"\"\",,n/a,2,P1\n"}) {
    const auto papers = paper_forms_in_csv(csv, short_form());
    ASSERT_TRUE(papers.has_value()) << csv;
    ASSERT_EQ(papers->size(), 1U);
    EXPECT_EQ((*papers)[0].respondent.code, "P1");
    EXPECT_EQ((*papers)[0].typed,
              (std::map<std::string, std::string>{{"a", "n/a"}, {"b", ""}, {"c", "good, \"very\""}}));
  }
}

TEST(PaperCsv, IsRefusedWhereItIsNone) {
  for (const char* csv :
       {"", "respondent,version,a,b\nP1,2,1,1\n", "respondent,version,a,b,c,d\nP1,2,1,1,x,y\n",
        "respondent,version,a,b,c,c\nP1,2,1,1,x,y\n", "version,a,b,c\n2,1,1,x\n", "respondent,a,b,c\nP1,1,1,x\n",
        "respondent,version,a,b,c\n", "respondent,version,a,b,c\nP1,2,1,1\n",
        "respondent,version,a,b,c\nP1,2,1,1,x\nP1,2,1,1,x\n", "respondent,version,a,b,c\nP1,2,1,1,\"x\n"})
    EXPECT_EQ(refused(csv), "bad_csv") << csv;
  EXPECT_EQ(refused("respondent,version,a,b,c\nP1,1,1,1,x\n"), "bad_csv") << "paper of an older version";
}

TEST(PaperCsv, TellsEveryPlaceInWhichTwoEntriesDiffer) {
  const auto entry = [](const char* rows) {
    return *paper_forms_in_csv(std::string("respondent,version,group,a,b,c\n") + rows, short_form());
  };
  const auto first = entry("P1,2,x,1,4,good\nP2,2,x,2,,\nP3,2,x,3,1,\n");
  EXPECT_TRUE(
      entry_differences(first, entry("P3,2,x,3,1,\nP1,2,x,1,4.0, good\nP2,2,x,2,,\n"), short_form()).empty())
      << "the order does not count, nor how a number is written";
  const auto found = entry_differences(first, entry("P1,2,y,2,4,Good\nP2,2,x,2,n/a,\nP4,2,x,3,1,\n"), short_form());
  std::vector<std::string> words;
  for (const EntryDifference& one : found)
    words.push_back(one.respondent + " " + one.column + " " + one.first + "|" + one.second);
  EXPECT_EQ(words, (std::vector<std::string>{"P1 group x|y", "P1 a 1|2", "P1 c good|Good", "P2 b |n/a",
                                             "P3 respondent P3|", "P4 respondent |P4"}));
}

}  // namespace
}  // namespace seldinger::app
