// Tests of `seldinger haptics` as its user types it: columns, signs, figures and refusals (docs/commands.md).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using fixtures::kProgram;

struct Row {
  double t_s, depth_mm, force_n;
};

std::vector<Row> inserted(const std::string& options) {
  const auto scratch = fixtures::fresh_folder("haptics_insert");
  const auto file = scratch / "force.csv";
  const auto ran =
      fixtures::run(kProgram + " haptics insert " + options + " --out '" + file.string() + "'", scratch);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_TRUE(ran.out.empty() && ran.err.empty()) << ran.out << ran.err;
  std::istringstream lines(fixtures::whole_file(file));
  std::string line;
  std::getline(lines, line);
  EXPECT_EQ(line, "t_s,depth_mm,force_axial_n");
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    Row row{NAN, NAN, NAN};
    EXPECT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf", &row.t_s, &row.depth_mm, &row.force_n), 3) << line;
    rows.push_back(row);
  }
  return rows;
}

TEST(HapticsInsert, WritesTheThesisKidney) {
  const auto rows = inserted("--tissue kidney --speed-mm-s 8.333333 --depth-mm 60 --hold-s 1 --retract");
  ASSERT_GT(rows.size(), 15000U);
  double peak = 0.0, peak_mm = 0.0, squares = 0.0;
  int plateau = 0, back = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(rows[i].t_s, 0.001 * static_cast<double>(i), 1e-9) << "one row per ms";
    if (rows[i].force_n > peak) {
      peak = rows[i].force_n;
      peak_mm = rows[i].depth_mm;
    }
    const bool in = i > 0 && rows[i].depth_mm > rows[i - 1].depth_mm;
    const bool out = i > 0 && rows[i].depth_mm < rows[i - 1].depth_mm;
    if (in && rows[i].depth_mm > 13.0) {
      squares += std::pow(rows[i].force_n - (0.010 * rows[i].depth_mm + 1.53), 2);
      ++plateau;
    }
    if (out && rows[i].depth_mm < 45.0) {
      EXPECT_LE(rows[i].force_n, 0.005) << "only friction pulls back";
      EXPECT_GE(rows[i].force_n, -0.010 * rows[i].depth_mm - 0.005);
      ++back;
    }
  }
  EXPECT_EQ(rows.front().depth_mm, 0.0);
  EXPECT_EQ(rows.front().force_n, 0.0);
  EXPECT_LT(peak, 3.3);
  EXPECT_NEAR(peak_mm, 10.0, 0.5);
  ASSERT_GT(plateau, 1000);
  EXPECT_LE(std::sqrt(squares / plateau), 0.065);
  EXPECT_GT(back, 1000);
  EXPECT_EQ(rows.back().depth_mm, 0.0);
}

TEST(HapticsInsert, RefusesWhatIsNoInsertionAndWritesNothing) {
  const auto scratch = fixtures::fresh_folder("haptics_refused");
  const std::string out = " --out '" + (scratch / "x.csv").string() + "'";
  for (const char* words :
       {"--tissue glass --speed-mm-s 1 --depth-mm 5", "--tissue bone --speed-mm-s 1 --depth-mm 5",
        "--speed-mm-s 1 --depth-mm 5", "--tissue liver --depth-mm 5", "--tissue liver --speed-mm-s 1",
        "--tissue liver --speed-mm-s 0 --depth-mm 5", "--tissue liver --speed-mm-s -1 --depth-mm 5",
        "--tissue liver --speed-mm-s nan --depth-mm 5", "--tissue liver --speed-mm-s 1e9 --depth-mm 5",
        "--tissue liver --speed-mm-s 1 --depth-mm 1e9", "--tissue liver --speed-mm-s 1 --depth-mm 5 --hold-s -1",
        "--tissue liver --speed-mm-s 1 --depth-mm 5 --gauge 30",
        "--tissue liver --speed-mm-s 1 --depth-mm 5 --tip blunt",
        "--tissue liver --speed-mm-s 1 --depth-mm 5 --touch soft"}) {
    const auto ran = fixtures::run(kProgram + " haptics insert " + words + out, scratch);
    EXPECT_EQ(ran.exit_code, 2) << words;
    EXPECT_EQ(ran.err.rfind("usage: ", 0), 0U) << ran.err;
  }
  for (const char* words : {"--tissue liver --speed-mm-s 1e-9 --depth-mm 5",
                            "--tissue liver --speed-mm-s 1 --depth-mm 5 --hold-s 1e300"}) {
    const auto ran = fixtures::run(kProgram + " haptics insert " + words + out, scratch);
    EXPECT_EQ(ran.exit_code, 3) << words;
    EXPECT_EQ(ran.err.rfind("error: too_long: ", 0), 0U) << ran.err;
  }
  EXPECT_FALSE(std::filesystem::exists(scratch / "x.csv"));
  EXPECT_EQ(fixtures::run(kProgram + " haptics insert --tissue liver --speed-mm-s 1 --depth-mm 5 --out "
                                     "/dev/null/x.csv",
                          scratch)
                .exit_code,
            4);
}

TEST(HapticsNeedles, DrawsEveryTipAndSaysWhereItsNumbersComeFrom) {
  const auto scratch = fixtures::fresh_folder("haptics_needles");
  const auto page = scratch / "needles.html";
  const auto ran =
      fixtures::run(kProgram + " haptics needles --tissue kidney --out '" + page.string() + "'", scratch);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  EXPECT_NE(ran.out.find("bevel    opens at 2.6"), std::string::npos) << ran.out;
  const std::string drawn = fixtures::whole_file(page);
  for (const char* tip : {"bevel", "diamond", "trocar", "core"}) {
    EXPECT_NE(ran.out.find(tip), std::string::npos) << tip;
    EXPECT_NE(drawn.find(tip), std::string::npos) << tip;
  }
  EXPECT_EQ(fixtures::run(kProgram + " haptics needles --tissue kidney", scratch).exit_code, 2);
}

// To renew it: seldinger haptics stability > docs/stability.md
TEST(HapticsStability, HoldsAndIsWhatTheDocumentSays) {
  const auto scratch = fixtures::fresh_folder("haptics_stability");
  const auto page = fixtures::run(kProgram + " haptics stability", scratch);
  EXPECT_EQ(page.exit_code, 0);
  EXPECT_EQ(page.out, fixtures::whole_file(fixtures::source_dir().string() + "/docs/stability.md"));
  const auto answer = fixtures::run(kProgram + " haptics stability --json", scratch);
  EXPECT_EQ(answer.exit_code, 0);
  const auto json = nlohmann::json::parse(answer.out);
  EXPECT_EQ(json.at("holds"), true);
  ASSERT_EQ(json.at("at_rest").size(), 900U);
  for (const auto& row : json.at("at_rest")) EXPECT_EQ(row.at("holds"), true) << row;
  EXPECT_EQ(json.at("walls").size(), 2U * 4U * 5U * 13U);
}

// What the servo says of its own punctuality adds up; how punctual this machine is, nobody asserts.
TEST(HapticsSelftest, AddsUpAndFailsBeyondTheShareAskedFor) {
  const auto scratch = fixtures::fresh_folder("haptics_selftest");
  for (const char* most : {"1", "0"}) {
    const auto ran =
        fixtures::run(kProgram + " haptics selftest --seconds 2 --most-missed " + most + " --json", scratch);
    const auto json = nlohmann::json::parse(ran.out);
    EXPECT_TRUE(ran.err.empty()) << ran.err;
    const double ticks = json.at("ticks"), missed = json.at("missed");
    EXPECT_GE(ticks, 10.0);
    EXPECT_NEAR(json.at("missed_share").get<double>(), missed / (ticks + missed), 1e-12);
    const bool holds = missed / (ticks + missed) <= std::strtod(most, nullptr);
    EXPECT_EQ(json.at("holds"), holds);
    EXPECT_EQ(ran.exit_code, holds ? 0 : 1);
    for (const char* name : {"period", "latency", "compute"}) {
      const auto& times = json.at(name);
      double n = 0.0, last_us = -1.0;
      for (const auto& bin : times.at("bins_us")) {
        EXPECT_GT(bin.at(0).get<double>(), last_us);
        last_us = bin.at(0);
        n += bin.at(1).get<double>();
      }
      EXPECT_EQ(n, times.at("n").get<double>());
      EXPECT_EQ(n, std::string(name) == "period" ? ticks - 1.0 : ticks) << name;
      EXPECT_LE(times.at("p50_us"), times.at("p99_9_us"));
      EXPECT_LE(times.at("p99_9_us"), times.at("max_us"));
    }
    EXPECT_GT(json.at("most_needle_n"), 0.5) << "the hands were at work";
    EXPECT_GT(json.at("most_probe_n"), 0.5);
    const std::string scheduler = json.at("scheduler");
    EXPECT_TRUE(scheduler == "SCHED_FIFO" || scheduler == "SCHED_OTHER") << scheduler;
  }
}

TEST(HapticsSelftest, PrintsATableAndRefusesNonsense) {
  const auto scratch = fixtures::fresh_folder("haptics_selftest_table");
  const auto ran = fixtures::run(kProgram + " haptics selftest --seconds 0.2 --most-missed 1", scratch);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  for (const char* word : {"p50", "p99.9", "max", "period", "latency", "compute", "missed", "scheduler SCHED_"})
    EXPECT_NE(ran.out.find(word), std::string::npos) << word << "\n" << ran.out;
  for (const char* words : {"--seconds 0", "--seconds -1", "--seconds nan", "--seconds 1e9", "--most-missed 2",
                            "--most-missed nan", "--seconds x"}) {
    const auto refused = fixtures::run(kProgram + " haptics selftest " + words, scratch);
    EXPECT_EQ(refused.exit_code, 2) << words;
    EXPECT_TRUE(refused.out.empty());
  }
}

// The laws against the published lines: ours keeps them at any speed, the thesis' at none but its own.
TEST(HapticsBench, ChartsBothLawsAgainstThePublishedLines) {
  const auto scratch = fixtures::fresh_folder("haptics_bench");
  const auto ran = fixtures::run(
      kProgram + " bench --stage haptics --quick --out '" + (scratch / "out").string() + "'", scratch);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
  std::istringstream lines(ran.out);
  std::string line;
  int ours = 0, thesis = 0, servo = 0;
  while (std::getline(lines, line)) {
    if (line.rfind("haptics,servo step of ", 0) == 0) ++servo;
    const std::size_t unit = line.find(",N rms,");
    if (unit == std::string::npos) continue;
    const double error_n = std::strtod(line.c_str() + line.rfind(',', unit - 1) + 1, nullptr);
    if (line.rfind("haptics,needle law,", 0) == 0) {
      EXPECT_LE(error_n, 0.065) << line;
      ++ours;
    } else {
      EXPECT_GE(error_n, 0.2) << line;
      ++thesis;
    }
  }
  EXPECT_EQ(ours, 2 * 3);
  EXPECT_EQ(thesis, 2 * 3 * 3);
  EXPECT_EQ(servo, 2 * 4) << "p50 and p99.9, of the least and of all, of two pairs of tools";
  const std::string page = fixtures::whole_file(scratch / "out" / "force_depth.html");
  for (const char* name : {"needle law", "thesis F1, m 50", "published line", "kidney", "liver"})
    EXPECT_NE(page.find(name), std::string::npos) << name;
  EXPECT_FALSE(fixtures::whole_file(scratch / "out" / "frontier.html").empty());
  // Two lengths of segments, the same answers as Embree; ticks of the proxies.
  for (const char* row : {"mesh index, segment", "Embree, segment", "surface proxy, tick", "volume proxy, tick"})
    EXPECT_NE(ran.out.find(row), std::string::npos) << row;
  EXPECT_NE(ran.out.find(", 0 answers differ"), std::string::npos);
}

}  // namespace
}  // namespace seldinger
