// Simulated trainees through the program: people, learners, threads, and that all of it says what it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/e2e/simulated/simulated_trainees.h"
#include "tests/fixtures/answers.h"
#include "tests/fixtures/places.h"
#include "tests/fixtures/process.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;
using fixtures::run;

using fixtures::kProgram;

class SimulateTest : public SimulatedTrainees {
 protected:
  static void SetUpTestSuite() { make("simulate"); }
};

TEST_F(SimulateTest, ThreadsAndPicturesChangeNothing) {
  const std::string words = "simulate --count 3 --seed 70 --operator intermediate --case " + first_case();
  const Json one = ask(words + " --jobs 1"), three = ask(words + " --jobs 3 --no-pictures");
  const Json &a = one.at("attempts"), &b = three.at("attempts");
  ASSERT_EQ(a.size(), 3U);
  ASSERT_EQ(b.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(a[i].at("seed"), 70 + i);
    EXPECT_EQ(b[i].at("seed"), 70 + i);
    EXPECT_EQ(a[i].at("metrics"), b[i].at("metrics")) << i;
  }
  EXPECT_NE(a[0].at("metrics"), a[1].at("metrics"));
}

TEST_F(SimulateTest, PeopleAreDifferentAndOnceThere) {
  const std::string words =
      "simulate --people 3 --count 2 --seed 5 --no-pictures --operator expert --case " + quick_case();
  // Two shards, then all of them: what a shard made is not made again.
  const Json shard = ask(words + " --shard 2/2"), first = ask(words), again = ask(words);
  const Json& attempts = first.at("attempts");
  ASSERT_EQ(shard.at("attempts").size(), 2U);
  ASSERT_EQ(attempts.size(), 6U);
  std::set<Json> seeds;
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(attempts[i].at("person"), i / 2 + 1);
    EXPECT_EQ(attempts[i].at("attempt_number"), i % 2 + 1);
    EXPECT_EQ(attempts[i].at("operator"), "expert");
    EXPECT_EQ(attempts[i].at("synthetic"), true);
    EXPECT_EQ(attempts[i].at("metrics"), again.at("attempts")[i].at("metrics"));
    EXPECT_EQ(attempts[i].at("attempt_id"), again.at("attempts")[i].at("attempt_id"));
    seeds.insert(attempts[i].at("seed"));
  }
  EXPECT_EQ(seeds.size(), 6U);
  EXPECT_EQ(attempts[2].at("attempt_id"), shard.at("attempts")[0].at("attempt_id"));
  EXPECT_EQ(attempts[3].at("metrics"), shard.at("attempts")[1].at("metrics"));
  // Another group's people of the same seed and number are others.
  const Json novices = ask("simulate --people 1 --seed 5 --no-pictures --operator novice --case " + quick_case());
  EXPECT_FALSE(seeds.contains(novices.at("attempts")[0].at("seed")));
}

// docs/simulated-people.sh as Slurm would start it: a library for each task, merged into one, where nothing is left
// to be made and nothing is there twice.
TEST_F(SimulateTest, ShardsOfAClusterMergeIntoOneLibraryWithoutADouble) {
  const std::string bundle = (scratch_ / "cases.sdbundle").string();
  ask("case bundle " + quick_case() + " --out " + bundle);
  const std::string words = " --people 3 --seed 9 --operator novice --case " + quick_case();
  const auto task = [&](const std::string& number) {
    const auto ran = run("SLURM_ARRAY_TASK_ID=" + number + " SELDINGER='" + kProgram + "' '" +
                             (fixtures::source_dir() / "docs/simulated-people.sh").string() + "' 2 '" + bundle +
                             "' '" + scratch_.string() + "'" + words,
                         scratch_);
    EXPECT_EQ(ran.exit_code, 0) << ran.out << ran.err;
    return ran.out;
  };
  task("1");
  task("2");
  EXPECT_NE(task("1").find("2 attempts of these people already existed"), std::string::npos);
  const auto merge = [&](const std::string& number) {
    const std::string shard = (scratch_ / ("shard-" + number)).string();
    EXPECT_EQ(run("mkdir -p " + shard + " && tar -xf " + shard + ".tar -C " + shard, scratch_).exit_code, 0);
    return ask("simulate merge " + shard);
  };
  const Json two = merge("1"), one = merge("2"), again = merge("1");
  EXPECT_EQ(two, Json::parse(R"({"synthetic": true, "people": 2, "attempts": 2, "there": 0})"));
  EXPECT_EQ(one, Json::parse(R"({"synthetic": true, "people": 1, "attempts": 1, "there": 0})"));
  EXPECT_EQ(again, Json::parse(R"({"synthetic": true, "people": 0, "attempts": 0, "there": 2})"));
  const std::size_t before = ask("attempt list").at("attempts").size();
  const Json all = ask("simulate" + words);
  EXPECT_EQ(all.at("attempts").size(), 3U);
  EXPECT_EQ(ask("attempt list").at("attempts").size(), before) << "nothing was left to be made";
}

TEST_F(SimulateTest, AFileOfSkillsMakesPeopleAboutItsOperator) {
  const auto file = scratch_ / "own.json";
  std::ofstream(file) << R"({"name": "own", "like": "expert"})";
  const std::string words =
      "simulate --people 2 --seed 5 --no-pictures --operator " + file.string() + " --case " + quick_case();
  const Json first = ask(words), again = ask(words);
  ASSERT_EQ(first.at("attempts").size(), 2U);
  EXPECT_EQ(first.at("attempts")[1].at("operator"), "own-2");
  EXPECT_EQ(first.at("attempts")[1].at("metrics"), again.at("attempts")[1].at("metrics"));
}

TEST_F(SimulateTest, ALearnerGetsBetter) {
  const Json ran = ask("simulate --count 16 --seed 1 --no-pictures --operator learner --case " + quick_case());
  const Json& attempts = ran.at("attempts");
  ASSERT_EQ(attempts.size(), 16U);
  double first = 0.0, last = 0.0;
  for (int i = 0; i < 4; ++i) {
    first += *fixtures::metric(attempts[static_cast<std::size_t>(i)], "blind_advance") / 4.0;
    last += *fixtures::metric(attempts[static_cast<std::size_t>(12 + i)], "blind_advance") / 4.0;
  }
  EXPECT_LT(last, 0.6 * first);
}

TEST_F(SimulateTest, SaysEverywhereThatItIsSynthetic) {
  const Json ran = ask("simulate --seed 3 --operator expert --case " + quick_case());
  EXPECT_EQ(ran.at("attempts")[0].at("synthetic"), true);
  const std::string id = ran.at("attempts")[0].at("attempt_id");
  EXPECT_EQ(ask("attempt show " + id).at("synthetic"), true);
  const Json list = ask("attempt list");
  for (const Json& attempt : list.at("attempts")) EXPECT_EQ(attempt.at("synthetic"), true);
  for (const std::string& words : {std::string("attempt list"), "attempt show " + id}) {
    const auto text = run(kProgram + " " + words + " --library " + library_, scratch_);
    EXPECT_NE(text.out.find("Simulated expert"), std::string::npos) << text.out;
  }
  // On which case, and by whom.
  const std::string listed = run(kProgram + " attempt list --library " + library_, scratch_).out;
  EXPECT_NE(listed.find("Simulated expert, seed 3"), std::string::npos) << listed;
  EXPECT_NE(listed.find(cases_[2].at("title").get<std::string>().substr(0, 20)), std::string::npos) << listed;
  // Nobody simulated passes for a person.
  const auto file = scratch_ / "person.json";
  std::ofstream(file) << R"({"name": "person"})";
  const auto refused =
      run(kProgram + " simulate --operator " + file.string() + " --case " + quick_case() + " --library " + library_,
          scratch_);
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_NE(refused.err.find("bad_operator"), std::string::npos) << refused.err;
}

TEST_F(SimulateTest, IsALineAnAttemptUnlessDetailsAreAskedFor) {
  const std::string words = " simulate --no-pictures --seed 40 --count 2 --operator expert --case " + quick_case();
  const auto brief = run(kProgram + words + " --library " + library_, scratch_);
  ASSERT_EQ(brief.exit_code, 0) << brief.err;
  EXPECT_EQ(std::count(brief.out.begin(), brief.out.end(), '\n'), 3) << brief.out;
  EXPECT_NE(brief.out.find(" of 2 passed\n"), std::string::npos) << brief.out;
  EXPECT_EQ(brief.err, "") << "progress is for terminals";
  const auto whole = run(kProgram + words + " --details --library " + library_, scratch_);
  EXPECT_NE(whole.out.find("\n  time_total "), std::string::npos) << whole.out;
  EXPECT_GT(std::count(whole.out.begin(), whole.out.end(), '\n'), 50);
}

}  // namespace
}  // namespace seldinger
