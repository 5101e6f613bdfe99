// The raw export's CSV: the grammar, bits of numbers, formulas, and that dictionary and files say the same.
#include "reports/export/raw_tables.h"

#include <gtest/gtest.h>

#include <bit>
#include <charconv>
#include <limits>
#include <random>
#include <set>

#include "assessment/registry.h"
#include "casedb/attempts/condition_table.h"
#include "tests/fixtures/csv_table.h"
#include "tests/reports/sample_attempt.h"

namespace seldinger::reports {
namespace {

using fixtures::csv_table;

double read_back(const std::string& text) {
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

TEST(CsvLine, NumbersReadBackBitForBit) {
  std::mt19937_64 bits(3);
  for (int i = 0; i < 20'000; ++i) {
    const double value = std::bit_cast<double>(std::uint64_t{bits()});
    const std::string line = CsvLine().number(value).take();
    if (!std::isfinite(value)) {
      EXPECT_EQ(line, "\n");
    } else {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(read_back(line)), std::bit_cast<std::uint64_t>(value)) << line;
    }
  }
  EXPECT_EQ(CsvLine().number(-1.23).number(1e300).number(0.1).number(std::nullopt).take(), "-1.23,1e+300,0.1,\n");
}

TEST(CsvLine, TextIsQuotedAndNoFormula) {
  EXPECT_EQ(CsvLine().text("a").text("a,b").text("a\"b").text("a\nb").text("").take(),
            "a,\"a,b\",\"a\"\"b\",\"a\nb\",\n");
  for (const std::string start : {"=", "+", "-", "@", "\t", "\r"}) {
    const auto cell = csv_table("x\n" + CsvLine().text(start + "HYPERLINK(\"http://x\",1)").take()).cell(0, "x");
    EXPECT_EQ(cell, "'" + start + "HYPERLINK(\"http://x\",1)");
  }
  EXPECT_EQ(CsvLine().text(std::string_view("\0x", 2)).take(), std::string("'\0x\n", 4));
  // What a spreadsheet sees after unquoting must not begin with one either.
  EXPECT_EQ(CsvLine().text("=1,2").take(), "\"'=1,2\"\n");
}

TEST(CsvLine, LinesAreReadAgain) {
  std::mt19937_64 bits(5);
  constexpr std::string_view kLetters = "ab,\"\n=' \r";
  std::string text;
  std::vector<std::vector<std::string>> written;
  for (int row = 0; row < 2'000; ++row) {
    CsvLine line;
    std::vector<std::string>& cells = written.emplace_back();
    for (std::uint64_t i = bits() % 4 + 1; i > 0; --i) {
      std::string& cell = cells.emplace_back("x");  // no formula
      for (std::uint64_t k = bits() % 5; k > 0; --k) cell += kLetters[bits() % kLetters.size()];
      line.text(cell);
    }
    text += line.take();
  }
  std::string_view rest = text;
  std::vector<std::string> cells;
  for (const auto& row : written) {
    ASSERT_TRUE(next_csv_line(rest, cells));
    ASSERT_EQ(cells, row);
  }
  EXPECT_FALSE(next_csv_line(rest, cells));
}

TEST(RawTables, DictionaryAndHeadersSayTheSame) {
  const auto dictionary = csv_table(data_dictionary());
  std::map<std::string, std::vector<std::string>> described;
  for (std::size_t i = 0; i < dictionary.rows.size(); ++i) {
    described[dictionary.cell(i, "file")].push_back(dictionary.cell(i, "column"));
    EXPECT_FALSE(dictionary.cell(i, "description").empty()) << dictionary.cell(i, "column");
    const std::string type = dictionary.cell(i, "type");
    EXPECT_TRUE((std::set<std::string>{"text", "number", "integer", "flag"}).contains(type)) << type;
  }
  const std::map<std::string, std::string> headers = {{"attempts.csv", attempts_header()},
                                                      {"metrics.csv", header_of(metric_columns())},
                                                      {"steps.csv", header_of(step_columns())},
                                                      {"events.csv", header_of(event_columns())},
                                                      {"facts.csv", header_of(fact_columns())},
                                                      {"poses/ATTEMPT.csv", header_of(pose_columns())},
                                                      {"forces/ATTEMPT.csv", header_of(force_columns())},
                                                      {"frames/ATTEMPT.csv", header_of(frame_columns())}};
  EXPECT_EQ(described.size(), headers.size());
  for (const auto& [file, header] : headers) {
    const auto columns = csv_table(header).header;
    EXPECT_EQ(described[file], columns) << file;
    EXPECT_EQ(std::set<std::string>(columns.begin(), columns.end()).size(), columns.size()) << file;
  }
}

TEST(RawTables, TheDictionarySaysHowAMetricIsCompared) {
  const auto dictionary = csv_table(data_dictionary());
  int metrics = 0;
  for (std::size_t i = 0; i < dictionary.rows.size(); ++i) {
    const bool metric = !dictionary.cell(i, "version").empty();
    metrics += metric ? 1 : 0;
    for (const char* column : {"better", "scale", "without_endpoint", "of_a_person"})
      EXPECT_EQ(dictionary.cell(i, column).empty(), !metric) << dictionary.cell(i, "column");
    if (dictionary.cell(i, "column") != "hit") continue;
    EXPECT_EQ(dictionary.cell(i, "better"), "higher");
    EXPECT_EQ(dictionary.cell(i, "scale"), "yes or no");
    EXPECT_EQ(dictionary.cell(i, "without_endpoint"), "failure");
    EXPECT_EQ(dictionary.cell(i, "of_a_person"), "proportion");
  }
  EXPECT_EQ(metrics, static_cast<int>(assessment::registry().size()));
}

TEST(RawTables, AMetricOfAnOlderVersionIsNotMixedIn) {
  AttemptView view = sample_attempt();
  const int now = assessment::find_metric("hit")->version;
  view.row.metrics = {{"hit", now + 1, 1.0, "bool", ""}, {"tip_target_dist", 1, 2.5, "mm", ""}};
  casedb::CaseRow of_case;
  of_case.origin = "import";
  AttemptFacts facts;
  facts.names = {"A-1", "C-1", "T-1", std::nullopt};
  facts.row = &view.row;
  facts.of_case = &of_case;
  const auto table = csv_table(attempts_header() + attempt_line(facts));
  EXPECT_EQ(table.cell(0, "hit"), "");
  EXPECT_EQ(table.cell(0, "tip_target_dist"), "2.5");
  EXPECT_EQ(table.cell(0, "person"), "");
  EXPECT_EQ(table.cell(0, "synthetic"), "1");
  EXPECT_EQ(table.cell(0, "operator"), "expert");
  EXPECT_EQ(table.cell(0, "throw_mm"), "");
  EXPECT_EQ(table.cell(0, "target_y_mm"), "-34.54");
}

TEST(RawTables, EachConditionHasItsColumnAndWhatIsNotKnownIsEmpty) {
  AttemptView view = sample_attempt();
  casedb::CaseRow of_case;
  of_case.origin = "import";
  AttemptFacts facts;
  facts.row = &view.row;
  facts.of_case = &of_case;
  const auto written = [&] { return csv_table(attempts_header() + attempt_line(facts)); };
  for (const casedb::ConditionRow& row : casedb::condition_rows()) {
    EXPECT_EQ(written().cell(0, row.id), "") << row.id;
    casedb::Conditions known;
    const casedb::ConditionValue number = row.kind == casedb::ConditionKind::whole ? 3.0 : 0.25;
    const std::string id = row.id;
    const std::string words = id.ends_with("_hand") ? "gamepad" : id == "handedness" ? "left" : "words";
    ASSERT_TRUE(row.write(known, row.kind == casedb::ConditionKind::flag   ? casedb::ConditionValue(false)
                                 : row.kind == casedb::ConditionKind::text ? casedb::ConditionValue(words)
                                                                           : number));
    view.row.conditions = known;
    EXPECT_EQ(written().cell(0, row.id), row.kind == casedb::ConditionKind::flag    ? "0"
                                         : row.kind == casedb::ConditionKind::whole ? "3"
                                         : row.kind == casedb::ConditionKind::text  ? words
                                                                                    : "0.25")
        << row.id;
    view.row.conditions = {};
  }
  EXPECT_EQ(written().cell(0, "away_s"), "");
  view.row.away_s = 12.5;
  EXPECT_EQ(written().cell(0, "away_s"), "12.5");
}

TEST(RawTables, HowLongAPauseWasIsBesideItsEvent) {
  cases::Recording recording;
  recording.events = {{1.0, cases::EventKind::guide_on}, {2.0, cases::EventKind::paused, 41.5}};
  const std::string name = "A-1";
  std::string text = header_of(event_columns());
  for (const RecordedEvent& event : recorded_events(recording))
    text += line_of(event_columns(), EventFact{&name, event});
  const auto table = csv_table(text);
  EXPECT_EQ(table.cell(0, "event"), "guide_on");
  EXPECT_EQ(table.cell(0, "source"), "workstation");
  EXPECT_EQ(table.cell(0, "wall_s"), "");
  EXPECT_EQ(table.cell(1, "event"), "paused");
  EXPECT_EQ(table.cell(1, "wall_s"), "41.5");
}

TEST(RawTables, SomebodysOwnWordsAreNotWritten) {
  AttemptView view = sample_attempt();
  view.row.operator_name = "Jane Doe";
  casedb::CaseRow of_case;
  of_case.title = "Mr Miller's liver";
  AttemptFacts facts;
  facts.row = &view.row;
  facts.of_case = &of_case;
  const std::string line = attempt_line(facts);
  for (const char* word : {"Jane", "Miller", "Liver"}) EXPECT_EQ(line.find(word), std::string::npos) << word;
  EXPECT_EQ(csv_table(attempts_header() + line).cell(0, "operator"), "custom");
}

TEST(RawTables, TheEndpointIsARowOfItsOwnTime) {
  cases::Recording recording;
  for (int i = 0; i < 4; ++i) {
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = {1.0 * i, 0.0, 0.0};
    pose.probe_origin_lps_mm = {0.0, 1.0 * i, 0.0};
    recording.poses.push_back(pose);
  }
  const std::string name = "A-1";
  const auto fired_at = [&](double t_s) {
    recording.endpoint = cases::Endpoint{t_s, {9.0, 9.0, 9.0}, {0.0, 1.0, 0.0}};
    const auto facts = pose_facts(name, recording);
    std::vector<std::size_t> at;
    for (std::size_t i = 0; i < facts.size(); ++i)
      if (facts[i].fire) at.push_back(i);
    EXPECT_EQ(at.size(), 1U);
    EXPECT_EQ(facts[at.front()].pose.t_s, t_s);
    EXPECT_EQ(facts[at.front()].pose.tip_lps_mm, glm::dvec3(9.0));
    return std::pair(facts.size(), facts[at.front()].pose.probe_origin_lps_mm.y);
  };
  EXPECT_EQ(fired_at(0.015), (std::pair<std::size_t, double>(5, 1.0)));  // between two: the probe stays
  EXPECT_EQ(fired_at(recording.poses[2].t_s), (std::pair<std::size_t, double>(4, 2.0)));
  EXPECT_EQ(fired_at(0.2), (std::pair<std::size_t, double>(5, 3.0)));
  recording.endpoint.reset();
  EXPECT_EQ(pose_facts(name, recording).size(), 4U);
}

}  // namespace
}  // namespace seldinger::reports
