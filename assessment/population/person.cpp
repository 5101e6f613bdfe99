#include "assessment/population/person.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "assessment/population/streams.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/base/hash.h"

namespace seldinger::assessment::population {
namespace {

using S = Skills;

constexpr double kCommon = 0.5;       // the correlation of any two abilities
constexpr double kMiddleShift = 0.6;  // where the rows' centres lie
constexpr double kLapseDepth = 1.5;

// Of a logarithm, and of a logit, whose unit is about 1.7 times as wide.
constexpr double kOwn = 0.35, kCase = 0.3, kOccasion = 0.25;
constexpr double kOwnLogit = 0.6, kCaseLogit = 0.5, kOccasionLogit = 0.4;

constexpr SkillRow log_row(double S::*value, double centre, Abilities loading, double strategy = 0.0) {
  return {value, centre, loading, strategy, kOwn, kCase, kOccasion};
}
constexpr SkillRow logit_row(double S::*value, double centre, Abilities loading, double strategy = 0.0) {
  return {value, centre, loading, strategy, kOwnLogit, kCaseLogit, kOccasionLogit};
}

// Eye and hand, spatial, planning, conduct; then strategy. Centres are the intermediate operator's, but for the
// clock: an attempt takes minutes, with search, talk and rest. Sizes are judgement, held against published effects
// in reference_effects.h. What loads on nothing does not tell groups apart: tremor, reaction and the pace of hands
// are of the person and the strategy, and who is experienced leaves out rather more of what is only said (the
// intermediate effect: Schmidt and Boshuizen, Mem. Cognit. 21, 1993, 338).
constexpr SkillRow kRows[] = {
    log_row(&S::reaction_delay_s, 0.35, {0, 0, 0, 0}),
    log_row(&S::tremor_mm, 0.15, {0, 0, 0, 0}),
    log_row(&S::sway_mm, 0.9, {-0.25, 0, 0, 0}),
    log_row(&S::probe_drift_mm, 1.5, {-0.4, 0, 0, 0}),
    log_row(&S::target_error_mm, 2.2, {0, -0.4, 0, 0}),
    log_row(&S::aim_error_deg, 3.0, {-0.15, -0.3, 0, 0}),
    log_row(&S::advance_mm_s, 5.0, {0, 0, 0, 0}, 0.35),
    log_row(&S::approach_mm_s, 20.0, {0, 0, 0, 0}, 0.3),
    log_row(&S::scan_s, 30.0, {0, -0.1, 0, 0}, -0.35),
    log_row(&S::accept_miss_mm, 2.5, {0, 0, 0, 0}, 0.25),
    logit_row(&S::look_error_share, 0.5, {0, -0.5, 0, 0}),
    logit_row(&S::full_withdrawal_share, 0.12, {0, 0, -0.4, 0}),
    logit_row(&S::leaves_organ_share, 0.3, {0, 0, -0.6, 0}),
    logit_row(&S::checks_aim_share, 0.65, {0, 0, 0.6, 0}, -0.4),
    logit_row(&S::blind_advance_share, 0.35, {0, 0, 0, -0.6}, 0.5),
    log_row(&S::realign_s, 0.9, {-0.25, 0, 0, 0}, -0.15),
    log_row(&S::follow_error_mm, 1.5, {-0.35, -0.1, 0, 0}),
    log_row(&S::fix_error_mm, 1.1, {0, -0.3, 0, 0}),
    log_row(&S::depth_error_mm, 6.0, {0, -0.3, 0, 0}),
    log_row(&S::arm_error_deg, 2.0, {0, -0.35, 0, 0}),
    log_row(&S::exposure_step_mm, 10.0, {0, 0, 0, 0}, 0.3),
    log_row(&S::look_s, 0.6, {0, 0, 0, -0.25}),
    logit_row(&S::collimator_open, 0.6, {0, 0, 0, -0.4}),
    log_row(&S::depth_turn_deg, 35.0, {0, 0, 0.15, 0}),
    logit_row(&S::skip_depth_view_share, 0.12, {0, 0, -0.5, 0}, 0.4),
    logit_row(&S::hand_in_beam_share, 0.25, {0, 0, 0, -0.6}),
    logit_row(&S::beam_while_moving_share, 0.25, {0, 0, 0, -0.6}, 0.3),
    logit_row(&S::beam_while_advancing_share, 0.2, {0, 0, 0, -0.5}, 0.3),
    log_row(&S::step_s, 4.0, {0, 0, 0, 0}, -0.3),
    logit_row(&S::skip_step_share, 0.1, {0, 0, 0.25, -0.15}, 0.5),
    logit_row(&S::misses_contraindication_share, 0.2, {0, 0, 0, -0.6}),
    logit_row(&S::stops_in_trouble_share, 0.7, {0, 0, 0, 0.5}),
    logit_row(&S::holds_breath_early_share, 0.6, {0, 0, 0.6, 0}),
    logit_row(&S::waits_for_breath_share, 0.7, {0, 0, 0, 0.5}, -0.4),
    logit_row(&S::shows_share, 0.75, {0, 0, 0, 0.3}, -0.3),
    log_row(&S::pause_s, 10.0, {0, 0, 0, 0}, -0.3),
};

bool is_share(const SkillField& field) noexcept {
  return std::string_view(field.unit) == "share" && field.max == 1.0;
}

double inverse_logit(double x) noexcept {
  return 1.0 / (1.0 + base::exact_exp(-x));
}

const SkillField& field_of(double Skills::*value) {
  for (const SkillField& field : skill_fields())
    if (field.value == value) return field;
  CHECK(false);  // every skill has its row
  return skill_fields().front();
}

}  // namespace

double ability_correlation(std::size_t a, std::size_t b) noexcept {
  return a == b ? 1.0 : kCommon;
}

std::optional<Group> named_group(const std::string& name) {
  if (name == "novice") return Group{name, {}, 1.0};
  if (name == "intermediate") return Group{name, {0.6, 0.6, 0.6, 0.6}, 4.0};
  if (name == "expert") return Group{name, {1.2, 1.2, 1.2, 1.2}, 14.0};
  return std::nullopt;
}

Group shifted_group(double shift) {
  char name[32];
  std::snprintf(name, sizeof name, "shift%g", shift);
  return {name, {shift, shift, shift, shift}, 1.0};
}

std::span<const SkillRow> skill_rows() {
  return kRows;
}

double gain_of(const Practice& practice, std::span<const double> days_before, double day) noexcept {
  const double taken = 1.0 - base::exact_exp(-practice.rate);
  double gain = 0.0;
  for (std::size_t i = 0; i < days_before.size(); ++i) {
    gain += (practice.ceiling - gain) * taken;
    const double next = i + 1 < days_before.size() ? days_before[i + 1] : day;
    gain *= base::exact_exp(-base::exact_log(2.0) * std::max(0.0, next - days_before[i]) / practice.half_life_days);
  }
  return gain;
}

Person drawn_person(const Group& group, std::uint64_t seed, std::uint64_t number) {
  Person person;
  person.key = person_key(seed, group.name, number);
  person.group = group.name;
  person.number = number;
  // One factor common to all: √ρ of it and √(1 − ρ) of the ability's own give every pair the correlation ρ.
  const double common = normal_of(stream_of(person.key, Drawn::ability, kAbilities));
  for (std::size_t a = 0; a < kAbilities; ++a)
    person.ability[a] = group.shift[a] + std::sqrt(kCommon) * common +
                        std::sqrt(1.0 - kCommon) * normal_of(stream_of(person.key, Drawn::ability, a));
  person.strategy = normal_of(stream_of(person.key, Drawn::strategy));
  const auto learning = [&](std::uint64_t what) { return stream_of(person.key, Drawn::learning, what); };
  // Rates vary by half of their mean; one in twelve does not learn.
  person.practice.rate = 0.12 * base::exact_exp(0.47 * normal_of(learning(0)));
  person.practice.ceiling =
      uniform_of(learning(1)) < 1.0 / 12.0 ? 0.0 : 0.8 * base::exact_exp(0.3 * normal_of(learning(2)));
  person.practice.half_life_days = 90.0 * base::exact_exp(0.5 * normal_of(learning(3)));
  person.practice.lapse_share = 0.05;
  person.years = std::clamp(
      group.middle_years * base::exact_exp(0.35 * normal_of(stream_of(person.key, Drawn::fact))), 0.0, 50.0);
  return person;
}

std::uint64_t case_key_of(std::string_view case_title) noexcept {
  return base::hash_bytes(std::as_bytes(std::span(case_title)));
}

Abilities ability_on(const Person& person, const Occasion& occasion) {
  const bool lapse = uniform_of(stream_of(person.key, Drawn::lapse, occasion.case_key, occasion.attempt)) <
                     person.practice.lapse_share;
  Abilities ability = person.ability;
  for (double& one : ability) one += lapse ? -kLapseDepth : occasion.gain;
  return ability;
}

OperatorProfile profile_on(const Person& person, const Occasion& occasion) {
  OperatorProfile profile = *named_profile("intermediate");  // what is the same in all people
  profile.name = person.group;
  const Abilities ability = ability_on(person, occasion);
  std::uint64_t which = 0;
  for (const SkillRow& row : kRows) {
    const SkillField& field = field_of(row.value);
    double moved = row.strategy * person.strategy;
    for (std::size_t a = 0; a < kAbilities; ++a) moved += row.loading[a] * (ability[a] - kMiddleShift);
    moved += row.own_sd * normal_of(stream_of(person.key, Drawn::specific, which));
    moved += row.case_sd * normal_of(stream_of(person.key, Drawn::with_case, occasion.case_key, which));
    const std::uint64_t then = stream_of(person.key, Drawn::occasion, occasion.case_key, occasion.attempt);
    moved += row.occasion_sd * normal_of(base::hash_combine(then, which));
    const double value = is_share(field) ? inverse_logit(base::exact_log(row.centre / (1.0 - row.centre)) + moved)
                                         : row.centre * base::exact_exp(moved);
    profile.*row.value = std::clamp(value, field.min, field.max);
    ++which;
  }
  return profile;
}

std::uint64_t attempt_seed(const Person& person, const Occasion& occasion) noexcept {
  return stream_of(person.key, Drawn::attempt, occasion.case_key, occasion.attempt) >> 11;
}

Mishaps mishaps_on(const Person& person, const Occasion& occasion) {
  Mishaps mishaps;
  const std::uint64_t device = stream_of(person.key, Drawn::device, occasion.case_key, occasion.attempt);
  if (uniform_of(device) < 0.01) mishaps.device_lost_s = 20.0 + 100.0 * base::uniform_at(device, 1);
  mishaps.patience_s = 360.0 * base::exact_exp(0.35 * normal_of(stream_of(person.key, Drawn::patience,
                                                                          occasion.case_key, occasion.attempt)));
  return mishaps;
}

bool comes_to(const Person& person, std::uint64_t session) {
  double mean = 0.0;
  for (const double one : person.ability) mean += one / static_cast<double>(kAbilities);
  const double leaves = inverse_logit(-3.0 - 0.5 * mean);  // at each session after the first
  for (std::uint64_t s = 1; s <= session; ++s)
    if (uniform_of(stream_of(person.key, Drawn::drop_out, s)) < leaves) return false;
  return true;
}

}  // namespace seldinger::assessment::population
