#include "app/replay/body_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/check.h"
#include "sim/imaging/mpr/mpr.h"

namespace seldinger::app {
namespace {

constexpr int kPixelsAside = 320;
constexpr double kMarginMm = 15.0, kLeastSideMm = 90.0, kMostSideMm = 320.0;
constexpr double kBeforeSkinMm = 15.0;
constexpr double kWindowCenterHu = 40.0, kWindowWidthHu = 400.0;  // soft tissue

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  void take(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
};

Box box_of(const cases::Case& scene, std::span<const glm::dvec3> points_lps_mm) {
  Box box;
  if (!scene.lesions.empty()) {
    const cases::Lesion& target = scene.lesions.front();
    box.take(target.center_lps_mm - target.radius_mm);
    box.take(target.center_lps_mm + target.radius_mm);
  }
  if (scene.planned_entry_lps_mm) box.take(*scene.planned_entry_lps_mm);
  for (const glm::dvec3& point : points_lps_mm) box.take(point);
  return box;
}

}  // namespace

std::vector<BodyPlane> body_planes(const cases::Case& scene, const assessment::Signals& signals) {
  std::vector<glm::dvec3> way;
  for (std::size_t i = 0; i < signals.poses.size(); ++i)
    if (signals.passages[i].depth_mm > -kBeforeSkinMm) way.push_back(signals.poses[i].tip_at_rest_lps_mm());
  if (way.empty() && scene.lesions.empty()) way.push_back(signals.poses.back().tip_at_rest_lps_mm());
  return body_planes(scene, way);
}

std::vector<BodyPlane> body_planes(const cases::Case& scene, std::span<const glm::dvec3> points_lps_mm) {
  CHECK(!scene.lesions.empty() || !points_lps_mm.empty());
  const glm::dvec3 through = scene.lesions.empty() ? points_lps_mm.back() : scene.lesions.front().center_lps_mm;
  return body_planes_through(scene, points_lps_mm, through, kLeastSideMm);
}

std::vector<BodyPlane> body_planes_through(const cases::Case& scene, std::span<const glm::dvec3> points_lps_mm,
                                           const glm::dvec3& place_lps_mm, double least_side_mm) {
  CHECK(!scene.lesions.empty() || !points_lps_mm.empty());
  CHECK(least_side_mm <= kMostSideMm);
  const Box box = box_of(scene, points_lps_mm);
  const glm::dvec3 size_mm = box.high - box.low, middle = 0.5 * (box.low + box.high);
  const glm::dvec3& through = place_lps_mm;
  const double side_mm =
      std::clamp(std::max({size_mm.x, size_mm.y, size_mm.z}) + 2.0 * kMarginMm, least_side_mm, kMostSideMm);
  std::vector<BodyPlane> planes;
  for (const PlaneKind& kind : plane_kinds()) {
    BodyPlane plane;
    plane.u = kind.u;
    plane.v = kind.v;
    plane.size_mm = glm::dvec2(side_mm);
    plane.name = kind.name;
    plane.left = kind.left;
    plane.right = kind.right;
    plane.upper = kind.upper;
    plane.lower = kind.lower;
    plane.side_mm = side_mm;
    const glm::dvec3 normal = glm::cross(kind.u, kind.v);
    const glm::dvec3 center = middle + normal * glm::dot(through - middle, normal);
    plane.corner_lps_mm = center - 0.5 * side_mm * (kind.u + kind.v);
    imaging::MprView view;
    view.center_lps_mm = center;
    view.u = kind.u;
    view.v = kind.v;
    view.pixel_mm = side_mm / kPixelsAside;
    view.width_px = view.height_px = kPixelsAside;
    plane.ct = {imaging::grey_from_hu(imaging::mpr_cpu(scene.volume, view, {std::nullopt, scene.lesions}),
                                      kWindowCenterHu, kWindowWidthHu),
                kPixelsAside, kPixelsAside};
    plane.skin = skin_lines(scene.skin, plane);
    for (const cases::Structure& structure : scene.structures) {
      auto segments = outline(structure.shape, plane, 2.0 * view.pixel_mm);
      if (!segments.empty()) plane.structures.push_back({structure.name, structure.rule, std::move(segments)});
    }
    planes.push_back(std::move(plane));
  }
  return planes;
}

}  // namespace seldinger::app
