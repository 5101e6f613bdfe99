#include "app/poses_csv.h"

#include <array>

#include "app/csv.h"

namespace seldinger::app {
namespace {

constexpr std::array<const char*, 17> kColumns = {"t_s",
                                                  "needle_tip_x_mm",
                                                  "needle_tip_y_mm",
                                                  "needle_tip_z_mm",
                                                  "needle_dir_x",
                                                  "needle_dir_y",
                                                  "needle_dir_z",
                                                  "probe_origin_x_mm",
                                                  "probe_origin_y_mm",
                                                  "probe_origin_z_mm",
                                                  "probe_axial_x",
                                                  "probe_axial_y",
                                                  "probe_axial_z",
                                                  "probe_lateral_x",
                                                  "probe_lateral_y",
                                                  "probe_lateral_z",
                                                  "fire"};

}  // namespace

base::Result<cases::Recording> recording_from_csv(const std::string& text) {
  const auto rows = rows_in_csv(text, kColumns);
  if (!rows) return rows.error();
  cases::Recording recording;
  for (std::size_t i = 0; i < rows->size(); ++i) {
    const auto value = rows->row(i);
    cases::PoseSample pose;
    pose.t_s = value[0];
    pose.tip_lps_mm = {value[1], value[2], value[3]};
    pose.needle_direction = {value[4], value[5], value[6]};
    pose.probe_origin_lps_mm = {value[7], value[8], value[9]};
    pose.probe_axial = {value[10], value[11], value[12]};
    pose.probe_lateral = {value[13], value[14], value[15]};
    recording.poses.push_back(pose);
    if (value[16] != 0.0 && !recording.endpoint)
      recording.endpoint = cases::Endpoint{pose.t_s, pose.tip_lps_mm, pose.needle_direction};
  }
  return recording;
}

}  // namespace seldinger::app
