// Expert sets against closed forms: quantiles, one value a person, who enters; scores by hand.
#include "assessment/grading/standard.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assessment/grading/worthwhile.h"
#include "assessment/registry.h"
#include "tests/assessment/grading/graded_samples.h"

namespace seldinger::assessment {
namespace {

MetricValue of(const char* id, std::optional<double> value) {
  const MetricInfo* info = find_metric(id);
  return {id, info->version, value, info->unit, value ? "" : "no_endpoint"};
}

// Its last metrics are core_in_target and blind_advance.
ExpertAttempt attempt_of(int person, int number, double core_mm, double blind_mm) {
  ExpertAttempt made;
  made.attempt_id = "a" + std::to_string(person) + "-" + std::to_string(number);
  made.person_id = "p" + std::to_string(100 + person);
  made.started_us = 1000 * person + number;
  made.metrics = good_quality();
  made.metrics.push_back(of("core_in_target", core_mm));
  made.metrics.push_back(of("blind_advance", blind_mm));
  return made;
}

// Person i of n: two attempts to get used to it, far off; then 10 i mm, a little less and a good deal more. Unseen
// they always advance 2 mm.
std::vector<ExpertAttempt> attempts_of(int people) {
  std::vector<ExpertAttempt> all;
  for (int person = 1; person <= people; ++person) {
    all.push_back(attempt_of(person, 1, 900.0, 50.0));
    all.push_back(attempt_of(person, 2, 900.0, 50.0));
    all.push_back(attempt_of(person, 3, 10.0 * person - 1.0, 2.0));
    all.push_back(attempt_of(person, 4, 10.0 * person, 2.0));
    all.push_back(attempt_of(person, 5, 10.0 * person + 50.0, 2.0));
  }
  return all;
}

ExpertSet standard_of(std::vector<ExpertAttempt> attempts) {
  ExpertSet set = expert_set(std::move(attempts));
  set.standard_id = "s";
  return set;
}

std::vector<MetricValue> metrics_with(double core_mm, double blind_mm) {
  return attempt_of(0, 0, core_mm, blind_mm).metrics;
}

const MetricBand* find(const ExpertSet& set, const char* id) {
  return set.find(id, find_metric(id)->version);
}

TEST(QuantileTest, IsTypeSeven) {
  // By hand: {2, 4, 4, 5, 7, 9}, quartiles 4, 4.5, 6.5.
  const std::vector<double> values{2, 4, 4, 5, 7, 9};
  EXPECT_DOUBLE_EQ(quantile(values, 0.25), 4.0);
  EXPECT_DOUBLE_EQ(quantile(values, 0.5), 4.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.75), 6.5);
  EXPECT_DOUBLE_EQ(quantile(values, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(quantile(values, 1.0), 9.0);
  EXPECT_DOUBLE_EQ(quantile(std::vector<double>{3.0}, 0.9), 3.0);
}

TEST(ExpertSetTest, ABandIsOverOneValueAPerson) {
  const ExpertSet set = expert_set(attempts_of(11));
  const MetricBand* core = find(set, "core_in_target");
  ASSERT_NE(core, nullptr);
  // Medians 10, 20, …, 110: the 10th percentile is the second, the 90th the tenth; the tail of 50 mm changes
  // nothing.
  EXPECT_DOUBLE_EQ(core->low, 20.0);
  EXPECT_DOUBLE_EQ(core->high, 100.0);
  EXPECT_DOUBLE_EQ(core->mean, 60.0);
  EXPECT_DOUBLE_EQ(core->sd, std::sqrt(1100.0));  // Σ (10 k)² for k = −5 … 5 is 11000, over 10
  EXPECT_EQ(core->n, 11U);
  EXPECT_EQ(set.newest_us, 11005);
  EXPECT_EQ(set.attempts, 33U);
  EXPECT_EQ(set.people, 11U);
  EXPECT_FALSE(set.standard()) << "nobody has set it";
  EXPECT_TRUE(set.enough_people());
  EXPECT_EQ(set.find("core_in_target", 99), nullptr);
  EXPECT_TRUE(set.only_other_version("core_in_target", 99));
  EXPECT_FALSE(set.only_other_version("hit", 1));
  EXPECT_EQ(find(set, "gap_share"), nullptr) << "of the recording, not of what was done";
}

TEST(ExpertSetTest, AToleranceIntervalIsMeanAndSdWithinWhatTheMetricCanBe) {
  const ExpertSet set = expert_set(attempts_of(11));
  const MetricBand* core = find(set, "core_in_target");
  ASSERT_TRUE(core->tolerance.has_value());
  // k = 2.737 of 11 people, 90 % with 95 % (Eisenhart, Hastay and Wallis 1947); no length is below 0.
  EXPECT_NEAR(core->tolerance->high, 60.0 + 2.737 * std::sqrt(1100.0), 0.1);
  EXPECT_EQ(core->tolerance->low, 0.0);
}

TEST(ExpertSetTest, FamiliarisationIsNotInIt) {
  // Before: consultants' attempts counted from the first one on; of five attempts here the median was 10 i + 50 mm.
  EXPECT_DOUBLE_EQ(find(expert_set(attempts_of(8)), "core_in_target")->mean, 45.0);
  // Who has four attempts is still getting used to it.
  auto four_each = attempts_of(9);
  std::erase_if(four_each, [](const ExpertAttempt& one) { return one.attempt_id == "a9-2"; });
  const ExpertSet set = expert_set(four_each);
  EXPECT_EQ(set.people, 8U);
  EXPECT_FALSE(std::binary_search(set.attempt_ids.begin(), set.attempt_ids.end(), "a9-5"));
  EXPECT_FALSE(std::binary_search(set.attempt_ids.begin(), set.attempt_ids.end(), "a1-1"));
  EXPECT_TRUE(std::binary_search(set.attempt_ids.begin(), set.attempt_ids.end(), "a1-3"));
}

TEST(ExpertSetTest, OnlyWhatWasCompletedCounts) {
  // Before: attempts that were stopped to begin again counted as well.
  auto all = attempts_of(8);
  for (ExpertAttempt& one : all)
    if (one.attempt_id == "a8-1") one.completed = false;
  EXPECT_EQ(expert_set(all).people, 7U);
  all.push_back(attempt_of(8, 6, 80.0, 2.0));
  EXPECT_EQ(expert_set(all).people, 8U);
}

TEST(ExpertSetTest, OfFewerThanEightPeopleThereIsNoNumber) {
  const ExpertSet set = expert_set(attempts_of(7));
  EXPECT_FALSE(set.enough_people());
  EXPECT_EQ(set.people, 7U);
  EXPECT_TRUE(set.bands.empty());
  EXPECT_FALSE(expert_set(attempts_of(8)).bands.empty());
  const ExpertSet nobody = expert_set({});
  EXPECT_TRUE(nobody.id.empty());
  EXPECT_TRUE(nobody.bands.empty());
}

TEST(ExpertSetTest, LeavesOutWhatIsNotGradableAndBandsOfFewerThanEight) {
  auto all = attempts_of(10);
  all[0].metrics[0].value = 0.5;           // gaps: person 1 has four gradable attempts left
  all[7].metrics[3].value = std::nullopt;  // one null is not in person 2's median
  for (std::size_t i = 10; i < 15; ++i) all[i].metrics.pop_back();  // person 3 has no blind_advance at all
  ExpertSet set = expert_set(all);
  EXPECT_EQ(set.people, 9U);
  ASSERT_NE(find(set, "blind_advance"), nullptr) << "one without it does not take it from all";
  EXPECT_EQ(find(set, "blind_advance")->n, 8U);
  EXPECT_EQ(find(set, "core_in_target")->n, 9U);
  for (std::size_t i = 15; i < 20; ++i) all[i].metrics.pop_back();
  EXPECT_EQ(find(expert_set(all), "blind_advance"), nullptr);
}

TEST(ExpertSetTest, VersionsAreNotMixed) {
  auto all = attempts_of(8);
  for (std::size_t i = 0; i < 5; ++i) all[i].metrics.back().version = 99;  // person 1 was measured otherwise
  EXPECT_EQ(find(expert_set(all), "blind_advance"), nullptr) << "seven people have the version in force";
}

TEST(ExpertSetTest, OneValueAPersonIsAsTheEstimandHasIt) {
  auto all = attempts_of(8);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].metrics.push_back(of("withdrawals_partial", i % 5 == 4 ? 3.0 : 0.0));  // 0, 0, 3 of the last three
    all[i].metrics.push_back(of("hit", i % 5 == 4 ? 0.0 : 1.0));
  }
  EXPECT_DOUBLE_EQ(find(expert_set(all), "withdrawals_partial")->mean, 1.0);  // before: the median, 0
  EXPECT_NEAR(find(expert_set(all), "hit")->mean, 2.0 / 3.0, 1e-12);          // before: 1
  // Who parks or defers has no withdrawals of anything.
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i].metrics.push_back(of("procedure_performed", i % 5 == 3 ? 0.0 : 1.0));
  EXPECT_DOUBLE_EQ(find(expert_set(all), "withdrawals_partial")->mean, 1.5);
}

TEST(ExpertSetTest, ItsNameTellsItsAttemptsInAnyOrder) {
  auto all = attempts_of(8);
  const std::string id = expert_set(all).id;
  std::reverse(all.begin(), all.end());
  EXPECT_EQ(expert_set(all).id, id);
  all.push_back(attempt_of(3, 6, 30.0, 2.0));
  EXPECT_NE(expert_set(all).id, id);
}

TEST(ScoreTest, IsTheMeanOfZByHand) {
  auto all = attempts_of(11);
  // Unseen advance 0, 1, …, 10 mm a person: mean 5, variance 11.
  for (std::size_t i = 0; i < all.size(); ++i) all[i].metrics.back().value = static_cast<double>(i / 5);
  const ExpertSet set = standard_of(all);
  const auto scored = [&](double core_mm, double blind_mm) {
    const auto metrics = metrics_with(core_mm, blind_mm);
    return *score(set, {}, {metrics, "", {}}, "").value;
  };
  EXPECT_DOUBLE_EQ(scored(60.0, 5.0), 50.0);
  // One sd more in the core, two sd more unseen.
  EXPECT_NEAR(scored(60.0 + std::sqrt(1100.0), 5.0 + 2.0 * std::sqrt(11.0)), 50.0 + 50.0 / 3.0 * (1.0 - 2.0) / 2.0,
              1e-9);
  EXPECT_NEAR(scored(1e9, -1e9), 100.0, 1e-9);
  EXPECT_NEAR(scored(-1e9, 1e9), 0.0, 1e-9);
  EXPECT_NEAR(scored(1e9, 1e9), 50.0, 1e-9) << "no metric outweighs another by more than three sd";
}

TEST(ScoreTest, SpeedNeverBuysBackABlindAdvance) {
  auto all = attempts_of(11);
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i].metrics.back().value = static_cast<double>(i / 5);
    all[i].metrics.push_back(of("time_total", 30.0 + static_cast<double>(i / 5)));
  }
  const ExpertSet set = standard_of(all);
  ASSERT_NE(find(set, "time_total"), nullptr) << "a band it has";
  const auto scored = [&](double time_s) {
    auto metrics = metrics_with(60.0, 15.0);
    metrics.push_back(of("time_total", time_s));
    return score(set, {}, {metrics, "", {}}, "");
  };
  // Before: 58 of 100 at 1 s, 42 at 36 s: z of time was one of three.
  EXPECT_EQ(scored(1.0).value, scored(36.0).value);
  EXPECT_LT(*scored(1.0).value, 50.0);
  for (const std::string_view id : scored_metrics()) EXPECT_EQ(id.find("time_total"), id.npos);
}

TEST(ScoreTest, WhatAllConsultantsDoAlikeStillCosts) {
  // All advance 2 mm unseen. Before: sd 0, so the metric was left out, and 60 mm more cost nothing: 50 of 100.
  const ExpertSet set = standard_of(attempts_of(8));
  EXPECT_EQ(find(set, "blind_advance")->sd, 0.0);
  const auto scored = [&](double blind_mm) {
    const auto metrics = metrics_with(45.0, blind_mm);
    return score(set, {}, {metrics, "", {}}, "");
  };
  const double least_mm = worthwhile(*find_metric("blind_advance")).difference;
  EXPECT_DOUBLE_EQ(*scored(2.0).value, 50.0);
  EXPECT_DOUBLE_EQ(*scored(2.0 + least_mm).value, 50.0 - 50.0 / 3.0 / 2.0);
  EXPECT_DOUBLE_EQ(*scored(62.0).value, 25.0);
  const Score made = scored(62.0);
  const auto part = std::find_if(made.parts.begin(), made.parts.end(),
                                 [](const ScorePart& one) { return one.id == "blind_advance"; });
  ASSERT_NE(part, made.parts.end());
  EXPECT_DOUBLE_EQ(part->least_sd, least_mm);
  EXPECT_DOUBLE_EQ(*part->z, -3.0);
}

TEST(ScoreTest, NeverWeighsAnewAndNeverBuysACriticalErrorBack) {
  const ExpertSet set = standard_of(attempts_of(8));
  auto metrics = metrics_with(20.0, 2.0);
  const Gradable attempt{metrics, "", {}};
  const Score whole = score(set, {}, attempt, "p0");
  ASSERT_TRUE(whole.value.has_value());
  EXPECT_EQ(whole.set_id, set.id);
  ASSERT_EQ(whole.parts.size(), 2U);
  EXPECT_EQ(score(set, {}, attempt, "p103").reason, "of_the_set");

  Grade failed;
  failed.verdict = Verdict::failed;
  failed.criteria = {{*criterion_from("blind_advance <= 0"), Outcome::missed, 2.0, "mm", "", false}};
  EXPECT_EQ(score(set, failed, attempt, "").value, whole.value) << "a grade says nothing to the score";
  failed.criteria[0].criterion.critical = true;
  EXPECT_EQ(score(set, failed, attempt, "").value, 0.0);
  EXPECT_EQ(score(set, failed, attempt, "").reason, "critical_error");

  metrics[3] = of("core_in_target", std::nullopt);
  const Score missing = score(set, {}, {metrics, "", {}}, "");
  EXPECT_FALSE(missing.value.has_value());
  EXPECT_EQ(missing.reason, "missing_metric");
  Grade gaps;
  gaps.reason = "tracking_gaps";
  EXPECT_EQ(score(set, gaps, attempt, "").reason, "tracking_gaps");
}

TEST(ScoreTest, ANewerVersionIsNotHeldAgainstAnOlderStandard) {
  const ExpertSet set = standard_of(attempts_of(8));
  auto metrics = metrics_with(20.0, 2.0);
  metrics.back().version += 1;
  const Score made = score(set, {}, {metrics, "", {}}, "");
  EXPECT_FALSE(made.value.has_value());
  EXPECT_EQ(made.reason, "other_version");
}

TEST(ScoreTest, WithoutAStandardThereIsNone) {
  // Before: five consultants were enough for a score.
  const auto metrics = metrics_with(20.0, 2.0);
  for (const int people : {5, 7, 8}) {
    const Score none = score(expert_set(attempts_of(people)), {}, {metrics, "", {}}, "");
    EXPECT_FALSE(none.value.has_value()) << people;
    EXPECT_EQ(none.reason, "no_expert_set") << people << ", and nobody has set it";
  }
}

}  // namespace
}  // namespace seldinger::assessment
