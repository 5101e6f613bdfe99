// The planned analysis on hand-made people, against the statistics' own oracles and counts made by hand.
#include "assessment/study/analysis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "assessment/statistics/groups/groups_procedures.h"
#include "assessment/statistics/relations/imputation.h"
#include "tests/assessment/study/sample_plan.h"

namespace seldinger::assessment::study {
namespace {

using testing::HasSubstr;

MetricValue now(const char* id, std::optional<double> value, const char* reason = "") {
  const MetricInfo* info = find_metric(id);
  return {id, info->version, value, info->unit, reason};
}

StudyAttempt attempt(std::optional<double> distance_mm, double nogo_mm = 0.0, double day = 0.0) {
  StudyAttempt made;
  made.case_id = "case-1";
  made.day = day;
  made.hand = "arm";
  made.metrics = {now("procedure_performed", 1.0), now("skin_punctures", 1.0),
                  now("tip_target_dist", distance_mm, distance_mm ? "" : "no_endpoint"),
                  now("nogo_length", nogo_mm)};
  return made;
}

StudyPerson person(const std::string& name, const std::string& group, std::vector<StudyAttempt> attempts) {
  return {name, group, std::move(attempts)};
}

// One attempt each.
std::vector<StudyPerson> people(const std::vector<double>& few, const std::vector<double>& many) {
  std::vector<StudyPerson> all;
  for (std::size_t i = 0; i < few.size(); ++i)
    all.push_back(person("f" + std::to_string(i), "few", {attempt(few[i])}));
  for (std::size_t i = 0; i < many.size(); ++i)
    all.push_back(person("m" + std::to_string(i), "many", {attempt(many[i])}));
  return all;
}

statistics::Answer by_hand(const char* test, const std::vector<double>& few, const std::vector<double>& many) {
  statistics::DataTable table;
  table.rows = few.size() + many.size();
  table.values = {{"x", few}};
  table.values[0].values.insert(table.values[0].values.end(), many.begin(), many.end());
  table.group.assign(few.size(), "few");
  table.group.insert(table.group.end(), many.size(), "many");
  for (const statistics::Procedure& one : statistics::groups_procedures())
    if (std::string(one.name) == test) return one.run(table, {});
  ADD_FAILURE() << test;
  return {};
}

const std::vector<double> kFew{9, 7, 6, 8, 11}, kMany{3, 4, 2, 7, 5, 1};

TEST(Analysis, IsThePlannedTestOfOneValueForEachPerson) {
  const StudyResult result = analyse(sample_plan(), people(kFew, kMany));
  const Compared& distance = result.primary.at(0);
  const statistics::Answer oracle = by_hand("brunner_munzel", kFew, kMany);
  ASSERT_TRUE(distance.refused.empty()) << distance.refused;
  EXPECT_EQ(distance.answer.n, 11U);
  EXPECT_EQ(distance.answer.estimate, oracle.estimate);
  EXPECT_EQ(distance.answer.p_value, oracle.p_value);
  EXPECT_DOUBLE_EQ(*distance.answer.estimate, 28.5 / 30.0) << "28 of 30 pairs and a tie, counted by hand";
  EXPECT_EQ(distance.first.median, 8.0);
  EXPECT_EQ(distance.second.median, 3.5);
  EXPECT_TRUE(result.stopped);
}

TEST(Analysis, APersonsAttemptsAreOneValueByTheMedian) {
  auto all = people(kFew, kMany);
  all[0].attempts = {attempt(1.0), attempt(9.0), attempt(20.0)};
  const Compared once = analyse(sample_plan(), people(kFew, kMany)).primary[0];
  const Compared thrice = analyse(sample_plan(), all).primary[0];
  EXPECT_EQ(thrice.answer.p_value, once.answer.p_value);
  EXPECT_EQ(thrice.answer.n, once.answer.n);
  EXPECT_EQ(thrice.first.attempts, 7U);
}

// Who gives up would otherwise make the group look better.
TEST(Analysis, WhoFailedRanksLast) {
  auto all = people(kFew, kMany);
  all[0].attempts = {attempt(std::nullopt)};
  const Compared failed = analyse(sample_plan(), all).primary[0];
  std::vector<double> worst = kFew;
  worst[0] = 1000.0;
  const statistics::Answer oracle = by_hand("brunner_munzel", worst, kMany);
  EXPECT_EQ(failed.answer.p_value, oracle.p_value);
  EXPECT_EQ(failed.answer.estimate, oracle.estimate);
  EXPECT_EQ(failed.first.failures, 1U);
  EXPECT_EQ(failed.first.with_value, 4U);
  ASSERT_EQ(failed.sensitivity.size(), 1U);
  EXPECT_EQ(failed.sensitivity[0].answer.n, 10U) << "only who has a value";
  EXPECT_EQ(failed.sensitivity[0].answer.p_value, by_hand("brunner_munzel", {7, 6, 8, 11}, kMany).p_value);
  // A minority of failures leaves the person's median a value.
  all[0].attempts = {attempt(std::nullopt), attempt(9.0), attempt(9.0)};
  EXPECT_EQ(analyse(sample_plan(), all).primary[0].first.failures, 0U);
}

TEST(Analysis, WhoHasNoAttemptIsLeftOutOrFailedAsThePlanSays) {
  auto all = people(kFew, kMany);
  all[5].attempts.clear();
  const Compared out = analyse(sample_plan(), all).primary[0];
  EXPECT_EQ(out.answer.n, 10U);
  EXPECT_EQ(out.second.absent, 1U);
  ASSERT_EQ(out.sensitivity.size(), 2U) << "best and worst for each group";
  EXPECT_LT(*out.sensitivity[0].answer.estimate, *out.answer.estimate) << "the absent one of the many as the worst";
  EXPECT_GT(*out.sensitivity[1].answer.estimate, *out.answer.estimate) << "and as the best";
  std::string json = sample_plan_json();
  json.replace(json.find("left_out"), 8, "failure");
  const Plan fails = plan_from_json(json).value();
  const Compared failed = analyse(fails, all).primary[0];
  std::vector<double> worst = kMany;
  worst[0] = 1000.0;
  EXPECT_EQ(failed.answer.p_value, by_hand("brunner_munzel", kFew, worst).p_value);
}

const Sensitivity* of_kind(const Compared& compared, OtherRule kind) {
  for (const Sensitivity& one : compared.sensitivity)
    if (one.kind == kind) return &one;
  return nullptr;
}

TEST(Analysis, PerProtocolIsWhoCameToEveryVisit) {
  Plan plan = sample_plan();
  auto all = people(kFew, kMany);
  StudyResult result = analyse(plan, all);
  add_sensitivity(plan, all, result);
  EXPECT_TRUE(result.primary[0].sensitivity.empty()) << "everybody came to the only visit";
  plan.visits.push_back({"later", 20.0, 30.0});
  for (StudyPerson& one : all) one.attempts.push_back(attempt(5.0, 0.0, 25.0));
  all[0].attempts.pop_back();
  all[10].attempts.back().day = 31.0;
  result = analyse(plan, all);
  add_sensitivity(plan, all, result);
  const Sensitivity* kept = of_kind(result.primary[0], OtherRule::per_protocol);
  ASSERT_NE(kept, nullptr);
  EXPECT_EQ(kept->answer.p_value, by_hand("brunner_munzel", {7, 6, 8, 11}, {3, 4, 2, 7, 5}).p_value);
  EXPECT_EQ(result.primary[0].answer.n, 11U) << "as they were meant to be treated";
  EXPECT_FALSE(result.primary[0].people[0].every_visit);
  EXPECT_TRUE(result.primary[0].people[1].every_visit);
}

// Of means the answer is known in closed form: those who are absent lie at a distance that leaves t at its limit.
TEST(Analysis, TheTippingPointIsWhereTheConclusionGoes) {
  std::string json = sample_plan_json();
  json.replace(json.find("\"brunner_munzel\""), 16, "\"welch\"");
  json.replace(json.find("\"smallest_worthwhile\": 2}"), 25, "\"smallest_worthwhile\": 2, \"failure_value\": 40}");
  const Plan plan = plan_from_json(json).value();
  auto all = people({9, 7, 6, 8, 11}, {3, 4, 2, 7, 5, 1});
  for (const char* name : {"m6", "m7"}) all.push_back(person(name, "many", {}));
  all.push_back(person("f5", "few", {}));
  StudyResult result = analyse(plan, all);
  ASSERT_LT(*result.primary[0].answer.p_value, plan.alpha);
  add_sensitivity(plan, all, result);
  const Sensitivity* tipping = of_kind(result.primary[0], OtherRule::tipping);
  ASSERT_NE(tipping, nullptr);
  const double shift = tipping->shift.value();
  EXPECT_GT(shift, 0.0);
  // The absent of the better group are worse, those of the other better; lower is better.
  const auto by_shift = [](double by) {
    return *by_hand("welch", {9, 7, 6, 8, 11, 8 - by}, {3, 4, 2, 7, 5, 1, 3.5 + by, 3.5 + by}).p_value;
  };
  EXPECT_NEAR(*tipping->answer.p_value, by_shift(shift), 1e-12);
  EXPECT_GE(by_shift(shift), plan.alpha);
  EXPECT_LT(by_shift(shift - 0.001 * 10.0), plan.alpha) << "the least shift, to a thousandth of the range";
  EXPECT_EQ(of_kind(analyse(plan, all).primary[0], OtherRule::tipping), nullptr) << "asked for by a report alone";
}

// Where the plan asks for it: who is absent, from the other outcome; the same as the procedure says of the same
// table.
TEST(Analysis, WhoIsAbsentIsImputedWhereThePlanAsksForIt) {
  Plan plan = sample_plan();
  plan.imputations = 20;
  plan.primary[1].impute_from = "distance";
  std::vector<StudyPerson> all;
  statistics::DataTable table;
  table.values.push_back({"nogo_length", {}});
  for (int i = 0; i < 20; ++i) {
    const bool few = i % 2 == 0, away = i == 6 || i == 7;
    const double distance = 3.0 + i % 7, nogo = distance + 0.25 * (i % 3) + (few ? 2.0 : 0.0);
    StudyPerson& one = all.emplace_back(person("p" + std::to_string(i), few ? "few" : "many", {}));
    one.attempts.push_back(attempt(distance, nogo));
    if (away) one.attempts.back().metrics.pop_back();
  }
  for (const bool few : {true, false})
    for (int i = few ? 0 : 1; i < 20; i += 2) {
      table.values.front().values.push_back(i == 6 || i == 7 ? std::nan("")
                                                             : 3.0 + i % 7 + 0.25 * (i % 3) + (few ? 2.0 : 0.0));
      table.x.push_back(3.0 + i % 7);
      table.group.emplace_back(few ? "few" : "many");
      ++table.rows;
    }
  StudyResult result = analyse(plan, all);
  add_sensitivity(plan, all, result);
  const Sensitivity* imputed = of_kind(result.primary[1], OtherRule::imputed);
  ASSERT_NE(imputed, nullptr);
  const statistics::Answer want =
      statistics::imputed(table, statistics::ProcedureOptions({{"order", "few:many"}, {"draws", "20"}}));
  ASSERT_TRUE(want.estimable());
  EXPECT_EQ(imputed->answer.estimate, want.estimate);
  EXPECT_EQ(imputed->answer.ci95, want.ci95);
  ASSERT_EQ(imputed->draws.size(), 20U);
  EXPECT_EQ(imputed->draws.front().size(), 2U);
  EXPECT_EQ(result.primary[1].answer.n, 18U) << "the planned comparison is of those who are there";
  EXPECT_EQ(of_kind(result.primary[0], OtherRule::imputed), nullptr) << "ranks are not imputed";
}

TEST(Analysis, WhatIsNotSignificantHasNoTippingPoint) {
  auto all = people({4, 5, 6, 3}, {5, 4, 6, 3.5});
  all.push_back(person("m4", "many", {}));
  StudyResult result = analyse(sample_plan(), all);
  add_sensitivity(sample_plan(), all, result);
  EXPECT_EQ(of_kind(result.primary[0], OtherRule::tipping), nullptr);
}

TEST(Analysis, AttemptsOutsideOfThePlanAreCountedByReason) {
  auto all = people(kFew, kMany);
  StudyAttempt other_case = attempt(0.0), late = attempt(0.0, 0.0, 10.6), early = attempt(0.0, 0.0, -10.1),
               simulated = attempt(0.0), lost = attempt(0.0), parked = attempt(0.0);
  other_case.case_id = "case-2";
  simulated.synthetic = true;
  lost.cut_off = "a device was lost";
  parked.metrics[0].value = 0.0;
  for (const StudyAttempt& one : {other_case, late, early, simulated, lost, parked}) all[0].attempts.push_back(one);
  const Compared distance = analyse(sample_plan(), all).primary[0];
  EXPECT_EQ(distance.answer.p_value, by_hand("brunner_munzel", kFew, kMany).p_value);
  std::map<std::string, std::size_t> why;
  for (const LeftOut& one : distance.left_out) why[one.why] = one.attempts;
  EXPECT_EQ(why, (std::map<std::string, std::size_t>{{"at another case", 1},
                                                     {"outside of the visit's days", 2},
                                                     {"made by a simulated operator", 1},
                                                     {"a device was lost", 1},
                                                     {"the procedure was not performed", 1}}));
  const Plan of_simulated = sample_plan(R"(, "people": "simulated")");
  EXPECT_EQ(analyse(of_simulated, all).primary[0].first.attempts, 1U) << "never both together";
}

TEST(Analysis, MixedVersionsAreRefusedWithWords) {
  auto all = people(kFew, kMany);
  all[0].attempts[0].metrics[2].version += 1;
  const StudyResult result = analyse(sample_plan(), all);
  EXPECT_THAT(result.primary[0].refused, HasSubstr("1 attempts have the metric in a version other"));
  EXPECT_FALSE(result.primary[0].p_adjusted);
  EXPECT_EQ(result.primary[0].answer.n, 0U);
  EXPECT_TRUE(result.primary[1].refused.empty()) << "each outcome for itself";
}

TEST(Analysis, MixedHandsAreRefusedOrEachForItself) {
  auto all = people(kFew, kMany);
  for (const std::size_t i : {0U, 1U, 5U, 6U}) all[i].attempts[0].hand = "mouse";
  EXPECT_THAT(analyse(sample_plan(), all).primary[0].refused, HasSubstr("arm, mouse"));
  const StudyResult parted = analyse(sample_plan(R"(, "hands": "stratified")"), all);
  ASSERT_EQ(parted.primary.size(), 4U) << "two outcomes, two hands";
  EXPECT_EQ(parted.primary[0].hand, "arm");
  EXPECT_EQ(parted.primary[0].answer.n, 7U);
  EXPECT_EQ(parted.primary[0].answer.p_value, by_hand("brunner_munzel", {6, 8, 11}, {2, 7, 5, 1}).p_value);
  EXPECT_EQ(parted.primary[1].answer.n, 4U);
}

// R: p.adjust(c(0.01, 0.04, 0.03), "holm") is 0.03 0.06 0.06.
TEST(Analysis, HolmCountsEveryPrimaryOutcome) {
  const auto adjusted = holm_adjusted({0.01, 0.04, 0.03});
  EXPECT_DOUBLE_EQ(*adjusted[0], 0.03);
  EXPECT_DOUBLE_EQ(*adjusted[1], 0.06);
  EXPECT_DOUBLE_EQ(*adjusted[2], 0.06);
  const auto with_a_gap = holm_adjusted({0.01, std::nullopt, 0.9});
  EXPECT_DOUBLE_EQ(*with_a_gap[0], 0.03) << "what could not be tested was planned all the same";
  EXPECT_FALSE(with_a_gap[1]);
  EXPECT_DOUBLE_EQ(*with_a_gap[2], 1.0);
  EXPECT_TRUE(holm_adjusted({}).empty());
}

TEST(Analysis, MeansTakeTheFailureValueOfThePlan) {
  std::string json = sample_plan_json();
  json.replace(json.find("\"brunner_munzel\""), 16, "\"welch\"");
  json.replace(json.find("\"smallest_worthwhile\": 2}"), 25, "\"smallest_worthwhile\": 2, \"failure_value\": 40}");
  auto all = people(kFew, kMany);
  all[0].attempts = {attempt(std::nullopt)};
  const Plan plan = plan_from_json(json).value();
  ASSERT_TRUE(problems_of(plan).empty());
  const Compared distance = analyse(plan, all).primary[0];
  EXPECT_EQ(distance.answer.p_value, by_hand("welch", {40, 7, 6, 8, 11}, kMany).p_value);
  EXPECT_DOUBLE_EQ(*distance.answer.estimate, 72.0 / 5.0 - 22.0 / 6.0);
}

TEST(Analysis, WhatIsTooSmallIsNotEstimableAndNeverANumber) {
  for (const auto& all :
       {std::vector<StudyPerson>{}, people({}, kMany), people({1}, {2}), people({3, 3, 3}, {3, 3, 3})}) {
    const StudyResult result = analyse(sample_plan(), all);
    for (const Compared& one : result.primary) {
      EXPECT_FALSE(one.answer.estimable());
      EXPECT_FALSE(one.p_adjusted);
    }
  }
  EXPECT_EQ(analyse(sample_plan(), people({}, kMany)).primary[0].answer.reason, "too_few") << "not a bad option";
  EXPECT_FALSE(analyse(sample_plan(), people({1, 2}, {3, 4})).stopped) << "three in each group were planned";
}

TEST(Analysis, ARecordingOfNoWorthIsLeftOutForItsStatedReason) {
  const MetricInfo* quality = nullptr;
  for (const MetricInfo& info : registry())
    if (info.group == Group::recording) quality = &info;
  ASSERT_NE(quality, nullptr);
  const Plan plan = sample_plan(std::string(R"(, "exclusions": [{"metric": ")") + quality->id +
                                R"(", "comparison": ">=", "value": 3, "why": "poor tracking"}])");
  auto all = people(kFew, kMany);
  all[0].attempts[0].metrics.push_back(now(quality->id, 3.0));
  all[1].attempts[0].metrics.push_back(now(quality->id, 2.9));
  const Compared distance = analyse(plan, all).primary[0];
  ASSERT_EQ(distance.left_out.size(), 1U);
  EXPECT_EQ(distance.left_out[0].why, "poor tracking");
  EXPECT_EQ(distance.first.absent, 1U);
}

}  // namespace
}  // namespace seldinger::assessment::study
