// Expert sets against closed forms: quantiles, medians a person, who enters; scores by hand.
#include "assessment/grading/standard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/assessment/grading/graded_samples.h"

namespace seldinger::assessment {
namespace {

ExpertAttempt attempt_of(int person, int number, double time_s, double blind_mm) {
  ExpertAttempt made;
  made.attempt_id = "a" + std::to_string(person) + "-" + std::to_string(number);
  made.person_id = "p" + std::to_string(person);
  made.started_us = 1000 * person + number;
  made.metrics = good_quality();
  made.metrics.push_back({"time_total", 1, time_s, "s", ""});
  made.metrics.push_back({"blind_advance", 1, blind_mm, "mm", ""});
  return made;
}

// Person i of n does 10 i s, a little less and a good deal more; and always advances 2 mm unseen.
std::vector<ExpertAttempt> attempts_of(int people) {
  std::vector<ExpertAttempt> all;
  for (int person = 1; person <= people; ++person) {
    all.push_back(attempt_of(person, 1, 10.0 * person - 1.0, 2.0));
    all.push_back(attempt_of(person, 2, 10.0 * person, 2.0));
    all.push_back(attempt_of(person, 3, 10.0 * person + 50.0, 2.0));
  }
  return all;
}

std::vector<MetricValue> metrics_with(double time_s, double blind_mm) {
  return attempt_of(0, 0, time_s, blind_mm).metrics;
}

TEST(QuantileTest, IsTypeSeven) {
  // assessment.md §3.1: {2, 4, 4, 5, 7, 9}, quartiles 4, 4.5, 6.5.
  const std::vector<double> values{2, 4, 4, 5, 7, 9};
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 4.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 4.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.75), 6.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 9.0);
  EXPECT_DOUBLE_EQ(quantile(std::vector<double>{3.0}, 0.9), 3.0);
}

TEST(ExpertSetTest, ABandIsOverEachPersonsMedian) {
  const ExpertSet set = expert_set(SetKind::consultants, attempts_of(11));
  const MetricBand* time = set.find("time_total", 1);
  ASSERT_NE(time, nullptr);
  // Medians 10, 20, …, 110: the 10th percentile is the second, the 90th the tenth; the tail of 50 s changes
  // nothing.
  EXPECT_DOUBLE_EQ(time->low, 20.0);
  EXPECT_DOUBLE_EQ(time->high, 100.0);
  EXPECT_DOUBLE_EQ(time->mean, 60.0);
  EXPECT_DOUBLE_EQ(time->sd, std::sqrt(1100.0));  // Σ (10 k)² for k = −5 … 5 is 11000, over 10
  EXPECT_EQ(time->n, 11U);
  EXPECT_EQ(set.newest_us, 11003);
  EXPECT_EQ(set.attempt_ids.size(), 33U);
  EXPECT_TRUE(set.standard());
  EXPECT_EQ(set.find("time_total", 2), nullptr);
  EXPECT_EQ(set.find("gap_share", 2), nullptr) << "of the recording, not of what was done";
}

TEST(ExpertSetTest, IsProvisionalBelowEightPeopleOfThreeAttempts) {
  EXPECT_TRUE(expert_set(SetKind::consultants, attempts_of(8)).standard());
  EXPECT_FALSE(expert_set(SetKind::consultants, attempts_of(7)).standard());
  auto two_each = attempts_of(8);
  std::erase_if(two_each,
                [](const ExpertAttempt& one) { return one.person_id == "p8" && one.started_us % 2 == 0; });
  const ExpertSet set = expert_set(SetKind::consultants, two_each);
  EXPECT_FALSE(set.standard());
  EXPECT_EQ(set.person_ids.size(), 7U) << "who has two attempts is not in it";
  EXPECT_FALSE(std::binary_search(set.attempt_ids.begin(), set.attempt_ids.end(), "a8-1"));
}

TEST(ExpertSetTest, OfFewPeopleShowsNoBand) {
  EXPECT_TRUE(expert_set(SetKind::consultants, attempts_of(4)).bands.empty());
  EXPECT_FALSE(expert_set(SetKind::consultants, attempts_of(5)).bands.empty());
  const ExpertSet nobody = expert_set(SetKind::consultants, {});
  EXPECT_TRUE(nobody.id.empty());
  EXPECT_TRUE(nobody.bands.empty());
}

TEST(ExpertSetTest, LeavesOutWhatIsNotGradableAndWhatNotAllHave) {
  auto all = attempts_of(8);
  all[0].metrics[0].value = 0.5;                                  // gaps: person 1 has two gradable attempts left
  all[3].metrics[4].value = std::nullopt;                         // one null is not in person 2's median
  for (std::size_t i = 6; i < 9; ++i) all[i].metrics.pop_back();  // person 3 has no blind_advance at all
  const ExpertSet set = expert_set(SetKind::consultants, all);
  EXPECT_EQ(set.person_ids.size(), 7U);
  EXPECT_EQ(set.find("blind_advance", 1), nullptr);
  ASSERT_NE(set.find("time_total", 1), nullptr);
}

TEST(ExpertSetTest, ItsNameTellsItsAttemptsInAnyOrder) {
  auto all = attempts_of(8);
  const std::string id = expert_set(SetKind::consultants, all).id;
  std::reverse(all.begin(), all.end());
  EXPECT_EQ(expert_set(SetKind::consultants, all).id, id);
  all.push_back(attempt_of(3, 4, 30.0, 2.0));
  EXPECT_NE(expert_set(SetKind::consultants, all).id, id);
}

TEST(ExpertSetTest, ASimulatedOneIsNeverAStandard) {
  const ExpertSet set = expert_set(SetKind::simulated, attempts_of(20));
  EXPECT_FALSE(set.standard());
  EXPECT_FALSE(set.bands.empty());
  EXPECT_EQ(set.person_ids.size(), 60U) << "each seed is one";
  const auto metrics = metrics_with(60.0, 2.0);
  const Score none = score(set, {}, {metrics, "", {}}, "");
  EXPECT_FALSE(none.value.has_value());
  EXPECT_EQ(none.reason, "no_expert_set");
}

TEST(ScoreTest, IsTheMeanOfZByHand) {
  auto all = attempts_of(11);
  // Unseen advance 0, 1, …, 10 mm a person: mean 5, variance 11.
  for (std::size_t i = 0; i < all.size(); ++i) all[i].metrics[4].value = static_cast<double>(i / 3);
  const ExpertSet set = expert_set(SetKind::consultants, all);
  const auto of = [&](double time_s, double blind_mm) {
    const auto metrics = metrics_with(time_s, blind_mm);
    return *score(set, {}, {metrics, "", {}}, "").value;
  };
  EXPECT_DOUBLE_EQ(of(60.0, 5.0), 50.0);
  // Less is better in both: one sd faster, two sd more unseen.
  EXPECT_NEAR(of(60.0 - std::sqrt(1100.0), 5.0 + 2.0 * std::sqrt(11.0)), 50.0 + 50.0 / 3.0 * (1.0 - 2.0) / 2.0,
              1e-9);
  EXPECT_NEAR(of(-1e9, -1e9), 100.0, 1e-9);
  EXPECT_NEAR(of(1e9, 1e9), 0.0, 1e-9);
  EXPECT_NEAR(of(-1e9, 1e9), 50.0, 1e-9) << "no metric outweighs another by more than three sd";
}

TEST(ScoreTest, NeverWeighsAnewAndNeverBuysACriticalErrorBack) {
  const ExpertSet set = expert_set(SetKind::consultants, attempts_of(8));
  auto metrics = metrics_with(20.0, 2.0);
  const Gradable attempt{metrics, "", {}};
  const Score whole = score(set, {}, attempt, "p0");
  ASSERT_TRUE(whole.value.has_value());
  EXPECT_EQ(whole.set_id, set.id);
  ASSERT_EQ(whole.parts.size(), 2U);
  EXPECT_EQ(whole.parts[0].reason, "no_spread") << "all advance 2 mm unseen";
  EXPECT_EQ(score(set, {}, attempt, "p3").reason, "of_the_set");

  Grade failed;
  failed.verdict = Verdict::failed;
  failed.criteria = {{*criterion_from("blind_advance <= 0"), Outcome::missed, 2.0, "mm", "", false}};
  EXPECT_EQ(score(set, failed, attempt, "").value, whole.value) << "a grade says nothing to the score";
  failed.criteria[0].criterion.critical = true;
  EXPECT_EQ(score(set, failed, attempt, "").value, 0.0);
  EXPECT_EQ(score(set, failed, attempt, "").reason, "critical_error");

  metrics[3].value = std::nullopt;
  metrics[3].reason = "no_endpoint";
  const Score missing = score(set, {}, {metrics, "", {}}, "");
  EXPECT_FALSE(missing.value.has_value());
  EXPECT_EQ(missing.reason, "missing_metric");
  Grade gaps;
  gaps.reason = "tracking_gaps";
  EXPECT_EQ(score(set, gaps, attempt, "").reason, "tracking_gaps");
}

TEST(ScoreTest, HasNoValueWhereTheSetDoesNotDiffer) {
  auto all = attempts_of(8);
  for (ExpertAttempt& one : all) one.metrics[3].value = 30.0;
  const auto metrics = metrics_with(20.0, 2.0);
  const Score none = score(expert_set(SetKind::consultants, all), {}, {metrics, "", {}}, "");
  EXPECT_FALSE(none.value.has_value());
  EXPECT_EQ(none.reason, "no_spread");
}

}  // namespace
}  // namespace seldinger::assessment
