#include "sim/imaging/room/scan_border.h"

#include <cmath>

#include "sim/base/check.h"
#include "sim/imaging/probe.h"

namespace seldinger::imaging {

std::vector<glm::dvec3> scan_border(const cases::Picture& picture, const cases::ConsoleSetting& console,
                                    int pieces) {
  CHECK(pieces >= 1);
  const Probe* probe = picture.modality == cases::Modality::ultrasound ? probe_named(picture.probe) : nullptr;
  std::vector<glm::dvec3> border;
  const double depth_mm =
      probe != nullptr ? taken_depth_mm(*probe, console.depth_mm, picture.depth_mm) : picture.depth_mm;
  if (probe != nullptr && probe->radius_mm > 0.0) {
    const double half = 0.5 * probe->elements * probe->pitch_mm / probe->radius_mm;
    const auto at = [&](double angle, double depth) {
      const double r = probe->radius_mm + depth;
      return glm::dvec3(r * std::sin(angle), 0.0, r * std::cos(angle) - probe->radius_mm);
    };
    for (int i = 0; i <= pieces; ++i) border.push_back(at(half * (2.0 * i / pieces - 1.0), depth_mm));
    for (int i = 0; i <= pieces; ++i) border.push_back(at(half * (1.0 - 2.0 * i / pieces), 0.0));
  } else {
    const double half = 0.5 * (probe != nullptr ? probe->elements * probe->pitch_mm : picture.width_mm);
    const double y = probe != nullptr ? 0.0 : console.slice_mm;
    border = {{-half, y, depth_mm}, {half, y, depth_mm}, {half, y, 0.0}, {-half, y, 0.0}};
  }
  border.push_back(border.front());
  return border;
}

}  // namespace seldinger::imaging
