#include "casedb/ratings/simulated_answers.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "assessment/population/raters.h"
#include "casedb/attempts/attempts.h"
#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/simulated_people.h"
#include "casedb/questionnaires/desk_rounds.h"
#include "casedb/ratings/rating_rounds.h"

namespace seldinger::casedb {
namespace {

namespace population = assessment::population;
namespace questionnaire = assessment::questionnaire;

constexpr double kDayUs = 86400e6;

base::Error nobody_simulated(const char* text) {
  return {"nobody_simulated", text};
}

// `place` answers which of so many points, from 0.
template <typename Place>
std::map<std::string, std::string> typed_on_scales(const questionnaire::Form& form, const Place& place) {
  std::map<std::string, std::string> typed;
  for (const questionnaire::Item& item : form.items) {
    if (item.kind != questionnaire::ItemKind::scale) continue;
    std::vector<int> values;
    for (const questionnaire::ScalePoint& one : form.find_scale(item.scale)->points)
      if (!one.no_opinion) values.push_back(one.value);
    typed.emplace(item.id, std::to_string(values.at(place(item.text, values.size()))));
  }
  return typed;
}

std::map<std::string, SimulatedTruth> truths_by_person(Library& library) {
  std::map<std::string, SimulatedTruth> truths;
  for (SimulatedTruth& one : list_simulated_truths(library)) truths.emplace(one.person_id, std::move(one));
  return truths;
}

// Which of the person's attempts at its case they are, by their seeds; those that are none of them are left out.
std::map<std::uint64_t, std::uint64_t> numbers_of(const population::Person& person, std::uint64_t case_key,
                                                  std::set<std::uint64_t> seeds) {
  constexpr std::uint64_t kMostAttempts = 100'000;  // as many as are made in a session
  std::map<std::uint64_t, std::uint64_t> numbers;
  for (std::uint64_t number = 0; number < kMostAttempts && !seeds.empty(); ++number) {
    const std::uint64_t seed = population::attempt_seed(person, {case_key, number, 0.0});
    if (seeds.erase(seed) > 0) numbers.emplace(seed, number);
  }
  return numbers;
}

// As it was in that attempt, with practice until then. Earlier ones that are not in the library count as made on
// the day of the next that is. Attempts that were not made as this person's own have none.
population::Abilities ability_in(Library& library, const population::Person& person, const AttemptRow& attempt) {
  const std::uint64_t case_key = population::case_key_of(attempt.case_title);
  std::map<std::uint64_t, double> started_days;  // by seed
  for (const AttemptRow& one : list_bare_attempts_of(library, *attempt.person_id))
    if (one.case_title == attempt.case_title)
      started_days.emplace(one.seed, static_cast<double>(one.started_us) / kDayUs);
  std::set<std::uint64_t> seeds{attempt.seed};
  for (const auto& [seed, day] : started_days) seeds.insert(seed);
  const auto numbers = numbers_of(person, case_key, std::move(seeds));
  const auto number = numbers.find(attempt.seed);
  if (number == numbers.end()) return person.ability;
  std::map<std::uint64_t, double> days;  // by number
  for (const auto& [seed, day] : started_days)
    if (const auto found = numbers.find(seed); found != numbers.end()) days.emplace(found->second, day);
  std::vector<double> before;
  for (std::uint64_t other = 0; other < number->second; ++other) before.push_back(days.lower_bound(other)->second);
  return population::ability_on(
      person, {case_key, number->second, population::gain_of(person.practice, before, days.at(number->second))});
}

base::Result<SimulatedAnswers> answer(Library& library, const Round& round) {
  Statement sets = question(library.database(), "sets_begun_in_round");
  CHECK(sets.bind("round_id", round.round_id).step());
  if (sets.integer("of_people") > 0) return base::Error{"round_in_use", "people answer in this round"};
  std::vector<std::pair<std::string, std::string>> people;  // and their groups
  Statement rows = question(library.database(), "simulated_in_study");
  for (rows.bind("study_id", round.study_id); rows.step();)
    people.emplace_back(rows.text("person_id"), rows.text("group_name"));
  if (people.empty()) return nobody_simulated("no simulated people are enrolled in the round's study");
  const auto forms = find_forms(library, round.form_id, round.version);
  if (!forms) return forms.error();
  const questionnaire::Form& form = forms->front().form;
  const auto truths = truths_by_person(library);
  SimulatedAnswers made;
  for (const auto& [person_id, group] : people) {
    const population::Person person = simulated_person_of(library, truths.at(person_id));
    const auto begun = begin_set_of(library, round, person_id, round.groups.empty() ? "" : group);
    if (!begun && begun.error().code == "respondent_taken") {
      ++made.there;
      continue;
    }
    if (!begun) return begun.error();
    const auto typed = typed_on_scales(form, [&](const std::string& words, std::size_t points) {
      return population::answered_point(person, words, points);
    });
    if (const auto sent = send_simulated(library, form, begun->response_id, typed); !sent) return sent.error();
    ++made.sent;
  }
  return made;
}

base::Result<SimulatedAnswers> rate(Library& library, const Round& round, std::uint64_t seed) {
  const auto forms = find_forms(library, round.form_id, round.version);
  if (!forms) return forms.error();
  const questionnaire::Form& form = forms->front().form;
  const auto truths = truths_by_person(library);
  SimulatedAnswers made;
  for (const AskedRating& one : list_asked_ratings(library, round.round_id)) {
    if (!one.simulated && (one.task.sent || !answers_of(library, one.response_id).empty()))
      return base::Error{"round_in_use", "people rate in this round"};
    if (one.task.sent) {
      ++made.there;
      continue;
    }
    const auto attempt = find_attempt(library, one.attempt_id);
    if (!attempt) return attempt.error();
    const auto truth = attempt->person_id ? truths.find(*attempt->person_id) : truths.end();
    if (truth == truths.end()) return nobody_simulated("one of the round's replays is not a simulated person's");
    const population::Person person = simulated_person_of(library, truth->second);
    const population::Abilities ability = ability_in(library, person, *attempt);
    const population::Rater rater = population::drawn_rater(seed, std::stoull(one.rater.substr(1)));  // "R1"
    const auto typed = typed_on_scales(form, [&](const std::string& words, std::size_t points) {
      return population::rated_point(rater, person, ability, words, one.task.number - 1, points);
    });
    if (const auto sent = send_simulated(library, form, one.response_id, typed); !sent) return sent.error();
    ++made.sent;
  }
  return made;
}

}  // namespace

base::Result<SimulatedAnswers> simulate_answers(Library& library, const std::string& code, std::uint64_t seed) {
  Transaction transaction(library.database());
  const auto round = find_round(library, code);
  if (!round) return round.error();
  if (!round->is_open()) return base::Error{"round_closed", "the round is closed: nobody answers any more"};
  auto made = round->rated ? rate(library, *round, seed) : answer(library, *round);
  if (!made) return made.error();
  if (made->sent + made->there == 0) return nobody_simulated("no replay of the round is a simulated person's");
  audit(library, Act::simulate_answers, {"round", round->round_id});
  transaction.commit();
  return made;
}

}  // namespace seldinger::casedb
