// Part of a segment between two parallel planes.
#pragma once

#include <algorithm>

namespace seldinger::imaging {

// Parameters of the part that is left; empty when !(from <= to).
struct SegmentPart {
  double from = 0.0, to = 1.0;
};

// The segment's coordinate across the planes is start + s·delta; kept is where low ≤ coordinate ≤ high.
inline SegmentPart clip(SegmentPart part, double start, double delta, double low, double high) noexcept {
  constexpr SegmentPart kNone{1.0, 0.0};
  if (delta == 0.0) return start >= low && start <= high ? part : kNone;
  const double one = (low - start) / delta, other = (high - start) / delta;
  part.from = std::max(part.from, std::min(one, other));
  part.to = std::min(part.to, std::max(one, other));
  return part;
}

}  // namespace seldinger::imaging
