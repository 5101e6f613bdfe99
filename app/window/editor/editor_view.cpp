#include "app/window/editor/editor_view.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

namespace seldinger::app {
namespace {

constexpr double kLeastMmPerPixel = 0.05, kMostMmPerPixel = 4.0;

// The box around the outermost voxels' middles.
cases::Bounds bounds_of(const volume::Volume& volume) {
  cases::Bounds bounds{glm::dvec3(1e300), glm::dvec3(-1e300)};
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 share(corner & 1, (corner >> 1) & 1, corner >> 2);
    const glm::dvec3 p(volume.lps_from_voxel * glm::dvec4(share * glm::dvec3(volume.size_voxels - 1), 1.0));
    bounds.low_lps_mm = glm::min(bounds.low_lps_mm, p);
    bounds.high_lps_mm = glm::max(bounds.high_lps_mm, p);
  }
  return bounds;
}

glm::dvec3 towards_viewer(const PlaneKind& kind) {
  return -glm::cross(kind.u, kind.v);
}

}  // namespace

void EditorView::fit(const volume::Volume& volume, glm::dvec2 plane_px) {
  const cases::Bounds bounds = bounds_of(volume);
  const glm::dvec3 middle = 0.5 * (bounds.low_lps_mm + bounds.high_lps_mm);
  const glm::dvec3 size = bounds.high_lps_mm - bounds.low_lps_mm;
  if (!placed_) cursor_lps_mm_ = middle;
  placed_ = true;
  middle_lps_mm_.fill(middle);
  mm_per_pixel_ = kLeastMmPerPixel;
  for (const PlaneKind& kind : plane_kinds())
    mm_per_pixel_ = std::max({mm_per_pixel_, std::abs(glm::dot(size, kind.u)) / std::max(1.0, plane_px.x),
                              std::abs(glm::dot(size, kind.v)) / std::max(1.0, plane_px.y)});
  mm_per_pixel_ = std::min(mm_per_pixel_, kMostMmPerPixel);
}

void EditorView::set_cursor(const volume::Volume& volume, const glm::dvec3& place_lps_mm) {
  const glm::dvec3 index(volume::voxel_from_lps(volume) * glm::dvec4(place_lps_mm, 1.0));
  const glm::dvec3 within = glm::clamp(index, glm::dvec3(0.0), glm::dvec3(volume.size_voxels - 1));
  cursor_lps_mm_ = within == index ? place_lps_mm : glm::dvec3(volume.lps_from_voxel * glm::dvec4(within, 1.0));
  placed_ = true;
}

void EditorView::go_to(const volume::Volume& volume, const glm::dvec3& place_lps_mm) {
  set_cursor(volume, place_lps_mm);
  middle_lps_mm_.fill(cursor_lps_mm_);
}

PlaneFrame EditorView::frame(std::size_t plane, glm::dvec2 plane_px) const {
  const PlaneKind& kind = plane_kinds().at(plane);
  const glm::dvec3 normal = towards_viewer(kind);
  const glm::dvec3 middle =
      middle_lps_mm_.at(plane) + normal * glm::dot(cursor_lps_mm_ - middle_lps_mm_.at(plane), normal);
  PlaneFrame frame;
  frame.u = kind.u;
  frame.v = kind.v;
  frame.size_mm = plane_px * mm_per_pixel_;
  frame.corner_lps_mm = middle - 0.5 * frame.size_mm.x * kind.u - 0.5 * frame.size_mm.y * kind.v;
  return frame;
}

glm::dvec3 EditorView::place(std::size_t plane, glm::dvec2 plane_px, glm::dvec2 at_px) const {
  const PlaneFrame seen = frame(plane, plane_px);
  return seen.corner_lps_mm + at_px.x * mm_per_pixel_ * seen.u + at_px.y * mm_per_pixel_ * seen.v;
}

glm::dvec2 EditorView::pixel(std::size_t plane, glm::dvec2 plane_px, const glm::dvec3& place_lps_mm) const {
  return frame(plane, plane_px).at(place_lps_mm) / mm_per_pixel_;
}

void EditorView::scroll(const volume::Volume& volume, std::size_t plane, int slices) {
  const glm::dvec3 normal = towards_viewer(plane_kinds().at(plane));
  double step_mm = 0.0;  // of the grid's axis that runs most across the plane
  double most = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const double across = std::abs(glm::dot(glm::dvec3(volume.lps_from_voxel[axis]), normal));
    if (across / volume.spacing_mm[axis] <= most) continue;
    most = across / volume.spacing_mm[axis];
    step_mm = across;
  }
  set_cursor(volume, cursor_lps_mm_ + normal * (step_mm * slices));
}

void EditorView::pan(std::size_t plane, glm::dvec2 by_px) {
  const PlaneKind& kind = plane_kinds().at(plane);
  middle_lps_mm_.at(plane) -= (by_px.x * kind.u + by_px.y * kind.v) * mm_per_pixel_;
}

void EditorView::zoom(std::size_t plane, glm::dvec2 plane_px, glm::dvec2 at_px, double factor) {
  const glm::dvec3 held = place(plane, plane_px, at_px);
  const double before = mm_per_pixel_;
  mm_per_pixel_ = std::clamp(mm_per_pixel_ * factor, kLeastMmPerPixel, kMostMmPerPixel);
  for (std::size_t i = 0; i < middle_lps_mm_.size(); ++i) {
    // The other planes keep the cursor where it is.
    const glm::dvec3 still = i == plane ? held : cursor_lps_mm_;
    middle_lps_mm_[i] = still + (middle_lps_mm_[i] - still) * (mm_per_pixel_ / before);
  }
}

}  // namespace seldinger::app
