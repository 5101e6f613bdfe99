#include "app/measure/ultrasound_goals/plane_scatterers.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shaders/shared/ultrasound.glsl.h"

namespace seldinger::measure {

std::vector<PlaneScatterer> scatterers_in(const imaging::UltrasoundView& view, const imaging::ScattererField& field,
                                          const PlaneWindow& window) {
  const imaging::Fan fan = imaging::fan_of(view);
  glm::dvec3 low(1e9), high(-1e9);
  for (double beam = window.first_beam; beam <= window.last_beam + 0.5; beam += 1.0)
    for (const double depth_mm : {window.from_mm, window.to_mm})
      for (const double y_mm : {-window.reach_y_mm, window.reach_y_mm}) {
        const glm::dvec3 p = fan.start_lps_mm(beam) + depth_mm * fan.direction(beam) + y_mm * fan.elevation;
        low = glm::min(low, p), high = glm::max(high, p);
      }
  // An arc bulges between two beams.
  low -= 1.0, high += 1.0;
  std::vector<PlaneScatterer> all;
  std::vector<std::uint32_t> keys;
  for (double depth_mm = window.from_mm; depth_mm < window.to_mm; depth_mm += 0.05) {
    const imaging::ScattererField::Lattice lattice = field.lattice_at(depth_mm);
    if (std::find(keys.begin(), keys.end(), lattice.key) != keys.end()) continue;
    keys.push_back(lattice.key);
    const double s = lattice.spacing_mm;
    const glm::ivec3 first(glm::floor(low / s)), last(glm::floor(high / s));
    for (int i = first.x; i <= last.x; ++i)
      for (int j = first.y; j <= last.y; ++j)
        for (int k = first.z; k <= last.z; ++k) {
          const std::uint32_t bits = shaders::us_lattice_bits(shaders::us_lattice_seed(lattice.key, i, j, k));
          const glm::dvec3 in_cube((static_cast<double>(bits >> 21) + 0.5) / 2048.0,
                                   (static_cast<double>((bits >> 11) & 1023U) + 0.5) / 1024.0,
                                   (static_cast<double>(bits & 2047U) + 0.5) / 2048.0);
          const glm::dvec3 p = s * (glm::dvec3(i, j, k) + in_cube) - view.origin_lps_mm;
          const double y_mm = glm::dot(p, fan.elevation);
          if (std::abs(y_mm) > window.reach_y_mm) continue;
          const double x_mm = glm::dot(p, view.lateral), z_mm = glm::dot(p, view.axial);
          const imaging::BeamAndDepth at = imaging::beam_and_depth(view, x_mm, z_mm);
          if (at.depth_mm < window.from_mm || at.depth_mm >= window.to_mm || at.beam < window.first_beam ||
              at.beam > window.last_beam || field.lattice_at(at.depth_mm).key != lattice.key)
            continue;
          const double sign = shaders::us_lattice_turned(bits) == 0 ? 1.0 : -1.0;
          all.push_back({x_mm, z_mm, y_mm, at.beam, at.depth_mm, sign * std::sqrt(s * s * s)});
        }
  }
  return all;
}

}  // namespace seldinger::measure
