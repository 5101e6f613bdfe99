#include <algorithm>
#include <cmath>

#include "sim/base/check.h"
#include "sim/imaging/mpr/mpr.h"

namespace seldinger::imaging {

MprView view_under_probe(const glm::dvec3& origin_lps_mm, const glm::dvec3& axial, const glm::dvec3& lateral,
                         double width_mm, double depth_mm, double pixel_mm) {
  CHECK(width_mm > 0.0 && depth_mm > 0.0 && pixel_mm > 0.0);
  MprView view;
  view.u = lateral;
  view.v = axial;
  view.pixel_mm = pixel_mm;
  view.width_px = std::max(1, static_cast<int>(std::lround(width_mm / pixel_mm)));
  view.height_px = std::max(1, static_cast<int>(std::lround(depth_mm / pixel_mm)));
  // The upper edge is the outer edge of the first row's pixels, so the first row lies half a pixel deep.
  view.center_lps_mm = origin_lps_mm + axial * (0.5 * pixel_mm * view.height_px);
  return view;
}

// DICOM PS3.3 C.11.2.1.3.2, LINEAR_EXACT: the window's ends map to black and white.
std::vector<unsigned char> grey_from_hu(const HuImage& hu, double window_center_hu, double window_width_hu) {
  CHECK(window_width_hu > 0.0);
  std::vector<unsigned char> grey(hu.size());
  const double black_hu = window_center_hu - 0.5 * window_width_hu;
  for (std::size_t i = 0; i < hu.size(); ++i) {
    const double value = (static_cast<double>(hu[i]) - black_hu) * 255.0 / window_width_hu;
    // Written so that NaN falls through to white.
    grey[i] = value < 255.0 ? static_cast<unsigned char>(std::max(value, 0.0) + 0.5) : 255;
  }
  return grey;
}

}  // namespace seldinger::imaging
