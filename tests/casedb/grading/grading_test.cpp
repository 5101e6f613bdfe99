// Grades of stored attempts: by the version that the rule names, against people who were consultants then.
#include "casedb/grading/grading.h"
#include "assessment/registry.h"

#include <algorithm>

#include "casedb/grading/comparison.h"
#include "tests/casedb/graded_library.h"

namespace seldinger::casedb {
namespace {

using assessment::SetKind;
using assessment::Verdict;

class GradingTest : public GradedLibrary {
 protected:
  AttemptGrade looked_at(const std::string& attempt_id) {
    return Grader(library_).look_at(find_attempt(library_, attempt_id).value());
  }
  void consultants(int people, int attempts_each) {
    for (int i = 0; i < people; ++i) {
      const std::string name = "Consultant " + std::to_string(i);
      const std::string person = user(name, Role::trainee);
      ASSERT_TRUE(set_level(library_, name, Level::consultant).has_value());
      for (int k = 0; k < attempts_each; ++k) attempt(person, 1.0, 10.0 + i);
    }
  }
};

TEST_F(GradingTest, IsByTheRuleOfTheCase) {
  rule({"hit >= 1", "time_total <= 30"});
  EXPECT_EQ(looked_at(attempt(std::nullopt, 1.0, 30.0)).grade.verdict, Verdict::passed);
  EXPECT_EQ(looked_at(attempt(std::nullopt, 1.0, 30.5)).grade.verdict, Verdict::failed);
  EXPECT_EQ(looked_at(attempt(std::nullopt, std::nullopt, 20.0)).grade.verdict, Verdict::failed);
}

TEST_F(GradingTest, TakesTheVersionThatTheRuleNamesAmongSeveral) {
  rule({"hit >= 1"});
  const std::string attempt_id = attempt(std::nullopt, 1.0, 30.0);
  ASSERT_TRUE(add_metrics(library_, attempt_id, {{"hit", 2, 0.0, "bool", ""}, {"hit", 3, 0.0, "bool", ""}}));
  const AttemptRow row = find_attempt(library_, attempt_id).value();
  ASSERT_EQ(row.older_metrics.size(), 2U);
  const auto newest =
      std::find_if(row.metrics.begin(), row.metrics.end(), [](const auto& m) { return m.id == "hit"; });
  EXPECT_EQ(newest->version, 3);
  EXPECT_EQ(looked_at(attempt_id).grade.verdict, Verdict::passed);
  for (const AttemptRow& one : list_attempts(library_)) EXPECT_EQ(one.older_metrics.size(), 2U);
}

TEST_F(GradingTest, TheCasesTimeLimitIsACriterion) {
  rule({"hit >= 1"}, 25.0);
  EXPECT_EQ(looked_at(attempt(std::nullopt, 1.0, 25.0)).grade.verdict, Verdict::passed);
  EXPECT_EQ(looked_at(attempt(std::nullopt, 1.0, 25.1)).grade.verdict, Verdict::failed);
}

TEST_F(GradingTest, WhatWasCutOffIsNotGradable) {
  rule({"hit >= 1"});
  for (const auto& [end, verdict] :
       {std::pair{AttemptEnd::interrupted, Verdict::not_gradable},
        std::pair{AttemptEnd::device_lost, Verdict::not_gradable}, std::pair{AttemptEnd::fired, Verdict::passed},
        std::pair{AttemptEnd::stopped, Verdict::passed}}) {
    NewAttempt made = new_attempt(std::nullopt, 1.0, 20.0);
    made.end = end;
    EXPECT_EQ(looked_at(add_attempt(library_, made).value()).grade.verdict, verdict) << name_of(end);
  }
}

TEST_F(GradingTest, EightConsultantsOfThreeAttemptsSetTheStandard) {
  rule({"hit >= 1"});
  const std::string one = attempt(user("T", Role::trainee), 1.0, 13.5);
  EXPECT_TRUE(looked_at(one).provisional);
  EXPECT_EQ(looked_at(one).score.reason, "no_expert_set");
  consultants(7, 3);
  EXPECT_TRUE(looked_at(one).provisional);
  EXPECT_FALSE(has_standard(library_, find_case(library_, case_id_).value()));
  EXPECT_EQ(looked_at(one).experts.person_ids.size(), 7U);
  const std::string person = user("Consultant 8", Role::mentor);
  ASSERT_TRUE(set_level(library_, "Consultant 8", Level::consultant).has_value());
  for (int k = 0; k < 3; ++k) attempt(person, 1.0, 17.0);
  const AttemptGrade grade = looked_at(one);
  EXPECT_FALSE(grade.provisional);
  CaseRow row = find_case(library_, case_id_).value();
  row.approach = find_attempt(library_, one).value().approach;  // as the sample attempts are made
  row.modality = find_attempt(library_, one).value().picture.modality;
  row.instrument.kind = find_attempt(library_, one).value().instrument.kind;
  EXPECT_TRUE(has_standard(library_, row));
  row.approach =
      row.approach == cases::Approach::in_plane ? cases::Approach::out_of_plane : cases::Approach::in_plane;
  EXPECT_FALSE(has_standard(library_, row));
  const assessment::MetricBand* time = grade.experts.find("time_total", 1);
  ASSERT_NE(time, nullptr);
  EXPECT_DOUBLE_EQ(time->mean, 13.5);  // 10 … 17 s
  EXPECT_NEAR(grade.score.value.value(), 50.0, 1e-9);
  EXPECT_EQ(looked_at(list_attempts_of(library_, person)[0].attempt_id).score.reason, "of_the_set");
}

TEST_F(GradingTest, WhoIsAConsultantLaterWasNoneThen) {
  rule({"hit >= 1"});
  const std::string person = user("Late", Role::trainee);
  attempt(person, 1.0, 20.0);
  EXPECT_TRUE(list_expert_attempts(library_, case_id_, SetKind::consultants).empty());
  ASSERT_TRUE(set_level(library_, "late", Level::consultant).has_value());
  EXPECT_TRUE(list_expert_attempts(library_, case_id_, SetKind::consultants).empty()) << "it began before";
  const std::string after = attempt(person, 1.0, 20.0);
  ASSERT_EQ(list_expert_attempts(library_, case_id_, SetKind::consultants).size(), 1U);
  EXPECT_EQ(list_expert_attempts(library_, case_id_, SetKind::consultants)[0].attempt_id, after);
  ASSERT_TRUE(set_level(library_, "Late", Level::trainee).has_value());
  attempt(person, 1.0, 20.0);
  EXPECT_EQ(list_expert_attempts(library_, case_id_, SetKind::consultants).size(), 1U);
  EXPECT_EQ(list_users(library_)[0].level, Level::trainee);
  EXPECT_EQ(set_level(library_, "Nobody", Level::trainee).error().code, "no_user");
}

TEST_F(GradingTest, SimulatedOperatorsNeverSetAStandard) {
  rule({"hit >= 1"});
  const std::string person = user("C", Role::trainee);
  ASSERT_TRUE(set_level(library_, "C", Level::consultant).has_value());
  for (int i = 0; i < 40; ++i) {
    NewAttempt made = new_attempt(i % 2 == 0 ? std::optional(person) : std::nullopt, 1.0, 10.0 + i);
    made.operator_name = "expert";
    static_cast<void>(add_attempt(library_, made).value());
  }
  EXPECT_TRUE(list_expert_attempts(library_, case_id_, SetKind::consultants).empty());
  const AttemptGrade grade = looked_at(attempt(user("T", Role::trainee), 1.0, 90.0));
  EXPECT_EQ(grade.experts.kind, SetKind::simulated);
  EXPECT_FALSE(grade.experts.bands.empty());
  EXPECT_TRUE(grade.provisional);
  EXPECT_FALSE(grade.score.value.has_value());
  ASSERT_FALSE(grade.debrief.empty());
  EXPECT_NE(grade.debrief[0].text.find("simulated expert, not a standard"), std::string::npos)
      << grade.debrief[0].text;
  consultants(5, 3);
  EXPECT_EQ(looked_at(attempt(user("U", Role::trainee), 1.0, 90.0)).experts.kind, SetKind::consultants)
      << "never mixed";
}

TEST_F(GradingTest, ExpertsAreThoseOfTheSameTask) {
  rule({"hit >= 1"});
  const std::string second_lesion = add_lesion(library_, case_id_, sample_lesion()).value();
  consultants(8, 3);
  NewAttempt other = new_attempt(std::nullopt, 1.0, 20.0);
  EXPECT_FALSE(looked_at(add_attempt(library_, other).value()).provisional);
  other.picture.modality = cases::Modality::xray;
  EXPECT_TRUE(looked_at(add_attempt(library_, other).value()).experts.id.empty());
  other = new_attempt(std::nullopt, 1.0, 20.0);
  other.approach =
      other.approach == cases::Approach::in_plane ? cases::Approach::out_of_plane : cases::Approach::in_plane;
  EXPECT_TRUE(looked_at(add_attempt(library_, other).value()).experts.id.empty());
  other = new_attempt(std::nullopt, 1.0, 20.0);
  other.lesion_id = second_lesion;
  EXPECT_TRUE(looked_at(add_attempt(library_, other).value()).experts.id.empty());
}

TEST_F(GradingTest, APersonBeginsNoMoreAttemptsThanTheCaseAllows) {
  rule({"hit >= 1"}, {}, 2);
  const std::string person = user("T", Role::trainee);
  attempt(person, 0.0, 20.0);
  static_cast<void>(open_attempt(library_, new_attempt(person, 0.0, 20.0)).value());
  EXPECT_EQ(add_attempt(library_, new_attempt(person, 1.0, 20.0)).error().code, "no_attempts_left");
  EXPECT_EQ(open_attempt(library_, new_attempt(person, 1.0, 20.0)).error().code, "no_attempts_left");
  NewAttempt simulated = new_attempt(person, 1.0, 20.0);
  simulated.operator_name = "novice";
  EXPECT_TRUE(add_attempt(library_, simulated).has_value()) << "that is not what a person did";
  EXPECT_TRUE(add_attempt(library_, new_attempt(user("U", Role::trainee), 1.0, 20.0)).has_value());
}

TEST_F(GradingTest, SideBySideNeverMixesPeopleAndSimulatedOperators) {
  rule({"hit >= 1", "time_total <= 30"});
  const std::string person = user("T", Role::trainee);
  for (const double time_s : {40.0, 20.0, 25.0}) attempt(person, 1.0, time_s);
  for (const double time_s : {10.0, 90.0}) {
    NewAttempt simulated = new_attempt(person, 0.0, time_s);  // in the person's name
    simulated.operator_name = "novice";
    static_cast<void>(add_attempt(library_, simulated).value());
  }
  attempt(std::nullopt, std::nullopt, 50.0);  // a simulated novice who never fired
  NewAttempt cut_off = new_attempt(person, 1.0, 1.0);
  cut_off.end = AttemptEnd::interrupted;
  static_cast<void>(add_attempt(library_, cut_off).value());
  NewAttempt other = new_attempt(person, 1.0, 1.0);
  other.started_us = 1;
  other.picture.modality = cases::Modality::xray;
  static_cast<void>(add_attempt(library_, other).value());

  const Comparison side = compare_attempts(library_, case_id_).value();
  EXPECT_EQ(side.other_tasks, 1U);
  ASSERT_EQ(side.criteria.size(), 2U);
  EXPECT_EQ(side.criteria[0].criterion.metric, "hit");
  ASSERT_EQ(side.groups.size(), 2U);
  const ComparedGroup &people = side.groups[0], &simulated = side.groups[1];
  EXPECT_EQ(people.person_id, person);
  EXPECT_EQ(people.attempts.size(), 4U);
  EXPECT_EQ(people.gradable, 3U) << "what was cut off is shown and not counted";
  EXPECT_EQ(people.passed, 2U);
  EXPECT_EQ(people.met, (std::vector<std::size_t>{3, 2}));
  EXPECT_DOUBLE_EQ(people.of_criteria[1].median, 25.0);
  EXPECT_DOUBLE_EQ(people.of_criteria[1].low, 20.0);
  EXPECT_DOUBLE_EQ(people.of_criteria[1].high, 40.0);
  EXPECT_FALSE(simulated.person_id.has_value());
  EXPECT_EQ(simulated.operator_name, "novice");
  EXPECT_EQ(simulated.attempts.size(), 3U);
  EXPECT_EQ(simulated.passed, 0U);
  EXPECT_EQ(simulated.of_criteria[0].n, 2U) << "null is no value";
  EXPECT_DOUBLE_EQ(simulated.of_criteria[1].median, 50.0);
  EXPECT_EQ(compare_attempts(library_, case_id_, {}, cases::Modality::ultrasound).error().code, "no_attempt");
  EXPECT_EQ(compare_attempts(library_, case_id_, {}, cases::Modality::xray).value().groups.size(), 1U);
  EXPECT_EQ(compare_attempts(library_, std::string(36, '0')).error().code, "no_case");
}

// Before: an attempt in which nobody did anything had the best of all values, and giving up was left out.
TEST_F(GradingTest, SideBySideIsAmongThoseWhoPerformedTheProcedure) {
  rule({"hit >= 1"});
  const std::string person = user("T", Role::trainee);
  const auto add = [&](double performed, std::optional<double> hit, double punctures) {
    NewAttempt made = new_attempt(person, hit, 20.0);
    made.metrics[3].version = assessment::find_metric("hit")->version;
    made.metrics.push_back({"procedure_performed", 1, performed, "bool", ""});
    made.metrics.push_back({"skin_punctures", 1, punctures, "count", ""});
    static_cast<void>(add_attempt(library_, made).value());
  };
  add(1.0, 1.0, 1.0);
  add(1.0, std::nullopt, 1.0);  // gave up
  add(0.0, std::nullopt, 0.0);  // parked
  const Comparison side = compare_attempts(library_, case_id_).value();
  ASSERT_EQ(side.groups.size(), 1U);
  const ComparedGroup& group = side.groups[0];
  EXPECT_EQ(group.attempts.size(), 3U);
  EXPECT_EQ(group.not_performed, 1U);
  EXPECT_EQ(group.gradable, 2U);
  for (std::size_t i = 0; i < side.metrics.size(); ++i) {
    if (std::string(side.metrics[i]->id) != "hit") continue;
    EXPECT_EQ(group.of_metrics[i].n, 1U);
    EXPECT_EQ(group.of_metrics[i].one.failures, 1U);
    EXPECT_EQ(group.of_metrics[i].one.estimate, 0.5);  // of the values alone: 1
    return;
  }
  ADD_FAILURE() << "hit is not compared";
}

}  // namespace
}  // namespace seldinger::casedb
