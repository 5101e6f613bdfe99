// Tests of assessment/estimand: what a null says of somebody, and what a person's attempts say together.
#include "assessment/estimand.h"

#include <gtest/gtest.h>

#include <cmath>

#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

MetricValue now(const char* id, std::optional<double> value, const char* reason = "") {
  const MetricInfo* info = find_metric(id);
  return {id, info->version, value, info->unit, reason};
}

std::vector<MetricValue> fired(double dist_mm) {
  return {now("procedure_performed", 1.0), now("skin_punctures", 1.0), now("hit", dist_mm < 6.0 ? 1.0 : 0.0),
          now("tip_target_dist", dist_mm), now("time_total", 30.0),    now("nogo_length", 0.0)};
}
std::vector<MetricValue> gave_up() {
  return {now("procedure_performed", 1.0),
          now("skin_punctures", 1.0),
          now("hit", std::nullopt, "no_endpoint"),
          now("tip_target_dist", std::nullopt, "no_endpoint"),
          now("time_total", 12.0),
          now("nogo_length", 2.0)};
}
std::vector<MetricValue> deferred() {
  auto made = gave_up();
  made[1].value = 0.0;
  return made;
}

Contribution of(const char* id, const std::vector<MetricValue>& attempt) {
  return contribution_of(*find_metric(id), attempt);
}

OnePerson person(const char* id, const std::vector<std::vector<MetricValue>>& attempts) {
  std::vector<Contribution> all;
  for (const auto& one : attempts) all.push_back(of(id, one));
  return of_one_person(*find_metric(id), all);
}

TEST(Estimand, OnlyWhatWasPerformedIsCompared) {
  EXPECT_TRUE(compared(fired(3.0)));
  EXPECT_TRUE(compared(gave_up()));
  std::vector<MetricValue> parked = gave_up();
  parked[0].value = 0.0;
  EXPECT_FALSE(compared(parked)) << "before: the best nogo_length there is";
  EXPECT_TRUE(compared({})) << "nobody measured whether";
}

// Before: left out, so that whoever gives up where it is hard has the better mean.
TEST(Estimand, WhoNeitherFiresNorDefersHasFailed) {
  EXPECT_EQ(of("hit", gave_up()).counted, Counted::failure);
  EXPECT_EQ(of("tip_target_dist", gave_up()).counted, Counted::failure);
  EXPECT_EQ(of("time_total", gave_up()).counted, Counted::censored) << "12 s is no time of a puncture";
  EXPECT_EQ(of("nogo_length", gave_up()).counted, Counted::value) << "what was harmed was harmed";
  for (const char* id : {"hit", "tip_target_dist", "time_total"})
    EXPECT_EQ(of(id, deferred()).counted, Counted::left_out) << id;
  EXPECT_EQ(of("hit", fired(3.0)).counted, Counted::value);
}

// Before: whoever defers had the best value of whatever counts errors of a puncture.
TEST(Estimand, ADeferralIsNoPunctureWithoutFault) {
  auto attempt = deferred();
  attempt[5].value = 0.0;
  attempt.push_back(now("withdrawals_partial", 0.0));
  attempt.push_back(now("breath_holds_failed", 0.0));
  attempt.push_back(now("decision_right", 1.0));
  attempt.push_back(now("steps_violated", 0.0));
  for (const char* id : {"nogo_length", "skin_punctures", "withdrawals_partial", "breath_holds_failed"}) {
    EXPECT_EQ(of(id, attempt).counted, Counted::left_out) << id;  // before: value, 0
    EXPECT_FALSE(tells(*find_metric(id), attempt)) << id;
  }
  for (const char* id : {"decision_right", "steps_violated", "procedure_performed"})
    EXPECT_EQ(of(id, attempt).counted, Counted::value) << id;
  EXPECT_EQ(of("nogo_length", fired(3.0)).counted, Counted::value);
  attempt[0].value = 0.0;
  EXPECT_EQ(of("decision_right", attempt).counted, Counted::left_out) << "neither performed nor deferred";
}

TEST(Estimand, ToDeferWhatWasToGoAheadIsToGiveItUp) {
  auto attempt = deferred();
  attempt.push_back(now("decision_right", 0.0));
  EXPECT_EQ(of("hit", attempt).counted, Counted::failure);          // before: left out
  EXPECT_EQ(of("time_total", attempt).counted, Counted::censored);  // before: left out
  EXPECT_EQ(of("nogo_length", attempt).counted, Counted::left_out) << "still nothing was met";
  EXPECT_EQ(person("hit", {attempt, fired(3.0)}).estimate, 0.5);  // before: 1
  attempt.back() = now("decision_right", std::nullopt, "no_right_decision");
  EXPECT_EQ(of("hit", attempt).counted, Counted::left_out) << "the case does not say what is right";
}

TEST(Estimand, OtherNullsAndOlderVersionsSayNothing) {
  auto attempt = fired(3.0);
  attempt[3] = now("tip_target_dist", std::nullopt, "no_target");
  EXPECT_EQ(of("tip_target_dist", attempt).counted, Counted::left_out);
  attempt[2].version = 1;
  EXPECT_EQ(of("hit", attempt).counted, Counted::left_out) << "another metric";
  attempt.push_back(now("first_pass_success", std::nullopt, "never_punctured"));
  EXPECT_EQ(of("first_pass_success", attempt).counted, Counted::failure);
}

TEST(Estimand, OneValueAPersonWithFailuresRankedLast) {
  const OnePerson some = person("tip_target_dist", {fired(3.0), gave_up(), fired(9.0)});
  EXPECT_EQ(some.values, 2U);
  EXPECT_EQ(some.failures, 1U);
  EXPECT_EQ(some.estimate, 9.0);  // of the values alone: 6
  const OnePerson most = person("tip_target_dist", {fired(3.0), gave_up(), gave_up()});
  EXPECT_FALSE(most.estimate.has_value());
  EXPECT_TRUE(most.worst);
  const OnePerson hits = person("hit", {fired(3.0), gave_up(), gave_up(), fired(9.0)});
  EXPECT_EQ(hits.estimate, 0.25);  // of the values alone: 0.5
  EXPECT_EQ(person("hit", {deferred(), fired(3.0)}).estimate, 1.0);
  const OnePerson times = person("time_total", {fired(3.0), fired(3.0), gave_up()});
  EXPECT_EQ(times.estimate, 30.0);  // with 12 s taken for a time: 24 as a mean
  EXPECT_EQ(times.censored, 1U);
  EXPECT_EQ(person("nogo_length", {fired(3.0), gave_up()}).estimate, 1.0);
  const OnePerson nobody = person("hit", {deferred()});
  EXPECT_FALSE(nobody.estimate.has_value() || nobody.worst);
}

}  // namespace
}  // namespace seldinger::assessment
