// Operators who are nobody: the same seed of two of them is two attempts that have nothing to do with each other,
// though both keep the seed that was asked for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "assessment/operators/plan.h"
#include "assessment/score.h"
#include "assessment/statistics/relations/correlation.h"
#include "session/attempt/simulated_attempt.h"
#include "session/attempt/simulation.h"
#include "sim/base/check.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::session {
namespace {

TEST(OperatorStreams, TheSeedIsKeptAndTheStreamIsOfNameAndSeed) {
  std::set<std::uint64_t> streams;
  for (const char* name : {"novice", "intermediate", "expert", "learner"}) {
    const auto trials = simulated_trials(*assessment::named_profile(name), 7, 50, std::nullopt);
    ASSERT_EQ(trials.size(), 50U);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      EXPECT_EQ(trials[i].seed, 7 + i);
      ASSERT_TRUE(trials[i].stream.has_value());
      EXPECT_EQ(*trials[i].stream, stream_of_operator(name, 7 + i));
      streams.insert(*trials[i].stream);
    }
  }
  EXPECT_EQ(streams.size(), 200U);
  // Those of people are their seeds, as they were.
  for (const SimulatedTrial& trial : simulated_trials(*assessment::named_profile("learner"), 7, 2, 3))
    EXPECT_FALSE(trial.stream.has_value());
}

constexpr std::size_t kPaired = 60;
using Columns = std::map<std::string, std::vector<double>>;  // by metric, of the seeds in turn; NaN: no value

Columns columns_of(const cases::Case& scene, const assessment::PuncturePlan& plan, const std::string& name,
                   bool of_the_raw_seed) {
  Columns columns;
  const auto trials = simulated_trials(*assessment::named_profile(name), 1, kPaired, std::nullopt);
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const std::uint64_t stream = of_the_raw_seed ? trials[i].seed : trials[i].stream.value();
    const auto scored = assessment::score(scene, run_attempt(scene, plan, trials[i].profile, stream));
    CHECK(scored.has_value());
    for (const assessment::MetricValue& one : scored->metrics) {
      auto& column = columns.try_emplace(one.id, kPaired, std::nan("")).first->second;
      column[i] = one.value.value_or(std::nan(""));
    }
  }
  return columns;
}

// Of the seeds at which both have a value; 0 where they are too few or all alike.
double paired_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (!std::isnan(a[i]) && !std::isnan(b[i])) {
      x.push_back(a[i]);
      y.push_back(b[i]);
    }
  if (x.size() < kPaired / 2) return 0.0;
  const double rho = assessment::statistics::rank_correlation(x, y);
  return std::isnan(rho) ? 0.0 : rho;
}

// Of 60 independent pairs a rank correlation has a standard error of 1/√59 = .13. Chance takes the largest of three
// times some 60 of them beyond 4 of these once in ninety such tests; those of one stream lie far beyond.
TEST(OperatorStreams, PairedSeedsOfTwoOperatorsAreUncorrelated) {
  cases::Case scene = fixtures::ball_case({55, 4.0, 100.0});
  scene.lesions.push_back({{0.0, -55.0, 0.0}, 6.0, 5.0});
  const auto plan = assessment::plan_puncture(scene.volume, scene.skin_index, scene.lesions[0].center_lps_mm,
                                              assessment::path_limits(scene));
  ASSERT_TRUE(plan.has_value());
  const double most = 4.0 / std::sqrt(static_cast<double>(kPaired - 1));
  for (const bool of_the_raw_seed : {false, true}) {
    std::map<std::string, Columns> columns;
    // What one stream does to two operators shows in one pair of them.
    const std::vector<std::string> names = of_the_raw_seed
                                               ? std::vector<std::string>{"intermediate", "expert"}
                                               : std::vector<std::string>{"novice", "intermediate", "expert"};
    for (const std::string& name : names) columns[name] = columns_of(scene, *plan, name, of_the_raw_seed);
    double largest = 0.0;
    for (auto a = columns.begin(); a != columns.end(); ++a)
      for (auto b = std::next(a); b != columns.end(); ++b)
        for (const auto& [metric, values] : a->second) {
          const auto other = b->second.find(metric);
          if (other == b->second.end()) continue;
          const double found = paired_correlation(values, other->second);
          largest = std::max(largest, std::abs(found));
          if (!of_the_raw_seed) {
            EXPECT_LT(std::abs(found), most) << a->first << ", " << b->first << ": " << metric;
          }
        }
    RecordProperty(of_the_raw_seed ? "largest_of_one_stream" : "largest", std::to_string(largest));
    if (of_the_raw_seed) {
      EXPECT_GT(largest, 1.3 * most) << "of one stream for both the test finds it";
    }
  }
}

}  // namespace
}  // namespace seldinger::session
