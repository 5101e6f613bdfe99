// One picture of a replay: what was on the screen, the needle in the body from two sides, and a strip over time.
#pragma once

#include <vector>

#include "app/replay/body_planes.h"
#include "app/replay/canvas.h"
#include "reports/charts/course.h"
#include "sim/case/state.h"

namespace seldinger::app {

class ReplayFrame {
 public:
  static constexpr int kWidthPx = 1280, kHeightPx = 720;

  // All must outlive it. `title` is written above the picture.
  ReplayFrame(const assessment::Signals& signals, const std::vector<BodyPlane>& planes,
              const reports::Course& course, const std::string& title);

  // `screen` may be without pixels.
  Canvas draw(const cases::State& state, const session::GreyPicture& screen, bool live) const;

 private:
  struct PlacedPlane {
    const BodyPlane* plane = nullptr;
    Rectangle area;
    glm::dvec2 px(const glm::dvec3& point_lps_mm) const;
  };
  void draw_plane(Canvas& canvas, const PlacedPlane& placed) const;
  void draw_strip(Canvas& canvas) const;
  double x_of(double t_s) const;
  double y_of_depth(double mm) const;
  double y_of_force(double n) const;

  const assessment::Signals& signals_;
  const reports::Course& course_;
  std::vector<PlacedPlane> planes_;
  double deepest_mm_ = 10.0, highest_n_ = 0.5, lowest_n_ = 0.0;
  Canvas ground_;  // all that does not change
};

}  // namespace seldinger::app
