// Simulated studies: that what is planted equal is not found different more often than chance has it, that
// intervals hold what is true, and that a larger shift is found more often.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "assessment/population/studies/dose_response.h"
#include "assessment/population/studies/simulated_study.h"
#include "tests/assessment/population/known_attempts.h"
#include "tests/assessment/study/sample_plan.h"

namespace seldinger::assessment::population {
namespace {

// More of them in `./run test --long`.
const std::size_t kStudies = std::getenv("SELDINGER_REPETITIONS") == nullptr ? 150 : 2000;

World world_of(double first, double second, std::size_t per_group) {
  World world;
  world.groups = {shifted_group(first), shifted_group(second)};
  world.groups[0].name = "few";
  world.groups[1].name = "many";
  world.per_group = per_group;
  return world;
}

const study::Plan& plan() {
  static const study::Plan kPlan = study::sample_plan(R"(, "people": "simulated")");
  return kPlan;
}

double three_errors(double share, std::size_t of) {
  return 3.0 * std::sqrt(share * (1.0 - share) / static_cast<double>(of));
}

TEST(SimulatedStudies, WhatIsPlantedEqualIsFoundDifferentAsOftenAsPlanned) {
  const auto sum = simulate_studies(plan(), world_of(0.0, 0.0, 12), fitted(), 3, kStudies, 20'000);
  ASSERT_EQ(sum.primary.size(), 2U);
  EXPECT_GE(sum.primary[0].analysed, kStudies - 2);
  // Of two primary outcomes each is held to .025.
  EXPECT_LE(static_cast<double>(sum.primary[0].significant),
            (0.025 + three_errors(0.025, kStudies)) * static_cast<double>(sum.primary[0].analysed));
  EXPECT_NEAR(*sum.primary[0].truth, 0.5, 5.0 * std::sqrt(1.0 / (12.0 * 10'000.0)));
  EXPECT_EQ(sum.primary[1].analysed, 0U) << "the surrogate has no no-go length";
}

TEST(SimulatedStudies, IntervalsHoldWhatIsTrueAndPowerRisesWithTheShift) {
  std::size_t before = 0;
  double truth_before = 0.5;
  for (const double shift : {0.2, 0.5, 0.8, 1.2}) {
    const auto sum = simulate_studies(plan(), world_of(0.0, shift, 30), fitted(), 5, kStudies, 40'000);
    const OutcomeSum& one = sum.primary[0];
    ASSERT_EQ(one.with_interval, kStudies) << shift;
    const double covered = static_cast<double>(one.covered) / static_cast<double>(one.with_interval);
    EXPECT_NEAR(covered, 0.95, 0.015 + three_errors(0.95, kStudies)) << shift;
    RecordProperty("coverage_" + std::to_string(shift), std::to_string(covered));
    EXPECT_GT(one.significant, before);
    EXPECT_GT(*one.truth, truth_before) << "the less able are further off";
    before = one.significant;
    truth_before = *one.truth;
  }
}

// ln distance is .5 − .4 θ + .6 noise: with lapses θ has the variance 1.107, so one that is shifted by .8 is larger
// than another with the probability Φ(−.32/√(2 (.16 · 1.107 + .36))) = .379.
TEST(SimulatedStudies, IntervalsOfEveryMetricHoldWhatIsTrueOfIt) {
  const std::vector<double> shifts = {0.0, 0.8};
  const auto doses =
      dose_response(fitted(), shifts, {.per_group = 30, .studies = kStudies, .truth_people = 50'000, .seed = 5});
  ASSERT_EQ(doses.size(), 3U);
  for (const MetricDose& one : doses) {
    ASSERT_EQ(one.responses.size(), 2U);
    EXPECT_NEAR(one.responses[0].area, 0.5, 5.0 * std::sqrt(1.0 / (12.0 * 20'000.0))) << one.metric;
    for (const MetricResponse& at : one.responses) {
      ASSERT_EQ(at.intervals, kStudies) << one.metric;
      const double covered = static_cast<double>(at.covered) / static_cast<double>(at.intervals);
      EXPECT_NEAR(covered, 0.95, 0.025 + three_errors(0.95, kStudies)) << one.metric;
      EXPECT_LT(std::abs(at.paired), 0.06) << one.metric;
      EXPECT_NEAR(at.mean_width, 0.28, 0.06) << one.metric;  // 2 · 1.96 √(61/(12 · 900)), less where there are ties
    }
    // Time is normal, 60 − 8 strategy + noise, and of no ability; distance is log-normal, a count no normal number.
    for (const MetricResponse& at : one.responses) {
      const bool is_distance = one.metric == "tip_target_dist";
      EXPECT_EQ(at.d.has_value(), is_distance || one.metric == "time_total") << one.metric;
      if (!at.d) continue;
      EXPECT_EQ(at.of_logarithms, is_distance);
      const bool differs = is_distance && &at != &one.responses[0];
      EXPECT_NEAR(*at.d, differs ? -0.32 / std::sqrt(0.16 * 1.107 + 0.36) : 0.0,
                  5.0 * std::sqrt(2.0 / 45'000.0) + (differs ? 0.03 : 0.0));
      ASSERT_EQ(at.d_intervals, kStudies);
      EXPECT_NEAR(static_cast<double>(at.d_covered) / static_cast<double>(at.d_intervals), 0.95,
                  0.015 + three_errors(0.95, kStudies));
    }
    const double shifted = one.responses[1].area;
    if (one.metric == "tip_target_dist") {
      EXPECT_NEAR(shifted, 0.379, 0.02);
    }
    if (one.metric == "withdrawals_full") {
      EXPECT_NEAR(shifted, 0.5, 0.02) << "it tells nothing";
    }
  }
}

TEST(SimulatedStudies, HaveTheSitesDevicesVisitsAndRatersThatWerePlanned) {
  World world = world_of(0.0, 1.2, 12);
  world.sites = 3;
  world.devices = 2;
  world.raters = 2;
  const SimulatedStudy made = simulated_study(plan(), world, fitted(), 1, 1);
  ASSERT_EQ(made.people.size(), 24U);
  ASSERT_EQ(made.data.size(), 24U);
  std::set<std::size_t> sites, devices;
  for (const StudiedPerson& one : made.people) {
    sites.insert(one.site);
    devices.insert(one.device);
  }
  EXPECT_EQ(sites.size(), 3U);
  EXPECT_EQ(devices.size(), 2U);
  EXPECT_EQ(made.ratings.size(), 24U * 2U * rated_items().size());
  for (const auto& person : made.data)
    for (const auto& attempt : person.attempts) EXPECT_TRUE(attempt.synthetic);
  // Another number is another study, the same the same.
  EXPECT_EQ(simulated_study(plan(), world, fitted(), 1, 1).people[5].person.ability, made.people[5].person.ability);
  EXPECT_NE(simulated_study(plan(), world, fitted(), 1, 2).people[5].person.ability, made.people[5].person.ability);
}

// What a world without differences between devices lacks is what the devices add.
TEST(SimulatedStudies, ADeviceIsAtOneSiteAndAddsTheSameToAllItsPeople) {
  World world = world_of(0.0, 1.2, 24);
  world.sites = 3;
  world.devices = 2;
  World alike = world;
  alike.device_sd = 0.0;
  const SimulatedStudy made = simulated_study(plan(), world, fitted(), 1, 1);
  const SimulatedStudy without = simulated_study(plan(), alike, fitted(), 1, 1);
  std::map<std::pair<std::size_t, std::size_t>, double> added;
  for (std::size_t i = 0; i < made.people.size(); ++i) {
    const StudiedPerson& one = made.people[i];
    const double more = one.person.ability[0] - without.people[i].person.ability[0];
    const auto known = added.emplace(std::pair(one.site, one.device), more).first;
    EXPECT_NEAR(more, known->second, 1e-12) << one.name;
  }
  ASSERT_EQ(added.size(), 6U);
  for (auto a = added.begin(); a != added.end(); ++a)
    for (auto b = std::next(a); b != added.end(); ++b)
      EXPECT_GT(std::abs(a->second - b->second), 1e-6) << "two devices, one of them at another site";
}

study::Plan plan_of_three_visits() {
  study::Plan three = plan();
  three.visits = {{"v", 0.0, 2.0}, {"week", 7.0, 9.0}, {"fortnight", 14.0, 16.0}};
  return three;
}

// Everybody comes at first; who stays away once does not come back; the less able stay away more often: each visit
// with the probability 1 / (1 + exp(3 + .5 of the mean ability)).
TEST(SimulatedStudies, PeopleComeToEachVisitUntilTheyDropOut) {
  const study::Plan three = plan_of_three_visits();
  World world = world_of(0.0, 1.2, 4000);
  world.raters = 1;
  const SimulatedStudy made = simulated_study(three, world, fitted(), 2, 1);
  double expected[2] = {}, variance[2] = {}, lost[2] = {};
  std::size_t attempts = 0;
  for (std::size_t i = 0; i < made.people.size(); ++i) {
    const auto& visits = made.data[i].attempts;
    ASSERT_GE(visits.size(), 1U);
    ASSERT_LE(visits.size(), 3U);
    for (std::size_t v = 0; v < visits.size(); ++v) EXPECT_EQ(visits[v].day, 1.0 + 7.0 * static_cast<double>(v));
    attempts += visits.size();
    double mean = 0.0;
    for (const double one : made.people[i].person.ability) mean += one / 4.0;
    const double stays = 1.0 - 1.0 / (1.0 + std::exp(3.0 + 0.5 * mean));
    const std::size_t group = i / world.per_group;
    expected[group] += 1.0 - stays * stays;
    variance[group] += (1.0 - stays * stays) * stays * stays;
    lost[group] += visits.size() < 3 ? 1.0 : 0.0;
  }
  for (const std::size_t group : {0U, 1U})
    EXPECT_NEAR(lost[group], expected[group], 4.0 * std::sqrt(variance[group]));
  EXPECT_GT(lost[0], lost[1]);
  EXPECT_EQ(made.ratings.size(), attempts * rated_items().size()) << "an attempt that was not made is not rated";
}

// An outcome of the last visit is of that visit's attempts alone; who dropped out is absent, and left out as
// planned.
TEST(SimulatedStudies, WhoDroppedOutIsAbsentAtTheLastVisit) {
  study::Plan three = plan_of_three_visits();
  three.primary.resize(1);
  three.primary[0].visit = "fortnight";
  const SimulatedStudy made = simulated_study(three, world_of(0.0, 1.2, 200), fitted(), 2, 1);
  const study::StudyResult result = study::analyse(three, made.data);
  ASSERT_EQ(result.primary.size(), 1U);
  std::size_t absent = 0, seen = 0;
  for (std::size_t i = 0; i < made.people.size(); ++i) {
    const study::PersonValue& one = result.primary[0].people[i];
    ASSERT_EQ(one.name, made.people[i].name);
    const auto& visits = made.data[i].attempts;
    if (visits.size() < 3) ++absent;
    std::optional<double> there;
    if (visits.size() == 3 && visits[2].cut_off.empty())
      for (const MetricValue& metric : visits[2].metrics)
        if (metric.id == "tip_target_dist") there = metric.value;
    EXPECT_EQ(one.standing, there ? study::Standing::value : study::Standing::absent) << one.name;
    if (!there) continue;
    ++seen;
    EXPECT_EQ(one.attempts, 1U);
    EXPECT_EQ(one.value, *there);
  }
  EXPECT_GT(absent, 5U) << "about one in fifteen";
  EXPECT_GT(seen, 300U);
  EXPECT_TRUE(result.primary[0].answer.estimable());
}

// Those who come to all three are on the third visit what practice has made of them: of a rate of .12 and a ceiling
// of .8, two attempts are worth about .16, which is .065 of the logarithm of distance.
TEST(SimulatedStudies, PracticeOfEarlierVisitsCounts) {
  const SimulatedStudy made = simulated_study(plan_of_three_visits(), world_of(0.0, 0.0, 6000), fitted(), 2, 1);
  std::vector<double> nearer;
  for (const auto& person : made.data) {
    if (person.attempts.size() < 3) continue;
    std::optional<double> first, last;
    for (std::size_t m = 0; m < person.attempts[0].metrics.size(); ++m)
      if (person.attempts[0].metrics[m].id == "tip_target_dist") {
        first = person.attempts[0].metrics[m].value;
        last = person.attempts[2].metrics[m].value;
      }
    if (first && last) nearer.push_back(std::log(*first) - std::log(*last));
  }
  ASSERT_GT(nearer.size(), 8000U);
  double mean = 0.0, square = 0.0;
  for (const double one : nearer) mean += one / static_cast<double>(nearer.size());
  for (const double one : nearer) square += (one - mean) * (one - mean);
  const double error = std::sqrt(square) / static_cast<double>(nearer.size());
  EXPECT_NEAR(mean, 0.065, 4.0 * error + 0.01);
  EXPECT_GT(mean, 4.0 * error);
}

// Each item of each attempt once by each rater; and no rater rates one group after the other, which would make the
// drift of raters a difference between groups.
TEST(SimulatedStudies, EveryRaterRatesEveryAttemptInAnOrderOfTheirOwn) {
  World world = world_of(0.0, 1.2, 12);
  world.raters = 3;
  const SimulatedStudy made = simulated_study(plan(), world, fitted(), 1, 1);
  std::set<std::tuple<std::string, std::size_t, std::size_t, std::size_t>> rated;
  std::map<std::size_t, std::vector<std::string>> order;
  for (const Rating& one : made.ratings) {
    EXPECT_TRUE(rated.emplace(one.person, one.visit, one.rater, one.item).second) << one.person;
    if (one.item == 0) order[one.rater].push_back(one.person);
  }
  std::size_t attempts = 0;
  for (const auto& person : made.data) attempts += person.attempts.size();
  ASSERT_EQ(attempts, 24U);
  EXPECT_EQ(rated.size(), attempts * 3U * rated_items().size());
  ASSERT_EQ(order.size(), 3U);
  EXPECT_NE(order[1], order[2]);
  for (const auto& [rater, people] : order) {
    std::size_t first_group = 0;  // among the first half
    for (std::size_t i = 0; i < 12; ++i) first_group += people[i].starts_with("S1-") ? 1 : 0;
    // Of 12 drawn from 12 and 12: 6 in the mean, a standard deviation of 1.25. One group after the other makes 0
    // or 12.
    EXPECT_NEAR(static_cast<double>(first_group), 6.0, 5.0) << rater;
  }
}

}  // namespace
}  // namespace seldinger::assessment::population
