// An attempt for 3D Slicer, all in LPS and millimetres: markups of its points and of the needle's way
// (*.mrk.json, Slicer's markups schema 1.0.3), and the needle's last place as a transform (*.tfm, ITK's text).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/export/formats/format_file.h"
#include "sim/case/form/mesh_index.h"
#include "sim/case/record/recording.h"

namespace seldinger::reports {

// Points of the way are at least so far apart, but for the last.
inline constexpr double kSlicerStepMm = 0.5;

// slicer/ATTEMPT_points.mrk.json: target, each entry through the skin, and where the tip was at the endpoint, or at
// last; slicer/ATTEMPT_path.mrk.json: the tip's way as a curve; slicer/ATTEMPT_needle.tfm: the needle there, as
// Slicer reads it from such a file: what takes the patient's LPS to the needle's own axes (tip at 0, z from hub to
// tip). As the tissue lies at rest, which is where target and CT are. None without a pose. Each says so where a
// simulated operator moved the hands: markups in the name that Slicer shows and in "synthetic", the transform in a
// comment.
std::vector<FormatFile> slicer_files(const std::string& attempt, bool synthetic, const cases::Recording& recording,
                                     const glm::dvec3& target_lps_mm, const cases::MeshIndex& skin);

}  // namespace seldinger::reports
