#include "app/window/editor/plane_painter.h"

#include <algorithm>

#include "sim/imaging/mpr/mpr.h"

namespace seldinger::app {
namespace {

constexpr int kOutlinePixels = 2;  // of the picture, an edge of an outline

}  // namespace

PaintedPlane paint_plane(const PlaneWish& wish) {
  const cases::Case& scene = wish.of->scene;
  PaintedPlane painted;
  painted.frame = wish.frame;
  imaging::MprView view;
  view.center_lps_mm = wish.frame.corner_lps_mm + 0.5 * wish.frame.size_mm.x * wish.frame.u +
                       0.5 * wish.frame.size_mm.y * wish.frame.v;
  view.u = wish.frame.u;
  view.v = wish.frame.v;
  view.pixel_mm = wish.frame.size_mm.x / wish.width_px;
  view.width_px = wish.width_px;
  view.height_px = wish.height_px;
  imaging::Inserted inserted;
  for (const cases::Lesion& lesion : wish.lesions)
    if (!lesion.in_volume() && inserted.lesions.size() < imaging::kMaxLesions) inserted.lesions.push_back(lesion);
  painted.ct = {imaging::grey_from_hu(imaging::mpr_cpu(scene.volume, view, inserted), wish.window.center_hu,
                                      wish.window.width_hu),
                wish.width_px, wish.height_px};
  painted.skin = skin_lines(scene.skin, wish.frame);
  if (wish.beside) painted.skin_beside = skin_lines(wish.beside->scene.skin, wish.frame);
  for (const cases::Structure& structure : scene.structures) {
    auto segments = outline(structure.shape, wish.frame, kOutlinePixels * view.pixel_mm);
    if (!segments.empty()) painted.structures.push_back({structure.name, structure.rule, std::move(segments)});
  }
  return painted;
}

PlanePainter::PlanePainter() {
  thread_ = std::thread([this] { run(); });
}

PlanePainter::~PlanePainter() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  woken_.notify_all();
  thread_.join();
}

void PlanePainter::wish(std::size_t plane, PlaneWish wish) {
  {
    const std::lock_guard lock(mutex_);
    wished_.at(plane) = std::move(wish);
  }
  woken_.notify_all();
}

std::optional<PaintedPlane> PlanePainter::take(std::size_t plane) {
  const std::lock_guard lock(mutex_);
  auto newest = std::move(painted_.at(plane));
  painted_.at(plane).reset();
  return newest;
}

bool PlanePainter::busy() const {
  const std::lock_guard lock(mutex_);
  return painting_ ||
         std::any_of(wished_.begin(), wished_.end(), [](const auto& wish) { return wish.has_value(); });
}

// In turn, so that none of them starves.
void PlanePainter::run() {
  for (std::size_t next = 0;; next = (next + 1) % kPlanes) {
    std::optional<PlaneWish> wish;
    {
      std::unique_lock lock(mutex_);
      painting_ = false;
      woken_.wait(lock, [this] {
        return stopping_ ||
               std::any_of(wished_.begin(), wished_.end(), [](const auto& one) { return one.has_value(); });
      });
      if (stopping_) return;
      if (!wished_[next]) continue;
      wish = std::move(wished_[next]);
      wished_[next].reset();
      painting_ = true;
    }
    PaintedPlane painted = paint_plane(*wish);
    const std::lock_guard lock(mutex_);
    painted_[next] = std::move(painted);
  }
}

}  // namespace seldinger::app
