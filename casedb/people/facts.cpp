#include "casedb/people/facts.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "casedb/database/audit.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/people.h"

namespace seldinger::casedb {
namespace {

constexpr FactInfo kFacts[] = {
    {.id = "years_in_radiology",
     .words = "Years in radiology",
     .unit = "years",
     .whole = false,
     .least = 0,
     .most = 70},
    {.id = "handedness", .words = "Writing hand", .choices = "left|right|both"},
    {.id = "logbook_total",
     .words = "Interventional procedures in your logbook, last 3 months",
     .unit = "count",
     .least = 0,
     .most = 5000},
    {.id = "logbook_independent",
     .words = "Of these, performed independently",
     .unit = "count",
     .least = 0,
     .most = 5000},
    {.id = "confidence",
     .words = "Confidence in performing image-guided needle punctures",
     .least = 1,
     .most = 10,
     .least_words = "none: I cannot do these",
     .most_words = "full: unsupervised in all cases"},
};

std::string digits_of(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value).ptr;
  return {text, end};
}

// Of the procedures in the logbook no more can have been independent than there were.
base::Result<void> check_logbook(const std::map<std::string, std::string>& told,
                                 const std::map<std::string, FactGiven>& before) {
  const auto number = [&](const char* fact_id) -> std::optional<double> {
    const auto now = told.find(fact_id);
    const auto then = before.find(fact_id);
    if (now != told.end()) return std::stod(now->second);
    return then == before.end() ? std::nullopt : std::optional(std::stod(then->second.answer));
  };
  const auto all = number("logbook_total"), independent = number("logbook_independent");
  if (!all || !independent || *independent <= *all) return {};
  return base::Error{"bad_answer", std::string(find_fact("logbook_independent")->words) + ": " +
                                       digits_of(*independent) + " are more than the " + digits_of(*all) +
                                       " procedures in the logbook"};
}

}  // namespace

std::span<const FactInfo> fact_infos() {
  return kFacts;
}

const FactInfo* find_fact(std::string_view id) noexcept {
  const auto found =
      std::find_if(std::begin(kFacts), std::end(kFacts), [&](const FactInfo& one) { return one.id == id; });
  return found == std::end(kFacts) ? nullptr : &*found;
}

std::vector<std::string> choices_of(const FactInfo& fact) {
  std::vector<std::string> choices;
  for (std::size_t from = 0; fact.is_choice() && from <= fact.choices.size();) {
    const std::size_t end = std::min(fact.choices.find('|', from), fact.choices.size());
    choices.emplace_back(fact.choices.substr(from, end - from));
    from = end + 1;
  }
  return choices;
}

base::Result<std::string> checked_answer(const std::string& fact_id, const std::string& answer) {
  const FactInfo* fact = find_fact(fact_id);
  if (fact == nullptr) {
    std::string known;
    for (const FactInfo& one : kFacts) known += (known.empty() ? "" : ", ") + std::string(one.id);
    return base::Error{"unknown_fact", "there is no such fact; known are " + known};
  }
  if (fact->is_choice()) {
    const auto choices = choices_of(*fact);
    if (std::find(choices.begin(), choices.end(), answer) != choices.end()) return answer;
    return base::Error{"bad_answer", std::string(fact->words) + ": one of " + std::string(fact->choices)};
  }
  double value = 0.0;
  const auto read = std::from_chars(answer.data(), answer.data() + answer.size(), value);
  const bool number = read.ec == std::errc() && read.ptr == answer.data() + answer.size() && std::isfinite(value);
  if (!number || value < fact->least || value > fact->most || (fact->whole && value != std::floor(value)))
    return base::Error{"bad_answer", std::string(fact->words) +
                                         (fact->whole ? ": a whole number from " : ": a number from ") +
                                         digits_of(fact->least) + " to " + digits_of(fact->most)};
  return digits_of(value + 0.0);  // no negative zero
}

base::Result<void> give_facts(Library& library, const std::string& person_id,
                              const std::map<std::string, std::string>& answers) {
  std::map<std::string, std::string> checked;
  for (const auto& [fact_id, answer] : answers) {
    auto fit = checked_answer(fact_id, answer);
    if (!fit) return fit.error();
    checked.emplace(fact_id, std::move(*fit));
  }
  if (checked.empty()) return {};
  Transaction transaction(library.database());
  if (const auto known = check_person(library, person_id); !known) return known.error();
  if (checked.contains("logbook_total") || checked.contains("logbook_independent"))
    if (const auto fit = check_logbook(checked, newest_facts(list_facts(library, person_id))); !fit)
      return fit.error();
  const std::int64_t given_us = now_us();
  for (const auto& [fact_id, answer] : checked)
    question(library.database(), "add_fact")
        .bind("person_id", person_id)
        .bind("fact_id", fact_id)
        .bind("given_us", given_us)
        .bind("answer", answer)
        .run();
  audit(library, Act::give_fact, {"person", person_id});
  transaction.commit();
  return {};
}

base::Result<void> give_fact(Library& library, const std::string& person_id, const std::string& fact_id,
                             const std::string& answer) {
  return give_facts(library, person_id, {{fact_id, answer}});
}

std::vector<FactGiven> list_facts(Library& library, const std::string& person_id) {
  std::vector<FactGiven> given;
  Statement rows = question(library.database(), "facts_of_person");
  for (rows.bind("person_id", person_id); rows.step();)
    given.push_back({rows.text("fact_id"), rows.text("answer"), rows.integer("given_us")});
  return given;
}

std::map<std::string, FactGiven> newest_facts(const std::vector<FactGiven>& given) {
  std::map<std::string, FactGiven> newest;
  for (const FactGiven& one : given) newest[one.fact_id] = one;
  return newest;
}

}  // namespace seldinger::casedb
