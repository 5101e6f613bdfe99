#include "app/body_planes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/imaging/mpr/mpr.h"

namespace seldinger::app {
namespace {

constexpr int kPixelsAside = 320;
constexpr double kMarginMm = 15.0, kLeastSideMm = 90.0, kMostSideMm = 320.0;
constexpr double kBeforeSkinMm = 15.0;
constexpr double kWindowCenterHu = 40.0, kWindowWidthHu = 400.0;  // soft tissue

struct PlaneKind {
  const char *name, *left, *right, *upper, *lower;
  glm::dvec3 u, v;
};
// As radiologists look: from the feet, from the front, from the left.
const PlaneKind kKinds[] = {
    {"Axial", "R", "L", "A", "P", {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
    {"Coronal", "R", "L", "H", "F", {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}},
    {"Sagittal", "A", "P", "H", "F", {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}},
};

struct Box {
  glm::dvec3 low{1e300}, high{-1e300};
  void take(const glm::dvec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
  }
};

Box box_of(const cases::Case& scene, const assessment::Signals& signals) {
  Box box;
  if (!scene.lesions.empty()) {
    const cases::Lesion& target = scene.lesions.front();
    box.take(target.center_lps_mm - target.radius_mm);
    box.take(target.center_lps_mm + target.radius_mm);
  }
  if (scene.planned_entry_lps_mm) box.take(*scene.planned_entry_lps_mm);
  for (std::size_t i = 0; i < signals.poses.size(); ++i)
    if (signals.passages[i].depth_mm > -kBeforeSkinMm) box.take(signals.poses[i].tip_at_rest_lps_mm());
  if (box.low.x > box.high.x) box.take(signals.poses.back().tip_at_rest_lps_mm());
  return box;
}

// The skin where the plane cuts it; the caps at the volume's ends are none.
std::vector<PlaneSegment> cut(const cases::Mesh& mesh, const BodyPlane& plane) {
  const glm::dvec3 normal = glm::cross(plane.u, plane.v);
  std::vector<PlaneSegment> segments;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (mesh.cut[t] != 0) continue;
    const glm::uvec3& triangle = mesh.triangles[t];
    glm::dvec3 corner[3];
    double height_mm[3];
    for (int i = 0; i < 3; ++i) {
      corner[i] = glm::dvec3(mesh.vertices_lps_mm[triangle[i]]);
      height_mm[i] = glm::dot(corner[i] - plane.corner_lps_mm, normal);
    }
    glm::dvec2 ends[2];
    int found = 0;
    for (int i = 0; i < 3 && found < 2; ++i) {
      const int j = (i + 1) % 3;
      if ((height_mm[i] < 0.0) == (height_mm[j] < 0.0)) continue;
      const double share = height_mm[i] / (height_mm[i] - height_mm[j]);
      ends[found++] = plane.at(corner[i] + share * (corner[j] - corner[i]));
    }
    if (found < 2) continue;
    const auto outside = [&](double a, double b) { return std::max(a, b) < 0.0 || std::min(a, b) > plane.side_mm; };
    if (outside(ends[0].x, ends[1].x) || outside(ends[0].y, ends[1].y)) continue;
    segments.push_back({ends[0], ends[1]});
  }
  return segments;
}

// The edges of the pixels whose centres lie inside, each run of them one segment.
std::vector<PlaneSegment> outline(const cases::Shape& shape, const BodyPlane& plane) {
  constexpr int n = kPixelsAside / 2;
  const double pixel_mm = plane.side_mm / n;
  std::vector<char> inside(static_cast<std::size_t>(n) * n, 0);
  const auto is_inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < n && y < n && inside[static_cast<std::size_t>(y * n + x)] != 0;
  };
  bool any = false;
  for (int y = 0; y < n; ++y) {
    const glm::dvec3 from = plane.corner_lps_mm + plane.v * ((y + 0.5) * pixel_mm);
    for (const cases::Stretch& stretch : cases::stretches_inside(shape, from, from + plane.u * plane.side_mm))
      for (int x = std::max(0, static_cast<int>(std::ceil(stretch.from * n - 0.5)));
           x < n && (x + 0.5) / n <= stretch.to; ++x) {
        inside[static_cast<std::size_t>(y * n + x)] = 1;
        any = true;
      }
  }
  std::vector<PlaneSegment> segments;
  if (!any) return segments;
  // `at(along, across)`: whether the edge before `across` parts inside from outside.
  const auto runs = [&](auto parts, auto segment) {
    for (int across = 0; across <= n; ++across)
      for (int along = 0, from = -1; along <= n; ++along) {
        const bool edge = along < n && parts(along, across);
        if (edge && from < 0) from = along;
        if (!edge && from >= 0) {
          segments.push_back(segment(from * pixel_mm, along * pixel_mm, across * pixel_mm));
          from = -1;
        }
      }
  };
  runs([&](int x, int y) { return is_inside(x, y - 1) != is_inside(x, y); },
       [](double from, double to, double y) {
         return PlaneSegment{{from, y}, {to, y}};
       });
  runs([&](int y, int x) { return is_inside(x - 1, y) != is_inside(x, y); },
       [](double from, double to, double x) {
         return PlaneSegment{{x, from}, {x, to}};
       });
  return segments;
}

}  // namespace

glm::dvec2 BodyPlane::at(const glm::dvec3& point_lps_mm) const {
  const glm::dvec3 from_corner = point_lps_mm - corner_lps_mm;
  return {glm::dot(from_corner, u), glm::dot(from_corner, v)};
}

std::vector<BodyPlane> body_planes(const cases::Case& scene, const assessment::Signals& signals) {
  const Box box = box_of(scene, signals);
  const glm::dvec3 size_mm = box.high - box.low, middle = 0.5 * (box.low + box.high);
  const glm::dvec3 through =
      scene.lesions.empty() ? signals.poses.back().tip_at_rest_lps_mm() : scene.lesions.front().center_lps_mm;
  const double side_mm =
      std::clamp(std::max({size_mm.x, size_mm.y, size_mm.z}) + 2.0 * kMarginMm, kLeastSideMm, kMostSideMm);
  std::vector<BodyPlane> planes;
  for (const PlaneKind& kind : kKinds) {
    BodyPlane plane{kind.name, kind.left, kind.right, kind.upper, kind.lower, {},
                    kind.u,    kind.v,    side_mm,    {},         {},         {}};
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
    plane.skin = cut(scene.skin, plane);
    for (const cases::Structure& structure : scene.structures) {
      auto segments = outline(structure.shape, plane);
      if (!segments.empty()) plane.structures.push_back({structure.name, structure.rule, std::move(segments)});
    }
    planes.push_back(std::move(plane));
  }
  return planes;
}

}  // namespace seldinger::app
