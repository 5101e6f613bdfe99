// What an MPR picture shows (docs/decisions/0005): tip and target centre within 2 mm of the plane and inside the
// rectangle. Geometry only, no rendering.
#pragma once

#include <optional>

#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/visible.h"

namespace seldinger::imaging {

constexpr double kMprSlabHalfMm = 2.0;  // docs/decisions/0005

// `target` is the centre of the target lesion. The rectangle's borders are the outer edges of the border pixels.
// `needle_length_mm` is the length of the shaft inside slab and rectangle.
Visible mpr_visible(const MprView& view, const std::optional<NeedlePose>& needle,
                    const std::optional<glm::dvec3>& target_lps_mm) noexcept;

}  // namespace seldinger::imaging
