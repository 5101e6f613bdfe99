#include "assessment/operators/profile.h"

namespace seldinger::assessment {

std::optional<OperatorProfile> named_profile(const std::string& name) {
  OperatorProfile profile;
  profile.name = name;
  if (name == "expert") return profile;
  if (name == "intermediate") {
    profile.reaction_delay_s = 0.35;
    profile.tremor_mm = 0.15;
    profile.sway_mm = 0.9;
    profile.probe_drift_mm = 1.5;
    profile.target_error_mm = 2.2;
    profile.aim_error_deg = 3.0;
    profile.advance_mm_s = 9.0;
    profile.approach_mm_s = 30.0;
    profile.scan_s = 5.0;
    profile.accept_miss_mm = 2.5;
    profile.max_redirections = 3;
    profile.full_withdrawal_share = 0.1;
    profile.blind_advance_share = 0.3;
    profile.fix_error_mm = 1.1;
    profile.depth_error_mm = 6.0;
    profile.arm_error_deg = 2.0;
    profile.exposure_step_mm = 10.0;
    profile.look_s = 0.6;
    profile.pulse_rate_hz = 7.5;
    profile.collimator_open = 0.65;
    profile.depth_turn_deg = 35.0;
    profile.skip_depth_view_share = 0.1;
    profile.hand_in_beam_share = 0.25;
    profile.beam_while_moving_share = 0.2;
    profile.beam_while_advancing_share = 0.2;
    return profile;
  }
  if (name == "novice") {
    profile.reaction_delay_s = 0.5;
    profile.tremor_mm = 0.25;
    profile.sway_mm = 1.6;
    profile.probe_drift_mm = 3.5;
    profile.target_error_mm = 4.5;
    profile.aim_error_deg = 7.0;
    profile.advance_mm_s = 7.0;
    profile.approach_mm_s = 20.0;
    profile.scan_s = 10.0;
    profile.accept_miss_mm = 4.0;
    profile.max_redirections = 4;
    profile.full_withdrawal_share = 0.35;
    profile.blind_advance_share = 0.8;
    profile.fix_error_mm = 2.0;
    profile.depth_error_mm = 9.0;
    profile.arm_error_deg = 5.0;
    profile.exposure_step_mm = 16.0;
    profile.look_s = 1.5;
    profile.pulse_rate_hz = 7.5;
    profile.collimator_open = 1.0;
    profile.depth_turn_deg = 22.0;
    profile.skip_depth_view_share = 0.35;
    profile.hand_in_beam_share = 0.6;
    profile.beam_while_moving_share = 0.6;
    profile.beam_while_advancing_share = 0.5;
    return profile;
  }
  return std::nullopt;
}

}  // namespace seldinger::assessment
