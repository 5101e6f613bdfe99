// Simulated people: who is drawn for a group, and how such a person punctures on an occasion. A person is a point
// in a space of abilities; a group moves its mean and nothing else, so two groups overlap as people do. What is
// written here is the planted truth that statistics are tested against, and says nothing about people.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "assessment/operators/profile.h"
#include "sim/base/names.h"

namespace seldinger::assessment::population {

// Another model of people has another version: attempts and surrogates of different ones are not mixed.
constexpr int kPeopleVersion = 1;

enum class Ability { eye_hand, spatial, planning, conduct };
inline constexpr auto kAbilityNames = base::names<Ability>({{Ability::eye_hand, "eye_hand"},
                                                            {Ability::spatial, "spatial"},
                                                            {Ability::planning, "planning"},
                                                            {Ability::conduct, "conduct"}});
constexpr std::size_t kAbilities = 4;
using Abilities = std::array<double, kAbilities>;  // in standard deviations of the population

// The correlation of two abilities within a group.
double ability_correlation(std::size_t a, std::size_t b) noexcept;

struct Group {
  std::string name;
  Abilities shift{};  // of the mean
  // Of the answers that such a person gives about himself: years in radiology, log-normal about the middle one.
  double middle_years = 1.0;
};
// novice (0), intermediate (0.6), expert (1.2); nothing otherwise.
std::optional<Group> named_group(const std::string& name);
// A group whose every ability is shifted by as much: `shift0.8`.
Group shifted_group(double shift);

// How a skill follows from a person: its logarithm, or of a share its logit, is the centre's plus loadings on
// abilities and strategy, plus a part of the person's own, of person and case, and of the occasion.
struct SkillRow {
  double Skills::*value;
  double centre;      // at abilities of 0.6, strategy 0
  Abilities loading;  // of better ability, on the log or logit: negative where less is better; 0: tells nothing
  double strategy;    // of one standard deviation towards fast and rough
  double own_sd, case_sd, occasion_sd;
};
std::span<const SkillRow> skill_rows();

// Practice adds to every ability: of what is left to the ceiling an attempt takes 1 − exp(−rate); between sessions
// it is lost with a half-life. An attempt is a lapse with a probability of its own.
struct Practice {
  double rate = 0.0, ceiling = 0.0, half_life_days = 1.0, lapse_share = 0.0;
};
// What practice has added before an attempt, by the days of the attempts behind the person and of this one, rising.
double gain_of(const Practice& practice, std::span<const double> days_before, double day) noexcept;

struct Person {
  std::uint64_t key = 0;
  std::string group;
  std::uint64_t number = 1;
  Abilities ability{};    // before any practice here
  double strategy = 0.0;  // standard deviations towards fast and rough
  Practice practice;
  double years = 0.0;  // in radiology
};
Person drawn_person(const Group& group, std::uint64_t seed, std::uint64_t number);

// The case by what it is called: every version of a case, in every library, is the same to a person.
std::uint64_t case_key_of(std::string_view case_title) noexcept;
struct Occasion {
  std::uint64_t case_key = 0;  // case_key_of its title
  std::uint64_t attempt = 0;   // the person's, from 0, at this case
  double gain = 0.0;           // of practice
};
// Ability as it is then: with practice and, in a lapse, without it and 1.5 less.
Abilities ability_on(const Person& person, const Occasion& occasion);
// Named as the group; what learns is the person, so the profile itself does not.
OperatorProfile profile_on(const Person& person, const Occasion& occasion);
// Of hands and eyes in the attempt; below 2^53, so that JSON readers keep it.
std::uint64_t attempt_seed(const Person& person, const Occasion& occasion) noexcept;

// What keeps an attempt from being whole.
struct Mishaps {
  std::optional<double> device_lost_s;  // at random
  double patience_s = 0.0;              // by the result: who has not fired by then gives up
};
Mishaps mishaps_on(const Person& person, const Occasion& occasion);
// By ability: whether the person is still there in the session of that number, from 0.
bool comes_to(const Person& person, std::uint64_t session);

}  // namespace seldinger::assessment::population
