// Stretches of time told by pictures.
#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "sim/case/record/recording.h"

namespace seldinger::reports {

struct Span {
  double from_s = 0.0, to_s = 0.0;
};

// Where `holds` says so of a frame; a frame lasts until the next one, the last as long as the one before it.
template <typename Predicate>
std::vector<Span> spans_where(std::span<const cases::FrameTruth> frames, Predicate holds) {
  std::vector<Span> spans;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!holds(frames[i])) continue;
    const double from_s = frames[i].t_s;
    const double last_s = i > 0 ? from_s - frames[i - 1].t_s : 0.0;
    const double to_s = i + 1 < frames.size() ? frames[i + 1].t_s : from_s + last_s;
    if (!std::isfinite(from_s) || !std::isfinite(to_s) || to_s < from_s) continue;
    if (!spans.empty() && spans.back().to_s == from_s) {
      spans.back().to_s = to_s;
    } else {
      spans.push_back({from_s, to_s});
    }
  }
  return spans;
}

}  // namespace seldinger::reports
