#include "app/replay/plane_lines.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::app {

const std::array<PlaneKind, 3>& plane_kinds() noexcept {
  static const std::array<PlaneKind, 3> kKinds = {{
      {"Axial", "R", "L", "A", "P", {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}},
      {"Coronal", "R", "L", "H", "F", {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0}},
      {"Sagittal", "A", "P", "H", "F", {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0}},
  }};
  return kKinds;
}

glm::dvec2 PlaneFrame::at(const glm::dvec3& point_lps_mm) const noexcept {
  const glm::dvec3 from_corner = point_lps_mm - corner_lps_mm;
  return {glm::dot(from_corner, u), glm::dot(from_corner, v)};
}

std::vector<PlaneSegment> skin_lines(const cases::Mesh& skin, const PlaneFrame& frame) {
  const glm::dvec3 normal = glm::cross(frame.u, frame.v);
  std::vector<PlaneSegment> segments;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
    if (skin.cut[t] != 0) continue;
    const glm::uvec3& triangle = skin.triangles[t];
    glm::dvec3 corner[3];
    double height_mm[3];
    for (int i = 0; i < 3; ++i) {
      corner[i] = glm::dvec3(skin.vertices_lps_mm[triangle[i]]);
      height_mm[i] = glm::dot(corner[i] - frame.corner_lps_mm, normal);
    }
    glm::dvec2 ends[2];
    int found = 0;
    for (int i = 0; i < 3 && found < 2; ++i) {
      const int j = (i + 1) % 3;
      if ((height_mm[i] < 0.0) == (height_mm[j] < 0.0)) continue;
      const double share = height_mm[i] / (height_mm[i] - height_mm[j]);
      ends[found++] = frame.at(corner[i] + share * (corner[j] - corner[i]));
    }
    if (found < 2) continue;
    const auto outside = [](double a, double b, double size) {
      return std::max(a, b) < 0.0 || std::min(a, b) > size;
    };
    if (outside(ends[0].x, ends[1].x, frame.size_mm.x) || outside(ends[0].y, ends[1].y, frame.size_mm.y)) continue;
    segments.push_back({ends[0], ends[1]});
  }
  return segments;
}

std::vector<PlaneSegment> outline(const cases::Shape& shape, const PlaneFrame& frame, double pixel_mm) {
  const int wide = std::max(1, static_cast<int>(std::lround(frame.size_mm.x / pixel_mm)));
  const int high = std::max(1, static_cast<int>(std::lround(frame.size_mm.y / pixel_mm)));
  std::vector<char> inside(static_cast<std::size_t>(wide) * static_cast<std::size_t>(high), 0);
  const auto at = [&](int x, int y) {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(wide) + static_cast<std::size_t>(x);
  };
  const auto is_inside = [&](int x, int y) {
    return x >= 0 && y >= 0 && x < wide && y < high && inside[at(x, y)] != 0;
  };
  bool any = false;
  for (int y = 0; y < high; ++y) {
    const glm::dvec3 from = frame.corner_lps_mm + frame.v * ((y + 0.5) * pixel_mm);
    for (const cases::Stretch& stretch : cases::stretches_inside(shape, from, from + frame.u * (pixel_mm * wide)))
      for (int x = std::max(0, static_cast<int>(std::ceil(stretch.from * wide - 0.5)));
           x < wide && (x + 0.5) / wide <= stretch.to; ++x) {
        inside[at(x, y)] = 1;
        any = true;
      }
  }
  std::vector<PlaneSegment> segments;
  if (!any) return segments;
  // `parts(along, across)`: whether the edge before `across` parts inside from outside.
  const auto runs = [&](int most_along, int most_across, auto parts, auto segment) {
    for (int across = 0; across <= most_across; ++across)
      for (int along = 0, from = -1; along <= most_along; ++along) {
        const bool edge = along < most_along && parts(along, across);
        if (edge && from < 0) from = along;
        if (!edge && from >= 0) {
          segments.push_back(segment(from * pixel_mm, along * pixel_mm, across * pixel_mm));
          from = -1;
        }
      }
  };
  runs(
      wide, high, [&](int x, int y) { return is_inside(x, y - 1) != is_inside(x, y); },
      [](double from, double to, double y) {
        return PlaneSegment{{from, y}, {to, y}};
      });
  runs(
      high, wide, [&](int y, int x) { return is_inside(x - 1, y) != is_inside(x, y); },
      [](double from, double to, double x) {
        return PlaneSegment{{x, from}, {x, to}};
      });
  return segments;
}

}  // namespace seldinger::app
