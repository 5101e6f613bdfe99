#include "app/attempts/poses_csv.h"

#include <vector>

#include "app/cli/csv.h"
#include "reports/export/raw_tables.h"

namespace seldinger::app {
namespace {

// As the raw export writes them, between the attempt's name and what a patient who moves has.
std::vector<const char*> columns() {
  std::vector<const char*> names;
  for (std::size_t i = 1; i <= reports::kPoseFileColumns; ++i)
    names.push_back(reports::pose_columns()[i].name.c_str());
  return names;
}

}  // namespace

base::Result<cases::Recording> recording_from_csv(const std::string& text) {
  const auto rows = rows_in_csv(text, columns());
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
