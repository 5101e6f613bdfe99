// Whether metrics find what was planted in simulated trainees. It tests the software, not validity: nothing here
// says that people differ so.
//
// Area under the ROC curve by its definition (Mann and Whitney's count of pairs), held against what was reasoned
// beforehand from the parameters that differ, and, where none does, against the exact distribution of that count
// when both groups are the same (Mann and Whitney, Ann. Math. Statist. 18, 1947, 50).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "assessment/operators/plan.h"
#include "assessment/score.h"
#include "session/attempt/simulated_attempt.h"
#include "session/attempt/simulation.h"
#include "sim/volume/analytic.h"
#include "tests/fixtures/ball_case.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::session {
namespace {

// More of them in `./run test --long`.
const std::uint64_t kRepetitions = [] {
  const char* const asked = std::getenv("SELDINGER_REPETITIONS");
  return asked == nullptr ? std::uint64_t{1} : std::strtoull(asked, nullptr, 10);
}();

constexpr std::size_t kPeople = 12;  // in each group

// A ball of soft tissue with a target 45 mm below its skin in an organ of its own, under slices.
struct Scene {
  cases::Case scene;
  assessment::PuncturePlan plan;
};
const Scene& ball() {
  static const Scene kScene = [] {
    Scene made;
    made.scene = fixtures::ball_case({55, 4.0, 100.0});
    made.scene.lesions.push_back({{0.0, -55.0, 0.0}, 6.0, 5.0});
    made.scene.structures.push_back({"organ", volume::TissueClass::soft_tissue, cases::StructureRule::organ,
                                     cases::Sphere{{0.0, -45.0, 0.0}, 35.0}});
    const auto plan =
        assessment::plan_puncture(made.scene.volume, made.scene.skin_index, made.scene.lesions[0].center_lps_mm,
                                  assessment::path_limits(made.scene));
    CHECK(plan.has_value());
    made.plan = *plan;
    return made;
  }();
  return kScene;
}

using Values = std::map<std::string, std::vector<double>>;  // by metric: one value a person, where there is one

Values measured(const assessment::OperatorProfile& profile, std::uint64_t seed, std::uint64_t attempt_number = 0) {
  Values values;
  for (const SimulatedTrial& trial : simulated_trials(profile, seed, 1, kPeople)) {
    const auto person = assessment::at_attempt(trial.profile, attempt_number);
    const auto scored = assessment::score(
        ball().scene, run_attempt(ball().scene, ball().plan, person, trial.seed + 1000 * attempt_number));
    CHECK(scored.has_value());
    for (const assessment::MetricValue& metric : scored->metrics)
      if (metric.value) values[metric.id].push_back(*metric.value);
  }
  return values;
}

// Pairs in which the first is larger, ties by half.
double pairs_above(const std::vector<double>& a, const std::vector<double>& b) {
  double count = 0.0;
  for (const double x : a)
    for (const double y : b) count += x > y ? 1.0 : x == y ? 0.5 : 0.0;
  return count;
}

double auc(const Values& a, const Values& b, const std::string& metric) {
  const auto &x = a.at(metric), &y = b.at(metric);
  EXPECT_GE(x.size(), kPeople - 2) << metric;
  EXPECT_GE(y.size(), kPeople - 2) << metric;
  return pairs_above(x, y) / static_cast<double>(x.size() * y.size());
}

// How many of all orders of n and m values have the count 0, 1, …, n·m: by taking the largest value away.
std::vector<double> orders_by_count(std::size_t n, std::size_t m) {
  std::map<std::pair<std::size_t, std::size_t>, std::vector<double>> known;
  for (std::size_t i = 0; i <= n; ++i)
    for (std::size_t j = 0; j <= m; ++j) {
      std::vector<double>& now = known[{i, j}];
      now.assign(i * j + 1, 0.0);
      if (i == 0 || j == 0) {
        now[0] = 1.0;
        continue;
      }
      const auto &without_a = known.at({i - 1, j}), &without_b = known.at({i, j - 1});
      for (std::size_t u = 0; u < without_a.size(); ++u) now[u + j] += without_a[u];
      for (std::size_t u = 0; u < without_b.size(); ++u) now[u] += without_b[u];
    }
  return known.at({n, m});
}

// Two-sided: the probability of a count at least so far from the middle, when both groups are the same.
double exact_p(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> orders = orders_by_count(a.size(), b.size());
  const double middle = static_cast<double>(orders.size() - 1) / 2.0, off = std::abs(pairs_above(a, b) - middle);
  double all = 0.0, beyond = 0.0;
  for (std::size_t u = 0; u < orders.size(); ++u) {
    all += orders[u];
    if (std::abs(static_cast<double>(u) - middle) >= off - 1e-9) beyond += orders[u];
  }
  return beyond / all;
}

// Whom each is larger in, reasoned from the skills: novices are told the target worse and accept more of a miss,
// drift, go on unseen, aim worse, are slower and leave steps out.
const std::map<std::string, bool> kNovicesHaveMore = {
    {"tip_target_dist", true},        {"probe_drift_advancing", true},
    {"blind_advance", true},          {"blind_advance_max", true},
    {"plane_angle_mean", true},       {"time_total", true},
    {"advance_visible_share", false}, {"steps_done", false}};
// Continuous, and of different sides of an attempt.
const char* const kContinuous[] = {"tip_target_dist", "probe_drift_advancing", "plane_angle_mean", "time_total",
                                   "path_tip"};

TEST(PlantedTruth, TheCountOfOrdersIsExact) {
  // By hand: 2 and 2 values have six orders with counts 0, 1, 2, 2, 3, 4.
  EXPECT_EQ(orders_by_count(2, 2), (std::vector<double>{1, 1, 2, 1, 1}));
  double all = 0.0;
  for (const double orders : orders_by_count(12, 12)) all += orders;
  EXPECT_EQ(all, 2704156.0);  // 24 over 12
  EXPECT_NEAR(exact_p({1, 2, 3}, {4, 5, 6}), 2.0 / 20.0, 1e-12);
  EXPECT_EQ(pairs_above({1, 2}, {2, 0}), 2.5);
}

TEST(PlantedTruth, ExpertsAndNovicesAreToldApart) {
  std::map<std::string, double> mean;
  for (std::uint64_t repetition = 0; repetition < kRepetitions; ++repetition) {
    const Values novices = measured(*assessment::named_profile("novice"), 100 + 1000 * repetition);
    const Values experts = measured(*assessment::named_profile("expert"), 500 + 1000 * repetition);
    for (const auto& [metric, more] : kNovicesHaveMore) {
      const double found = more ? auc(novices, experts, metric) : auc(experts, novices, metric);
      EXPECT_GE(found, 0.65) << metric << ", repetition "
                             << repetition;  // of 12 and 12 people an AUC is known to ±.1
      mean[metric] += found / static_cast<double>(kRepetitions);
    }
  }
  for (const auto& [metric, found] : mean) {
    EXPECT_GE(found, 0.8) << metric;
    RecordProperty("auc_" + metric, std::to_string(found));
  }
}

// Slow, but with an expert's hands: only time tells, and how far the tip went, since a hand that waits trembles.
TEST(PlantedTruth, WhatIsPlantedEqualIsNotToldApart) {
  assessment::OperatorProfile slow = *assessment::named_profile("expert");
  const assessment::OperatorProfile novice = *assessment::named_profile("novice");
  slow.scan_s = slow.learning.towards.scan_s = novice.scan_s;
  slow.step_s = slow.learning.towards.step_s = novice.step_s;
  double farther = 0.0;
  for (std::uint64_t repetition = 0; repetition < kRepetitions; ++repetition) {
    const Values slows = measured(slow, 100 + 1000 * repetition);
    const Values experts = measured(*assessment::named_profile("expert"), 500 + 1000 * repetition);
    EXPECT_GE(auc(slows, experts, "time_total"), 0.8) << repetition;
    farther += auc(slows, experts, "path_tip") / static_cast<double>(kRepetitions);
    for (const char* metric : {"tip_target_dist", "probe_drift_advancing", "plane_angle_mean"})
      EXPECT_GE(exact_p(slows.at(metric), experts.at(metric)), 1e-3 / (3.0 * static_cast<double>(kRepetitions)))
          << metric << ", repetition " << repetition;
  }
  EXPECT_GE(farther, 0.7);
}

TEST(PlantedTruth, TwoGroupsOfOneProfileAreNotToldApart) {
  for (const char* name : {"novice", "expert"}) {
    std::map<std::string, double> mean;
    for (std::uint64_t repetition = 0; repetition < kRepetitions; ++repetition) {
      const auto profile = *assessment::named_profile(name);
      const Values a = measured(profile, 100 + 1000 * repetition), b = measured(profile, 500 + 1000 * repetition);
      for (const char* metric : kContinuous) {
        EXPECT_GE(exact_p(a.at(metric), b.at(metric)),
                  1e-3 / (2.0 * std::size(kContinuous) * static_cast<double>(kRepetitions)))
            << name << ", " << metric << ", repetition " << repetition;
        mean[metric] += auc(a, b, metric) / static_cast<double>(kRepetitions);
      }
    }
    // Of one area the standard deviation is √((n + m + 1) / (12 n m)); four of the mean's.
    const double sd = std::sqrt((2.0 * kPeople + 1.0) / (12.0 * kPeople * kPeople));
    for (const auto& [metric, found] : mean)
      EXPECT_NEAR(found, 0.5, 4.0 * sd / std::sqrt(static_cast<double>(kRepetitions))) << name << ", " << metric;
  }
}

TEST(PlantedTruth, AnExpertDefersWithoutAPuncture) {
  assessment::PuncturePlan plan = ball().plan;
  plan.brief = {2.4, 38.0};
  const auto recording = run_attempt(ball().scene, plan, *assessment::named_profile("expert"), 1);
  EXPECT_FALSE(recording.endpoint.has_value());
  std::vector<cases::EventKind> said;
  for (const cases::Event& event : *recording.events)
    if (event.kind != cases::EventKind::calipers_recorded) said.push_back(event.kind);
  EXPECT_EQ(said, (std::vector{cases::EventKind::sign_in, cases::EventKind::defer, cases::EventKind::sign_out}));
  for (const cases::PoseSample& pose : recording.poses)
    ASSERT_GT(ball().scene.skin_index.closest(pose.tip_lps_mm).distance_mm, 5.0);
  EXPECT_LT(static_cast<double>(recording.inputs.size()) * recording.dt_s, 10.0);
}

// The first attempts of learners are a novice's, late ones an expert's.
TEST(PlantedTruth, LearnersBecomeExperts) {
  const assessment::OperatorProfile learner = *assessment::named_profile("learner");
  const Values first = measured(learner, 100, 0), late = measured(learner, 100, 30);
  const Values experts = measured(*assessment::named_profile("expert"), 500);
  for (const char* metric : {"tip_target_dist", "blind_advance", "time_total"}) {
    EXPECT_GE(auc(first, late, metric), 0.8) << metric;
    EXPECT_GE(auc(first, experts, metric), 0.8) << metric;
  }
  for (const char* metric : {"tip_target_dist", "time_total"})
    EXPECT_GE(exact_p(late.at(metric), experts.at(metric)), 1e-3) << metric;
}

}  // namespace
}  // namespace seldinger::session
