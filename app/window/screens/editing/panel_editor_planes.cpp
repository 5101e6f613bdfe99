#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>

#include "app/window/screens/editing/panel_editor.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/key_focus.h"
#include "app/window/surface/panel_items.h"
#include "app/window/surface/screen_words.h"

namespace seldinger::app {
namespace {

constexpr ImU32 kWords = IM_COL32(205, 222, 232, 255), kCross = IM_COL32(120, 190, 230, 150);
constexpr ImU32 kSkinLine = IM_COL32(235, 190, 150, 170), kSkinBeside = IM_COL32(90, 200, 255, 200);
constexpr ImU32 kLesion = kTargetColour;
constexpr ImU32 kChosen = IM_COL32(255, 235, 120, 255), kWay = IM_COL32(110, 235, 150, 230);
constexpr ImU32 kWayMet = IM_COL32(255, 120, 90, 255);
constexpr double kReachPx = 7.0, kClickPx = 4.0, kNearPlaneMm = 3.0;
constexpr int kCorners = 64;

// Draws in pixels of one plane.
struct Pen {
  const CaseEditor& editor;
  std::size_t plane;
  glm::dvec2 size_px;
  ImVec2 corner;
  ImDrawList* draw = ImGui::GetWindowDrawList();

  ImVec2 at(const glm::dvec3& place) const {
    const glm::dvec2 px = editor.view.pixel(plane, size_px, place);
    return {corner.x + static_cast<float>(px.x), corner.y + static_cast<float>(px.y)};
  }
  double across_mm(const glm::dvec3& place) const {
    const PlaneKind& kind = plane_kinds()[plane];
    return glm::dot(place - editor.view.cursor_lps_mm(), glm::cross(kind.u, kind.v));
  }
  // Where the plane cuts an ellipsoid along LPS.
  void round(const glm::dvec3& center, const glm::dvec3& radii, ImU32 colour, float thick) const {
    const PlaneKind& kind = plane_kinds()[plane];
    const glm::dvec3 normal = glm::abs(glm::cross(kind.u, kind.v));
    const double share = across_mm(center) / glm::dot(normal, radii);
    if (std::abs(share) >= 1.0) return;
    const double within = std::sqrt(1.0 - share * share) / editor.view.mm_per_pixel();
    const double wide = within * glm::dot(glm::abs(kind.u), radii),
                 high = within * glm::dot(glm::abs(kind.v), radii);
    const ImVec2 middle = at(center);
    std::array<ImVec2, kCorners> line;
    for (int i = 0; i < kCorners; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / kCorners;
      line[static_cast<std::size_t>(i)] = {middle.x + static_cast<float>(wide * std::cos(angle)),
                                           middle.y + static_cast<float>(high * std::sin(angle))};
    }
    draw->AddPolyline(line.data(), kCorners, colour, ImDrawFlags_Closed, thick);
    cross(middle, colour);
  }
  void cross(const ImVec2& middle, ImU32 colour) const {
    draw->AddLine({middle.x - 4.0F, middle.y}, {middle.x + 4.0F, middle.y}, colour);
    draw->AddLine({middle.x, middle.y - 4.0F}, {middle.x, middle.y + 4.0F}, colour);
  }
  void tube(const cases::Tube& tube, ImU32 colour) const {
    const auto radius_px = static_cast<float>(tube.radius_mm / editor.view.mm_per_pixel());
    for (std::size_t i = 0; i < tube.points_lps_mm.size(); ++i) {
      const ImVec2 middle = at(tube.points_lps_mm[i]);
      if (i > 0) draw->AddLine(at(tube.points_lps_mm[i - 1]), middle, colour, 1.0F);
      if (std::abs(across_mm(tube.points_lps_mm[i])) <= tube.radius_mm)
        draw->AddCircle(middle, std::max(2.0F, radius_px), colour, 24, 1.0F);
      draw->AddCircleFilled(middle, 3.5F, colour, 10);
    }
  }
  void shape(const cases::Shape& drawn, ImU32 colour) const {
    if (const auto* sphere = std::get_if<cases::Sphere>(&drawn))
      round(sphere->center_lps_mm, glm::dvec3(sphere->radius_mm), colour, 1.5F);
    if (const auto* ellipsoid = std::get_if<cases::Ellipsoid>(&drawn))
      round(ellipsoid->center_lps_mm, ellipsoid->radii_mm, colour, 1.5F);
    if (const auto* drawn_tube = std::get_if<cases::Tube>(&drawn)) tube(*drawn_tube, colour);
  }
  void words(const ImVec2& where, ImU32 colour, const std::string& text) const {
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    draw->AddRectFilled({where.x - 3.0F, where.y - 1.0F}, {where.x + size.x + 3.0F, where.y + size.y + 1.0F},
                        IM_COL32(0, 0, 0, 140), 2.0F);
    draw->AddText(where, colour, text.c_str());
  }
};

void push(std::vector<double>& list, const glm::dvec3& v) {
  list.insert(list.end(), {v.x, v.y, v.z});
}

}  // namespace

EditorPlanes::EditorPlanes(gpu::Context& context) {
  for (Shown& one : shown_)
    one.picture = std::make_unique<gpu::ScreenPicture>(context, gpu::ScreenPicture::Pixels::grey);
}

void EditorPlanes::begin() {
  for (Shown& one : shown_) {
    one.painted.reset();
    one.asked.clear();
  }
  fitted_ = dragged_ = false;
  pressed_.reset();
  look_ = {};
}

void EditorPlanes::ask(std::size_t plane, const CaseEditor& editor) {
  PlaneWish wish;
  wish.of = look_.of;
  wish.beside = look_.beside;
  const auto forms = editor.shown_lesions();
  for (std::size_t i = 0; i < forms.size(); ++i) {
    cases::Lesion lesion;
    if (!cases::is_plain(forms[i])) continue;  // it is in the volume
    lesion.center_lps_mm = forms[i].center_lps_mm;
    lesion.radius_mm = forms[i].radii_mm.x;
    lesion.hu = forms[i].hu;
    wish.lesions.push_back(lesion);
  }
  wish.frame = editor.view.frame(plane, size_px_);
  wish.width_px = static_cast<int>(size_px_.x);
  wish.height_px = static_cast<int>(size_px_.y);
  wish.window = editor.view.window;
  std::vector<double> asked = {static_cast<double>(wish.of->number),
                               wish.beside ? static_cast<double>(wish.beside->number) : 0.0,
                               wish.frame.size_mm.x,
                               wish.frame.size_mm.y,
                               wish.window.center_hu,
                               wish.window.width_hu};
  push(asked, wish.frame.corner_lps_mm);
  for (const cases::Lesion& lesion : wish.lesions) {
    push(asked, lesion.center_lps_mm);
    asked.insert(asked.end(), {lesion.radius_mm, lesion.hu});
  }
  if (asked == shown_[plane].asked) return;
  shown_[plane].asked = std::move(asked);
  painter_.wish(plane, std::move(wish));
}

void EditorPlanes::draw_picture(std::size_t plane, const CaseEditor& editor, const ImVec2& corner) {
  Shown& shown = shown_[plane];
  if (auto painted = painter_.take(plane)) {
    shown.picture->show(painted->ct.width_px, painted->ct.height_px, painted->ct.grey);
    shown.painted = std::move(painted);
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (!shown.painted) {
    draw->AddText({corner.x + 12.0F, corner.y + 10.0F}, kWords, "the case is being loaded …");
    return;
  }
  // What was painted may be a moment old: it is shown where it belongs now.
  const Pen pen{editor, plane, size_px_, corner};
  const PlaneFrame& frame = shown.painted->frame;
  const ImVec2 low = pen.at(frame.corner_lps_mm);
  const ImVec2 high = pen.at(frame.corner_lps_mm + frame.u * frame.size_mm.x + frame.v * frame.size_mm.y);
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(shown.picture->name())), low, high);
  const auto lines = [&](const std::vector<PlaneSegment>& segments, ImU32 colour) {
    const glm::dvec2 scale(glm::dvec2(high.x - low.x, high.y - low.y) / frame.size_mm);
    const auto at = [&](const glm::dvec2& mm) {
      return ImVec2{low.x + static_cast<float>(mm.x * scale.x), low.y + static_cast<float>(mm.y * scale.y)};
    };
    for (const PlaneSegment& segment : segments) draw->AddLine(at(segment.from_mm), at(segment.to_mm), colour);
  };
  lines(shown.painted->skin_beside, kSkinBeside);
  lines(shown.painted->skin, kSkinLine);
  for (const PlaneOutline& one : shown.painted->structures) lines(one.segments, colour_of_rule(one.rule));
}

void EditorPlanes::draw_case(std::size_t plane, const CaseEditor& editor, const ImVec2& corner) {
  const Pen pen{editor, plane, size_px_, corner};
  const auto lesions = editor.shown_lesions();
  for (std::size_t i = 0; i < lesions.size(); ++i)
    pen.round(lesions[i].center_lps_mm, lesions[i].radii_mm,
              editor.tool == EditorTool::lesion && i == editor.lesion ? kChosen : kLesion, 1.5F);
  const auto structures = editor.shown_structures();
  if (editor.tool == EditorTool::structure)
    for (std::size_t i = 0; i < structures.size(); ++i)
      if (structures[i].kind == casedb::StructureKind::drawn)
        pen.shape(structures[i].drawn, i == editor.structure ? kChosen : colour_of_rule(structures[i].rule));
  if (const auto& entry = editor.row().planned_entry_lps_mm) {
    const ImVec2 from = pen.at(*entry);
    const bool here = std::abs(pen.across_mm(*entry)) <= kNearPlaneMm;
    if (!lesions.empty()) {
      const ImVec2 to = pen.at(lesions.front().center_lps_mm);
      pen.draw->AddLine(from, to, kWay, 1.5F);
      const auto scene = editor.scene();
      if (scene && scene->way)
        for (const session::WayPart& part : scene->way->parts) {
          if (!part.forbidden) continue;
          const glm::dvec3 along = (scene->way->target_lps_mm - scene->way->entry_lps_mm) / scene->way->length_mm;
          pen.draw->AddLine(pen.at(part.place_lps_mm), pen.at(part.place_lps_mm + along * part.length_mm), kWayMet,
                            4.0F);
        }
    }
    if (here)
      pen.draw->AddCircleFilled(from, 5.0F, kWay, 16);
    else
      pen.draw->AddCircle(from, 5.0F, kWay, 16, 1.5F);
  }
  const ImVec2 cursor = pen.at(editor.view.cursor_lps_mm());
  constexpr float kGap = 10.0F;
  const ImVec2 end{corner.x + static_cast<float>(size_px_.x), corner.y + static_cast<float>(size_px_.y)};
  pen.draw->AddLine({corner.x, cursor.y}, {cursor.x - kGap, cursor.y}, kCross);
  pen.draw->AddLine({cursor.x + kGap, cursor.y}, {end.x, cursor.y}, kCross);
  pen.draw->AddLine({cursor.x, corner.y}, {cursor.x, cursor.y - kGap}, kCross);
  pen.draw->AddLine({cursor.x, cursor.y + kGap}, {cursor.x, end.y}, kCross);
}

void EditorPlanes::draw_words(std::size_t plane, const CaseEditor& editor, const ImVec2& corner) {
  const Pen pen{editor, plane, size_px_, corner};
  const PlaneKind& kind = plane_kinds()[plane];
  const float wide = static_cast<float>(size_px_.x), high = static_cast<float>(size_px_.y);
  char text[160];
  const glm::dvec3 normal = glm::abs(glm::cross(kind.u, kind.v));
  std::snprintf(text, sizeof text, "%s  %c %.1f mm", kind.name,
                normal.x > 0.5   ? 'x'
                : normal.y > 0.5 ? 'y'
                                 : 'z',
                glm::dot(normal, editor.view.cursor_lps_mm()));
  pen.words({corner.x + 6.0F, corner.y + 4.0F}, kWords, text);
  if (*look_.caption != '\0') pen.words({corner.x + 6.0F, corner.y + scaled(24.0F)}, kWords, look_.caption);
  pen.words({corner.x + 6.0F, corner.y + 0.5F * high}, kWords, kind.left);
  pen.words({corner.x + wide - scaled(18.0F), corner.y + 0.5F * high}, kWords, kind.right);
  pen.words({corner.x + 0.5F * wide, corner.y + 4.0F}, kWords, kind.upper);
  pen.words({corner.x + 0.5F * wide, corner.y + high - scaled(40.0F)}, kWords, kind.lower);
  // A centimetre.
  const auto cm_px = static_cast<float>(10.0 / editor.view.mm_per_pixel());
  pen.draw->AddLine({corner.x + wide - 10.0F - cm_px, corner.y + 14.0F},
                    {corner.x + wide - 10.0F, corner.y + 14.0F}, kWords, 2.0F);
  const bool by_keys = by_keys_ == plane;
  if (!by_keys && under_mouse_ != plane) return;
  const ImVec2 mouse = ImGui::GetMousePos();
  const glm::dvec3 place = by_keys ? editor.view.cursor_lps_mm()
                                   : editor.view.place(plane, size_px_, {mouse.x - corner.x, mouse.y - corner.y});
  if (look_.of != editor.scene()) {
    const volume::Volume& volume = look_.of->scene.volume;
    const auto hu =
        volume::sample_trilinear(volume, glm::dvec3(volume::voxel_from_lps(volume) * glm::dvec4(place, 1.0)));
    if (!hu) return;
    std::snprintf(text, sizeof text, "%.1f, %.1f, %.1f   %.0f HU", place.x, place.y, place.z, *hu);
    pen.words({corner.x + 6.0F, corner.y + high - scaled(20.0F)}, kWords, text);
    return;
  }
  const auto spot = editor.spot(place);
  if (!spot || !spot->hu) return;
  std::snprintf(text, sizeof text, "%.1f, %.1f, %.1f   %.0f HU   %s   %.0f mm deep", place.x, place.y, place.z,
                *spot->hu, volume::about(spot->tissue).name, spot->depth_mm);
  std::string said = text;
  for (const std::string& one : spot->in) said += "   " + one;
  pen.words({corner.x + 6.0F, corner.y + high - scaled(20.0F)}, kWords, said);
  if (by_keys) say_words(said);
}

void EditorPlanes::take_mouse(std::size_t plane, CaseEditor& editor, const Keys& keys, const ImVec2& corner) {
  const ImGuiIO& io = ImGui::GetIO();
  const ImVec2 mouse = ImGui::GetMousePos();
  const glm::dvec2 at_px(mouse.x - corner.x, mouse.y - corner.y);
  const glm::dvec3 place = editor.view.place(plane, size_px_, at_px);
  const volume::Volume& volume = look_.of->scene.volume;
  if (ImGui::IsItemHovered()) {
    under_mouse_ = plane;
    if (io.MouseWheel != 0.0F) {
      if (keys.control)
        editor.view.zoom(plane, size_px_, at_px, std::pow(0.85, io.MouseWheel));
      else
        editor.view.scroll(volume, plane, static_cast<int>(std::lround(io.MouseWheel)));
    }
  }
  if (ImGui::IsItemActivated() && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    pressed_ = plane;
    pressed_px_ = at_px;
    dragged_ = false;
    editor.grab(plane, place, kReachPx * editor.view.mm_per_pixel());
  }
  if (ImGui::IsItemActive() && (io.MouseDelta.x != 0.0F || io.MouseDelta.y != 0.0F)) {
    if (ImGui::IsMouseDown(ImGuiMouseButton_Right)) editor.view.pan(plane, {io.MouseDelta.x, io.MouseDelta.y});
    if (ImGui::IsMouseDown(ImGuiMouseButton_Middle)) {
      editor.view.window.name = "window";
      editor.view.window.width_hu = std::max(10.0, editor.view.window.width_hu + 2.0 * io.MouseDelta.x);
      editor.view.window.center_hu -= io.MouseDelta.y;
    }
  }
  if (pressed_ != plane) return;
  dragged_ = dragged_ || glm::distance(at_px, pressed_px_) > kClickPx;
  if (dragged_ && editor.grabbed())
    editor.drag(plane, place);
  else if (dragged_ || editor.tool == EditorTool::look || editor.tool == EditorTool::rule ||
           editor.tool == EditorTool::prepare)
    editor.view.set_cursor(volume, place);
  if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) return;
  pressed_.reset();
  if (dragged_ && editor.grabbed())
    editor.let_go();
  else if (!dragged_ && !editor.grabbed())
    editor.click(place);
  else
    editor.drop_grip();
}

void EditorPlanes::draw(std::size_t plane, CaseEditor& editor, EditorLook look, const Keys& keys, float width,
                        float height) {
  look_ = std::move(look);
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  if (plane == 0) under_mouse_.reset();
  ImGui::PushID(static_cast<int>(plane));
  ImGui::InvisibleButton(
      "plane", {width, height},
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  note_item("plane");
  if (plane == 0) by_keys_.reset();
  const bool has_keys = keep_keys();
  if (has_keys) by_keys_ = plane;
  ImGui::PopID();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect(corner, {corner.x + width, corner.y + height}, true);
  draw->AddRectFilled(corner, {corner.x + width, corner.y + height}, IM_COL32(0, 0, 0, 255));
  size_px_ = {std::max(16.0F, std::floor(width)), std::max(16.0F, std::floor(height))};
  if (look_.of) {
    if (!fitted_ && look_.of == editor.scene()) {
      editor.view.fit(editor.scene()->scene.volume, size_px_);
      if (!editor.lesions().empty())
        editor.view.set_cursor(editor.scene()->scene.volume, editor.lesions().front().form.center_lps_mm);
      fitted_ = true;
    }
    take_mouse(plane, editor, keys, corner);
    ask(plane, editor);
  }
  draw_picture(plane, editor, corner);
  if (shown_[plane].painted) {
    draw_case(plane, editor, corner);
    draw_words(plane, editor, corner);
  }
  if (has_keys) {
    const ImVec2 end{corner.x + width, corner.y + height};
    draw->AddRect({corner.x + 1.0F, corner.y + 1.0F}, {end.x - 1.0F, end.y - 1.0F},
                  ImGui::GetColorU32(ImGuiCol_NavHighlight), 0.0F, 0, 3.0F);
    note_focus(plane_kinds()[plane].name);
  }
  draw->PopClipRect();
}

}  // namespace seldinger::app
