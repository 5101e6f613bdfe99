#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/vectors.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {
namespace {

constexpr double kUnitSlack = 1e-6;
constexpr double kLeastSine = 1e-6;  // of the angle between rays and detector
constexpr double kMaxPixels = 268435456.0;
constexpr double kFarMm = 1e9;  // beyond it doubles lose the micrometre

bool usable(const glm::dvec3& p) {
  return base::is_finite(p) && glm::length(p) <= kFarMm;
}

}  // namespace

base::Result<void> check_geometry(const XrayGeometry& g) {
  const auto bad = [](const char* text) { return base::Error{"bad_geometry", text}; };
  if (g.width_px <= 0 || g.height_px <= 0) return bad("the picture has no pixels");
  if (static_cast<double>(g.width_px) * g.height_px > kMaxPixels) return bad("the picture has too many pixels");
  if (!(g.pixel_mm > 0.0) || !std::isfinite(g.pixel_mm)) return bad("the pixel has no size");
  if (!usable(g.detector_center_lps_mm)) return bad("the detector's centre is not a place");
  if (!(std::abs(glm::length(g.u) - 1.0) <= kUnitSlack && std::abs(glm::length(g.v) - 1.0) <= kUnitSlack &&
        std::abs(glm::dot(g.u, g.v)) <= kUnitSlack))
    return bad("u and v are not perpendicular and of unit length");
  const glm::dvec3 normal = glm::cross(g.u, g.v);
  if (!g.source_lps_mm) {
    if (!(std::abs(glm::length(g.direction) - 1.0) <= kUnitSlack))
      return bad("the direction is not of unit length");
    if (!(std::abs(glm::dot(g.direction, normal)) > kLeastSine)) return bad("rays run along the detector");
    return {};
  }
  if (!usable(*g.source_lps_mm)) return bad("the source is not a place");
  const glm::dvec3 from_center_mm = *g.source_lps_mm - g.detector_center_lps_mm;
  if (!(std::abs(glm::dot(from_center_mm, normal)) > kLeastSine * glm::length(from_center_mm)))
    return bad("the source lies in the detector's plane");
  return {};
}

std::optional<glm::dvec2> pixel_of(const XrayGeometry& g, const glm::dvec3& p_lps_mm) noexcept {
  const glm::dvec3 normal = glm::cross(g.u, g.v);
  const glm::dvec3 ray = g.source_lps_mm ? p_lps_mm - *g.source_lps_mm : g.direction;
  const glm::dvec3 from = g.source_lps_mm ? *g.source_lps_mm : p_lps_mm;
  const double depth = glm::dot(ray, normal), distance = glm::dot(g.detector_center_lps_mm - from, normal);
  if (g.source_lps_mm && !(depth * distance > kLeastSine * distance * distance)) return std::nullopt;
  const glm::dvec3 hit = from + ray * (distance / depth) - g.detector_center_lps_mm;
  const glm::dvec2 pixel(glm::dot(hit, g.u) / g.pixel_mm + 0.5 * (g.width_px - 1),
                         glm::dot(hit, g.v) / g.pixel_mm + 0.5 * (g.height_px - 1));
  if (!std::isfinite(pixel.x) || !std::isfinite(pixel.y)) return std::nullopt;
  return pixel;
}

RaySegment ray_of(const XrayGeometry& g, const volume::Volume& volume, int column, int row) {
  const glm::dvec3 pixel = g.detector_center_lps_mm + g.u * (g.pixel_mm * (column - 0.5 * (g.width_px - 1))) +
                           g.v * (g.pixel_mm * (row - 0.5 * (g.height_px - 1)));
  if (g.source_lps_mm) return {*g.source_lps_mm, pixel};
  // One length for all pixels, so that starts are affine in column and row: beyond the sphere around the volume.
  const glm::dvec3 half_voxels = 0.5 * glm::dvec3(volume.size_voxels);
  const glm::dvec3 middle(volume.lps_from_voxel * glm::dvec4(half_voxels - 0.5, 1.0));
  const double radius_mm = glm::length(half_voxels * volume.spacing_mm);
  const double half_diagonal_mm = 0.5 * g.pixel_mm * std::hypot(g.width_px, g.height_px);
  const double length_mm = glm::length(g.detector_center_lps_mm - middle) + half_diagonal_mm + radius_mm + 1.0;
  return {pixel - g.direction * length_mm, pixel};
}

}  // namespace seldinger::imaging
