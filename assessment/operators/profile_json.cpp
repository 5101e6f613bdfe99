#include <cmath>
#include <nlohmann/json.hpp>

#include "assessment/operators/profile.h"

namespace seldinger::assessment {

base::Result<OperatorProfile> profile_from_json(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object()) return base::Error{"bad_operator", "the operator's file is not a JSON object"};
  OperatorProfile profile = *named_profile("expert");
  profile.name = "custom";
  struct Field {
    const char* name;
    double* value;
    double min, max;
  };
  double redirections = profile.max_redirections;
  const Field fields[] = {{"reaction_delay_s", &profile.reaction_delay_s, 0.0, 5.0},
                          {"tremor_mm", &profile.tremor_mm, 0.0, 10.0},
                          {"sway_mm", &profile.sway_mm, 0.0, 50.0},
                          {"probe_drift_mm", &profile.probe_drift_mm, 0.0, 50.0},
                          {"target_error_mm", &profile.target_error_mm, 0.0, 100.0},
                          {"aim_error_deg", &profile.aim_error_deg, 0.0, 45.0},
                          {"advance_mm_s", &profile.advance_mm_s, 0.5, 200.0},
                          {"approach_mm_s", &profile.approach_mm_s, 1.0, 300.0},
                          {"scan_s", &profile.scan_s, 0.0, 120.0},
                          {"accept_miss_mm", &profile.accept_miss_mm, 0.1, 100.0},
                          {"max_redirections", &redirections, 0.0, 20.0},
                          {"redirect_depth_share", &profile.redirect_depth_share, 0.0, 0.9},
                          {"full_withdrawal_share", &profile.full_withdrawal_share, 0.0, 1.0},
                          {"blind_advance_share", &profile.blind_advance_share, 0.0, 1.0},
                          {"fix_error_mm", &profile.fix_error_mm, 0.0, 50.0},
                          {"depth_error_mm", &profile.depth_error_mm, 0.0, 100.0},
                          {"arm_error_deg", &profile.arm_error_deg, 0.0, 30.0},
                          {"exposure_step_mm", &profile.exposure_step_mm, 1.0, 200.0},
                          {"look_s", &profile.look_s, 0.0, 20.0},
                          {"pulse_rate_hz", &profile.pulse_rate_hz, 3.0, 15.0},
                          {"collimator_open", &profile.collimator_open, 0.05, 1.0},
                          {"depth_turn_deg", &profile.depth_turn_deg, 5.0, 90.0},
                          {"skip_depth_view_share", &profile.skip_depth_view_share, 0.0, 1.0},
                          {"hand_in_beam_share", &profile.hand_in_beam_share, 0.0, 1.0},
                          {"beam_while_moving_share", &profile.beam_while_moving_share, 0.0, 1.0},
                          {"beam_while_advancing_share", &profile.beam_while_advancing_share, 0.0, 1.0}};
  base::Error error{"bad_operator", "", {}};
  for (const auto& [key, value] : json.items()) {
    if (key == "name" && value.is_string() && value.get<std::string>().size() <= 64) {
      profile.name = value.get<std::string>();
      continue;
    }
    const Field* found = nullptr;
    for (const Field& field : fields)
      if (key == field.name) found = &field;
    if (found == nullptr)
      error.findings.push_back({"unknown_field", "the operator's file holds a field that is not known"});
    else if (!value.is_number() || !(value.get<double>() >= found->min && value.get<double>() <= found->max))
      error.findings.push_back({"bad_field", std::string(found->name) + " is not a number in its range"});
    else
      *found->value = value.get<double>();
  }
  if (!error.findings.empty()) {
    error.text = error.findings.front().text;
    error.findings.erase(error.findings.begin());
    return error;
  }
  profile.max_redirections = static_cast<int>(std::lround(redirections));
  return profile;
}

}  // namespace seldinger::assessment
