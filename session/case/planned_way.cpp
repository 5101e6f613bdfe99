#include "session/case/planned_way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "assessment/operators/plan.h"

namespace seldinger::session {
namespace {

constexpr double kStepMm = 0.5;
constexpr double kLeastMm = 0.5;  // of a stretch: what is shorter is a voxel's corner
constexpr double kDegrees = 180.0 / std::numbers::pi;

double angle_deg(double cosine) {
  return std::acos(std::clamp(cosine, -1.0, 1.0)) * kDegrees;
}

// Runs of the way where the CT says so.
template <typename Is>
void add_runs(const char* what, const PlannedWay& way, const cases::Case& scene, double from_mm, const Is& is,
              std::vector<WayPart>& parts) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(scene.volume);
  const glm::dvec3 direction = (way.target_lps_mm - way.entry_lps_mm) / way.length_mm;
  double begun_mm = -1.0;
  const auto end = [&](double at_mm) {
    if (begun_mm >= 0.0 && at_mm - begun_mm >= kLeastMm)
      parts.push_back({what, begun_mm, at_mm - begun_mm, way.entry_lps_mm + direction * begun_mm, true});
    begun_mm = -1.0;
  };
  for (double s_mm = from_mm; s_mm <= way.length_mm; s_mm += kStepMm) {
    const glm::dvec3 p = way.entry_lps_mm + direction * s_mm;
    const glm::dvec3 voxel(voxel_from_lps * glm::dvec4(p, 1.0));
    const auto hu = volume::sample_trilinear(scene.volume, voxel);
    if (hu && is(*hu, voxel, p)) {
      if (begun_mm < 0.0) begun_mm = s_mm;
    } else {
      end(s_mm);
    }
  }
  end(way.length_mm);
}

void add_structures(const cases::Case& scene, const assessment::PathLimits& limits, PlannedWay& way) {
  for (const cases::Structure& structure : scene.structures) {
    double inside_mm = 0.0;
    for (const cases::Stretch& part :
         cases::stretches_inside(structure.shape, way.entry_lps_mm, way.target_lps_mm)) {
      const double length_mm = (part.to - part.from) * way.length_mm;
      inside_mm += length_mm;
      if (length_mm < kLeastMm) continue;
      way.parts.push_back(
          {structure.name, part.from * way.length_mm, length_mm,
           way.entry_lps_mm + part.from * (way.target_lps_mm - way.entry_lps_mm),
           structure.rule == cases::StructureRule::critical || structure.rule == cases::StructureRule::major});
    }
    if (structure.rule == cases::StructureRule::must_cross && inside_mm < limits.must_cross_mm)
      way.not_crossed.push_back(structure.name);
  }
}

}  // namespace

bool PlannedWay::free() const noexcept {
  return !too_long && not_crossed.empty() &&
         std::none_of(parts.begin(), parts.end(), [](const WayPart& part) { return part.forbidden; });
}

std::optional<PlannedWay> planned_way(const cases::Case& scene) {
  if (!scene.planned_entry_lps_mm || scene.lesions.empty()) return std::nullopt;
  return way_between(scene, *scene.planned_entry_lps_mm, scene.lesions.front().center_lps_mm);
}

std::optional<PlannedWay> way_between(const cases::Case& scene, const glm::dvec3& entry_lps_mm,
                                      const glm::dvec3& target_lps_mm) {
  PlannedWay way;
  way.entry_lps_mm = entry_lps_mm;
  way.target_lps_mm = target_lps_mm;
  way.length_mm = glm::distance(way.entry_lps_mm, way.target_lps_mm);
  if (!(way.length_mm > kStepMm)) return std::nullopt;
  const glm::dvec3 direction = (way.target_lps_mm - way.entry_lps_mm) / way.length_mm;
  if (!scene.skin_index.empty()) {
    const cases::Closest near = scene.skin_index.closest_skin(way.entry_lps_mm);
    way.skin_angle_deg = angle_deg(-glm::dot(direction, scene.skin_index.normal(near.triangle)));
  }
  way.head_deg = 90.0 - angle_deg(direction.z);
  const assessment::PathLimits limits = assessment::path_limits(scene);
  way.too_long = way.length_mm > scene.instrument.length_mm;
  // A target, or the lumen it is in, may be full of contrast agent.
  const auto open = [&](const glm::dvec3& p) {
    return std::any_of(limits.open.begin(), limits.open.end(),
                       [&](const cases::Shape& shape) { return cases::signed_distance_mm(shape, p, 1.0) < 0.0; });
  };
  add_runs(
      "bone", way, scene, 0.0,
      [&](double hu, const glm::dvec3& voxel, const glm::dvec3& p) {
        return assessment::is_bone(limits, scene.volume, voxel, hu) && !open(p);
      },
      way.parts);
  add_runs(
      "gas", way, scene, limits.skin_free_mm,
      [&](double hu, const glm::dvec3&, const glm::dvec3& p) { return hu < limits.gas_hu && !open(p); }, way.parts);
  add_structures(scene, limits, way);
  std::stable_sort(way.parts.begin(), way.parts.end(),
                   [](const WayPart& a, const WayPart& b) { return a.from_mm < b.from_mm; });
  return way;
}

}  // namespace seldinger::session
