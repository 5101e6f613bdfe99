// Attempts in real time, as a person's: stored while they run, with how the servo kept time; and what is left when
// the program dies.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <map>
#include <nlohmann/json.hpp>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/process.h"
#include "tests/fixtures/until.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kProgram;

class LiveTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = fixtures::fresh_folder("live");
    library_ = (scratch_ / "library").string();
    const Json demo = fixtures::demo_library("", library_);
    case_id_ = demo["case_id"];
  }
  static Json ask(const std::string& words, int expected = 0) {
    const auto ran = run(kProgram + " " + words + " --json --library " + library_, scratch_);
    EXPECT_EQ(ran.exit_code, expected) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  }
  static inline std::filesystem::path scratch_;
  static inline std::string library_, case_id_;
};

TEST_F(LiveTest, AnAttemptInRealTimeIsOneLikeAnyOther) {
  const Json made = ask("simulate --real-time --operator expert --seed 101 --case " + case_id_);
  const std::string id = made["attempts"][0]["attempt_id"];
  EXPECT_EQ(fixtures::metric(made["attempts"][0], "hit"), 1.0);
  const Json shown = ask("attempt show " + id);
  EXPECT_EQ(shown["end"], "fired");
  const Json& servo = shown["servo"];
  ASSERT_TRUE(servo.is_object());
  EXPECT_GT(servo["ticks"], 3000);
  EXPECT_EQ(servo["compute"]["n"], servo["ticks"]);
  // The attempt's clock is the wall's: what was missed is made up for, but for stalls of more than 20 ms.
  EXPECT_GE(shown["duration_s"].get<double>(), 1e-3 * servo["ticks"].get<double>() - 0.5);
  EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true) << "with missed ticks and all";
  const Json again = ask("recompute");
  EXPECT_EQ(again["not_bit_identical"], 0);
  EXPECT_EQ(again["added"], 0);
  EXPECT_EQ(again["not_scored"], Json::array());
  EXPECT_GT(again["values"], 100);
}

TEST_F(LiveTest, AttemptsInVirtualTimeHaveNoServoAndTheSameForcesAgain) {
  const Json made = ask("simulate --operator novice --seed 7 --case " + case_id_);
  const std::string id = made["attempts"][0]["attempt_id"];
  const Json shown = ask("attempt show " + id);
  EXPECT_TRUE(shown["servo"].is_null());
  EXPECT_TRUE(shown["away_s"].is_null());
  EXPECT_EQ(shown["conditions"]["needle_hand"], "simulated");
  EXPECT_EQ(shown["conditions"]["guide_used"], false);
  EXPECT_TRUE(shown["conditions"]["window_width_px"].is_null());
  EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true);
}

// What a mentor lets happen is heard, kept, replayed, and asked after.
TEST_F(LiveTest, AMentorsEventIsPartOfTheAttempt) {
  for (const std::string how : {"", " --real-time"}) {
    const Json made = ask("simulate --operator expert --seed 5 --event pressure_drop@4.5 --event cough@3 --case " +
                          case_id_ + how);
    const std::string id = made["attempts"][0]["attempt_id"];
    const Json shown = ask("attempt show " + id);
    std::vector<std::string> mentors;
    for (const Json& event : shown["events"])
      if (event["source"] == "mentor") {
        mentors.push_back(event["kind"]);
        EXPECT_NEAR(event["t_s"].get<double>(), mentors.size() == 1 ? 3.0 : 4.5, 0.025) << how;
      }
    EXPECT_EQ(mentors, (std::vector<std::string>{"cough", "pressure_drop"})) << how;
    std::map<std::string, std::string> states;
    for (const Json& step : shown["steps"]) states[step["id"]] = step["state"];
    EXPECT_TRUE(states["stop_in_trouble"] == "done" || states["stop_in_trouble"] == "violated") << how;
    EXPECT_EQ(states["judge_depth"], "not_asked") << "of fluoroscopy";
    EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true) << how;
    const Json scored = ask("score " + id);
    EXPECT_EQ(scored["steps"], shown["steps"]) << how;
  }
  for (const char* wrong : {"cough", "cough@", "cough@-1", "sign_in@2", "sneeze@3", "cough@nan"})
    EXPECT_EQ(run(kProgram + " simulate --operator expert --event " + wrong + " --case " + case_id_ +
                      " --library " + library_,
                  scratch_)
                  .exit_code,
              2)
        << wrong;
  const auto injected = run(kProgram + " simulate --operator expert --instrument core --event inject@3 --case " +
                                case_id_ + " --library " + library_,
                            scratch_);
  EXPECT_EQ(injected.exit_code, 3);
  EXPECT_EQ(injected.err.rfind("error: no_injection: ", 0), 0U) << injected.err;
}

// kill -9 in the middle: whoever lists the attempts next finds it, readable and marked.
TEST_F(LiveTest, AProgramThatDiesLeavesAnInterruptedAttempt) {
  const std::string words = "simulate --real-time --operator novice --seed 3 --case " + case_id_;
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c",
            ("exec " + kProgram + " " + words + " --library " + library_ + " >/dev/null").c_str(),
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  const auto count = [&] {
    std::size_t interrupted = 0;
    const Json list = ask("attempt list");
    for (const Json& attempt : list["attempts"])
      if (attempt["end"] == "interrupted") ++interrupted;
    return interrupted;
  };
  const auto stored_s = [&] {
    const Json list = ask("attempt list");
    return list["running"].empty() ? 0.0 : list["running"][0]["stored_s"].get<double>();
  };
  EXPECT_TRUE(fixtures::until([&] { return stored_s() >= 2.0; }, fixtures::kPatienceS, 0.1));
  EXPECT_EQ(count(), 0U) << "while it runs, nobody takes it";
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  ASSERT_EQ(count(), 1U);
  const Json list = ask("attempt list");
  for (const Json& attempt : list["attempts"]) {
    if (attempt["end"] != "interrupted") continue;
    EXPECT_GE(attempt["duration_s"], 1.9);
    EXPECT_EQ(attempt["seed"], 3);
    EXPECT_FALSE(attempt["metrics"].empty());
    EXPECT_EQ(ask("replay " + attempt["attempt_id"].get<std::string>() + " --verify")["verified"], true);
  }
  EXPECT_TRUE(ask("attempt list")["running"].empty());
}

// Or somebody goes on with it: the same attempt, one recording, and the gap is in it.
TEST_F(LiveTest, WhatAKillInterruptedGoesOn) {
  const auto err = scratch_ / "killed.err";
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    ::execl("/bin/sh", "sh", "-c",
            ("exec " + kProgram + " simulate --real-time --operator novice --seed 4 --case " + case_id_ +
             " --library " + library_ + " >/dev/null 2>" + err.string())
                .c_str(),
            static_cast<char*>(nullptr));
    ::_exit(127);
  }
  const auto stored_s = [&] {
    const Json list = ask("attempt list");
    return list["running"].empty() ? 0.0 : list["running"][0]["stored_s"].get<double>();
  };
  ASSERT_TRUE(fixtures::until([&] { return stored_s() >= 4.0; }, fixtures::kPatienceS, 0.1));
  const std::string id = ask("attempt list")["running"][0]["attempt_id"];
  EXPECT_NE(fixtures::whole_file(err).find(id), std::string::npos) << "whoever started it can know";
  EXPECT_EQ(run(kProgram + " simulate --resume " + id + " --library " + library_, scratch_).exit_code, 3)
      << "it runs";
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  EXPECT_EQ(run(kProgram + " simulate --resume " + id + " --case " + case_id_ + " --library " + library_, scratch_)
                .exit_code,
            2)
      << "the case is its own";
  const Json made = ask("simulate --resume " + id);
  EXPECT_EQ(made["attempts"][0]["attempt_id"], id);
  EXPECT_EQ(made["attempts"][0]["seed"], 4);
  const Json shown = ask("attempt show " + id);
  EXPECT_NE(shown["end"], "interrupted");
  EXPECT_GT(shown["duration_s"], 4.0);
  EXPECT_GT(shown["away_s"], 0.0);
  int marks = 0;
  for (const Json& event : shown["events"])
    if (event["kind"] == "resumed") {
      ++marks;
      EXPECT_EQ(event["source"], "workstation");
      EXPECT_GT(event["t_s"], 4.0);
    }
  EXPECT_EQ(marks, 1);
  EXPECT_EQ(ask("replay " + id + " --verify")["verified"], true);
  EXPECT_EQ(ask("recompute")["not_bit_identical"], 0);
  EXPECT_EQ(run(kProgram + " simulate --resume " + id + " --library " + library_, scratch_).exit_code, 3)
      << "it has ended";
  EXPECT_TRUE(ask("attempt list")["running"].empty());
}

TEST_F(LiveTest, UnderXrayItIsRefused) {
  const std::string library = (scratch_ / "xray").string();
  const std::string xray_case = fixtures::demo_library("--modality xray", library)["case_id"];
  const auto ran = run(
      kProgram + " simulate --real-time --operator expert --library " + library + " --case " + xray_case, scratch_);
  EXPECT_EQ(ran.exit_code, 3);
  EXPECT_NE(ran.err.find("error: not_in_real_time: "), std::string::npos) << ran.err;
}

}  // namespace
}  // namespace seldinger
