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

  // Guided by fluoroscopy.
  double fix_error_mm = 0.6;                // 1 σ per axis, on the detector, of a place read off a picture
  double depth_error_mm = 4.0;              // 1 σ of the depth expected before a depth view
  double arm_error_deg = 1.0;               // 1 σ of each angle of the bull's-eye view
  double exposure_step_mm = 8.0;            // advance between exposures
  double look_s = 0.3;                      // pedal down for one look
  double pulse_rate_hz = 3.0;               // 3, 7.5 or 15, or the nearest
  double collimator_open = 0.45;            // of the field's half width and height
  double depth_turn_deg = 50.0;             // from the bull's-eye view to the depth view
  double skip_depth_view_share = 0.0;       // probability of going without a depth view
  double hand_in_beam_share = 0.0;          // probability of holding on to the needle during a look
  double beam_while_moving_share = 0.0;     // probability of turning the arm with the pedal down
  double beam_while_advancing_share = 0.0;  // probability of advancing with the pedal down
};

// novice, intermediate, expert; nothing otherwise.
std::optional<OperatorProfile> named_profile(const std::string& name);

// From a JSON object with any of the fields above (the rest as the expert's). Refused: `bad_operator`.
base::Result<OperatorProfile> profile_from_json(const std::string& text);

}  // namespace seldinger::assessment
