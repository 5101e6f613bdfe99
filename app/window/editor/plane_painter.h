// The case editor's planes of the CT, painted by a thread of its own, so that the window never waits for a slice.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

#include "app/replay/body_planes.h"
#include "app/window/editor/draft_case.h"
#include "session/guidance/slice_picture.h"

namespace seldinger::app {

// One plane as it is asked for.
struct PlaneWish {
  std::shared_ptr<const CheckedCase> of;
  std::shared_ptr<const CheckedCase> beside;  // whose skin is drawn too; may be nothing
  std::vector<cases::Lesion> lesions;         // as they are drawn now; those in the volume are in it already
  PlaneFrame frame;
  int width_px = 0, height_px = 0;
  session::HuWindow window = session::kHuWindows[0];
};

struct PaintedPlane {
  PlaneFrame frame;
  session::GreyPicture ct;
  std::vector<PlaneSegment> skin, skin_beside;
  std::vector<PlaneOutline> structures;
};

class PlanePainter {
 public:
  static constexpr std::size_t kPlanes = 3;

  PlanePainter();
  ~PlanePainter();
  PlanePainter(const PlanePainter&) = delete;
  PlanePainter& operator=(const PlanePainter&) = delete;

  // What was asked for before and is not painted yet is passed over.
  void wish(std::size_t plane, PlaneWish wish);
  // The newest of this plane, if there is one since the last call.
  std::optional<PaintedPlane> take(std::size_t plane);
  bool busy() const;

 private:
  void run();

  mutable std::mutex mutex_;
  std::condition_variable woken_;
  std::array<std::optional<PlaneWish>, kPlanes> wished_;
  std::array<std::optional<PaintedPlane>, kPlanes> painted_;
  bool painting_ = false, stopping_ = false;
  std::thread thread_;  // last: it uses the rest
};

// As the painter does it.
PaintedPlane paint_plane(const PlaneWish& wish);

}  // namespace seldinger::app
