// A patient who breathes and whose tissue yields, under MPR and ultrasound: attempts that replay bit for bit, tips
// told at rest, and a still patient who is the same as ever.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kProgram;

class MotionTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = fixtures::fresh_folder("motion");
    library_ = (scratch_ / "library").string();
    const Json demo = fixtures::demo_library("", library_);
    still_ = demo["case_id"];
    const auto added = run(
        "printf 'a long password' | " + kProgram + " user add mia --role mentor --library " + library_, scratch_);
    ASSERT_EQ(added.exit_code, 0) << added.err;
  }
  static Json ask(const std::string& words, int expected = 0) {
    const auto ran = run(kProgram + " " + words + " --json --library " + library_, scratch_);
    EXPECT_EQ(ran.exit_code, expected) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  }
  static void set(const std::string& case_id, const std::string& words) {
    const auto ran = run(kProgram + " case setting " + case_id + " " + words + " --library " + library_, scratch_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
  }
  // A version of the demo's case, under MPR unless told otherwise.
  static std::string version(const std::string& words, const std::string& modality = "mpr") {
    const auto ran = run(kProgram + " case version " + still_ + " --by mia --json --library " + library_, scratch_);
    EXPECT_EQ(ran.exit_code, 0) << ran.err;
    const std::string case_id = Json::parse(ran.out)["case_id"];
    set(case_id, "--modality " + modality + " " + words);
    return case_id;
  }
  static inline std::filesystem::path scratch_;
  static inline std::string library_, still_;
};

TEST_F(MotionTest, AnAttemptAtWhoBreathesAndYieldsReplaysBitForBit) {
  const std::string moving = version("--breath-depth 1 --tissue yields");
  EXPECT_EQ(ask("case show " + moving)["motion"]["breath_depth"], 1.0);
  const Json made = ask("simulate --operator expert --seed 4 --event cough@6 --case " + moving);
  const std::string id = made["attempts"][0]["attempt_id"];
  EXPECT_TRUE(fixtures::metric(made["attempts"][0], "tip_target_dist").has_value());
  EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true);
  const Json again = ask("recompute --attempt " + id);
  EXPECT_EQ(again["not_bit_identical"], 0);
  EXPECT_EQ(again["not_scored"], Json::array());
  EXPECT_GT(again["values"], 60);
}

TEST_F(MotionTest, UnderUltrasoundToo) {
  const std::string moving = version("--breath-depth 1 --tissue yields", "ultrasound");
  const Json made = ask("simulate --operator expert --seed 4 --event cough@6 --case " + moving);
  const std::string id = made["attempts"][0]["attempt_id"];
  EXPECT_TRUE(fixtures::metric(made["attempts"][0], "tip_target_dist").has_value());
  EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true);
  const Json again = ask("recompute --attempt " + id);
  EXPECT_EQ(again["not_bit_identical"], 0);
  EXPECT_EQ(again["not_scored"], Json::array());
  const auto ran = run(
      kProgram + " replay " + id + " --out " + (scratch_ / "moving_us.html").string() + " --library " + library_,
      scratch_);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST_F(MotionTest, UnderFluoroscopyToo) {
  const std::string moving = version("--breath-depth 1 --tissue yields", "xray");
  const Json made = ask("simulate --operator expert --seed 4 --case " + moving);
  const std::string id = made["attempts"][0]["attempt_id"];
  EXPECT_TRUE(fixtures::metric(made["attempts"][0], "tip_target_dist").has_value());
  EXPECT_GT(fixtures::metric(made["attempts"][0], "fluoroscopy_time").value(), 0.5);
  EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true);
  const Json again = ask("recompute --attempt " + id);
  EXPECT_EQ(again["not_bit_identical"], 0);
  EXPECT_EQ(again["not_scored"], Json::array());
  const auto ran = run(
      kProgram + " replay " + id + " --out " + (scratch_ / "moving_xray.html").string() + " --library " + library_,
      scratch_);
  EXPECT_EQ(ran.exit_code, 0) << ran.err;
}

TEST_F(MotionTest, TheSameHandsMeetAnotherPlaceInWhoBreathes) {
  // Nothing but the breath differs: where the needle is at rest, and so what it meets.
  const auto distance = [](const std::string& case_id) {
    const Json made = ask("simulate --operator novice --seed 9 --case " + case_id);
    return fixtures::metric(made["attempts"][0], "tip_target_dist").value();
  };
  const std::string a = version(""), b = version("--breath-depth 1.5");
  const double still_mm = distance(a), again_mm = distance(a), breathing_mm = distance(b);
  EXPECT_EQ(still_mm, again_mm);
  EXPECT_GT(std::abs(breathing_mm - still_mm), 0.1);
}

TEST_F(MotionTest, ExplainListsWhatCanMoveTheTissueAndNothingElse) {
  const auto kinds = [](const Json& explained) {
    std::vector<std::string> list;
    for (const Json& one : explained["displacement"]["sources"]) list.push_back(one["kind"]);
    return list;
  };
  const Json still = ask("case explain " + version(""));
  EXPECT_TRUE(kinds(still).empty());
  EXPECT_EQ(still["displacement"]["bytes"], 0);
  EXPECT_EQ(still["displacement"]["there_ns"], 0.0);
  EXPECT_GT(still["held"].size(), 2U);
  const Json breathing = ask("case explain " + version("--breath-depth 1"));
  EXPECT_EQ(kinds(breathing), std::vector<std::string>({"breath"}));
  EXPECT_GT(breathing["displacement"]["there_ns"], 0.0);
  const std::string id = version("--tissue yields");
  EXPECT_EQ(kinds(ask("case explain " + id)),
            std::vector<std::string>({"press", "needle tip", "needle shaft", "organ"}));
  const Json both = ask("case explain " + version("--tissue yields --breath-depth 1"));
  EXPECT_EQ(both["displacement"]["count"], 5);
  EXPECT_EQ(both["displacement"]["most"], 16);
  EXPECT_GT(both["displacement"]["back_ns"], both["displacement"]["there_ns"]);
}

TEST_F(MotionTest, ExpertsHitInAHeldBreathAndNovicesMostlyDoNotHoldIt) {
  for (const std::string words :
       {"--breath-depth 1", "--breath-depth 1.5 --tissue yields", "--breath-depth 1 --ct-breath inspiration"}) {
    const std::string case_id = version(words);
    const bool breathed_in = words.find("inspiration") != std::string::npos;
    for (const bool expert : {true, false}) {
      const Json made = ask("simulate --seed 1 --count 10 --no-pictures --case " + case_id + " --operator " +
                            (expert ? "expert" : "novice"));
      double hits = 0.0, held = 0.0, steps = 0.0;
      for (const Json& attempt : made["attempts"]) {
        hits += fixtures::metric(attempt, "hit").value();
        held += fixtures::metric(attempt, "fired_breath_held").value();
        if (expert) {
          // That a hold ends is noticed with a delay.
          EXPECT_GE(fixtures::metric(attempt, "advance_breath_held_share").value(), breathed_in ? 0.99 : 1.0)
              << attempt["seed"];
          EXPECT_GE(fixtures::metric(attempt, "steps_done").value(), 0.8) << words << ", " << attempt["seed"];
        }
        steps += fixtures::metric(attempt, "steps_done").value();
      }
      EXPECT_TRUE(!expert || steps / 10.0 >= 0.95) << words << ": " << steps;
      EXPECT_TRUE(expert ? hits >= 9.0 && held == 10.0 : held <= 8.0) << words << ": " << hits << ", " << held;
    }
  }
  // Of who lies still nothing is said about breath.
  const Json still = ask("simulate --seed 1 --operator expert --case " + version(""));
  for (const char* id : {"fired_breath_held", "advance_breath_held_share"}) {
    const Json& metrics = still["attempts"][0]["metrics"];
    const auto one = std::find_if(metrics.begin(), metrics.end(), [&](const Json& it) { return it["id"] == id; });
    ASSERT_NE(one, metrics.end()) << id;
    EXPECT_TRUE((*one)["value"].is_null()) << *one;
    EXPECT_EQ((*one)["reason"], "patient_lies_still");
  }
}

TEST_F(MotionTest, NobodyBreathesDeeperThanThatAndEveryModalityTakesWhoDoes) {
  const std::string moving = version("--breath-depth 1");
  set(moving, "--also xray");
  const Json made = ask("simulate --operator expert --no-pictures --modality xray --case " + moving);
  EXPECT_TRUE(fixtures::metric(made["attempts"][0], "fluoroscopy_time").has_value());
  const auto bad = run(kProgram + " case setting " + moving + " --breath-depth 9 --library " + library_, scratch_);
  EXPECT_EQ(bad.exit_code, 3);
}

}  // namespace
}  // namespace seldinger
