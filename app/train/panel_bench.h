// The mentor's bench: three planes of the CT and the room, what the tool in hand can set, what the case's checks
// found, and the way from draft to published.
#pragma once

#include <array>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/train/case_bench.h"
#include "app/train/plane_painter.h"
#include "app/train/trace.h"
#include "app/train/trainer.h"
#include "app/train/window.h"
#include "sim/gpu/screen_picture.h"
#include "sim/imaging/room/room_renderer.h"

struct ImVec2;

namespace seldinger::casedb {
struct SettingRow;
}

namespace seldinger::app {

// The planes, with what is drawn over them and the mouse in them.
class BenchPlanes {
 public:
  explicit BenchPlanes(gpu::Context& context);

  void begin();  // another case
  void draw(std::size_t plane, CaseBench& bench, const Keys& keys, float width, float height);
  std::optional<std::size_t> under_mouse() const noexcept { return under_mouse_; }
  glm::dvec2 size_px() const noexcept { return size_px_; }

 private:
  void ask(std::size_t plane, const CaseBench& bench);
  void draw_picture(std::size_t plane, const CaseBench& bench, const ImVec2& corner);
  void draw_case(std::size_t plane, const CaseBench& bench, const ImVec2& corner);
  void draw_words(std::size_t plane, const CaseBench& bench, const ImVec2& corner);
  void take_mouse(std::size_t plane, CaseBench& bench, const Keys& keys, const ImVec2& corner);

  struct Shown {
    std::unique_ptr<gpu::ScreenPicture> picture;
    std::optional<PaintedPlane> painted;
    std::vector<double> asked;  // what the newest wish was made of
  };
  std::array<Shown, PlanePainter::kPlanes> shown_;
  std::optional<std::size_t> under_mouse_, pressed_;
  glm::dvec2 pressed_px_{0.0}, size_px_{1.0};
  bool dragged_ = false, fitted_ = false;
  PlanePainter painter_;
};

// The patient in the room: looked through or cut away, with all that is placed; a click on the skin sets the entry.
class BenchRoom {
 public:
  explicit BenchRoom(gpu::Context& context) : context_(context) {}

  void begin();
  void draw(CaseBench& bench, const Keys& keys, float width, float height);
  void toggle_glass() noexcept { glass_ = !glass_; }

 private:
  struct Room {
    Room(gpu::Context& context, imaging::RoomScene made) : scene(std::move(made)), renderer(context, scene) {}
    imaging::RoomScene scene;
    imaging::RoomRenderer renderer;
    imaging::DrawList list;
    std::vector<double> looked;  // from where, and at what, `picture` was drawn
    unsigned int picture = 0;
  };
  void prepare(const CaseBench& bench);
  void take_mouse(CaseBench& bench, float width, float height);

  gpu::Context& context_;
  std::unique_ptr<Room> room_;
  std::optional<imaging::RoomCamera> camera_;
  std::string made_of_;  // what the room was made of, or is being
  std::future<imaging::RoomScene> making_;
  bool glass_ = true, dragged_ = false;
};

class BenchPanel {
 public:
  explicit BenchPanel(gpu::Context& context) : planes_(context), room_(context) {}

  void draw(Trainer& trainer, const Keys& keys);
  void end() noexcept { case_id_.clear(); }
  static void tell(const CaseBench& bench, TraceLine& line);

 private:
  void read_keys(Trainer& trainer, const Keys& keys);
  void draw_top(Trainer& trainer);
  void draw_actions(Trainer& trainer);
  void draw_tool(CaseBench& bench);
  void draw_lesion(CaseBench& bench);
  void draw_structure(CaseBench& bench);
  void choose_structure(CaseBench& bench);
  bool draw_structure_meaning();  // name, rule, tissue; true: changed
  bool draw_drawn_structure();    // size and HU; true: changed
  void draw_entry(CaseBench& bench);
  void draw_rule_and_setting(CaseBench& bench);
  bool draw_rule(const CaseBench& bench);  // true: changed
  bool draw_setting(CaseBench& bench);     // true: changed
  bool draw_setting(const casedb::SettingRow& row);  // true: changed
  void draw_checks(CaseBench& bench);
  void draw_help();

  BenchPlanes planes_;
  BenchRoom room_;
  std::string case_id_;
  bool help_ = false;
  std::array<char, 256> note_{}, name_{}, title_{};
  std::string name_of_, title_of_;  // what these fields were filled from
  struct TextInHand {
    std::array<char, 256> typed{};
    std::string filled_from;
  };
  std::map<std::string, TextInHand> texts_;  // of settings, by column
  casedb::CaseSetting setting_;              // while a field of it is in hand
  bool setting_in_hand_ = false;
  cases::LesionForm form_;
  bool form_in_hand_ = false;
  casedb::StructureRow structure_;
  bool structure_in_hand_ = false;
};

}  // namespace seldinger::app
