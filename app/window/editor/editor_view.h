// How the case editor's three planes look at a case: through one cursor, at one scale, each moved as it was
// dragged.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "app/replay/plane_lines.h"
#include "app/window/editor/plane_painter.h"

namespace seldinger::app {

class EditorView {
 public:
  // All of the case in every plane of so many pixels; the cursor where it is, or in the middle.
  void fit(const volume::Volume& volume, glm::dvec2 plane_px);

  const glm::dvec3& cursor_lps_mm() const noexcept { return cursor_lps_mm_; }
  // Within the volume; the planes stay where they were dragged to.
  void set_cursor(const volume::Volume& volume, const glm::dvec3& place_lps_mm);
  // The same, and into the middle of each plane.
  void go_to(const volume::Volume& volume, const glm::dvec3& place_lps_mm);

  PlaneFrame frame(std::size_t plane, glm::dvec2 plane_px) const;
  // Of pixels from the plane's upper left corner, and back.
  glm::dvec3 place(std::size_t plane, glm::dvec2 plane_px, glm::dvec2 at_px) const;
  glm::dvec2 pixel(std::size_t plane, glm::dvec2 plane_px, const glm::dvec3& place_lps_mm) const;

  // The cursor through the plane by so many slices of the CT, towards the viewer when positive.
  void scroll(const volume::Volume& volume, std::size_t plane, int slices);
  void pan(std::size_t plane, glm::dvec2 by_px);
  // All planes; what lies at `at_px` of this one stays there. factor < 1: nearer.
  void zoom(std::size_t plane, glm::dvec2 plane_px, glm::dvec2 at_px, double factor);

  double mm_per_pixel() const noexcept { return mm_per_pixel_; }
  session::HuWindow window = session::kHuWindows[0];

 private:
  glm::dvec3 cursor_lps_mm_{0.0};
  std::array<glm::dvec3, 3> middle_lps_mm_{};  // of each plane; what is across it is the cursor's
  double mm_per_pixel_ = 1.0;
  bool placed_ = false;
};

}  // namespace seldinger::app
