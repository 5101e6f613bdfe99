// The raw export as a researcher makes and reads it: files, names, bits, and a pose file scored again.
#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/csv_table.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::csv_table;
using fixtures::run;
using fixtures::whole_file;
namespace fs = std::filesystem;

using fixtures::kProgram;

// One library for all: the torso by ultrasound and by fluoroscopy, what people wrote everywhere it can stand.
struct Made {
  fs::path scratch = fixtures::fresh_folder("raw_export");
  std::string library = (scratch / "library").string();
  std::vector<Json> attempts;
  std::vector<std::string> planted = {"Zebedee", "HYPERLINK", "Quagmire"};
  std::string case_id, xray_case_id;

  fixtures::Ran command(const std::string& words) const {
    return run(kProgram + " " + words + " --library " + library, scratch);
  }
  Json answer(const std::string& words) const {
    const auto ran = command(words + " --json");
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  }
  Made() {
    case_id = fixtures::demo_library("", library).at("case_id").get<std::string>();
    xray_case_id = answer("demo --no-serve --modality xray").at("case_id").get<std::string>();
    const Json written = answer("import " + fixtures::shared_data_dir().string() +
                                "/ct-abdomen-pelvis/abdomen_pelvis_2x.mha --title '=HYPERLINK(\"Quagmire\")'");
    const std::string ct = written.at("case_id").get<std::string>();
    EXPECT_EQ(command("case lesion " + ct + " --center-mm 63,77,-620 --radius-mm 8 --hu 60").exit_code, 0);
    EXPECT_EQ(command("simulate --operator expert --seed 2 --case " + ct).exit_code, 0);
    EXPECT_EQ(
        run("echo a-long-password | " + kProgram + " user add Zebedee --role mentor --library " + library, scratch)
            .exit_code,
        0);
    std::ofstream(scratch / "own.json") << R"({"name": "=HYPERLINK Quagmire", "scan_s": 0.5})";
    EXPECT_EQ(
        command("simulate --case " + case_id + " --seed 5 --operator " + (scratch / "own.json").string()).exit_code,
        0);
    const Json listed = answer("attempt list");
    for (const Json& one : listed.at("attempts"))
      attempts.push_back(answer("attempt show " + one.at("attempt_id").get<std::string>()));
    for (const Json& attempt : attempts)
      for (const char* id : {"attempt_id", "case_id", "lesion_id", "person_id"})
        if (attempt.at(id).is_string()) planted.push_back(attempt.at(id).get<std::string>());
    for (const Json& attempt : attempts)
      planted.push_back(std::to_string(attempt.at("started_us").get<std::int64_t>() / 1'000'000));
  }
  std::string at(const std::string& name) const { return (scratch / name).string(); }
};

Made& made() {
  static Made one;
  return one;
}

double number(const std::string& text) {
  double value = std::nan("");
  const auto end = std::from_chars(text.data(), text.data() + text.size(), value).ptr;
  EXPECT_EQ(end, text.data() + text.size()) << text;
  return value;
}

// The exported attempt of a stored one: what is measured tells.
std::size_t row_of(const fixtures::CsvTable& attempts, const Json& stored) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < attempts.rows.size(); ++i)
    if (number(attempts.cell(i, "time_total")) == fixtures::metric(stored, "time_total") &&
        number(attempts.cell(i, "path_tip")) == fixtures::metric(stored, "path_tip"))
      found.push_back(i);
  EXPECT_EQ(found.size(), 1U);
  return found.empty() ? 0 : found.front();
}

TEST(RawExport, EveryNumberIsTheStoredOneBitForBit) {
  SELDINGER_NEEDS_SHARED_DATA();
  const Json told = made().answer("export --out " + made().at("all"));
  ASSERT_EQ(told.at("attempts"), made().attempts.size());
  const auto attempts = csv_table(whole_file(made().at("all/attempts.csv")));
  const auto metrics = csv_table(whole_file(made().at("all/metrics.csv")));
  ASSERT_EQ(attempts.rows.size(), made().attempts.size());
  EXPECT_EQ(told.at("metrics"), metrics.rows.size());
  std::map<std::pair<std::string, std::string>, std::size_t> long_row;
  for (std::size_t i = 0; i < metrics.rows.size(); ++i)
    long_row[{metrics.cell(i, "attempt"), metrics.cell(i, "metric")}] = i;
  int values = 0, reasons = 0;
  for (const Json& stored : made().attempts) {
    const std::size_t row = row_of(attempts, stored);
    EXPECT_EQ(attempts.cell(row, "modality"), stored.at("modality"));
    EXPECT_EQ(number(attempts.cell(row, "duration_s")), stored.at("duration_s").get<double>());
    EXPECT_EQ(attempts.cell(row, "synthetic"), "1");
    for (const Json& metric : stored.at("metrics")) {
      const std::string id = metric.at("id").get<std::string>(), wide = attempts.cell(row, id);
      const std::size_t at = long_row.at({attempts.cell(row, "attempt"), id});
      EXPECT_EQ(metrics.cell(at, "value"), wide) << id;
      EXPECT_EQ(metrics.cell(at, "unit"), metric.at("unit"));
      EXPECT_EQ(metrics.cell(at, "current"), "1");
      if (metric.at("value").is_null()) {
        EXPECT_EQ(wide, "");
        EXPECT_EQ(metrics.cell(at, "reason"), metric.at("reason"));
        ++reasons;
      } else {
        EXPECT_EQ(number(wide), metric.at("value").get<double>()) << id;
        EXPECT_EQ(metrics.cell(at, "reason"), "");
        ++values;
      }
    }
  }
  const auto steps = csv_table(whole_file(made().at("all/steps.csv")));
  std::map<std::string, int> states, of_attempt;
  for (std::size_t i = 0; i < steps.rows.size(); ++i) {
    ++states[steps.cell(i, "state")];
    ++of_attempt[steps.cell(i, "attempt")];
    EXPECT_EQ(steps.cell(i, "state") == "not_asked", !steps.cell(i, "reason").empty());
    if (!steps.cell(i, "t_s").empty()) number(steps.cell(i, "t_s"));
  }
  EXPECT_EQ(of_attempt.size(), made().attempts.size());
  for (const char* state : {"done", "skipped", "not_asked"}) EXPECT_GT(states[state], 0) << state;
  EXPECT_GT(values, 100);
  EXPECT_GT(reasons, 50);
}

TEST(RawExport, HoldsNothingThatIdentifies) {
  SELDINGER_NEEDS_SHARED_DATA();
  ASSERT_EQ(made().command("export --out " + made().at("scanned")).exit_code, 0);
  std::size_t files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(made().at("scanned"))) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const std::string text = entry.path().filename().string() + "\n" + whole_file(entry.path());
    for (const std::string& word : made().planted)
      EXPECT_EQ(text.find(word), std::string::npos) << word << " in " << entry.path().filename();
  }
  EXPECT_GT(files, 10U);
  // The scan finds what is there: the library itself has each of them.
  std::string all;
  for (const char* name :
       {"seldinger.sqlite", "seldinger.sqlite-wal", "identities.sqlite", "identities.sqlite-wal"})
    all += whole_file(fs::path(made().library) / name);
  EXPECT_NE(all.find(made().planted[0]), std::string::npos);
  EXPECT_NE(all.find(made().attempts[0].at("attempt_id").get<std::string>()), std::string::npos);
}

// Before: three people, of whom nobody had consented; `demo` simulates in somebody's name.
TEST(RawExport, WhatWasSimulatedIsNobodysAlsoInSomebodysName) {
  SELDINGER_NEEDS_SHARED_DATA();
  EXPECT_TRUE(std::any_of(made().attempts.begin(), made().attempts.end(),
                          [](const Json& one) { return one.at("person_id").is_string(); }));
  ASSERT_EQ(made().command("export --raw none --out " + made().at("tables")).exit_code, 0);
  const auto attempts = csv_table(whole_file(made().at("tables/attempts.csv")));
  ASSERT_EQ(attempts.rows.size(), made().attempts.size());
  for (std::size_t i = 0; i < attempts.rows.size(); ++i) {
    EXPECT_EQ(attempts.cell(i, "synthetic"), "1");
    for (const char* column : {"person", "person_attempt", "days_since_first"})
      EXPECT_EQ(attempts.cell(i, column), "") << column;
  }
  std::set<std::string> files;
  for (const auto& entry : fs::directory_iterator(made().at("tables"))) files.insert(entry.path().filename());
  EXPECT_EQ(files,
            (std::set<std::string>{"attempts.csv", "metrics.csv", "steps.csv", "facts.csv", "data_dictionary.csv",
                                   "datapackage.json", "redcap_dictionary.csv", "README.txt"}));
}

TEST(RawExport, NamesAreOfOneExportUnlessThereIsAKey) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto names = [](const std::string& folder, const char* column) {
    std::set<std::string> all;
    const auto table = csv_table(whole_file(made().at(folder + "/attempts.csv")));
    for (std::size_t i = 0; i < table.rows.size(); ++i) all.insert(table.cell(i, column));
    all.erase("");
    return all;
  };
  const std::string key = " --key " + made().at("trial.key");
  for (const char* words : {"one", "two"})
    ASSERT_EQ(made().command("export --raw none --out " + made().at(words)).exit_code, 0);
  for (const char* words : {"three", "four"})
    ASSERT_EQ(made().command("export --raw events --out " + made().at(words) + key).exit_code, 0);
  for (const char* column : {"attempt", "case", "target"}) {
    const auto one = names("one", column);
    EXPECT_GT(one.size(), 1U) << column;
    for (const std::string& name : names("two", column)) EXPECT_FALSE(one.contains(name)) << name;
  }
  EXPECT_EQ(whole_file(made().at("three/attempts.csv")), whole_file(made().at("four/attempts.csv")));
  EXPECT_EQ(whole_file(made().at("three/events.csv")), whole_file(made().at("four/events.csv")));
  EXPECT_GT(csv_table(whole_file(made().at("three/events.csv"))).rows.size(), made().attempts.size());
}

TEST(RawExport, APoseFileScoresAsTheStoredAttempt) {
  SELDINGER_NEEDS_SHARED_DATA();
  ASSERT_EQ(made().command("export --out " + made().at("scored") + " --case " + made().case_id).exit_code, 0);
  const auto attempts = csv_table(whole_file(made().at("scored/attempts.csv")));
  int compared = 0;
  for (const Json& stored : made().attempts) {
    if (stored.at("case_id") != made().case_id) continue;
    const std::size_t row = row_of(attempts, stored);
    const auto value = [&](const char* column) { return number(attempts.cell(row, column)); };
    const Json scene = {{"volume", {{"case", made().case_id}}},
                        {"needle",
                         {{"tip_mm", {0, 0, 0}},
                          {"direction", {0, 0, 1}},
                          {"length_mm", value("needle_length_mm")},
                          {"radius_mm", value("needle_radius_mm")},
                          {"instrument", attempts.cell(row, "instrument")}}},
                        {"lesions",
                         {{{"center_mm", {value("target_x_mm"), value("target_y_mm"), value("target_z_mm")}},
                           {"radius_mm", value("target_radius_mm")},
                           {"hu", 20}}}}};
    std::ofstream(made().at("scene.json")) << scene;
    const std::string name = attempts.cell(row, "attempt");
    const Json scored = made().answer("score --poses " + made().at("scored/poses/" + name + ".csv") + " --scene " +
                                      made().at("scene.json"));
    for (const char* id : {"hit", "tip_target_dist", "tip_target_surface", "tip_target_axial", "tip_target_lateral",
                           "closest_approach", "skin_punctures", "withdrawals_partial", "withdrawals_full",
                           "path_tip", "path_in_tissue", "path_inefficiency", "swept_area", "ldlj", "time_total",
                           "time_in_tissue", "time_puncture_to_target"}) {
      EXPECT_EQ(fixtures::metric(scored, id), fixtures::metric(stored, id)) << id;
      ++compared;
    }
    const auto frames = csv_table(whole_file(made().at("scored/frames/" + name + ".csv")));
    EXPECT_GT(frames.rows.size(), 100U);
    EXPECT_EQ(frames.cell(0, "kv"), "");
    EXPECT_NE(frames.cell(0, "tip_within_2_mm"), "");
    EXPECT_GT(csv_table(whole_file(made().at("scored/forces/" + name + ".csv"))).rows.size(), 100U);
  }
  EXPECT_EQ(compared, 4 * 17);
}

TEST(RawExport, RefusesAndLeavesNothing) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto before = fixtures::fingerprint(made().library);
  const auto refused = [&](const std::string& words, const std::string& code) {
    const auto ran = made().command("export " + words);
    EXPECT_EQ(ran.exit_code, 3) << words;
    EXPECT_EQ(ran.err.rfind("error: " + code + ": ", 0), 0U) << ran.err;
  };
  fs::create_directory(made().at("there"));
  refused("--out " + made().at("there"), "exists");
  refused("--out " + made().at("none") + " --case " + std::string(36, '0') + " --key " + made().at("new.key"),
          "no_case");
  EXPECT_FALSE(fs::exists(made().at("new.key")));
  EXPECT_EQ(made().command("export --raw everything --out " + made().at("none")).exit_code, 2);
  EXPECT_EQ(made().command("export").exit_code, 2);
  EXPECT_FALSE(fs::exists(made().at("none")));
  EXPECT_FALSE(fs::exists(made().at("none.unfinished")));
  EXPECT_TRUE(fs::is_empty(made().at("there")));
  EXPECT_EQ(fixtures::fingerprint(made().library), before);
}

// The page's own lines run, and it names the files that there are.
TEST(RawExport, TheDocumentSaysWhatHappens) {
  SELDINGER_NEEDS_SHARED_DATA();
  const std::string page = whole_file(fixtures::source_dir() / "docs" / "export.md");
  std::istringstream lines(page);
  std::set<std::string> named;
  int commands = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("| `", 0) == 0) named.insert(line.substr(3, line.find('`', 3) - 3));
    if (line.rfind("seldinger ", 0) != 0) continue;
    for (const auto& [shown, real] : {std::pair<std::string, std::string>("seldinger ", kProgram + " "),
                                      {"/srv/seldinger", made().library},
                                      {"/export/", made().at("page_")},
                                      {"/keys/", made().at("page_")}})
      if (const std::size_t from = line.find(shown); from != std::string::npos)
        line.replace(from, shown.size(), real);
    const auto ran = run(line, made().scratch);
    EXPECT_EQ(ran.exit_code, 0) << line << "\n" << ran.err;
    ++commands;
  }
  EXPECT_EQ(commands, 2);
  std::set<std::string> there = {"poses/ATTEMPT.csv", "forces/ATTEMPT.csv", "frames/ATTEMPT.csv"};
  for (const auto& entry : fs::directory_iterator(made().at("page_monday")))
    if (entry.is_regular_file()) there.insert(entry.path().filename());
  EXPECT_EQ(named, there);
}

}  // namespace
}  // namespace seldinger
