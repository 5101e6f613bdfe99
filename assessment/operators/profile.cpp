#include "assessment/operators/profile.h"

#include <algorithm>

#include "sim/base/exact_math.h"
#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::assessment {
namespace {

using S = Skills;

// Values are judgement, chosen so that novice, intermediate and expert differ in the way the literature says they
// do: unseen advance and probe drift (Sites et al., Reg. Anesth. Pain Med. 32, 2007, 107), redirections, distance
// to the target.
constexpr SkillField kFields[] = {
    {"reaction_delay_s", "s", 0, 5, 0.5, 0.35, 0.25, true, "from a picture to acting on it", &S::reaction_delay_s},
    {"tremor_mm", "mm", 0, 10, 0.25, 0.15, 0.1, true, "amplitude, 8–12 Hz (physiological tremor)", &S::tremor_mm},
    {"sway_mm", "mm", 0, 50, 1.6, 0.9, 0.5, true, "slow wander of the needle hand", &S::sway_mm},
    {"probe_drift_mm", "mm", 0, 50, 3.5, 1.5, 0.5, true, "slow wander of the probe out of plane",
     &S::probe_drift_mm},
    {"target_error_mm", "mm", 0, 100, 4.5, 2.2, 1, true, "1 σ per axis of where the target is believed to be",
     &S::target_error_mm},
    {"aim_error_deg", "deg", 0, 45, 7, 3, 1, true, "1 σ of the first aim; each further one is better",
     &S::aim_error_deg},
    {"advance_mm_s", "mm/s", 0.5, 200, 7, 9, 12, true, "speed of advance in tissue", &S::advance_mm_s},
    {"approach_mm_s", "mm/s", 1, 300, 20, 30, 40, true, "speed outside", &S::approach_mm_s},
    {"scan_s", "s", 0, 120, 10, 5, 2, true, "time to find the plane", &S::scan_s},
    {"accept_miss_mm", "mm", 0.1, 100, 4, 2.5, 2, true, "a larger seen miss beside the target is corrected",
     &S::accept_miss_mm},
    {"look_error_share", "share", 0, 1, 0.7, 0.5, 0.4, true,
     "of the error about the target, left after tip and target were seen together", &S::look_error_share},
    {"max_redirections", "count", 0, 20, 4, 3, 3, false, "so often a miss is corrected", &S::max_redirections},
    {"redirect_depth_share", "share", 0, 0.9, 0.4, 0.4, 0.4, false, "withdrawn to this share of the depth before",
     &S::redirect_depth_share},
    {"full_withdrawal_share", "share", 0, 1, 0.35, 0.1, 0, true, "probability that a redirection leaves the skin",
     &S::full_withdrawal_share},
    {"leaves_organ_share", "share", 0, 1, 0.7, 0.3, 0, true,
     "probability that a redirection leaves the organ that was entered", &S::leaves_organ_share},
    {"checks_aim_share", "share", 0, 1, 0.2, 0.7, 1, true,
     "probability of checking the aim before the organ's capsule is punctured", &S::checks_aim_share},
    {"blind_advance_share", "share", 0, 1, 0.8, 0.3, 0, true,
     "probability of going on when the tip is not in the picture", &S::blind_advance_share},
    {"realign_s", "s", 0.05, 20, 1.5, 0.9, 0.6, true, "time constant of bringing the probe over the needle",
     &S::realign_s},
    {"follow_error_mm", "mm", 0, 50, 4, 1.5, 0.5, true,
     "1 σ of where the probe is put, out of plane, to meet the tip", &S::follow_error_mm},
    {"fix_error_mm", "mm", 0, 50, 2, 1.1, 0.6, true, "1 σ per axis, on the detector, of a place read off a picture",
     &S::fix_error_mm},
    {"depth_error_mm", "mm", 0, 100, 9, 6, 4, true, "1 σ of the depth expected before a depth view",
     &S::depth_error_mm},
    {"arm_error_deg", "deg", 0, 30, 5, 2, 1, true, "1 σ of each angle of the bull's-eye view", &S::arm_error_deg},
    {"exposure_step_mm", "mm", 1, 200, 16, 10, 8, true, "advance between exposures", &S::exposure_step_mm},
    {"look_s", "s", 0, 20, 1.5, 0.6, 0.3, true, "pedal down for one look", &S::look_s},
    {"pulse_rate_hz", "Hz", 3, 15, 7.5, 7.5, 3, false, "3, 7.5 or 15, or the nearest", &S::pulse_rate_hz},
    {"collimator_open", "share", 0.05, 1, 1, 0.65, 0.45, true, "of the field's half width and height",
     &S::collimator_open},
    {"depth_turn_deg", "deg", 5, 90, 22, 35, 50, true, "from the bull's-eye view to the depth view",
     &S::depth_turn_deg},
    {"skip_depth_view_share", "share", 0, 1, 0.35, 0.1, 0, true, "probability of going without a depth view",
     &S::skip_depth_view_share},
    {"hand_in_beam_share", "share", 0, 1, 0.6, 0.25, 0, true,
     "probability of holding on to the needle during a look", &S::hand_in_beam_share},
    {"beam_while_moving_share", "share", 0, 1, 0.6, 0.2, 0, true,
     "probability of turning the arm with the pedal down", &S::beam_while_moving_share},
    {"beam_while_advancing_share", "share", 0, 1, 0.5, 0.2, 0, true, "probability of advancing with the pedal down",
     &S::beam_while_advancing_share},
    {"step_s", "s", 0.05, 60, 1, 0.6, 0.4, true, "time for each step around the puncture; nobody trains waiting",
     &S::step_s},
    {"skip_step_share", "share", 0, 1, 0.25, 0.08, 0, true, "probability of leaving out a step around the puncture",
     &S::skip_step_share},
    {"misses_contraindication_share", "share", 0, 1, 0.6, 0.2, 0, true,
     "probability of proceeding where INR or platelets forbid it", &S::misses_contraindication_share},
    {"stops_in_trouble_share", "share", 0, 1, 0.3, 0.7, 1, true,
     "probability of stopping when the patient coughs, bleeds or loses pressure", &S::stops_in_trouble_share},
    // Last: people drawn before there were these stay who they are.
    {"holds_breath_early_share", "share", 0, 1, 0.1, 0.6, 1, true,
     "probability of asking for a held breath before the needle goes in, not only before the trigger",
     &S::holds_breath_early_share},
    {"waits_for_breath_share", "share", 0, 1, 0.2, 0.7, 1, true,
     "probability of going on only while breath is held, and of asking again when it is lost",
     &S::waits_for_breath_share},
    {"shows_share", "share", 0, 1, 0.4, 0.8, 1, true,
     "probability of testing the probe's side, and of measuring the depth, rather than only saying so",
     &S::shows_share},
    {"pause_s", "s", 0, 120, 0, 0, 0, false, "talk and rest before the sign-in, the preparation and the sign-out",
     &S::pause_s},
};
static_assert(sizeof(Skills) == std::size(kFields) * sizeof(double), "every skill has its row");

constexpr double kLearnersRate = 0.15;  // of an exponential: half of the gap is gone after five attempts (design)

Skills skills_of(double SkillField::*column) {
  Skills skills{};
  for (const SkillField& field : kFields) skills.*field.value = field.*column;
  return skills;
}

Skills drawn(Skills skills, double spread, base::Rng& rng) {
  for (const SkillField& field : kFields) {
    const double z = rng.normal();
    if (field.personal)
      skills.*field.value = std::clamp(skills.*field.value * base::exact_exp(spread * z), field.min, field.max);
  }
  return skills;
}

}  // namespace

std::span<const SkillField> skill_fields() noexcept {
  return kFields;
}

std::optional<OperatorProfile> named_profile(const std::string& name) {
  OperatorProfile profile;
  profile.name = name;
  profile.learning.towards = skills_of(&SkillField::expert);
  if (name == "expert") {
    static_cast<Skills&>(profile) = profile.learning.towards;
  } else if (name == "intermediate") {
    static_cast<Skills&>(profile) = skills_of(&SkillField::intermediate);
  } else if (name == "novice" || name == "learner") {
    static_cast<Skills&>(profile) = skills_of(&SkillField::novice);
    profile.learning.rate = name == "learner" ? kLearnersRate : 0.0;
  } else {
    return std::nullopt;
  }
  return profile;
}

OperatorProfile person_of(const OperatorProfile& profile, std::uint64_t person_seed) {
  OperatorProfile person = profile;
  // Two streams with the same draws: who is quick as a novice is quick as an expert.
  base::Rng now(person_seed), later(person_seed);
  static_cast<Skills&>(person) = drawn(profile, profile.person_spread, now);
  person.learning.towards = drawn(profile.learning.towards, profile.person_spread, later);
  return person;
}

OperatorProfile at_attempt(const OperatorProfile& profile, std::uint64_t number) {
  OperatorProfile now = profile;
  const Learning& learning = profile.learning;
  if (!(learning.rate > 0.0)) return now;
  const double n = learning.before + static_cast<double>(number);
  const double left =
      base::exact_exp(-learning.rate * (learning.law == LearningLaw::exponential ? n : base::exact_log(1.0 + n)));
  for (const SkillField& field : kFields) {
    const double towards = learning.towards.*field.value;
    now.*field.value = towards + (profile.*field.value - towards) * left;
  }
  return now;
}

}  // namespace seldinger::assessment
