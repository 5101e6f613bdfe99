// The planning CT, once the case is there: in three planes, small in the briefing and large where a way is planned,
// and in 3-D. With target, structures, skin, the way that the case proposes and the trainee's own.
#pragma once

#include <array>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "app/replay/body_planes.h"
#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "sim/gpu/screen_picture.h"
#include "sim/imaging/room/room_renderer.h"

namespace seldinger::app {

// The patient looked through, and the two ways in him.
class PlanningRoom {
 public:
  explicit PlanningRoom(gpu::Context& context) : context_(context) {}
  // A place on the skin that was clicked on, just now. `plan`: null: there is none.
  std::optional<glm::dvec3> draw(const std::shared_ptr<const session::Task>& task,
                                 const assessment::PlannedPath* plan, float width, float height);
  void end();

 private:
  struct Room {
    Room(gpu::Context& context, imaging::RoomModel made) : model(std::move(made)), renderer(context, model) {}
    imaging::RoomModel model;
    imaging::RoomRenderer renderer;
    imaging::DrawList list;
    std::vector<double> looked;  // from where `picture` was drawn
    unsigned int picture = 0;
  };
  bool prepare(const std::shared_ptr<const session::Task>& task);
  void look(const cases::Case& scene);  // the first camera
  std::optional<glm::dvec3> take_mouse(const cases::Case& scene, float width, float height);

  gpu::Context& context_;
  std::weak_ptr<const session::Task> of_;  // a case is large: it is not kept
  std::future<imaging::RoomModel> making_;
  std::unique_ptr<Room> room_;
  std::optional<imaging::RoomCamera> camera_;
  bool dragged_ = false;
};

class PlanningPanel {
 public:
  explicit PlanningPanel(gpu::Context& context) : context_(context), room_(context) {}

  // In the briefing: the axial plane large, the others beside it, all through the target or where one looked last.
  // `task` null: it is being prepared.
  void draw_small(const Trainer& trainer, const std::shared_ptr<const session::Task>& task);
  // The whole screen below its heading, where a way is planned.
  void draw_large(Trainer& trainer, const Keys& keys, const std::shared_ptr<const session::Task>& task);
  bool open() const noexcept { return open_; }
  void set_open(bool open) noexcept { open_ = open; }
  void end();  // another case

 private:
  enum class End { entry, tip };  // of the way: which one a click sets

  void take(const std::shared_ptr<const session::Task>& task);
  void draw_plane(std::size_t plane, const Trainer& trainer, const session::Task& task, float side_px) const;
  void take_mouse(std::size_t plane, Trainer& trainer, const Keys& keys, float side_px);
  void read_keys(Trainer& trainer, const Keys& keys);
  void set_end(Trainer& trainer, const glm::dvec3& place_lps_mm);
  void draw_words(Trainer& trainer, const session::Task& task);

  gpu::Context& context_;
  PlanningRoom room_;
  std::weak_ptr<const session::Task> of_;
  std::future<std::vector<BodyPlane>> painting_;  // the window does not wait for it
  std::optional<glm::dvec3> through_, painted_;   // where the planes are to meet, and do or will
  double side_mm_ = 0.0;                          // of those that are painted or will be, at least
  std::vector<BodyPlane> planes_;
  std::vector<std::unique_ptr<gpu::ScreenPicture>> pictures_;
  std::optional<session::PlannedWay> way_;  // the trainee's, and of which plan
  std::optional<assessment::PlannedPath> way_of_;
  End end_ = End::entry;
  bool open_ = false;
};

}  // namespace seldinger::app
