// Grades of stored attempts: by the version that the rule names, against people who were consultants then.
#include "casedb/grading/grading.h"
#include "assessment/registry.h"

#include <algorithm>

#include "casedb/database/sqlite.h"
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
  std::string consultant(const std::string& name, Role role = Role::trainee) {
    std::string person = user(name, role);
    EXPECT_TRUE(set_level(library_, name, Level::consultant).has_value());
    return person;
  }
  // Each takes 10 s, 11 s, ...; the first two attempts 90 s.
  void consultants(int people, int attempts_each) {
    for (int i = 0; i < people; ++i) {
      const std::string person = consultant("Consultant " + std::to_string(i));
      for (int k = 0; k < attempts_each; ++k) attempt_blind(person, k < 2 ? 90.0 : 10.0 + i, 2.0);
    }
  }
  std::string attempt_blind(const std::optional<std::string>& person, double time_s, double blind_mm) {
    NewAttempt made = new_attempt(person, 1.0, time_s);
    made.metrics.push_back(metric("blind_advance", blind_mm));
    return add_attempt(library_, made).value();
  }
  Task task() { return task_of(find_attempt(library_, list_attempts(library_)[0].attempt_id).value()); }
  base::Result<std::string> set_one(const std::string& by = "Dora") {
    return set_standard(library_, case_id_, {}, {}, by);
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
  const int hit = metric("hit", {}).version;
  ASSERT_TRUE(
      add_metrics(library_, attempt_id, {{"hit", hit + 1, 0.0, "bool", ""}, {"hit", hit + 2, 0.0, "bool", ""}}));
  const AttemptRow row = find_attempt(library_, attempt_id).value();
  ASSERT_EQ(row.older_metrics.size(), 2U);
  const auto newest =
      std::find_if(row.metrics.begin(), row.metrics.end(), [](const auto& m) { return m.id == "hit"; });
  EXPECT_EQ(newest->version, hit + 2);
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

TEST_F(GradingTest, EightConsultantsOfFiveAttemptsMakeAStandardThatADirectorSets) {
  rule({"hit >= 1"});
  user("Dora", Role::director);
  const std::string one = attempt_blind(user("T", Role::trainee), 13.5, 2.0);
  EXPECT_TRUE(looked_at(one).provisional);
  EXPECT_EQ(looked_at(one).score.reason, "no_expert_set");
  consultants(7, 5);
  const std::string person = consultant("Consultant 8");
  for (int k = 0; k < 4; ++k) attempt_blind(person, 17.0, 2.0);
  EXPECT_EQ(looked_at(one).experts.people, 7U);
  EXPECT_TRUE(looked_at(one).experts.bands.empty()) << "before: a band of five people and more";
  EXPECT_EQ(set_one().error().code, "too_few_consultants");
  attempt_blind(person, 17.0, 2.0);
  EXPECT_TRUE(looked_at(one).provisional) << "nobody has set it";
  EXPECT_TRUE(looked_at(one).experts.bands.empty());
  EXPECT_EQ(looked_at(one).experts.people, 8U);
  CaseRow row = find_case(library_, case_id_).value();
  EXPECT_FALSE(has_standard(library_, row));

  const std::string standard_id = set_one().value();
  const AttemptGrade grade = looked_at(one);
  EXPECT_FALSE(grade.provisional);
  EXPECT_EQ(grade.experts.standard_id, standard_id);
  EXPECT_TRUE(has_standard(library_, row));
  row.approach =
      row.approach == cases::Approach::in_plane ? cases::Approach::out_of_plane : cases::Approach::in_plane;
  EXPECT_FALSE(has_standard(library_, row));
  const assessment::MetricBand* time = grade.experts.find("time_total", metric("time_total", {}).version);
  ASSERT_NE(time, nullptr);
  EXPECT_DOUBLE_EQ(time->mean, 13.5);  // 10 … 17 s; with what was spent on getting used to it, before, more
  EXPECT_EQ(time->n, 8U);
  EXPECT_TRUE(time->tolerance.has_value());
  EXPECT_NEAR(grade.score.value.value(), 50.0, 1e-9);
  EXPECT_EQ(looked_at(list_attempts_of(library_, person)[0].attempt_id).score.reason, "of_the_set");
}

// Attempts can be erased by others: what the standard is made of is read where it is stored, in one transaction.
// Before, it was read outside of one (here: "too_few_consultants" at once), and an attempt erased meanwhile broke
// the storing.
TEST_F(GradingTest, AStandardIsMadeWhileNobodyElseWrites) {
  rule({"hit >= 1"});
  user("Dora", Role::director);
  Library other = open_library(library_.folder());
  const Transaction writing(other.database());
  library_.database().run("PRAGMA busy_timeout = 20");
  EXPECT_THROW(static_cast<void>(set_one()), DatabaseFailure);
}

TEST_F(GradingTest, WhatTheGuideOrHelpLedSetsNoStandard) {
  rule({"hit >= 1"});
  user("Dora", Role::director);
  const auto attempts_of = [&](const std::string& person, const Conditions& conditions) {
    NewAttempt made = new_attempt(person, 1.0, 10.0);
    made.conditions = conditions;
    for (int k = 0; k < 5; ++k) ASSERT_TRUE(add_attempt(library_, made));
  };
  Conditions guided, helped, unaided;
  guided.guide_used = true;
  helped.guide_used = unaided.guide_used = false;
  helped.help_level = 1;
  unaided.help_level = 0;
  for (int i = 0; i < 6; ++i) attempts_of(consultant("Consultant " + std::to_string(i)), unaided);
  attempts_of(consultant("Guided"), guided);
  attempts_of(consultant("Helped"), helped);
  EXPECT_EQ(set_one().error().code, "too_few_consultants");  // before: set, of eight
  attempts_of(consultant("Seventh"), unaided);
  attempts_of(consultant("Older"), {});  // nothing is known of it
  EXPECT_TRUE(set_one().has_value());
}

TEST_F(GradingTest, AStandardStaysAsItWasSet) {
  rule({"hit >= 1"});
  user("Dora", Role::director);
  consultants(8, 5);
  const std::string one = attempt_blind(user("T", Role::trainee), 20.0, 12.0);
  const std::string standard_id = set_one().value();
  EXPECT_EQ(set_one().error().code, "same_standard");
  const AttemptGrade then = looked_at(one);
  ASSERT_TRUE(then.score.value.has_value());
  // More attempts of the same people and of another, and a new version of a metric for all: before, each of these
  // moved bands and scores.
  const std::string late = consultant("Late");
  for (int k = 0; k < 5; ++k) attempt_blind(late, 200.0, 60.0);
  for (const AttemptRow& row : list_attempts(library_)) {
    MetricValue next = metric("blind_advance", 0.0);
    next.version += 1;
    ASSERT_TRUE(add_metrics(library_, row.attempt_id, {next}));
  }
  const AttemptGrade now = looked_at(one);
  EXPECT_EQ(now.experts.standard_id, standard_id);
  EXPECT_EQ(now.score.value, then.score.value);
  ASSERT_EQ(now.experts.bands.size(), then.experts.bands.size());
  for (std::size_t i = 0; i < now.experts.bands.size(); ++i) {
    EXPECT_EQ(now.experts.bands[i].version, then.experts.bands[i].version);
    EXPECT_EQ(now.experts.bands[i].low, then.experts.bands[i].low);
    EXPECT_EQ(now.experts.bands[i].high, then.experts.bands[i].high);
    EXPECT_EQ(now.experts.bands[i].mean, then.experts.bands[i].mean);
  }
  for (const char* sql :
       {"UPDATE standard SET people = 9", "DELETE FROM standard", "UPDATE standard_band SET mean = 0",
        "DELETE FROM standard_band", "UPDATE standard_attempt SET attempt_id = ''"})
    EXPECT_THROW(library_.database().run(sql), DatabaseFailure) << sql;
  // Another may be set; the old one stays beside it.
  const std::string next_id = set_one().value();
  EXPECT_EQ(looked_at(one).experts.standard_id, next_id);
  EXPECT_NE(looked_at(one).score.value, then.score.value);
  const auto all = list_standards(library_, case_id_);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[0].set.standard_id, next_id);
  EXPECT_EQ(all[1].set.bands[0].mean, then.experts.bands[0].mean);
}

TEST_F(GradingTest, NobodySetsAStandardThatGradesThem) {
  rule({"hit >= 1"});
  consultants(7, 5);
  const std::string director = consultant("Dora", Role::director);
  for (int k = 0; k < 5; ++k) attempt_blind(director, 20.0, 2.0);
  user("Mia", Role::mentor);
  user("Dean", Role::director);
  EXPECT_EQ(set_one("Dora").error().code, "not_allowed");
  EXPECT_EQ(set_one("Mia").error().code, "not_allowed");
  EXPECT_EQ(set_one("Nobody").error().code, "no_user");
  EXPECT_TRUE(list_standards(library_, case_id_).empty());
  EXPECT_TRUE(set_one("Dean").has_value());
}

TEST_F(GradingTest, WhatWasStoppedIsNotCompleted) {
  rule({"hit >= 1"});
  const std::string person = consultant("C");
  for (int k = 0; k < 5; ++k) {
    NewAttempt made = new_attempt(person, std::nullopt, 5.0);
    made.end = AttemptEnd::stopped;  // to begin again
    static_cast<void>(add_attempt(library_, made).value());
  }
  EXPECT_EQ(consultants_of(library_, task()).people, 0U);
  for (int k = 0; k < 5; ++k) attempt(person, 1.0, 20.0);
  EXPECT_EQ(consultants_of(library_, task()).people, 1U);
  CaseSetting defer;
  defer.clinic.defer = true;
  EXPECT_TRUE(completed(list_attempts(library_).back(), defer)) << "deferring is how such a case is completed";
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
  // Before: the simulated set's bands, and "simulated expert, not a standard: 14–45 s" in the debrief.
  EXPECT_EQ(grade.experts.people, 0U);
  EXPECT_TRUE(grade.experts.bands.empty());
  EXPECT_TRUE(grade.provisional);
  EXPECT_FALSE(grade.score.value.has_value());
  ASSERT_FALSE(grade.debrief.empty());
  for (const assessment::Sentence& one : grade.debrief) {
    EXPECT_EQ(one.text.find("simulated"), std::string::npos) << one.text;
    EXPECT_EQ(one.text.find("consultants"), std::string::npos) << one.text;
  }
  user("Dora", Role::director);
  EXPECT_EQ(set_one().error().code, "too_few_consultants");
}

TEST_F(GradingTest, ExpertsAreThoseOfTheSameTask) {
  rule({"hit >= 1"});
  const std::string second_lesion = add_lesion(library_, case_id_, sample_lesion()).value();
  consultants(8, 5);
  user("Dora", Role::director);
  ASSERT_TRUE(set_one().has_value());
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
  add(1.0, std::nullopt, 0.0);  // deferred
  const Comparison side = compare_attempts(library_, case_id_).value();
  ASSERT_EQ(side.groups.size(), 1U);
  const ComparedGroup& group = side.groups[0];
  EXPECT_EQ(group.attempts.size(), 4U);
  EXPECT_EQ(group.not_performed, 1U);
  EXPECT_EQ(group.gradable, 3U);
  const auto of = [&](const std::string& id) {
    const auto found =
        std::find_if(side.metrics.begin(), side.metrics.end(), [&](const auto& one) { return one.id == id; });
    EXPECT_NE(found, side.metrics.end()) << id;
    return group.of_metrics.at(static_cast<std::size_t>(found - side.metrics.begin()));
  };
  EXPECT_EQ(of("hit").n, 1U);
  EXPECT_EQ(of("hit").one.failures, 1U);
  EXPECT_EQ(of("hit").one.estimate, 0.5);  // of the values alone: 1
  // Of a deferral nothing; before: 3 values from 0 to 1.
  EXPECT_EQ(of("skin_punctures").n, 2U);
  EXPECT_EQ(of("skin_punctures").low, 1.0);
  EXPECT_EQ(of("skin_punctures").one.estimate, 1.0);  // before: 2/3
}

// A case of an older law of sight: its attempts have older versions of what is told by sight, and no newer one
// comes.
TEST_F(GradingTest, AnOlderLawOfSightHasItsOwnVersions) {
  library_.database().run("DROP TRIGGER training_case_keeps_its_sight_law");
  library_.database().run("UPDATE training_case SET sight_law = 'echo'");
  rule({"hit >= 1"});
  const int newest = assessment::find_metric("vis_joint")->version;
  for (int i = 0; i < 8; ++i) {
    const std::string person = consultant("Consultant " + std::to_string(i));
    for (int k = 0; k < 5; ++k) {
      NewAttempt made = new_attempt(person, 1.0, 20.0);
      made.metrics.push_back({"vis_joint", newest - 4, 0.1 * i, "share", ""});
      static_cast<void>(add_attempt(library_, made).value());
    }
  }
  const Comparison side = compare_attempts(library_, case_id_).value();
  const auto shown = std::find_if(side.metrics.begin(), side.metrics.end(),
                                  [](const auto& one) { return std::string_view(one.id) == "vis_joint"; });
  ASSERT_NE(shown, side.metrics.end());
  EXPECT_EQ(shown->version, newest - 4);
  EXPECT_EQ(side.groups.at(0).of_metrics.at(static_cast<std::size_t>(shown - side.metrics.begin())).n, 5U);
  user("Dora", Role::director);
  ASSERT_TRUE(set_one());
  const auto set = standard_of(library_, task());
  ASSERT_TRUE(set.has_value());
  EXPECT_NE(set->find("vis_joint", newest - 4), nullptr);
  EXPECT_EQ(set->find("vis_joint", newest), nullptr);
  // Of the newest law these attempts were not measured.
  library_.database().run("UPDATE training_case SET sight_law = 'tilt'");
  const Comparison newer = compare_attempts(library_, case_id_).value();
  EXPECT_TRUE(std::none_of(newer.metrics.begin(), newer.metrics.end(),
                           [](const auto& one) { return std::string_view(one.id) == "vis_joint"; }));
  EXPECT_EQ(consultants_of(library_, task()).find("vis_joint", newest - 4), nullptr);
}

}  // namespace
}  // namespace seldinger::casedb
