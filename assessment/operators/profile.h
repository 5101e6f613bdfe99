// How well a simulated trainee does, how he differs from others like him, and how he learns. Software test data:
// what they show says nothing about validity (docs/clinical.md). What is written here is the planted truth that
// metrics are tested against.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "sim/base/result.h"

namespace seldinger::assessment {

// Who acts otherwise for the same skills and seed has another version: what was simulated of different ones is not
// mixed. It is raised with the hashes in tests/assessment/operators.
constexpr int kOperatorVersion = 2;

// Each is a row of skill_fields(), which tells unit, range, values and what it means.
struct Skills {
  // With needle and picture.
  double reaction_delay_s, tremor_mm, sway_mm, probe_drift_mm, target_error_mm, aim_error_deg, advance_mm_s,
      approach_mm_s, scan_s, accept_miss_mm, look_error_share, max_redirections, redirect_depth_share,
      full_withdrawal_share, leaves_organ_share, checks_aim_share, blind_advance_share, realign_s, follow_error_mm;
  // Guided by fluoroscopy.
  double fix_error_mm, depth_error_mm, arm_error_deg, exposure_step_mm, look_s, pulse_rate_hz, collimator_open,
      depth_turn_deg, skip_depth_view_share, hand_in_beam_share, beam_while_moving_share,
      beam_while_advancing_share;
  // Around the puncture.
  double step_s, skip_step_share, misses_contraindication_share, stops_in_trouble_share;
  // At a patient who breathes.
  double holds_breath_early_share, waits_for_breath_share;
  // What a deed can show.
  double shows_share;
  // Between the parts of the work.
  double pause_s;
};

struct SkillField {
  const char* name;  // of the JSON's field
  const char* unit;
  double min, max;
  double novice, intermediate, expert;
  bool personal;  // people differ in it
  const char* about;
  double Skills::*value;
};
std::span<const SkillField> skill_fields() noexcept;

// How a person's skills go from his own towards `towards` with the attempts behind him: what is left of the gap
// after n of them is exp(−rate·n) (Heathcote, Brown and Mewhort, Psychon. Bull. Rev. 7, 2000, 185), or (1 +
// n)^−rate (Newell and Rosenbloom, 1981).
enum class LearningLaw { exponential, power };
struct Learning {
  LearningLaw law = LearningLaw::exponential;
  double rate = 0.0;  // 0: nothing is learned
  double before = 0;  // attempts before the first
  Skills towards{};
};

struct OperatorProfile : Skills {
  std::string name;
  Learning learning{};
  double person_spread = 0.2;  // 1 σ of a person's skills about these, as a share of each
};

// novice, intermediate, expert; learner: a novice who becomes an expert. Nothing otherwise.
std::optional<OperatorProfile> named_profile(const std::string& name);

// One of the people with such a profile: each personal skill times exp(spread · z), kept in its range; what he
// learns towards is his own too. The same seed, the same person.
OperatorProfile person_of(const OperatorProfile& profile, std::uint64_t person_seed);

// As it is in the attempt with this number, from 0.
OperatorProfile at_attempt(const OperatorProfile& profile, std::uint64_t number);

// From a JSON object with any of skill_fields() (the rest as the expert's, or as `like` names), name,
// person_spread, and of a learner learning_rate, learning_law, attempts_before, learns_towards. Refused:
// `bad_operator`.
base::Result<OperatorProfile> profile_from_json(const std::string& text);

// docs/operators.md.
std::string operators_markdown();

}  // namespace seldinger::assessment
