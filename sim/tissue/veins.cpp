#include "sim/tissue/veins.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/ascii.h"

namespace seldinger::tissue {
namespace {

constexpr double kLeastOpen = 0.05;  // of its width next to the near wall, with what is pushed (design)
constexpr double kStrainMm = 0.5;    // over which strain is told

}  // namespace

bool says_vein(const std::string& name) {
  const std::string lower = base::lower(name);
  return lower.find("vein") != std::string::npos || lower.find("vena") != std::string::npos;
}

std::vector<CompressibleVein> compressible_veins(const cases::Case& scene) {
  std::vector<CompressibleVein> veins;
  for (const cases::Structure& one : scene.structures) {
    const auto* tube = std::get_if<cases::Tube>(&one.shape);
    if (tube == nullptr || tube->points_lps_mm.size() < 2 || !(tube->radius_mm > 0.0) ||
        one.tissue != volume::TissueClass::vessel || !says_vein(one.name) || veins.size() == kMostVeins)
      continue;
    veins.push_back({one.name, *tube});
  }
  return veins;
}

std::optional<SqueezedVein> squeezed(const CompressibleVein& vein, const SkinPress& press,
                                     double shear_n_mm2) noexcept {
  if (!(press.depth_mm > 0.0)) return std::nullopt;
  // Where it comes next to the line along which is pressed.
  const std::vector<glm::dvec3>& points = vein.tube.points_lps_mm;
  glm::dvec3 middle(0.0), along(0.0);
  double nearest_mm2 = 1e300;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const glm::dvec3 way = points[i + 1] - points[i];
    const double length2 = glm::dot(way, way);
    if (!(length2 > 0.0)) continue;
    const glm::dvec3 from = points[i] - press.at_lps_mm;
    // Of both, what is across the press.
    const glm::dvec3 from_across = from - glm::dot(from, press.inward) * press.inward;
    const glm::dvec3 way_across = way - glm::dot(way, press.inward) * press.inward;
    const double across2 = glm::dot(way_across, way_across);
    const double share =
        across2 > 1e-6 * length2 ? std::clamp(-glm::dot(from_across, way_across) / across2, 0.0, 1.0) : 0.5;
    const glm::dvec3 off = from_across + share * way_across;
    if (glm::dot(off, off) >= nearest_mm2) continue;
    nearest_mm2 = glm::dot(off, off);
    middle = points[i] + share * way;
    along = way / std::sqrt(length2);
  }
  if (nearest_mm2 >= 1e300) return std::nullopt;
  const double outside_n_mm2 = pressure_n_mm2(press, middle, shear_n_mm2);
  double left = vein_area_share(outside_n_mm2, kVeinBloodNMm2);
  if (!(left < 1.0)) return std::nullopt;
  // What is pushed adds to what closes: no more is closed than the near wall, pushed most, leaves room for.
  const Displacement pushed = displacement_of({.presses = {&press, 1}});
  const glm::dvec3 across = press.inward - glm::dot(press.inward, along) * along;
  const double across2 = glm::dot(across, across);
  const glm::dvec3 deeper = across2 > 1e-6 ? across / std::sqrt(across2) : press.inward;  // across the vein
  const glm::dvec3 wall = middle - vein.tube.radius_mm * deeper, step = kStrainMm * deeper;
  const double strain =
      1.0 - glm::dot(displaced(pushed, wall + step) - displaced(pushed, wall), deeper) / kStrainMm;
  const double open = std::clamp(kLeastOpen + strain, 0.0, 1.0);
  left = std::max(left, open * open);
  const glm::dvec3 half = 0.5 * kClosedLengthMm * along;
  return SqueezedVein{middle - half, middle + half, vein.tube.radius_mm, left};
}

}  // namespace seldinger::tissue
