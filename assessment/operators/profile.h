// How well a simulated trainee does. Software test data: what they show says nothing about validity (clinical.md).
#pragma once

#include <optional>
#include <string>

#include "sim/base/result.h"

namespace seldinger::assessment {

// Values of the named profiles are judgement, chosen so that novice, intermediate and expert differ in the way the
// literature says they do (assessment.md §1.3): unseen advance, probe drift, redirections, distance to the target.
struct OperatorProfile {
  std::string name;
  double reaction_delay_s = 0.25;  // from a picture to acting on it
  double tremor_mm = 0.1;          // amplitude, 8–12 Hz (physiological tremor)
  double sway_mm = 0.5;            // slow wander of the needle hand
  double probe_drift_mm = 0.5;     // slow wander of the probe out of plane
  double target_error_mm = 1.0;    // 1 σ per axis of where the target is believed to be
  double aim_error_deg = 1.0;      // 1 σ of the first aim
  double advance_mm_s = 12.0;
  double approach_mm_s = 40.0;
  double scan_s = 2.0;                 // time to find the plane
  double accept_miss_mm = 2.0;         // a larger seen miss beside the target is corrected …
  int max_redirections = 3;            // … this many times
  double redirect_depth_share = 0.4;   // withdrawn to this share of the depth before a new aim
  double full_withdrawal_share = 0.0;  // probability that a redirection leaves the skin
  double blind_advance_share = 0.0;    // probability of going on when the tip is not in the picture
};

// novice, intermediate, expert; nothing otherwise.
std::optional<OperatorProfile> named_profile(const std::string& name);

// From a JSON object with any of the fields above (the rest as the expert's). Refused: `bad_operator`.
base::Result<OperatorProfile> profile_from_json(const std::string& text);

}  // namespace seldinger::assessment
