#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include "app/window/screens/editing/panel_editor.h"
#include "app/window/surface/panel_items.h"
#include "casedb/cases/structure_json.h"

namespace seldinger::app {
namespace {

constexpr float kDegreesPerPixel = 0.3F, kRoomClickPx = 4.0F;
constexpr float kSoftwareShare = 0.8F;  // as the attempt's room (panel_room)
// Than an operator stands: it is a small picture; where skins are compared all of it shows.
constexpr double kNearer = 0.65, kFarther = 1.5;
constexpr int kRoomHelp = 3;  // target, entry and way

// Whatever meshes of a stored case are made of; lesion and entry are drawn from the scene as it is.
std::string made_of(const CaseEditor& editor) {
  std::string text =
      editor.row().case_id + casedb::name_of(editor.row().position) + casedb::name_of(editor.row().modality);
  for (const casedb::StructureRow& one : editor.structures())
    text += one.structure_id + std::string(volume::about(one.tissue).name) +
            (one.kind == casedb::StructureKind::drawn ? casedb::json_of_shape(one.drawn) : "");
  return text;
}

}  // namespace

void EditorRoom::begin() {
  room_.reset();
  camera_->reset();
  made_of_.clear();
  making_ = {};
  look_ = {};
}

void EditorRoom::end() {
  look_ = {};
  if (making_.valid() && making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) making_ = {};
}

// Skin and bone take a moment: a thread makes them, and until then the room before is shown.
void EditorRoom::prepare(const CaseEditor& editor) {
  if (making_.valid()) {
    if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    room_ = std::make_unique<Room>(context_, making_.get());
  }
  std::string wanted = stored(editor) ? made_of(editor) : std::to_string(look_.of->number);
  if (wanted == made_of_) return;
  if (stored(editor) && editor.checking()) return;  // the scene is not that of what is stored yet
  made_of_ = std::move(wanted);
  making_ = std::async(std::launch::async, [of = look_.of, every_triangle = !stored(editor)] {
    imaging::RoomWish wish;
    wish.mentor = true;
    if (every_triangle) wish.skin_triangles = of->scene.skin.triangles.size();
    return imaging::make_room_model(of->scene, wish);
  });
}

void EditorRoom::take_mouse(CaseEditor& editor, float width, float height) {
  const ImGuiIO& io = ImGui::GetIO();
  const cases::Case& scene = look_.of->scene;
  imaging::RoomCamera& camera = **camera_;
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0F) imaging::zoom(camera, std::pow(0.9, io.MouseWheel));
  if (ImGui::IsItemActivated()) dragged_ = false;
  const ImVec2 gone = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
  if (ImGui::IsItemActive()) {
    dragged_ = dragged_ || std::hypot(gone.x, gone.y) > kRoomClickPx;
    if (dragged_ && ImGui::IsMouseDown(ImGuiMouseButton_Left))
      imaging::orbit(camera, room_->scene.frame, -kDegreesPerPixel * io.MouseDelta.x,
                     kDegreesPerPixel * io.MouseDelta.y);
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
      imaging::pan(camera, -io.MouseDelta.x / height, io.MouseDelta.y / height);
  }
  if (!ImGui::IsItemDeactivated() || dragged_ || !ImGui::IsMouseReleased(ImGuiMouseButton_Left)) return;
  const ImVec2 mouse = ImGui::GetMousePos(), corner = ImGui::GetItemRectMin();
  const imaging::RoomProjection projection = imaging::projection_of(camera, 0, width / height);
  const glm::dvec3 ray = imaging::ray_of(projection, {mouse.x - corner.x, mouse.y - corner.y},
                                         static_cast<int>(width), static_cast<int>(height));
  const auto place = skin_under(scene, projection.eye_lps_mm, ray, room_->list.cut);
  if (!place) return;
  if (editor.tool == EditorTool::entry) editor.click(*place);
  editor.view.go_to(scene.volume, *place);
}

void EditorRoom::draw(CaseEditor& editor, EditorLook look, float width, float height) {
  look_ = std::move(look);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton(
      "room", {width, height},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  if (look_.of) prepare(editor);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (!room_ || !look_.of) {
    draw->AddRectFilled(corner, {corner.x + width, corner.y + height}, IM_COL32(60, 64, 68, 255));
    draw->AddText({corner.x + 12.0F, corner.y + 10.0F}, IM_COL32(220, 230, 235, 255), "preparing the room …");
    return;
  }
  note_item("room");  // once it is made
  const cases::Case& scene = look_.of->scene;
  const cases::State state;
  if (!*camera_) {
    // No hand holds a needle here: as if one stood where one would look.
    const glm::dvec3 site = first_look(scene, editor.lesions(), room_->scene.frame.up);
    cases::State looking;
    looking.needle.tip_lps_mm = site;
    looking.needle.direction = -room_->scene.frame.up;
    *camera_ = imaging::room_camera(room_->scene, scene, looking, imaging::RoomView::operator_side);
    (*camera_)->eye_lps_mm += site - (*camera_)->target_lps_mm;
    (*camera_)->target_lps_mm = site;
    imaging::zoom(**camera_, stored(editor) ? kNearer : kFarther);
  }
  take_mouse(editor, width, height);
  imaging::RoomPicture asked;
  const float share = context_.software() ? kSoftwareShare : 1.0F;
  asked.width_px = std::max(16, static_cast<int>(share * width));
  asked.height_px = std::max(16, static_cast<int>(share * height));
  asked.quality = imaging::room_quality(context_);
  asked.camera = **camera_;
  imaging::RoomOptions options;
  options.help = kRoomHelp;
  options.mentor = true;
  options.glass = glass_ && stored(editor);
  options.needle = options.probe = false;
  // Nothing moves by itself here: it is drawn again only when it would look another way.
  const auto& eye = (*camera_)->eye_lps_mm;
  const auto& target = (*camera_)->target_lps_mm;
  std::vector<double> looks = {static_cast<double>(look_.of->number),
                               options.glass ? 1.0 : 0.0,
                               static_cast<double>(asked.width_px),
                               static_cast<double>(asked.height_px),
                               eye.x,
                               eye.y,
                               eye.z,
                               target.x,
                               target.y,
                               target.z};
  if (looks != room_->looked) {
    imaging::make_draw_list(room_->scene, scene, state, options, room_->list);
    if (!stored(editor)) room_->list.cut.reset();  // all of the skin is looked at
    room_->picture = room_->renderer.draw(room_->list, asked);
    room_->looked = std::move(looks);
  }
  const unsigned int name = room_->picture;
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name)), corner,
                 {corner.x + width, corner.y + height}, {0.0F, 1.0F}, {1.0F, 0.0F});
  draw->AddText({corner.x + 8.0F, corner.y + 4.0F}, IM_COL32(30, 40, 50, 255),
                !stored(editor) ? look_.caption
                : glass_        ? "Room (C: cut away)"
                                : "Room (C: look through)");
}

}  // namespace seldinger::app
