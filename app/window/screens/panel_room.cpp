#include "app/window/screens/panel_room.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "sim/tissue/displacement.h"

namespace seldinger::app {
namespace {

using devices::HandAction;

// Which key does what. The window's other keys are in panel_attempt.
constexpr std::array<std::pair<int, HandAction>, 19> kHandKeys = {{
    {kTab, HandAction::swap},        {'G', HandAction::guide},      {kBackspace, HandAction::reset},
    {kSpace, HandAction::fire},      {'F', HandAction::freeze},     {'D', HandAction::slide_right},
    {'A', HandAction::slide_left},   {'W', HandAction::slide_up},   {'S', HandAction::slide_down},
    {'E', HandAction::slide_away},   {'Q', HandAction::slide_near}, {kPageDown, HandAction::advance},
    {kPageUp, HandAction::withdraw}, {'I', HandAction::tilt_more},  {'K', HandAction::tilt_less},
    {'L', HandAction::rock_more},    {'J', HandAction::rock_less},  {'O', HandAction::rotate_more},
    {'U', HandAction::rotate_less},
}};

devices::HeldActions held_actions(const Keys& keys) {
  devices::HeldActions actions;
  const auto set = [&](HandAction action) { actions.set(static_cast<std::size_t>(action)); };
  for (const auto& [key, action] : kHandKeys)
    if (keys.held(key)) set(action);
  if (keys.shift) set(HandAction::fine);
  if (keys.control) set(HandAction::keep_tilt);
  return actions;
}

cases::ToolPose pose_of_held(const Seen& seen) {
  const cases::State& state = seen.moment.state;
  if (seen.held == devices::HeldTool::needle) return {state.needle.tip_lps_mm, state.needle.direction, {}};
  return {state.probe.origin_lps_mm, state.probe.axial, state.probe.lateral};
}

// Where the tissue has it in which it stands; about the needle while its stylet is in, but for the point.
std::optional<imaging::RoomIntroducer> introducer_of(const engine::Moment& moment) {
  constexpr double kPointMm = 3.0, kShortestMm = 1.0;  // less tells no direction
  const cases::NeedleState& needle = moment.state.needle;
  if (moment.introducer == haptics::Introducer::closed)
    return imaging::RoomIntroducer{needle.tip_lps_mm - kPointMm * needle.direction, needle.direction};
  if (!moment.tube) return std::nullopt;
  const glm::dvec3 end_lps_mm = tissue::displaced(moment.displacement, moment.tube->end_lps_mm);
  const glm::dvec3 in_mm = end_lps_mm - tissue::displaced(moment.displacement, moment.tube->entry_lps_mm);
  const double deep_mm = glm::length(in_mm);
  if (!(deep_mm > kShortestMm)) return imaging::RoomIntroducer{end_lps_mm, needle.direction};
  return imaging::RoomIntroducer{end_lps_mm, in_mm / deep_mm};
}

// By imaging::RoomView; the key is its number.
constexpr std::array<const char*, imaging::kRoomViewNames.size()> kViewWords = {
    "operator’s side", "head end",         "foot end",       "from above",
    "over the needle", "along the needle", "near the probe", "along the picture’s plane"};

bool of_probe(imaging::RoomView view) {
  return view == imaging::RoomView::near_probe || view == imaging::RoomView::along_plane;
}

std::string view_words(imaging::RoomView view) {
  const auto number = static_cast<std::size_t>(view);
  return std::string(kViewWords[number]) + " (" + std::to_string(number + 1) + ")";
}

constexpr double kLeastZoom = 0.25, kMostZoom = 4.0;
constexpr float kViewDegreesPerPixel = 0.3F;
// Of its width and height a room is drawn so large in software, where it costs by the pixel, and then stretched.
constexpr float kViewSoftwareShare = 0.8F;

}  // namespace

void RoomPanel::begin(const cases::Case& scene, bool left_handed) {
  end();
  left_handed_ = left_handed;
  has_inside_ = false;
  inside_ = RoomInside::whole;
  room_ = std::make_unique<Room>(context_, imaging::make_room_model(scene), left_handed);
  view_ = imaging::RoomView::operator_side;
  named_ = *view_;
  own_ = false;
  zoom_ = 1.0;
  begun_ = false;
}

void RoomPanel::set_view(imaging::RoomView view) {
  if (room_ && room_->scene.probe == imaging::kNoMesh && of_probe(view)) return;
  if (view == named_ && !own_) zoom_ = 1.0;  // once more: as it was
  view_ = named_ = view;
  own_ = false;
}

void RoomPanel::look_inside(std::shared_ptr<const cases::Case> scene) {
  constexpr std::array kNext = {RoomInside::cut_away, RoomInside::looked_through, RoomInside::whole};
  inside_ = kNext[static_cast<std::size_t>(inside_)];
  if (has_inside_ || making_.valid()) return;
  imaging::RoomWish wish;
  wish.mentor = true;
  wish.picture = scene->picture;
  making_ = std::async(std::launch::async,
                       [scene = std::move(scene), wish] { return imaging::make_room_model(*scene, wish); });
}

void RoomPanel::take_made() {
  if (!making_.valid() || making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
  auto made = std::make_unique<Room>(context_, making_.get(), left_handed_);
  made->camera = room_->camera;
  room_ = std::move(made);
  has_inside_ = true;
}

devices::HandView RoomPanel::hand_view(const Room& room, const cases::ToolPose& tool, float height_px) const {
  const imaging::RoomCamera& camera = room.camera;
  devices::HandView view;
  view.away = glm::normalize(camera.target_lps_mm - camera.eye_lps_mm);
  view.right = glm::normalize(glm::cross(view.away, camera.up));
  view.up = glm::cross(view.right, view.away);
  const double far_mm = std::max(50.0, glm::dot(tool.position_lps_mm - camera.eye_lps_mm, view.away));
  const double half = std::tan(0.5 * camera.height_deg * std::numbers::pi / 180.0);
  view.mm_per_pixel = 2.0 * far_mm * half / std::max(1.0F, height_px);
  return view;
}

devices::HandView RoomPanel::view_of_hands(const Seen& seen) const {
  return room_ && begun_ ? hand_view(*room_, pose_of_held(seen), size_px_[1]) : devices::HandView{};
}

// A view that is asked for comes in a moment. With Alt held the left button turns it, the others shift it, and the
// wheel brings it nearer.
void RoomPanel::move_camera(Room& room, const cases::Case& scene, const cases::State& state, const Keys& keys,
                            double elapsed_s) {
  constexpr double kViewS = 0.6;
  if (view_ && (begun_ || state.tick > 0)) {  // before a tick nobody knows where the tools are
    room.from = room.camera;
    room.to = imaging::room_camera(room.scene, scene, state, *view_);
    imaging::zoom(room.to, zoom_);
    imaging::stay_clear(room.to, room.scene.frame, scene.skin_index, {}, 1.0);
    imaging::stay_off_tools(room.to, room.scene, state);
    room.on_way = begun_ ? 0.0 : 1.0;
    if (!begun_) room.camera = room.to;
    begun_ = true;
    view_.reset();
  }
  if (room.on_way < 1.0) {
    room.on_way = std::min(1.0, room.on_way + elapsed_s / kViewS);
    room.camera = imaging::between(room.from, room.to, room.on_way);
  }
  if (begun_) imaging::stay_off_tools(room.camera, room.scene, state);
  const ImGuiIO& io = ImGui::GetIO();
  if (!keys.alt || (!ImGui::IsItemHovered() && !ImGui::IsItemActive())) return;
  const ImVec2 size = ImGui::GetItemRectSize();
  const bool moves = io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F;
  own_ = own_ || (moves && ImGui::IsItemActive());
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left))
    imaging::orbit(room.camera, room.scene.frame, -kViewDegreesPerPixel * io.MouseDelta.x,
                   kViewDegreesPerPixel * io.MouseDelta.y);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Right) || ImGui::IsMouseDown(ImGuiMouseButton_Middle))
    imaging::pan(room.camera, -io.MouseDelta.x / size.y, io.MouseDelta.y / size.y);
  if (io.MouseWheel != 0.0F) {
    const double before = zoom_;
    zoom_ = std::clamp(zoom_ * std::pow(0.9, io.MouseWheel), kLeastZoom, kMostZoom);
    imaging::zoom(room.camera, zoom_ / before);
  }
  imaging::stay_clear(room.camera, room.scene.frame, scene.skin_index, {}, size.x / std::max(1.0F, size.y));
  imaging::stay_off_tools(room.camera, room.scene, state);
}

void RoomPanel::place(const cases::Case& scene, const Seen& seen, const Keys& keys, double elapsed_s) {
  const ImVec2 size = ImGui::GetContentRegionAvail(), corner = ImGui::GetCursorScreenPos();
  corner_px_ = {corner.x, corner.y};
  size_px_ = {size.x, size.y};
  ImGui::InvisibleButton(
      "room", size,
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  if (room_) note_item("room");  // once it is made
  ImGui::SetItemAllowOverlap();  // by the views' button
  over_ = ImGui::IsItemHovered();
  dragging_ = ImGui::IsItemActive();
  if (room_) move_camera(*room_, scene, seen.moment.state, keys, elapsed_s);
}

std::optional<cases::HandKind> RoomPanel::hands(const Seen& seen, const Keys& keys, const Pointer& pointer,
                                                double wheel, const OtherHands& other, double elapsed_s,
                                                devices::HandIntent& sum) {
  const Pointer before = std::exchange(pointer_, pointer);
  if (!room_ || !begun_) return std::nullopt;
  devices::MouseEvents events;
  events.elapsed_s = elapsed_s;
  events.actions = held_actions(keys);
  if (!keys.alt) {
    if (dragging_) {
      events.right_px = pointer.x_px - before.x_px;
      events.down_px = pointer.y_px - before.y_px;
      events.primary = pointer.down[0];
      events.secondary = pointer.down[1];
      events.middle = pointer.down[2];
    }
    if (under_pointer()) events.wheel_notches = wheel;
  }
  const cases::ToolPose held = pose_of_held(seen);
  const devices::HandView view = view_of_hands(seen);
  devices::HandIntent intent = room_->mouse.intent(events, view, seen.held, held);
  std::optional<cases::HandKind> leads;
  double most = 0.0;
  const auto look = [&](cases::HandKind hand, const devices::HandIntent& its) {
    const double way = devices::way_of(its);
    if (way > most) leads = hand;
    most = std::max(most, way);
  };
  look(cases::HandKind::mouse, intent);
  if (other.gamepad) {
    const devices::HandIntent its = room_->gamepad.intent(*other.gamepad, view, seen.held, held, elapsed_s);
    look(cases::HandKind::gamepad, its);
    devices::join(its, intent);
  }
  if (other.space_mouse) {
    const devices::HandIntent its = room_->space_mouse.intent(*other.space_mouse, view, elapsed_s);
    look(cases::HandKind::space_mouse, its);
    devices::join(its, intent);
  }
  devices::add(intent, sum);
  return leads;
}

void RoomPanel::draw(const cases::Case& scene, const Seen& seen, int help) {
  if (!room_ || !begun_) return;
  take_made();
  imaging::RoomPicture picture;
  const float share = context_.software() ? kViewSoftwareShare : 1.0F;
  picture.width_px = std::max(16, static_cast<int>(share * size_px_[0]));
  picture.height_px = std::max(16, static_cast<int>(share * size_px_[1]));
  picture.views = stereo_ ? 2 : 1;
  picture.camera = room_->camera;
  picture.quality = imaging::room_quality(context_);
  imaging::RoomOptions options;
  options.help = help;
  options.mentor = has_inside_ && inside_ != RoomInside::whole;
  options.glass = inside_ == RoomInside::looked_through;
  const engine::Moment& moment = seen.moment;
  options.numb_lps_mm =
      std::span(moment.numb_lps_mm).first(std::min<std::size_t>(moment.numbed, engine::kNumbPlaces));
  options.nicks_lps_mm =
      std::span(moment.nick_lps_mm).first(std::min<std::size_t>(moment.nicked, engine::kNickPlaces));
  options.introducer = introducer_of(moment);
  imaging::make_draw_list(room_->scene, scene, seen.moment.state, options, room_->list);
  const unsigned int name = room_->renderer.draw(room_->list, picture, seen.moment.displacement);
  drawn_.emplace(context_);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(name)), {corner_px_[0], corner_px_[1]},
                 {corner_px_[0] + size_px_[0], corner_px_[1] + size_px_[1]}, {0.0F, 1.0F}, {1.0F, 0.0F});
}

void RoomPanel::draw_views() {
  if (!room_) return;
  std::string words = "View: " + (own_ ? std::string("your own") : view_words(named_));
  char nearer[16];
  std::snprintf(nearer, sizeof nearer, ", %.1f×", 1.0 / zoom_);
  if (zoom_ != 1.0) words += nearer;
  const auto wide_of = [&] {
    return ImGui::CalcTextSize(words.c_str()).x + 2.0F * ImGui::GetStyle().FramePadding.x;
  };
  if (wide_of() > size_px_[0] - 16.0F)  // of a small room its key says it
    words = own_ ? "Your own view" : "View (" + std::to_string(static_cast<int>(named_) + 1) + ")";
  const float wide = wide_of();
  ImGui::SetCursorScreenPos({corner_px_[0] + size_px_[0] - wide - 8.0F, corner_px_[1] + 8.0F});
  if (ImGui::Button((words + "##views").c_str())) ImGui::OpenPopup("views");
  note_item(words.c_str());
  ImGui::SetNextWindowPos({corner_px_[0] + size_px_[0] - 8.0F, ImGui::GetItemRectMax().y + 2.0F}, ImGuiCond_Always,
                          {1.0F, 0.0F});
  if (!ImGui::BeginPopup("views")) return;
  for (std::size_t i = 0; i < imaging::kRoomViewNames.size(); ++i) {
    const auto view = static_cast<imaging::RoomView>(i);
    if (of_probe(view) && room_->scene.probe == imaging::kNoMesh) continue;
    const std::string name = view_words(view);
    if (ImGui::Selectable(name.c_str(), view == named_ && !own_)) set_view(view);
    note_item(name.c_str());
  }
  ImGui::TextDisabled("Alt: drag turns, right drag shifts, wheel zooms");
  ImGui::TextDisabled("the same view once more: without zoom");
  ImGui::EndPopup();
}

bool RoomPanel::finished(double most_s) {
  if (drawn_ && drawn_->passed(most_s)) drawn_.reset();
  return !drawn_;
}

}  // namespace seldinger::app
