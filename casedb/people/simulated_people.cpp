#include "casedb/people/simulated_people.h"

#include <bit>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "assessment/population/streams.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/facts.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

namespace population = assessment::population;

std::string pseudonym_of(const population::Person& person) {
  char text[16];
  std::snprintf(
      text, sizeof text, "S-%010llx",
      static_cast<unsigned long long>(
          population::stream_of(person.key, population::Drawn::identity, population::kPeopleVersion, 2) >> 24U));
  return text;
}

}  // namespace

// UUID version 8 (RFC 9562): its bits are the person's stream, so that two libraries give the same person the same
// id.
std::string simulated_person_id(const population::Person& person) {
  const auto word = [&](std::uint64_t which) {
    return population::stream_of(person.key, population::Drawn::identity, population::kPeopleVersion, which);
  };
  const std::uint64_t high = (word(0) & ~0xf000ULL) | 0x8000ULL;
  const std::uint64_t low = (word(1) & ~(3ULL << 62U)) | (2ULL << 62U);
  char text[37];
  std::snprintf(
      text, sizeof text, "%08llx-%04llx-%04llx-%04llx-%012llx", static_cast<unsigned long long>(high >> 32U),
      static_cast<unsigned long long>(high >> 16U & 0xffffU), static_cast<unsigned long long>(high & 0xffffU),
      static_cast<unsigned long long>(low >> 48U), static_cast<unsigned long long>(low & 0xffffffffffffULL));
  return text;
}

std::string simulated_person(Library& library, const population::Person& person, std::uint64_t seed) {
  const std::string person_id = simulated_person_id(person);
  Sqlite& database = library.database();
  {
    Transaction transaction(database);
    bool is_new = false;
    {
      Statement add = question(database, "add_simulated_person");
      add.bind("person_id", person_id).bind("pseudonym", pseudonym_of(person)).bind("created_us", now_us());
      is_new = add.step();
      if (is_new) CHECK(!add.step());
    }
    if (is_new)
      question(database, "add_simulated_truth")
          .bind("person_id", person_id)
          .bind("people_version", population::kPeopleVersion)
          .bind("seed", std::bit_cast<std::int64_t>(seed))
          .bind("group_name", person.group)
          .bind("number", static_cast<std::int64_t>(person.number))
          .bind("eye_hand", person.ability[0])
          .bind("spatial", person.ability[1])
          .bind("planning", person.ability[2])
          .bind("conduct", person.ability[3])
          .bind("strategy", person.strategy)
          .run();
    transaction.commit();
  }
  if (list_facts(library, person_id).empty()) {
    char years[16];
    std::snprintf(years, sizeof years, "%.1f", person.years);
    const bool left = population::uniform_of(population::stream_of(person.key, population::Drawn::fact, 1)) < 0.1;
    const auto given =
        give_facts(library, person_id, {{"years_in_radiology", years}, {"handedness", left ? "left" : "right"}});
    CHECK(given.has_value());
  }
  return person_id;
}

bool is_simulated(Library& library, const std::string& person_id) {
  return question(library.database(), "simulated_person").bind("person_id", person_id).step();
}

std::set<std::string> simulated_people(Library& library) {
  std::set<std::string> people;
  for (Statement rows = question(library.database(), "simulated_people"); rows.step();)
    people.insert(rows.text("person_id"));
  return people;
}

population::Person simulated_person_of(Library& library, const SimulatedTruth& truth) {
  // What is not planted by the group is the seed's and the number's alone.
  population::Person person = population::drawn_person({truth.group, {}, 0.0}, truth.seed, truth.number);
  person.ability = truth.ability;
  person.strategy = truth.strategy;
  const auto facts = newest_facts(list_facts(library, truth.person_id));
  if (const auto years = facts.find("years_in_radiology"); years != facts.end())
    person.years = std::strtod(years->second.answer.c_str(), nullptr);
  return person;
}

std::vector<SimulatedTruth> list_simulated_truths(Library& library) {
  std::vector<SimulatedTruth> truths;
  for (Statement rows = question(library.database(), "simulated_truths"); rows.step();) {
    SimulatedTruth& one = truths.emplace_back();
    one.person_id = rows.text("person_id");
    one.group = rows.text("group_name");
    one.seed = std::bit_cast<std::uint64_t>(rows.integer("seed"));
    one.number = static_cast<std::uint64_t>(rows.integer("number"));
    one.people_version = rows.small_integer("people_version");
    one.ability = {rows.real("eye_hand"), rows.real("spatial"), rows.real("planning"), rows.real("conduct")};
    one.strategy = rows.real("strategy");
  }
  return truths;
}

}  // namespace seldinger::casedb
