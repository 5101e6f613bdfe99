// Tests of the commands that a program beside `seldinger` runs: with that program, with another in its place, and
// without any.
#include <gtest/gtest.h>

#include <fstream>

#include "app/bench_stages.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

namespace fs = std::filesystem;
const std::string kProgram = seldinger::fixtures::program();

// A copy of the product in a folder of its own, without seldinger-measure.
class Alone {
 public:
  explicit Alone(const std::string& name) : folder_(fixtures::fresh_folder(name)) {
    fs::create_directories(folder_ / "bin");
    fs::copy_file(kProgram, folder_ / "bin" / "seldinger");
  }
  fs::path measure() const { return folder_ / "bin" / "seldinger-measure"; }
  fs::path out() const { return folder_ / "out"; }
  fixtures::Ran run(const std::string& words) const {
    return fixtures::run("'" + (folder_ / "bin" / "seldinger").string() + "' " + words, folder_ / "said");
  }

 private:
  fs::path folder_;
};

TEST(Measure, WhereItIsAbsentOneLineTellsHowToBuildIt) {
  const Alone alone("measure_absent");
  for (const std::string& words :
       {"bench --quick --stage xray --out '" + alone.out().string() + "'", std::string("goals haptics --json"),
        std::string("goals ultrasound --quick"), std::string("haptics stability --json")}) {
    const auto ran = alone.run(words);
    EXPECT_EQ(ran.exit_code, 4) << words;
    EXPECT_EQ(ran.err,
              "error: measure_not_built: benchmarks and goals are a program of their own: build it with ./run "
              "measure\n")
        << words;
    const bool json = words.find("--json") != std::string::npos;
    EXPECT_EQ(ran.out.find("\"measure_not_built\"") != std::string::npos, json) << ran.out;
    EXPECT_EQ(ran.out.empty(), !json) << words;
  }
  EXPECT_FALSE(fs::exists(alone.out()));
  EXPECT_EQ(alone.run("goals haptics --no-such-option").exit_code, 2) << "wrong use is told without it";
  EXPECT_EQ(alone.run("bench --help").exit_code, 0);
}

TEST(Measure, WhatIsBesideGetsEveryWordAndAnswers) {
  const Alone alone("measure_beside");
  std::ofstream(alone.measure()) << "#!/bin/sh\nprintf '<%s>\\n' \"$@\"\nexit 1\n";
  fs::permissions(alone.measure(), fs::perms::owner_all);
  const auto ran = alone.run("bench --out 'a b' --stage '' --quick");
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_EQ(ran.out, "<bench>\n<--out>\n<a b>\n<--stage>\n<>\n<--quick>\n");
  EXPECT_EQ(alone.run("goals haptics --json").out, "<goals>\n<haptics>\n<--json>\n");
  EXPECT_EQ(alone.run("haptics stability").out, "<haptics>\n<stability>\n");
}

TEST(Measure, WhatCannotBeStartedIsAnotherFailure) {
  const Alone alone("measure_not_started");
  fs::create_directories(alone.measure());
  const auto ran = alone.run("goals haptics");
  EXPECT_EQ(ran.exit_code, 4);
  EXPECT_EQ(ran.err.rfind("error: measure_not_started: ", 0), 0U) << ran.err;
}

TEST(Measure, AnUnknownStageIsAUsageErrorThatNamesTheKnownOnes) {
  const auto scratch = fixtures::fresh_folder("measure_stage");
  const auto out = scratch / "out";
  for (const char* stages : {"nonsense", "xray,", "", "mpr,XRAY"}) {
    const auto ran = fixtures::run(
        kProgram + " bench --quick --stage '" + stages + "' --out '" + out.string() + "'", scratch / "said");
    EXPECT_EQ(ran.exit_code, 2) << stages;
    const std::string first = ran.err.substr(0, ran.err.find('\n'));
    EXPECT_EQ(first.rfind("usage: --stage knows ", 0), 0U) << ran.err;
    for (const app::BenchStageWords& stage : app::kBenchStages)
      EXPECT_NE(first.find(stage.name), std::string::npos) << stage.name;
    EXPECT_FALSE(fs::exists(out)) << stages;
  }
}

TEST(Measure, AloneItKnowsItsOwnCommandsOnly) {
  const auto scratch = fixtures::fresh_folder("measure_alone");
  const std::string measure = fs::path(kProgram).parent_path() / "seldinger-measure";
  EXPECT_EQ(fixtures::run(measure + " bench --help", scratch).out,
            fixtures::run(kProgram + " bench --help", scratch).out);
  EXPECT_EQ(fixtures::run(measure + " case list", scratch).exit_code, 2);
}

}  // namespace
}  // namespace seldinger
