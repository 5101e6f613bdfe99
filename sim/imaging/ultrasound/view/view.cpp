#include "sim/imaging/ultrasound/view/view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/base/vectors.h"

namespace seldinger::imaging {

void check_view(const UltrasoundView& view, std::span<const float> depth_below_skin_mm) {
  CHECK(view.beams >= 1 && view.beams <= 4096 && view.samples >= 1 && view.samples <= 16384);
  CHECK(view.depth_mm > 0.0 && view.depth_mm <= 400.0 && view.frequency_mhz >= 0.0 && view.focus_mm >= 0.0);
  CHECK(view.scatterers_per_cell > 0.0);
  CHECK(base::is_finite(view.origin_lps_mm) && glm::length(view.origin_lps_mm) <= 1e8);  // lattice numbers are ints
  CHECK(std::abs(glm::length(view.axial) - 1.0) < 1e-6 && std::abs(glm::length(view.lateral) - 1.0) < 1e-6);
  CHECK(std::abs(glm::dot(view.axial, view.lateral)) < 1e-6);
  CHECK(depth_below_skin_mm.empty() || depth_below_skin_mm.size() == static_cast<std::size_t>(view.probe.elements));
}

double working_mhz(const UltrasoundView& view) noexcept {
  return view.frequency_mhz > 0.0 ? view.frequency_mhz : view.probe.frequency_mhz;
}

}  // namespace seldinger::imaging
