// Simulated people's answers and simulated raters' ratings in rounds of a library: what was planted, each once, and
// never taken for a person's.
#include "casedb/ratings/simulated_answers.h"

#include <set>

#include "assessment/population/raters.h"
#include "assessment/questionnaire/shipped_forms.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/people.h"
#include "casedb/people/relations.h"
#include "casedb/people/simulated_people.h"
#include "casedb/ratings/rating_rounds.h"
#include "casedb/studies/enrolments.h"
#include "tests/assessment/study/sample_plan.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

namespace population = assessment::population;

class SimulatedAnswersTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  std::string study_id_ = add_study(library_, "Simulated needles").value();
  std::map<std::string, population::Person> people_;  // by their ids
  struct Made {
    std::string person_id;
    population::Occasion occasion;
  };
  std::map<std::string, Made> made_;  // by attempt

  void SetUp() override {
    for (const char* form : {"osats-grs", "workshop-2007"})
      ASSERT_TRUE(store_form(library_, std::string(assessment::questionnaire::find_shipped_form(form)->json)));
    std::string plan = assessment::study::sample_plan_json(R"(, "people": "simulated")");
    for (std::size_t at = plan.find("case-1"); at != plan.npos; at = plan.find("case-1"))
      plan.replace(at, 6, case_id_);
    ASSERT_TRUE(store_plan(library_, study_id_, plan));
    ASSERT_TRUE(freeze_plan(library_, study_id_));
    for (const char* group : {"novice", "expert"})
      for (std::uint64_t number = 1; number <= 5; ++number)
        add(population::drawn_person(*population::named_group(group), 3, number));
  }
  // Somebody with two attempts, a week apart; enrolled where their years fit.
  void add(const population::Person& person) {
    const std::string person_id = simulated_person(library_, person, 3);
    people_.emplace(person_id, person);
    if (const auto enrolled = enrol_in_study(library_, study_id_, person_id); !enrolled) {
      EXPECT_EQ(enrolled.error().code, "no_group");
    }
    const std::vector<double> days = {0.0};
    for (std::uint64_t attempt = 0; attempt < 2; ++attempt) {
      population::Occasion occasion{population::case_key_of(sample_case().title), attempt, 0.0};
      if (attempt == 1) occasion.gain = population::gain_of(person.practice, days, 7.0);
      NewAttempt one = sample_attempt(case_id_, lesion_id_);
      one.person_id = person_id;
      one.seed = population::attempt_seed(person, occasion);
      one.started_us = 1'700'000'000'000'000 + static_cast<std::int64_t>(attempt) * 7 * 86'400'000'000;
      made_.emplace(add_attempt(library_, one).value(), Made{person_id, occasion});
    }
  }
  Round questionnaire_round(const std::optional<std::string>& study_id) {
    return open_round(library_, {.title = "After", .form_id = "workshop-2007", .study_id = study_id}).value();
  }
  OpenedRatingRound rating_round() {
    NewRatingRound round;
    round.round = {.title = "Replays", .form_id = "osats-grs", .study_id = study_id_};
    for (const auto& [attempt_id, made] : made_)
      round.replays.push_back({attempt_id, "<section>a replay</section>"});
    round.raters = 3;
    round.repeats = 4;
    round.seed = 1;
    return open_rating_round(library_, round).value();
  }
  std::size_t enrolled() { return list_study_enrolments(library_, study_id_).size(); }
};

TEST_F(SimulatedAnswersTest, WhoIsEnrolledAnswersOnceAndAsPlanted) {
  ASSERT_GE(enrolled(), 5U);
  const Round round = questionnaire_round(study_id_);
  const auto made = simulate_answers(library_, round.code, 1);
  ASSERT_TRUE(made.has_value()) << made.error().code;
  EXPECT_EQ(made->sent, enrolled());
  const auto responses = list_responses(library_, round.code);
  ASSERT_TRUE(responses.has_value());
  ASSERT_EQ(responses->sets.size(), enrolled());
  std::map<std::string, std::string> ids;
  for (const StudyEnrolment& one : list_study_enrolments(library_, study_id_)) ids[one.pseudonym] = one.person_id;
  for (const auto& [questionnaire_id, set] : responses->sets) {
    EXPECT_EQ(set.source, "simulated");
    const population::Person& person = people_.at(ids.at(set.respondent));
    // Item 8h is the last of the published statements; item 5, on ten points, none of them.
    EXPECT_EQ(set.answers.at("8h").value, population::answer_of(person, 5));
    EXPECT_EQ(
        set.answers.at("5").value,
        1.0 + static_cast<double>(population::answered_point(
                  person, "How confident do you feel when performing imaging guided needle puncture procedures?",
                  10)));
    EXPECT_EQ(set.answers.at("9").state, assessment::questionnaire::AnswerState::missing) << "a comment";
  }
  const auto again = simulate_answers(library_, round.code, 1);
  EXPECT_EQ(again->sent, 0U);
  EXPECT_EQ(again->there, enrolled());
  // People have a round of their own.
  EXPECT_EQ(begin_response(library_, round.code, {.code = "", .group = "", .language = ""}).error().code,
            "round_in_use");
  const Round peoples = questionnaire_round(study_id_);
  const auto begun = begin_response(library_, peoples.code, {.code = "", .group = "", .language = ""});
  ASSERT_TRUE(begun.has_value()) << begun.error().code;
  EXPECT_EQ(simulate_answers(library_, peoples.code, 1).error().code, "round_in_use");
  // A draft, which may be changed but for this.
  library_.database().run("UPDATE response_set SET simulated = 1 WHERE submitted_us IS NULL");
  EXPECT_TRUE(refused_by_constraint(
      [&] { library_.database().run("UPDATE response_set SET simulated = 0 WHERE submitted_us IS NULL"); }));
}

TEST_F(SimulatedAnswersTest, RatersSendWhatTheirSeveritySeesOfTheAbilityThen) {
  const auto opened = rating_round();
  const auto made = simulate_answers(library_, opened.round.code, 9);
  ASSERT_TRUE(made.has_value()) << made.error().code;
  const auto ratings = list_ratings(library_, opened.round.code);
  ASSERT_TRUE(ratings.has_value());
  EXPECT_EQ(ratings->ratings.size(), ratings->asked);
  EXPECT_EQ(count_simulated(*ratings), ratings->asked);
  EXPECT_EQ(made->sent, ratings->asked);
  std::set<std::string> raters;
  for (const SentRating& one : ratings->ratings) {
    raters.insert(one.rater);
    const Made& of = made_.at(one.attempt_id);
    const population::Person& person = people_.at(of.person_id);
    const auto rater = population::drawn_rater(9, static_cast<std::uint64_t>(one.rater.at(1) - '0'));
    EXPECT_EQ(one.answers.at("handling").value,
              1.0 + static_cast<double>(population::rated_point(rater, person,
                                                                population::ability_on(person, of.occasion),
                                                                "Instrument handling", one.number - 1, 5)));
  }
  EXPECT_EQ(raters.size(), 3U);
  EXPECT_EQ(simulate_answers(library_, opened.round.code, 9)->there, ratings->asked);
}

// Of somebody's six attempts the last alone is left: the five before it were practice all the same, on that day at
// the latest.
TEST_F(SimulatedAnswersTest, WhatIsMissingWasPractice) {
  const auto person = population::drawn_person(*population::named_group("novice"), 3, 40);
  const std::vector<double> days(5, 0.0);
  const population::Occasion occasion{population::case_key_of(sample_case().title), 5,
                                      population::gain_of(person.practice, days, 0.0)};
  ASSERT_GT(occasion.gain, 0.1);
  NewAttempt last = sample_attempt(case_id_, lesion_id_);
  last.person_id = simulated_person(library_, person, 3);
  last.seed = population::attempt_seed(person, occasion);
  NewRatingRound asked;
  asked.round = {.title = "The last", .form_id = "osats-grs"};
  asked.replays = {{add_attempt(library_, last).value(), "<section></section>"}};
  asked.raters = asked.each = 9;  // all of them
  const auto opened = open_rating_round(library_, asked);
  ASSERT_TRUE(opened.has_value()) << opened.error().code;
  ASSERT_TRUE(simulate_answers(library_, opened->round.code, 9));
  const auto ratings = list_ratings(library_, opened->round.code);
  ASSERT_TRUE(ratings.has_value());
  std::size_t seen = 0;
  for (const SentRating& one : ratings->ratings)
    for (const assessment::questionnaire::Item& item : ratings->form.form.items) {
      if (item.kind != assessment::questionnaire::ItemKind::scale) continue;
      const auto rater = population::drawn_rater(9, static_cast<std::uint64_t>(one.rater.at(1) - '0'));
      const auto point = [&](const population::Abilities& ability) {
        return 1.0 +
               static_cast<double>(population::rated_point(rater, person, ability, item.text, one.number - 1, 5));
      };
      const double with_practice = point(population::ability_on(person, occasion));
      EXPECT_EQ(one.answers.at(item.id).value, with_practice) << one.rater << " " << item.id;
      seen += with_practice != point(person.ability) ? 1U : 0U;
    }
  EXPECT_GT(seen, 0U) << "somebody sees the practice";
}

TEST_F(SimulatedAnswersTest, PeopleAreNotAnsweredFor) {
  EXPECT_EQ(simulate_answers(library_, questionnaire_round({}).code, 1).error().code, "nobody_simulated");
  EXPECT_EQ(simulate_answers(library_, "XXXXXX", 1).error().code, "no_round");
  const Round closed = questionnaire_round(study_id_);
  ASSERT_TRUE(close_round(library_, closed.round_id));
  EXPECT_EQ(simulate_answers(library_, closed.code, 1).error().code, "round_closed");
  // A person has begun to rate.
  const auto in_use = rating_round();
  ASSERT_TRUE(keep_rating(library_, rater_secret(in_use.keys[2]), 1, {{"time", "4"}}, false));
  EXPECT_EQ(simulate_answers(library_, in_use.round.code, 1).error().code, "round_in_use");
  EXPECT_TRUE(list_ratings(library_, in_use.round.code)->ratings.empty()) << "all or nothing";
  // One replay is a person's.
  NewAttempt tinas = sample_attempt(case_id_, lesion_id_);
  tinas.person_id = add_user(library_, "tina", Role::trainee, "a password").value();
  tinas.operator_name = kPersonOperator;
  NewRatingRound mixed;
  mixed.round = {.title = "Replays", .form_id = "osats-grs"};
  mixed.replays = {{made_.begin()->first, "<section></section>"},
                   {add_attempt(library_, tinas).value(), "<section></section>"}};
  const auto opened = open_rating_round(library_, mixed);
  ASSERT_TRUE(opened.has_value()) << opened.error().code;
  EXPECT_EQ(simulate_answers(library_, opened->round.code, 1).error().code, "nobody_simulated");
  EXPECT_TRUE(list_ratings(library_, opened->round.code)->ratings.empty());
}

}  // namespace
}  // namespace seldinger::casedb
