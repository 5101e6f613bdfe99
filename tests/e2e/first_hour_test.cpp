// docs/first-hour.md, run as it stands there, and what it makes: three drills on blocks of gel that hold their
// check, each passed by a simulated expert whose replay is true, and the curriculum that leads through them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/fixtures/answers.h"
#include "tests/fixtures/demo_library.h"
#include "tests/fixtures/page_commands.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;
using fixtures::with;

using fixtures::kProgram;

bool passes(const Json& attempt, const Json& criteria) {
  for (const Json& criterion : criteria) {
    const auto value = fixtures::metric(attempt, criterion.at("metric"));
    const double wanted = criterion.at("value");
    if (!value || !(criterion.at("comparison") == "<=" ? *value <= wanted : *value >= wanted)) return false;
  }
  return !criteria.empty();
}

class FirstHour : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    scratch_ = fixtures::fresh_folder("first_hour");
    library_ = (scratch_ / "library").string();
    made_ = fixtures::demo_library("--drills", library_);
  }
  static Json ask(const std::string& words) {
    const auto ran = run(kProgram + " " + words + " --json --library '" + library_ + "'", scratch_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  }
  static inline std::filesystem::path scratch_;
  static inline std::string library_;
  static inline Json made_;
};

// Who logs in first finds somebody to look after.
TEST_F(FirstHour, ItsPeopleAreInACohort) {
  std::multiset<std::string> posts;
  const Json cohort = ask("cohort show Demonstration");
  for (const Json& one : cohort.at("enrolments")) posts.insert(one.at("post"));
  EXPECT_EQ(posts, (std::multiset<std::string>{"learner", "mentor", "mentor"}));
}

TEST_F(FirstHour, HasThreeDrillsThatHoldTheirCheck) {
  ASSERT_EQ(made_.at("drills").size(), 3U);
  EXPECT_TRUE(made_.at("cases").empty());
  const char* kTitles[] = {"Drill 1: find the plane", "Drill 2: keep the tip in view",
                           "Drill 3: reach depth out of plane"};
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& drill = made_.at("drills")[i];
    EXPECT_EQ(drill.at("number"), std::string("D").append(std::to_string(i + 1)));
    EXPECT_EQ(drill.at("title"), kTitles[i]);
    EXPECT_EQ(drill.at("state"), "published");
    const Json check = ask("case check " + drill.at("case_id").get<std::string>());
    for (const Json& one : check.at("checks")) EXPECT_TRUE(one.at("holds").get<bool>()) << one;
    const Json shown = ask("case show " + drill.at("case_id").get<std::string>());
    EXPECT_EQ(shown.at("difficulty"), "easy");
    EXPECT_EQ(shown.at("subject"), "phantom");
    EXPECT_EQ(shown.at("approach"), i == 2 ? "out_of_plane" : "in_plane");
  }
}

TEST_F(FirstHour, EachHasAnExpertsPassToWatchThatReplaysTrue) {
  ASSERT_EQ(made_.at("drills").size(), 3U);
  for (const Json& drill : made_.at("drills")) {
    SCOPED_TRACE(drill.at("title"));
    EXPECT_EQ(drill.at("hit").at("synthetic"), true);
    const std::string attempt_id = drill.at("hit").at("attempt_id");
    const Json attempt = ask("attempt show " + attempt_id);
    EXPECT_EQ(attempt.at("case_id"), drill.at("case_id"));
    EXPECT_EQ(attempt.at("synthetic"), true);
    const Json shown = ask("case show " + drill.at("case_id").get<std::string>());
    EXPECT_TRUE(passes(attempt, shown.at("rule")));
    EXPECT_EQ(*fixtures::metric(attempt, "first_pass_success"), 1.0);
    EXPECT_FALSE(fixtures::metric(attempt, "pain_reactions")) << "nobody is there";
    std::set<std::string> not_asked;
    for (const Json& step : attempt.at("steps"))
      if (step.at("state") == "not_asked" && step.at("reason") == "no_patient") not_asked.insert(step.at("id"));
    for (const char* step : {"sign_in", "decide", "anaesthetise", "sign_out"})
      EXPECT_TRUE(not_asked.contains(step)) << step;
    EXPECT_EQ(ask("replay --verify " + attempt_id).at("verified"), true);
  }
}

TEST_F(FirstHour, MostNovicesDoNotPassWithoutLearning) {
  ASSERT_EQ(made_.at("drills").size(), 3U);
  for (const Json& drill : made_.at("drills")) {
    const std::string id = drill.at("case_id");
    const Json criteria = ask("case show " + id).at("rule");
    const Json ran = ask("simulate --count 5 --no-pictures --seed 1 --operator novice --case " + id);
    ASSERT_EQ(ran.at("attempts").size(), 5U);
    int passed = 0;
    for (const Json& attempt : ran.at("attempts")) passed += passes(attempt, criteria) ? 1 : 0;
    EXPECT_LE(passed, 2) << drill.at("title");
  }
}

TEST_F(FirstHour, IsACurriculumInWhichEachDrillOpensTheNext) {
  ASSERT_EQ(made_.at("curricula").size(), 1U);
  const Json shown = ask("curriculum show " + made_.at("curricula")[0].at("curriculum_id").get<std::string>());
  EXPECT_EQ(shown.at("title"), "First hour");
  EXPECT_EQ(shown.at("state"), "published");
  ASSERT_EQ(shown.at("items").size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json& item = shown.at("items")[i];
    EXPECT_EQ(item.at("case_id"), made_.at("drills")[i].at("case_id"));
    ASSERT_EQ(item.at("gates").size(), i == 0 ? 0U : 1U) << item;
    if (i == 0) continue;
    EXPECT_EQ(item.at("gates")[0].at("after"), i);
    EXPECT_EQ(item.at("gates")[0].at("reached"), "passed");
  }
}

TEST_F(FirstHour, IsMadeOnce) {
  const Json again = ask("demo --drills");
  EXPECT_EQ(again.at("drills"), made_.at("drills"));
  EXPECT_EQ(again.at("curricula"), made_.at("curricula"));
  EXPECT_TRUE(again.at("accounts").empty());
  EXPECT_EQ(run(kProgram + " demo --drills --ct x --library '" + library_ + "'", scratch_).exit_code, 2);
}

// A published case keeps its rule: a library of a program with other rules gets the next version of the case.
TEST_F(FirstHour, ADrillWhoseRuleHasChangedGetsItsNextVersion) {
  const std::string library = (scratch_ / "older").string();
  std::filesystem::copy(library_, library, std::filesystem::copy_options::recursive);
  const auto answer = [&](const std::string& words) {
    const auto ran = run(kProgram + " " + words + " --json --library '" + library + "'", scratch_);
    EXPECT_EQ(ran.exit_code, 0) << words << "\n" << ran.err;
    return Json::parse(ran.out, nullptr, false);
  };
  const std::string first = made_.at("drills")[0].at("case_id");
  const std::string older = answer("case version " + first + " --by mentor").at("case_id");
  ASSERT_EQ(
      run(kProgram + " case setting " + older + " --pass 'vis_joint >= 0.5' --library '" + library + "'", scratch_)
          .exit_code,
      0);
  const Json again = answer("demo --drills");
  const std::string now = again.at("drills")[0].at("case_id");
  const Json shown = answer("case show " + now);
  EXPECT_EQ(shown.at("version"), 3);
  EXPECT_EQ(shown.at("rule"), ask("case show " + first).at("rule"));
  EXPECT_EQ(again.at("drills")[1], made_.at("drills")[1]);
  EXPECT_EQ(again.at("curricula"), made_.at("curricula")) << "what was passed counts on";
  EXPECT_EQ(answer("case show " + first).at("state"), "retired");
}

TEST_F(FirstHour, ThePagesCommandsRunAsTheyStand) {
  const std::string library = (scratch_ / "page").string();
  const auto commands = fixtures::commands_of_page("first-hour.md");
  ASSERT_GE(commands.size(), 6U);
  std::string drill, curriculum, attempt;
  for (const std::string& command : commands) {
    if (command.rfind("train ", 0) == 0) continue;  // a window, tested by itself
    std::string line = with(with(with(command, "DRILL", drill), "CURRICULUM", curriculum), "ATTEMPT", attempt);
    line = with(line, "--library library", "--library '" + library + "'");
    line = with(line, "--out sheet.html", "--out '" + (scratch_ / "sheet.html").string() + "'");
    const bool makes = command.rfind("demo ", 0) == 0;
    const auto ran = run("printf 'a password\\n' | " + kProgram + " " + line + (makes ? " --json" : ""), scratch_);
    ASSERT_EQ(ran.exit_code, 0) << command << "\n" << ran.err;
    if (!makes) continue;
    const Json made = Json::parse(ran.out);
    drill = made.at("drills")[0].at("case_id");
    attempt = made.at("drills")[0].at("hit").at("attempt_id");
    curriculum = made.at("curricula")[0].at("curriculum_id");
  }
  EXPECT_NE(fixtures::whole_file(scratch_ / "sheet.html").find("Training only"), std::string::npos);
}

TEST_F(FirstHour, SomebodyCanTrainAndLearnsThePasswordAtOnce) {
  std::set<std::string> names;
  for (const Json& one : made_.at("accounts")) names.insert(one.at("name"));
  EXPECT_EQ(names, (std::set<std::string>{"mentor", "reviewer", "director", "trainee"}));
  // Interrupted while the attempts are made, the accounts have been shown.
  for (const auto& [words, last] : {std::pair{"--drills", "trainee"}, {"--no-serve", "expert"}}) {
    const std::string library = (scratch_ / words).string(), to = " --library '" + library + "'";
    const auto ran =
        run(kProgram + " demo " + words + to + " > shown & pid=$!; for i in $(seq 600); do grep -q '^  " + last +
                " ' shown && break; sleep 0.1; done; kill -KILL $pid; cat shown",
            scratch_);
    EXPECT_EQ(ran.out.rfind("Accounts, shown once:\n  mentor ", 0), 0U) << ran.out;
    const auto made = run(kProgram + " attempt list --json" + to, scratch_);
    EXPECT_LT(Json::parse(made.out).at("attempts").size(), 3U) << "it was at work when the accounts were shown";
  }
}

}  // namespace
}  // namespace seldinger
