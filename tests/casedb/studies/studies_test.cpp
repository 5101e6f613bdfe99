// Studies in a library: a frozen plan and what was noted cannot be changed, nobody knows the next allocation, and
// who withdraws or is erased is gone.
#include <cstdlib>
#include <map>

#include "assessment/estimand.h"
#include "assessment/registry.h"
#include "assessment/study/randomisation.h"
#include "casedb/database/credentials.h"
#include "casedb/database/digests.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/people/facts.h"
#include "casedb/people/people.h"
#include "casedb/people/relations.h"
#include "casedb/people/simulated_people.h"
#include "casedb/studies/lock.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/study_data.h"
#include "casedb/studies/visits.h"
#include "tests/assessment/study/sample_plan.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace study = assessment::study;

template <typename T>
std::string code(const base::Result<T>& result) {
  return result ? "none" : result.error().code;
}

class StudiesTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  std::string rita_ = add_user(library_, "rita", Role::researcher, "a password").value();
  std::string study_id_ = add_study(library_, "Needles").value();
  std::string text_id_;

  void SetUp() override {
    ASSERT_TRUE(add_researcher(library_, study_id_, rita_));
    ASSERT_TRUE(add_consent_text(library_, study_id_, "May we?"));
    text_id_ = list_consents(library_, rita_).at(0).text_id;
  }
  std::string plan_of(std::string json) const {
    for (std::size_t at = json.find("case-1"); at != json.npos; at = json.find("case-1"))
      json.replace(at, 6, case_id_);
    return json;
  }
  void freeze(const std::string& json) {
    ASSERT_TRUE(store_plan(library_, study_id_, plan_of(json)));
    ASSERT_TRUE(freeze_plan(library_, study_id_));
  }
  std::string somebody(const std::string& name, const std::map<std::string, std::string>& facts) {
    const std::string person = add_user(library_, name, Role::trainee, "a password").value();
    EXPECT_TRUE(give_consent(library_, person, text_id_));
    EXPECT_TRUE(give_facts(library_, person, facts));
    return person;
  }
  void attempt(const std::string& person_id, double distance_mm) {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.person_id = person_id;
    made.operator_name = kPersonOperator;
    made.recording = sample_recording(50);
    made.started_us = started_us_;
    made.metrics = {
        {"procedure_performed", assessment::find_metric("procedure_performed")->version, 1.0, "bool", ""},
        {"tip_target_dist", assessment::find_metric("tip_target_dist")->version, distance_mm, "mm", ""},
        {"nogo_length", assessment::find_metric("nogo_length")->version, 0.0, "mm", ""}};
    ASSERT_TRUE(add_attempt(library_, made));
  }
  std::int64_t started_us_ = 0;
};

TEST_F(StudiesTest, ADraftIsReplacedAndAFrozenPlanStays) {
  EXPECT_EQ(code(freeze_plan(library_, study_id_)), "no_plan");
  EXPECT_EQ(code(store_plan(library_, "no such study", plan_of(study::sample_plan_json()))), "no_study");
  const auto first = store_plan(library_, study_id_, plan_of(study::sample_plan_json()));
  ASSERT_TRUE(first);
  EXPECT_EQ(first->body_hash, sha256_hex(std::as_bytes(std::span(first->body))));
  EXPECT_TRUE(has_draft(library_, study_id_));
  EXPECT_EQ(first->seed, "") << "drawn at the freeze";
  const auto second = store_plan(library_, study_id_, plan_of(study::sample_plan_json(R"(, "alpha": 0.01)")));
  EXPECT_NE(second->body_hash, first->body_hash);
  std::string unanswered = second->body;
  unanswered.replace(unanswered.find("\"decision\":\"d\""), 14, "\"decision\":\"REPLACE: what is decided?\"");
  ASSERT_TRUE(store_plan(library_, study_id_, unanswered));
  EXPECT_EQ(code(freeze_plan(library_, study_id_)), "bad_study_plan") << "words of the template";
  ASSERT_TRUE(store_plan(library_, study_id_, second->body));
  const auto frozen = freeze_plan(library_, study_id_);
  ASSERT_TRUE(frozen);
  EXPECT_TRUE(frozen->frozen());
  EXPECT_EQ(frozen->body_hash, second->body_hash);
  EXPECT_EQ(frozen->seed_hash, sha256_hex(std::as_bytes(std::span(frozen->seed))));
  EXPECT_FALSE(has_draft(library_, study_id_));
  EXPECT_EQ(code(store_plan(library_, study_id_, plan_of(study::sample_plan_json()))), "plan_frozen");
  EXPECT_EQ(code(freeze_plan(library_, study_id_)), "plan_frozen");
  for (const char* change : {"UPDATE study_plan SET body = '{}'", "UPDATE study_plan SET frozen_us = NULL",
                             "UPDATE study_plan SET seed = NULL", "DELETE FROM study_plan"})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(change); })) << change;
  EXPECT_EQ(find_plan(library_, study_id_)->body, frozen->body);
}

// Nobody asks simulated people for consent; and no study of people has them.
TEST_F(StudiesTest, SimulatedPeopleTakePartInStudiesOfSimulatedPeopleAlone) {
  const auto group = *assessment::population::named_group("novice");
  std::string simulated;
  for (std::uint64_t number = 1; simulated.empty(); ++number) {
    const auto person = assessment::population::drawn_person(group, 1, number);
    if (person.years <= 0.9) simulated = simulated_person(library_, person, 1);
  }
  const std::string real = somebody("tina", {{"years_in_radiology", "0.5"}});
  freeze(study::sample_plan_json());
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, simulated)), "no_consent");
  EXPECT_TRUE(enrol_in_study(library_, study_id_, real));
  const std::string other = add_study(library_, "Simulated needles").value();
  EXPECT_FALSE(consenting_people(library_, other).contains(simulated)) << "no plan yet";
  ASSERT_TRUE(store_plan(library_, other, plan_of(study::sample_plan_json(R"(, "people": "simulated")"))));
  ASSERT_TRUE(freeze_plan(library_, other));
  EXPECT_EQ(code(enrol_in_study(library_, other, real)), "real_person");
  // Consent to research with the library covers studies of real people, and makes nobody a simulated one.
  ASSERT_TRUE(add_consent_text(library_, std::nullopt, "May research use your attempts?"));
  for (const Consent& one : list_consents(library_, real))
    if (!one.study_id) {
      ASSERT_TRUE(give_consent(library_, real, one.text_id));
    }
  ASSERT_TRUE(consenting_people(library_, other).contains(real));
  EXPECT_EQ(code(enrol_in_study(library_, other, real)), "real_person");
  const StoredPlan plan = *find_plan(library_, other);
  EXPECT_EQ(people_asked(library_, plan), (std::set<std::string>{simulated}));
  for (const StudyPeople& people : {blinded_counts(library_, plan).people, study_data(library_, plan).flow.people,
                                    find_study(library_, other)->people}) {
    EXPECT_EQ(people.simulated_people(), 1);
    EXPECT_EQ(people.consenting(), 0)
        << "who consents to research with the library is in no study of simulated people";
  }
  EXPECT_TRUE(people_asked(library_, *find_plan(library_, study_id_)).contains(real));
  for (const StudyPeople& people : {blinded_counts(library_, *find_plan(library_, study_id_)).people,
                                    study_data(library_, *find_plan(library_, study_id_)).flow.people,
                                    find_study(library_, study_id_)->people}) {
    EXPECT_EQ(people.simulated_people(), 0);
    EXPECT_EQ(people.consenting(), 1);
  }
  const auto enrolled = enrol_in_study(library_, other, simulated);
  ASSERT_TRUE(enrolled) << enrolled.error().text;
  EXPECT_EQ(enrolled->pseudonym.substr(0, 2), "S-");
  EXPECT_TRUE(list_study_enrolments(library_, other).at(0).consents);
}

TEST_F(StudiesTest, APlanNamesWhatTheLibraryHas) {
  EXPECT_EQ(code(store_plan(library_, study_id_, study::sample_plan_json())), "bad_study_plan") << "no such case";
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string json = plan_of(study::sample_plan_json("", study::kArms));
    return json.replace(json.find(from), from.size(), to);
  };
  EXPECT_TRUE(store_plan(library_, study_id_, plan_of(study::sample_plan_json("", study::kArms))));
  EXPECT_EQ(code(store_plan(library_, study_id_, changed("handedness", "confidence"))), "bad_study_plan")
      << "strata of a number";
  EXPECT_EQ(code(store_plan(library_, study_id_, changed("handedness", "height"))), "bad_study_plan");
  std::string json = plan_of(study::sample_plan_json());
  EXPECT_EQ(code(store_plan(library_, study_id_, json.replace(json.find("\"value\": 1}"), 11, "\"value\": 1000}"))),
            "bad_study_plan")
      << "no answer to that question";
}

TEST_F(StudiesTest, WhoConsentsIsEnrolledByTheirFactsOnce) {
  const std::string tina = somebody("tina", {{"years_in_radiology", "0.5"}});
  ASSERT_TRUE(store_plan(library_, study_id_, plan_of(study::sample_plan_json())));
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, tina)), "plan_not_frozen");
  ASSERT_TRUE(freeze_plan(library_, study_id_));
  const std::string otto = somebody("otto", {}), mia = somebody("mia", {{"years_in_radiology", "3"}});
  const std::string nora = add_user(library_, "nora", Role::trainee, "a password").value();
  const auto enrolled = enrol_in_study(library_, study_id_, tina);
  ASSERT_TRUE(enrolled);
  EXPECT_EQ(enrolled->group, "few");
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, tina)), "already_enrolled");
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, otto)), "fact_missing");
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, mia)), "no_group");
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, nora)), "no_consent");
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, "nobody")), "no_person");
  ASSERT_TRUE(give_fact(library_, tina, "years_in_radiology", "9"));
  EXPECT_EQ(list_study_enrolments(library_, study_id_).at(0).group, "few") << "as it was when they came";
  EXPECT_EQ(count_ever_enrolled(library_, study_id_), 1U);
  EXPECT_TRUE(
      refused_by_constraint([&] { library_.database().run("UPDATE study_enrolment SET group_name = 'many'"); }));
}

// Each place is that of the seed's sequence in the stratum, taken in the order of enrolment, and nothing that is
// stored tells the next one: who is not enrolled has no row.
TEST_F(StudiesTest, ChanceAllocatesInTheSequenceOfEachStratum) {
  freeze(study::sample_plan_json("", study::kArms));
  const auto plan = find_plan(library_, study_id_);
  std::map<std::string, std::size_t> next;
  std::map<std::string, int> in_group;
  for (int i = 0; i < 9; ++i) {
    const std::string hand = i % 3 == 0 ? "left" : "right";
    const auto one = enrol_in_study(library_, study_id_, somebody("p" + std::to_string(i), {{"handedness", hand}}));
    ASSERT_TRUE(one);
    EXPECT_EQ(one->stratum, "handedness=" + hand);
    EXPECT_EQ(one->position, static_cast<std::int64_t>(next[hand]));
    const std::uint64_t seed = std::stoull(plan->seed.substr(0, 16), nullptr, 16);
    EXPECT_EQ(one->group, plan->plan.groups[study::allocated(plan->plan, seed, one->stratum, next[hand]++)].name);
    ++in_group[one->group];
    EXPECT_EQ(list_study_enrolments(library_, study_id_).size(), static_cast<std::size_t>(i + 1));
  }
  EXPECT_LE(std::abs(in_group["few"] - 2 * in_group["many"]), 6) << "2 : 1 at each block's end";
  ASSERT_TRUE(erase_person(library_, "p8", std::nullopt));  // the place stays taken
  EXPECT_EQ(list_study_enrolments(library_, study_id_).size(), 8U);
  EXPECT_EQ(count_ever_enrolled(library_, study_id_), 9U);
  const auto after = enrol_in_study(library_, study_id_, somebody("later", {{"handedness", "right"}}));
  EXPECT_EQ(after->position, static_cast<std::int64_t>(next["right"]));
  EXPECT_TRUE(damaged_values(library_.database()).empty());
}

TEST_F(StudiesTest, LooksAndDeviationsAreAppended) {
  EXPECT_EQ(code(add_deviation(library_, study_id_, "early")), "no_plan");
  ASSERT_TRUE(store_plan(library_, study_id_, plan_of(study::sample_plan_json())));
  EXPECT_EQ(code(add_deviation(library_, study_id_, "early")), "plan_not_frozen");
  ASSERT_TRUE(freeze_plan(library_, study_id_));
  EXPECT_EQ(code(add_deviation(library_, study_id_, "")), "bad_text");
  EXPECT_EQ(code(add_deviation(library_, study_id_, "\xff")), "bad_text");
  ASSERT_TRUE(add_deviation(library_, study_id_, "The room was moved"));
  library_.act_for(Actor::person(rita_));
  note_look(library_, study_id_, "study look", 7);
  note_look(library_, study_id_, "report validity", 8);
  const auto looks = list_looks(library_, study_id_);
  ASSERT_EQ(looks.size(), 2U);
  EXPECT_EQ(looks[0].number, 1);
  EXPECT_EQ(looks[0].actor, "person");
  EXPECT_TRUE(looks[0].pseudonym);
  EXPECT_EQ(looks[1].text, "report validity");
  EXPECT_EQ(looks[1].people, 8);
  EXPECT_EQ(list_deviations(library_, study_id_).at(0).text, "The room was moved");
  for (const char* change : {"UPDATE study_look SET people = 0", "DELETE FROM study_look",
                             "UPDATE study_deviation SET body = 'none'", "DELETE FROM study_deviation"})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(change); })) << change;
  EXPECT_TRUE(damaged_values(library_.database()).empty());
}

// Attempts, too, stay out of sight of who plans by them.
TEST_F(StudiesTest, WhoWorksOnADraftSeesNothingOfItsPeople) {
  const std::string tina = somebody("tina", {});
  EXPECT_TRUE(relation_to(library_, rita_, tina).own_study) << "a study without a plan is as it was";
  ASSERT_TRUE(store_plan(library_, study_id_, plan_of(study::sample_plan_json())));
  EXPECT_FALSE(relation_to(library_, rita_, tina).own_study);
  ASSERT_TRUE(freeze_plan(library_, study_id_));
  EXPECT_TRUE(relation_to(library_, rita_, tina).own_study);
}

TEST_F(StudiesTest, TheAnalysisIsOfWhoTakesPartAndStillConsents) {
  freeze(study::sample_plan_json());
  std::map<std::string, std::string> people;
  for (const char* name : {"f1", "f2", "f3", "m1", "m2", "m3"}) {
    people[name] = somebody(name, {{"years_in_radiology", name[0] == 'f' ? "1" : "20"}});
    started_us_ = enrol_in_study(library_, study_id_, people[name])->enrolled_us + 1;
    attempt(people[name], name[0] == 'f' ? 10.0 + name[1] : 1.0 + name[1]);
  }
  somebody("outside", {{"years_in_radiology", "1"}});
  const auto analysed = [&] {
    const auto plan = find_plan(library_, study_id_);
    StudyData data = study_data(library_, *plan);
    const study::StudyResult result = study::analyse(plan->plan, data.people);
    add_analysed(result, data.flow);
    return std::pair(data.flow, result);
  };
  const auto [flow, result] = analysed();
  EXPECT_EQ(result.primary[0].answer.n, 6U);
  EXPECT_EQ(people_with_outcome(result), 6U);
  EXPECT_EQ(flow.people.consenting(), 7);
  EXPECT_EQ(flow.groups[0].allocated, 3U);
  EXPECT_EQ(flow.groups[1].analysed, 3U);
  EXPECT_EQ(data_hash(result), data_hash(analysed().second)) << "the same data, the same hash";

  ASSERT_TRUE(withdraw_consent(library_, people["f1"], text_id_));
  const auto [without, fewer] = analysed();
  EXPECT_EQ(fewer.primary[0].answer.n, 5U);
  EXPECT_EQ(without.groups[0].withdrew, 1U);
  EXPECT_NE(data_hash(fewer), data_hash(result));
  ASSERT_TRUE(give_consent(library_, people["f1"], text_id_));
  EXPECT_EQ(data_hash(analysed().second), data_hash(result)) << "who consents again is in the group they were in";
  ASSERT_TRUE(erase_person(library_, "m2", std::nullopt));
  const auto [erased, fewest] = analysed();
  EXPECT_EQ(fewest.primary[0].second.persons, 2U);
  EXPECT_EQ(erased.unknown, 1U);
  EXPECT_EQ(erased.ever_enrolled, 6U);
  EXPECT_TRUE(damaged_values(library_.database()).empty());
}

TEST_F(StudiesTest, WhatIsBegunAfterTheLockIsNotAnalysed) {
  ASSERT_TRUE(store_plan(library_, study_id_, plan_of(study::sample_plan_json())));
  EXPECT_EQ(code(lock_data(library_, *find_plan(library_, study_id_))), "plan_not_frozen");
  ASSERT_TRUE(freeze_plan(library_, study_id_));
  const StoredPlan plan = *find_plan(library_, study_id_);
  std::vector<std::string> people;
  for (const char* name : {"f1", "f2", "m1", "m2"}) {
    people.push_back(somebody(name, {{"years_in_radiology", name[0] == 'f' ? "1" : "20"}}));
    started_us_ = enrol_in_study(library_, study_id_, people.back())->enrolled_us + 1;
    if (people.size() < 4) attempt(people.back(), 3.0);
  }
  const auto hash = [&] { return data_hash(study::analyse(plan.plan, study_data(library_, plan).people)); };
  EXPECT_FALSE(find_lock(library_, study_id_));
  const auto lock = lock_data(library_, plan);
  ASSERT_TRUE(lock);
  EXPECT_EQ(lock->data_hash, hash());
  EXPECT_EQ(lock->people, 3);
  EXPECT_EQ(code(lock_data(library_, plan)), "data_locked");
  started_us_ = lock->locked_us + 1;
  attempt(people[3], 8.0);
  attempt(people[0], 8.0);
  EXPECT_EQ(hash(), lock->data_hash);
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, people[0])), "already_enrolled");
  const auto result = study::analyse(plan.plan, study_data(library_, plan).people);
  EXPECT_TRUE(std::any_of(
      result.primary[0].left_out.begin(), result.primary[0].left_out.end(),
      [](const auto& one) { return one.why == "begun after the data were locked" && one.attempts == 2; }));
  EXPECT_EQ(code(enrol_in_study(library_, study_id_, somebody("late", {{"years_in_radiology", "1"}}))),
            "data_locked");
  for (const char* change : {"UPDATE study_lock SET people = 0", "DELETE FROM study_lock"})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(change); })) << change;
  ASSERT_TRUE(withdraw_consent(library_, people[1], text_id_));
  EXPECT_NE(hash(), lock->data_hash) << "who withdraws is gone, and the hash tells";
  EXPECT_TRUE(damaged_values(library_.database()).empty());
}

// What is read of an attempt is what the plan asks about and what tells whether it fired: the same comes out of
// all.
TEST_F(StudiesTest, TheAnalysisReadsWhatDecidesIt) {
  freeze(study::sample_plan_json());
  const auto version = [](const char* id) { return assessment::find_metric(id)->version; };
  const std::string nina = somebody("nina", {{"years_in_radiology", "1"}});
  started_us_ = enrol_in_study(library_, study_id_, nina)->enrolled_us + 1;
  attempt(nina, 3.0);
  NewAttempt parked = sample_attempt(case_id_, lesion_id_);
  parked.person_id = nina;
  parked.operator_name = kPersonOperator;
  parked.recording = sample_recording(50);
  parked.started_us = started_us_ + 1;
  parked.conditions.needle_hand = cases::HandKind::arm;
  parked.conditions.needle_arm = "Inverse3";
  parked.metrics = {{"procedure_performed", version("procedure_performed"), 1.0, "bool", ""},
                    {"tip_target_surface", version("tip_target_surface"), {}, "mm", "no_endpoint"},
                    {"skin_punctures", version("skin_punctures"), 0.0, "count", ""},
                    {"path_tip", version("path_tip"), 2.0, "mm", ""},
                    {"nogo_length", version("nogo_length"), 0.0, "mm", ""}};
  ASSERT_TRUE(add_attempt(library_, parked));
  const auto people = study_data(library_, *find_plan(library_, study_id_)).people;
  ASSERT_EQ(people.size(), 1U);
  ASSERT_EQ(people[0].attempts.size(), 2U);
  const auto rows = list_attempts_of(library_, nina);
  ASSERT_EQ(rows[0].metrics.size(), 5U);
  EXPECT_EQ(people[0].attempts[0].metrics.size(), 4U) << "neither asked about nor without an endpoint";
  EXPECT_EQ(people[0].attempts[0].hand, "arm");
  EXPECT_EQ(people[0].attempts[0].arm, "Inverse3");
  EXPECT_EQ(people[0].attempts[1].arm, "");
  const assessment::MetricInfo& nogo = *assessment::find_metric("nogo_length");
  EXPECT_EQ(assessment::contribution_of(nogo, people[0].attempts[0].metrics).counted,
            assessment::contribution_of(nogo, rows[0].metrics).counted);
  EXPECT_EQ(assessment::contribution_of(nogo, people[0].attempts[0].metrics).counted, assessment::Counted::left_out)
      << "it was said to be deferred";
}

// What somebody states after their enrolment may come of what they did.
TEST_F(StudiesTest, BackgroundIsWhatStoodAtTheEnrolmentAndEverySite) {
  freeze(study::sample_plan_json());
  const std::string nina = somebody("nina", {{"years_in_radiology", "1"}, {"logbook_total", "4"}});
  for (const char* site : {"North", "South", ""}) {
    const auto cohort = add_cohort(library_, std::string("Cohort ") + site, "Programme", site);
    ASSERT_TRUE(enrol(library_, *cohort, nina, Post::learner));
    if (std::string_view(site) == "South") {
      EXPECT_TRUE(end_enrolment(library_, *cohort, nina).has_value());
    }
  }
  ASSERT_TRUE(give_fact(library_, nina, "logbook_total", "5"));
  const std::string pseudonym = enrol_in_study(library_, study_id_, nina)->pseudonym;
  ASSERT_TRUE(give_fact(library_, nina, "logbook_total", "90"));
  ASSERT_TRUE(give_fact(library_, nina, "handedness", "left"));
  const auto backgrounds = study_data(library_, *find_plan(library_, study_id_)).backgrounds;
  ASSERT_EQ(backgrounds.size(), 1U);
  EXPECT_EQ(backgrounds.at(pseudonym).answers,
            (std::map<std::string, std::string>{{"years_in_radiology", "1"}, {"logbook_total", "5"}}));
  EXPECT_EQ(backgrounds.at(pseudonym).sites, (std::vector<std::string>{"North", "South"}));
}

// Windows in days since the enrolment; an attempt counts on the first and the last of them.
TEST_F(StudiesTest, VisitsAreAheadDueMissedOrMade) {
  freeze(study::sample_plan_json());
  const auto plan = find_plan(library_, study_id_);
  ASSERT_FALSE(plan->plan.visits.empty());
  const study::Visit& visit = plan->plan.visits.front();
  const std::string nina = somebody("nina", {{"years_in_radiology", "1"}, {"handedness", "right"}});
  const auto enrolled = enrol_in_study(library_, study_id_, nina);
  ASSERT_TRUE(enrolled) << enrolled.error().text;
  const auto at = [&](double day) { return enrolled->enrolled_us + static_cast<std::int64_t>(day * 86'400e6); };
  const auto state_at = [&](double day) {
    for (const PersonVisit& one : list_visits(library_, *plan, at(day)))
      if (one.visit == visit.name) return std::string(base::name_of(kVisitStateNames, one.state));
    return std::string("none");
  };
  EXPECT_EQ(list_visits(library_, *plan, at(0)).size(), plan->plan.visits.size());
  EXPECT_EQ(state_at(visit.from_day - 0.1), "ahead");
  EXPECT_EQ(state_at(visit.from_day + 0.1), "due");
  EXPECT_EQ(state_at(visit.to_day + 0.1), "missed");
  started_us_ = at(visit.to_day + 0.5);
  attempt(nina, 3.0);
  EXPECT_EQ(state_at(visit.to_day + 1.0), "missed") << "too late is another day";
  started_us_ = at((visit.from_day + visit.to_day) / 2.0);
  attempt(nina, 3.0);
  EXPECT_EQ(state_at(visit.to_day + 1.0), "made");
  ASSERT_TRUE(withdraw_consent(library_, nina, text_id_));
  EXPECT_TRUE(list_visits(library_, *plan, at(0)).empty());
}

}  // namespace
}  // namespace seldinger::casedb
