// How far the tip was from the target over time, and when the picture showed it: SVG with the same numbers as a
// table.
#pragma once

#include <span>
#include <vector>

#include "reports/charts/frame_spans.h"
#include "reports/markup/html.h"
#include "sim/case/case.h"
#include "sim/case/record/recording.h"

namespace seldinger::reports {

struct DistancePoint {
  double t_s = 0.0;
  double distance_mm = 0.0;
};

// At most `max_points` samples, the first and the last among them; samples that are not finite are left out.
std::vector<DistancePoint> distance_over_time(std::span<const cases::PoseSample> poses, const cases::Lesion& lesion,
                                              std::size_t max_points);

// When a live picture showed the tip.
std::vector<Span> tip_visible_spans(std::span<const cases::FrameTruth> frames);

// Empty when the recording holds fewer than two usable samples.
Html time_chart(const cases::Recording& recording, const cases::Lesion& lesion);

}  // namespace seldinger::reports
