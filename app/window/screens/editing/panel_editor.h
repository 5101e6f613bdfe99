// The case editor: three planes of the CT and the room, what the tool in hand can set, what the case's checks
// found, and the way from draft to published.
#pragma once

#include <array>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/editor/case_editor.h"
#include "app/window/editor/plane_painter.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/trace.h"
#include "app/window/surface/window.h"
#include "app/window/trainer/trainer.h"
#include "sim/gpu/screen_picture.h"
#include "sim/imaging/room/room_renderer.h"

struct ImVec2;

namespace seldinger::casedb {
struct SettingRow;
}

namespace seldinger::app {

// What a plane or the room looks at: the case as it is stored, or its CT as it came or prepared anew.
struct EditorLook {
  std::shared_ptr<const CheckedCase> of;        // nothing: it is not there yet
  std::shared_ptr<const CheckedCase> beside{};  // whose skin is drawn too
  const char* caption = "";
};

// The planes, with what is drawn over them and the mouse in them.
class EditorPlanes {
 public:
  explicit EditorPlanes(gpu::Context& context);

  void begin();               // another case
  void end() { look_ = {}; }  // in every frame without the editor: else a whole volume would stay
  void draw(std::size_t plane, CaseEditor& editor, EditorLook look, const Keys& keys, float width, float height);
  std::optional<std::size_t> under_mouse() const noexcept { return under_mouse_; }
  // The plane that has the keyboard: arrows lead the cursor in it, the page keys through it, Space clicks there.
  std::optional<std::size_t> by_keys() const noexcept { return by_keys_; }
  glm::dvec2 size_px() const noexcept { return size_px_; }

 private:
  void ask(std::size_t plane, const CaseEditor& editor);
  void draw_picture(std::size_t plane, const CaseEditor& editor, const ImVec2& corner);
  void draw_case(std::size_t plane, const CaseEditor& editor, const ImVec2& corner);
  void draw_words(std::size_t plane, const CaseEditor& editor, const ImVec2& corner);
  void take_mouse(std::size_t plane, CaseEditor& editor, const Keys& keys, const ImVec2& corner);

  struct Shown {
    std::unique_ptr<gpu::ScreenPicture> picture;
    std::optional<PaintedPlane> painted;
    std::vector<double> asked;  // what the newest wish was made of
  };
  std::array<Shown, PlanePainter::kPlanes> shown_;
  std::optional<std::size_t> under_mouse_, by_keys_, pressed_;
  glm::dvec2 pressed_px_{0.0}, size_px_{1.0};
  bool dragged_ = false, fitted_ = false;
  EditorLook look_;  // of the plane that is being drawn
  PlanePainter painter_;
};

// The patient in the room: looked through or cut away, with all that is placed; a click on the skin sets the entry.
class EditorRoom {
 public:
  using Camera = std::shared_ptr<std::optional<imaging::RoomCamera>>;  // rooms side by side have one

  EditorRoom(gpu::Context& context, Camera camera) : context_(context), camera_(std::move(camera)) {}

  void begin();
  void end();  // as of the planes
  void draw(CaseEditor& editor, EditorLook look, float width, float height);
  void toggle_glass() noexcept { glass_ = !glass_; }

 private:
  struct Room {
    Room(gpu::Context& context, imaging::RoomModel made) : scene(std::move(made)), renderer(context, scene) {}
    imaging::RoomModel scene;
    imaging::RoomRenderer renderer;
    imaging::DrawList list;
    std::vector<double> looked;  // from where, and at what, `picture` was drawn
    unsigned int picture = 0;
  };
  void prepare(const CaseEditor& editor);
  bool stored(const CaseEditor& editor) const { return look_.of == editor.scene(); }
  void take_mouse(CaseEditor& editor, float width, float height);

  gpu::Context& context_;
  std::unique_ptr<Room> room_;
  Camera camera_;
  EditorLook look_;      // of the frame
  std::string made_of_;  // what the room was made of, or is being
  std::future<imaging::RoomModel> making_;
  bool glass_ = true, dragged_ = false;
};

// A number in a field, noted by its label. True once it is entered, not while it is typed.
bool number_field(const char* label, double& value, double step, const char* format, bool& in_hand);

class EditorPanel {
 public:
  explicit EditorPanel(gpu::Context& context)
      : planes_(context),
        prepared_planes_(context),
        room_(context, camera_),
        came_room_(context, skin_camera_),
        prepared_room_(context, skin_camera_) {}

  void draw(Trainer& trainer, const Keys& keys);
  void end();
  static void tell(CaseEditor& editor, TraceLine& line);

 private:
  void read_keys(Trainer& trainer, const Keys& keys);
  void lead_cursor(CaseEditor& editor, const Keys& keys);
  void draw_top(Trainer& trainer);
  void draw_actions(Trainer& trainer);
  void draw_tool(CaseEditor& editor);
  void draw_lesion(CaseEditor& editor);
  void draw_structure(CaseEditor& editor);
  void choose_structure(CaseEditor& editor);
  bool draw_lesion_kind();        // true: changed, and with it what CT shows
  bool draw_structure_meaning();  // name, rule, tissue; true: changed
  bool draw_drawn_structure();    // size and HU; true: changed
  void draw_entry(CaseEditor& editor);
  void draw_rule_and_setting(CaseEditor& editor);
  bool draw_rule(const CaseEditor& editor);          // true: changed
  bool draw_setting(CaseEditor& editor);             // true: changed
  bool draw_setting(const casedb::SettingRow& row);  // true: changed
  void draw_checks(CaseEditor& editor);
  static void draw_rehearsal(CaseEditor& editor);
  void draw_history(const CaseEditor& editor);
  void ask_to_publish(const CaseEditor& editor, bool own_cohort);
  void draw_help();

  void draw_pictures(CaseEditor& editor, const Keys& keys, float wide, float high);
  void draw_preparation(CaseEditor& editor);
  static void draw_histogram(DraftPreparation& preparing, casedb::Preparation& settings, bool& in_hand);

  EditorRoom::Camera camera_ = std::make_shared<std::optional<imaging::RoomCamera>>(),
                     skin_camera_ = std::make_shared<std::optional<imaging::RoomCamera>>();
  EditorPlanes planes_, prepared_planes_;
  EditorRoom room_, came_room_, prepared_room_;
  std::string case_id_;
  bool help_ = false;
  Question question_;
  bool to_own_cohort_ = false;  // what is asked about
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
  casedb::Preparation preparation_;
  bool preparation_in_hand_ = false;
  std::optional<std::string> kept_preparation_;  // the draft that it became, to be opened
};

}  // namespace seldinger::app
