#include "app/window/screens/panel_planning.h"

#include <imgui.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "app/window/trainer/plan_words.h"

namespace seldinger::app {
namespace {

constexpr ImU32 kOwnColour = IM_COL32(255, 205, 80, 255), kCrossColour = IM_COL32(150, 190, 215, 90);
constexpr double kSmallSideMm = 90.0, kLargeSideMm = 160.0;  // of a plane, at least
constexpr double kStepMm = 1.0, kLongStepMm = 5.0;
constexpr float kGapPx = 6.0F;
constexpr float kOrbitDegreesPerPixel = 0.3F, kClickPx = 4.0F, kDrawnShare = 0.8F;
constexpr double kNearerThanAnOperator = 0.65;
constexpr int kAllHelp = 3;  // target and proposed way

void draw_way(ImDrawList* draw, const ImVec2& entry, const ImVec2& tip, ImU32 colour) {
  draw->AddLine(entry, tip, colour, 1.5F);
  draw->AddCircleFilled(entry, 3.5F, colour);
  draw->AddCircle(tip, 4.5F, colour, 0, 1.5F);
}

// Legible on liver, which is as light.
void shadowed(ImDrawList* draw, const ImVec2& at, const char* words) {
  draw->AddText({at.x + 1.0F, at.y + 1.0F}, IM_COL32(0, 0, 0, 255), words);
  draw->AddText(at, IM_COL32(205, 222, 232, 255), words);
}

}  // namespace

void PlanningRoom::end() {
  making_ = {};
  of_.reset();
  room_.reset();
  camera_.reset();
}

// Skin and bone take a moment: a thread makes them. False: they are not there yet.
bool PlanningRoom::prepare(const std::shared_ptr<const session::Task>& task) {
  if (of_.lock() != task) {
    end();
    of_ = task;
    imaging::RoomWish wish;
    wish.mentor = true;
    wish.picture = task->scene.picture;
    making_ = std::async(std::launch::async, [task, wish] { return imaging::make_room_model(task->scene, wish); });
  }
  if (making_.valid() && making_.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
    room_ = std::make_unique<Room>(context_, making_.get());
  return room_ != nullptr;
}

void PlanningRoom::look(const cases::Case& scene) {
  const glm::dvec3 site = scene.planned_entry_lps_mm.value_or(
      scene.skin_index.closest_skin(scene.lesions.front().center_lps_mm).point_lps_mm);
  cases::State looking;
  looking.needle.tip_lps_mm = site;
  looking.needle.direction = -room_->model.frame.up;
  camera_ = imaging::room_camera(room_->model, scene, looking, imaging::RoomView::operator_side);
  camera_->eye_lps_mm += site - camera_->target_lps_mm;
  camera_->target_lps_mm = site;
  imaging::zoom(*camera_, kNearerThanAnOperator);
}

std::optional<glm::dvec3> PlanningRoom::take_mouse(const cases::Case& scene, float width, float height) {
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && io.MouseWheel != 0.0F) imaging::zoom(*camera_, std::pow(0.9, io.MouseWheel));
  if (ImGui::IsItemActivated()) dragged_ = false;
  if (ImGui::IsItemActive()) {
    const ImVec2 gone = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F);
    dragged_ = dragged_ || std::hypot(gone.x, gone.y) > kClickPx;
    if (dragged_)
      imaging::orbit(*camera_, room_->model.frame, -kOrbitDegreesPerPixel * io.MouseDelta.x,
                     kOrbitDegreesPerPixel * io.MouseDelta.y);
  }
  if (!ImGui::IsItemDeactivated() || dragged_) return std::nullopt;
  const ImVec2 mouse = ImGui::GetMousePos(), corner = ImGui::GetItemRectMin();
  const imaging::RoomProjection projection = imaging::projection_of(*camera_, 0, width / height);
  const glm::dvec3 ray = imaging::ray_of(projection, {mouse.x - corner.x, mouse.y - corner.y},
                                         static_cast<int>(width), static_cast<int>(height));
  return skin_under(scene, projection.eye_lps_mm, ray, room_->list.cut);
}

std::optional<glm::dvec3> PlanningRoom::draw(const std::shared_ptr<const session::Task>& task,
                                             const assessment::PlannedPath* plan, float width, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos(), end{corner.x + width, corner.y + height};
  ImGui::InvisibleButton("in 3-D", {width, height});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (!prepare(task)) {
    draw->AddRectFilled(corner, end, IM_COL32(60, 64, 68, 255));
    shadowed(draw, {corner.x + 12.0F, corner.y + 10.0F}, "preparing the 3-D view …");
    return std::nullopt;
  }
  note_item("in 3-D");  // once it is made
  const cases::Case& scene = task->scene;
  if (!camera_) look(scene);
  const auto clicked = take_mouse(scene, width, height);
  imaging::RoomPicture asked;
  const float share = context_.software() ? kDrawnShare : 1.0F;
  asked.width_px = std::max(16, static_cast<int>(share * width));
  asked.height_px = std::max(16, static_cast<int>(share * height));
  asked.quality = imaging::room_quality(context_);
  asked.camera = *camera_;
  const auto &eye = camera_->eye_lps_mm, &target = camera_->target_lps_mm;
  std::vector<double> looks = {
      1.0 * asked.width_px, 1.0 * asked.height_px, eye.x, eye.y, eye.z, target.x, target.y, target.z};
  if (looks != room_->looked) {  // nothing moves by itself here
    imaging::RoomOptions options;
    options.help = kAllHelp;
    options.mentor = options.glass = true;
    options.needle = options.probe = false;
    imaging::make_draw_list(room_->model, scene, {}, options, room_->list);
    room_->picture = room_->renderer.draw(room_->list, asked);
    room_->looked = std::move(looks);
  }
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(room_->picture)), corner, end,
                 {0.0F, 1.0F}, {1.0F, 0.0F});
  draw->PushClipRect(corner, end, true);
  if (plan != nullptr) {
    const imaging::RoomProjection projection = imaging::projection_of(*camera_, 0, width / height);
    const auto at = [&](const glm::dvec3& place) {
      return imaging::pixel_of(projection, place, static_cast<int>(width), static_cast<int>(height));
    };
    if (const auto entry = at(plan->entry_lps_mm), tip = at(plan->tip_lps_mm); entry && tip)
      draw_way(draw, {corner.x + static_cast<float>(entry->x), corner.y + static_cast<float>(entry->y)},
               {corner.x + static_cast<float>(tip->x), corner.y + static_cast<float>(tip->y)}, kOwnColour);
  }
  shadowed(draw, {corner.x + 6.0F, corner.y + 2.0F}, "3-D: drag turns, wheel zooms, click: entry");
  draw->PopClipRect();
  return clicked;
}

void PlanningPanel::end() {
  painting_ = {};
  of_.reset();
  planes_.clear();
  pictures_.clear();
  through_.reset();
  painted_.reset();
  way_.reset();
  way_of_.reset();
  room_.end();
  end_ = End::entry;
  open_ = false;
}

// Painted beside the window, one after the other: what was asked for in between is passed over.
void PlanningPanel::take(const std::shared_ptr<const session::Task>& task) {
  if (of_.lock() != task) {
    const bool open = open_;
    end();
    open_ = open;
    of_ = task;
    through_ = task->lesion.lesion.center_lps_mm;
  }
  if (painting_.valid() && painting_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) {
    planes_ = painting_.get();
    pictures_.resize(planes_.size());
    for (std::size_t i = 0; i < planes_.size(); ++i) {
      if (!pictures_[i])
        pictures_[i] = std::make_unique<gpu::ScreenPicture>(context_, gpu::ScreenPicture::Pixels::grey);
      pictures_[i]->show(planes_[i].ct.width_px, planes_[i].ct.height_px, planes_[i].ct.grey);
    }
  }
  const double side_mm = open_ ? kLargeSideMm : kSmallSideMm;
  if (painting_.valid() || (painted_ == through_ && side_mm_ == side_mm)) return;
  painted_ = through_;
  side_mm_ = side_mm;
  painting_ = std::async(std::launch::async, [task, side_mm, through = *through_] {
    return body_planes_through(task->scene, {}, through, side_mm);
  });
}

void PlanningPanel::draw_plane(std::size_t number, const Trainer& trainer, const session::Task& task,
                               float side_px) const {
  const BodyPlane& plane = planes_[number];
  const ImVec2 corner = ImGui::GetCursorScreenPos(), end{corner.x + side_px, corner.y + side_px};
  ImGui::InvisibleButton(plane.name.c_str(), {side_px, side_px},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
  note_item(plane.name.c_str());
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(pictures_[number]->name())), corner,
                 end);
  const float scale = side_px / static_cast<float>(plane.side_mm);
  const auto at = [&](const glm::dvec3& place_lps_mm) {
    const glm::dvec2 mm = plane.at(place_lps_mm);
    return ImVec2{corner.x + scale * static_cast<float>(mm.x), corner.y + scale * static_cast<float>(mm.y)};
  };
  const auto lines = [&](const std::vector<PlaneSegment>& segments, ImU32 colour) {
    for (const PlaneSegment& one : segments)
      draw->AddLine(
          {corner.x + scale * static_cast<float>(one.from_mm.x),
           corner.y + scale * static_cast<float>(one.from_mm.y)},
          {corner.x + scale * static_cast<float>(one.to_mm.x), corner.y + scale * static_cast<float>(one.to_mm.y)},
          colour);
  };
  draw->PushClipRect(corner, end, true);
  lines(plane.skin, IM_COL32(235, 190, 150, 170));
  for (const PlaneOutline& one : plane.structures) lines(one.segments, colour_of_rule(one.rule));
  if (open_ && painted_) {  // where the other planes cut it
    const ImVec2 cross = at(*painted_);
    draw->AddLine({cross.x, corner.y}, {cross.x, end.y}, kCrossColour);
    draw->AddLine({corner.x, cross.y}, {end.x, cross.y}, kCrossColour);
  }
  // Of the ball what this plane cuts of it.
  const cases::Lesion& target = task.lesion.lesion;
  const double off_mm = painted_ ? glm::dot(target.center_lps_mm - *painted_, glm::cross(plane.u, plane.v)) : 0.0;
  const ImVec2 middle = at(target.center_lps_mm);
  if (const double cut = target.radius_mm * target.radius_mm - off_mm * off_mm; cut > 0.0)
    draw->AddCircle(middle, scale * static_cast<float>(std::sqrt(cut)), kTargetColour, 48, 1.5F);
  if (task.scene.planned_entry_lps_mm) {
    const ImVec2 entry = at(*task.scene.planned_entry_lps_mm);
    draw->AddLine(entry, middle, kTargetColour, 1.0F);
    draw->AddCircleFilled(entry, 3.0F, kTargetColour);
  }
  if (const auto& own = trainer.plan()) draw_way(draw, at(own->entry_lps_mm), at(own->tip_lps_mm), kOwnColour);
  const auto say = [&](float x, float y, const std::string& words) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    shadowed(draw,
             {corner.x + 4.0F + x * (side_px - size.x - 8.0F), corner.y + 2.0F + y * (side_px - size.y - 4.0F)},
             words.c_str());
  };
  say(0.0F, 0.0F, plane.name);
  say(0.0F, 0.5F, plane.left);
  say(1.0F, 0.5F, plane.right);
  say(0.5F, 1.0F, plane.lower);
  draw->PopClipRect();
}

void PlanningPanel::draw_small(const Trainer& trainer, const std::shared_ptr<const session::Task>& task) {
  constexpr float kLeastPx = 200.0F;
  if (task != nullptr) take(task);
  if (task == nullptr || planes_.empty()) {
    quiet("It is being prepared …");
    return;
  }
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float words_px = 2.0F * ImGui::GetTextLineHeightWithSpacing();
  const float high = std::max(scaled(kLeastPx), std::min((room.x - kGapPx) / 1.5F, room.y - words_px));
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {kGapPx, kGapPx});
  draw_plane(0, trainer, *task, high);
  ImGui::SameLine();
  ImGui::BeginGroup();
  for (std::size_t plane = 1; plane < planes_.size(); ++plane)
    draw_plane(plane, trainer, *task, 0.5F * (high - kGapPx));
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  std::string legend =
      task->scene.planned_entry_lps_mm ? "Green: the target and the proposed path." : "Green: the target.";
  if (trainer.plan()) legend += " Yellow: your own path.";
  if (!task->scene.structures.empty()) legend += " Red: critical structures; orange: major ones.";
  quiet(legend.c_str());
}

void PlanningPanel::set_end(Trainer& trainer, const glm::dvec3& place_lps_mm) {
  if (end_ == End::entry)
    trainer.plan_entry(place_lps_mm);
  else
    trainer.plan_tip(place_lps_mm);
}

// The left button sets an end of the way, the right one where the planes meet; the wheel goes from slice to slice.
void PlanningPanel::take_mouse(std::size_t number, Trainer& trainer, const Keys& keys, float side_px) {
  const BodyPlane& plane = planes_[number];
  const ImVec2 mouse = ImGui::GetMousePos(), corner = ImGui::GetItemRectMin();
  const double mm = plane.side_mm / side_px;
  if (ImGui::IsItemHovered() && ImGui::GetIO().MouseWheel != 0.0F)
    *through_ += std::round(static_cast<double>(ImGui::GetIO().MouseWheel)) * (keys.shift ? kLongStepMm : kStepMm) *
                 glm::cross(plane.u, plane.v);
  if (!ImGui::IsItemActive()) return;
  const glm::dvec3 place =
      plane.corner_lps_mm + mm * (mouse.x - corner.x) * plane.u + mm * (mouse.y - corner.y) * plane.v;
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
    set_end(trainer, place);
  else
    through_ = place;
}

// The chosen end by keys: as it is seen in the axial plane, and along the body.
void PlanningPanel::read_keys(Trainer& trainer, const Keys& keys) {
  if (keys.pressed('1')) end_ = End::entry;
  if (keys.pressed('2')) end_ = End::tip;
  if (keys.pressed('3')) trainer.plan_as_proposed();
  if (keys.pressed(kBackspace)) trainer.drop_plan();
  const auto both = [&](int more, int less) {
    return (keys.pressed(more) ? 1.0 : 0.0) - (keys.pressed(less) ? 1.0 : 0.0);
  };
  const PlaneKind& axial = plane_kinds()[0];
  const glm::dvec3 by = both(kRight, kLeft) * axial.u + both(kDown, kUp) * axial.v +
                        both(kPageUp, kPageDown) * glm::dvec3(0.0, 0.0, 1.0);
  if (glm::length(by) == 0.0) return;
  const glm::dvec3 from = !trainer.plan()      ? *through_
                          : end_ == End::entry ? trainer.plan()->entry_lps_mm
                                               : trainer.plan()->tip_lps_mm;
  set_end(trainer, from + (keys.shift ? kLongStepMm : kStepMm) * by);
  if (trainer.plan()) through_ = end_ == End::entry ? trainer.plan()->entry_lps_mm : trainer.plan()->tip_lps_mm;
}

void PlanningPanel::draw_words(Trainer& trainer, const session::Task& task) {
  if (trainer.plan() != way_of_) {
    way_of_ = trainer.plan();
    way_ = way_of_ ? session::way_between(task.scene, way_of_->entry_lps_mm, way_of_->tip_lps_mm) : std::nullopt;
  }
  if (!way_) {
    ImGui::TextWrapped(
        "No path is planned yet: click where the needle is to go in (1), then where its tip is to be "
        "when it is fired (2).");
    note_item("No path is planned yet");
  } else {
    const std::string words = "Your path: " + way_words(*way_) + ".";
    ImGui::TextWrapped("%s", words.c_str());
    note_item(words.c_str());
    std::string against;
    for (const std::string& one : warnings_of(*way_)) against += (against.empty() ? "It goes " : "; ") + one;
    ImGui::PushStyleColor(ImGuiCol_Text,
                          against.empty() ? ImVec4(0.45F, 0.85F, 0.55F, 1.0F) : ImVec4(0.96F, 0.58F, 0.40F, 1.0F));
    against = against.empty() ? "It meets nothing that it must avoid." : against + ".";
    ImGui::TextWrapped("%s", against.c_str());
    ImGui::PopStyleColor();
    note_item(against.c_str());
  }
}

void PlanningPanel::draw_large(Trainer& trainer, const Keys& keys,
                               const std::shared_ptr<const session::Task>& task) {
  take(task);
  if (planes_.empty()) return quiet("It is being prepared …");
  read_keys(trainer, keys);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float words_px = 3.2F * ImGui::GetTextLineHeightWithSpacing() + 1.4F * ImGui::GetFrameHeightWithSpacing();
  const float high = std::min(room.y - words_px, 0.55F * room.x);
  const float right = room.x - high - kGapPx, small = std::min(0.5F * (right - kGapPx), 0.58F * high);
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {kGapPx, kGapPx});
  const auto plane = [&](std::size_t number, float side_px) {
    draw_plane(number, trainer, *task, side_px);
    take_mouse(number, trainer, keys, side_px);
  };
  plane(0, high);
  ImGui::SameLine();
  ImGui::BeginGroup();
  plane(1, small);
  ImGui::SameLine();
  plane(2, small);
  const auto& own = trainer.plan();
  const auto skin = room_.draw(task, own ? &*own : nullptr, right, high - small - kGapPx);
  if (skin) trainer.plan_entry(*skin);
  ImGui::EndGroup();
  ImGui::PopStyleVar();
  draw_words(trainer, *task);
  const auto choice = [&](const char* words, End its) {
    if (end_ == its) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
    const bool was = end_ == its;
    if (noted_button(words)) end_ = its;
    if (was) ImGui::PopStyleColor();
    ImGui::SameLine();
  };
  choice("Entry (1)", End::entry);
  choice("Tip (2)", End::tip);
  const bool proposed = trainer.proposes_path();
  ImGui::BeginDisabled(!proposed);
  if (noted_button("As proposed (3)")) trainer.plan_as_proposed();
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (noted_button("No plan (Backspace)")) trainer.drop_plan();
  ImGui::SameLine();
  if (noted_button("Back to the briefing (P)")) open_ = false;
  if (!proposed) {
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    quiet("This case proposes no path.");
    note_item("This case proposes no path");
  }
  quiet(
      "Click or drag: entry or tip · arrows, Page Up, Page Down: by 1 mm · wheel: slices, Shift: by 5 · "
      "right click: planes meet there");
}

}  // namespace seldinger::app
