#include "app/window/screens/panel_monitor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/window/hands/console_picture.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"

namespace seldinger::app {
namespace {

constexpr ImU32 kCaliper = IM_COL32(255, 220, 90, 255), kMonitorWords = IM_COL32(200, 220, 230, 255),
                kBeam = IM_COL32(240, 70, 50, 255), kNothing = IM_COL32(0, 0, 0, 255);
constexpr float kCaliperReachPx = 9.0F;  // of a caliper's end, for a hand
constexpr double kNoteS = 4.0;

}  // namespace

void MonitorPanel::begin(const cases::Case& scene) {
  kind_ = scene.picture;
  machine_ = scene.fluoroscope;
  machine_state_ = {};
  shown_ = {};
  knobs_.begin(scene.picture);
  calipers_.clear();
  measured_mm_.reset();
  measuring_ = frozen_ = false;
  dose_from_s_ = dose_from_mgy_ = dose_mgy_min_ = 0.0;
  kept_.reset();
  note_.clear();
}

std::optional<Canvas> MonitorPanel::take_kept() {
  std::optional<Canvas> kept;
  kept.swap(kept_);
  return kept;
}

void MonitorPanel::say(std::string note) {
  note_ = std::move(note);
  note_until_s_ = session::clock_s() + kNoteS;
}

void MonitorPanel::keep() {
  if (shown_.picture.width_px < 1) return;
  char text[160];
  const cases::ConsoleSetting& stood = shown_.console;
  switch (kind_.modality) {
    case cases::Modality::ultrasound: {
      char focus[32] = "focus at every depth";
      if (stood.focus_mm > 0.0) std::snprintf(focus, sizeof focus, "focus %.0f mm", stood.focus_mm);
      std::snprintf(text, sizeof text, "%s  %.1f MHz  depth %.0f mm  %s", kind_.probe.c_str(), stood.frequency_mhz,
                    stood.depth_mm, focus);
      break;
    }
    case cases::Modality::mpr:
      std::snprintf(text, sizeof text, "CT slice  %s window  %+.0f mm beside the probe",
                    session::kHuWindows[knobs_.window].name, stood.slice_mm);
      break;
    case cases::Modality::xray:
      std::snprintf(text, sizeof text, "%s %.0f  %s %.0f  %.0f kV %.0f mA",
                    machine_state_.arm.lao_deg < 0.0 ? "RAO" : "LAO", std::abs(machine_state_.arm.lao_deg),
                    machine_state_.arm.cranial_deg < 0.0 ? "CAUD" : "CRAN",
                    std::abs(machine_state_.arm.cranial_deg), machine_state_.last_technique.kv,
                    machine_state_.last_technique.ma);
      break;
  }
  kept_ = console_picture(shown_, knobs_.screen.flip, calipers_, {text, "Simulated - for training only"});
}

// Depths, focus and the probe's marker.
void MonitorPanel::draw_marks(float left, float top, float zoom, float ruler_x) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto y_of = [&](double mm) {
    return top + zoom * static_cast<float>(pixel_of(shown_, false, {0.0, mm}).y + 0.5);
  };
  const float across = zoom * static_cast<float>(shown_.picture.width_px), face = y_of(0.0);
  note_part("depth below the face", left, face, across, y_of(shown_.console.depth_mm) - face);
  for (const double mm : depth_marks_mm(shown_)) {
    const bool is_long = std::lround(mm) % 50 == 0;
    const float y = y_of(mm);
    draw->AddLine({ruler_x - (is_long ? 10.0F : 5.0F), y}, {ruler_x, y}, kMonitorWords);
    if (is_long && mm > 0.0)
      draw->AddText({ruler_x - 34.0F, y - 9.0F}, kMonitorWords, std::to_string(std::lround(0.1 * mm)).c_str());
  }
  if (kind_.modality != cases::Modality::ultrasound) return;
  if (shown_.console.focus_mm > 0.0) {
    const float y = y_of(shown_.console.focus_mm);
    draw->AddTriangleFilled({ruler_x - 14.0F, y}, {ruler_x, y - 7.0F}, {ruler_x, y + 7.0F}, kCaliper);
  }
  // The side of the probe's marker (lateral) is left.
  draw->AddCircleFilled({left + (knobs_.screen.flip ? across - 14.0F : 14.0F), top + 14.0F}, 5.0F, kCaliper);
}

// The picture's item is the last one.
void MonitorPanel::measure(float left, float top, float zoom) {
  const bool flip = knobs_.screen.flip;
  if (measuring_) {
    const ImVec2 mouse = ImGui::GetMousePos();
    const glm::dvec2 at_mm = mm_of(shown_, flip, {(mouse.x - left) / zoom - 0.5F, (mouse.y - top) / zoom - 0.5F});
    if (ImGui::IsItemActivated()) calipers_.press(at_mm, kCaliperReachPx / zoom * shown_.pixel_mm);
    if (ImGui::IsItemActive()) calipers_.drag(at_mm);
    if (ImGui::IsItemDeactivated()) {
      if (const auto caliper = calipers_.held()) measured_mm_ = calipers_.depth_mm(*caliper);
      calipers_.release();
    }
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto place = [&](const glm::dvec2& end_mm) {
    const glm::dvec2 px = pixel_of(shown_, flip, end_mm) + 0.5;
    return ImVec2{left + zoom * static_cast<float>(px.x), top + zoom * static_cast<float>(px.y)};
  };
  const std::vector<glm::dvec2>& ends = calipers_.ends_mm();
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const ImVec2 at = place(ends[i]);
    draw->AddLine({at.x - 6.0F, at.y}, {at.x + 6.0F, at.y}, kCaliper, 1.5F);
    draw->AddLine({at.x, at.y - 6.0F}, {at.x, at.y + 6.0F}, kCaliper, 1.5F);
    if (i % 2 == 0) continue;
    draw->AddLine(place(ends[i - 1]), at, kCaliper, 1.0F);
    const char name[2] = {static_cast<char>('A' + i / 2), '\0'};
    draw->AddText({at.x + 8.0F, at.y - 18.0F}, kCaliper, name);
  }
  float y = top + 26.0F;
  for (const std::string& line : calipers_.words()) {
    draw->AddText({left + 10.0F, y}, kCaliper, line.c_str());
    y += ImGui::GetTextLineHeight() + 2.0F;
  }
}

void MonitorPanel::draw_picture(const session::Monitor& monitor, const cases::State& state, float width,
                                float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("picture", {width, height});
  note_item("picture");
  notches_ = ImGui::IsItemHovered() ? static_cast<int>(std::lround(ImGui::GetIO().MouseWheel)) : 0;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + height};
  const bool xray = kind_.modality == cases::Modality::xray;
  const auto strip = [&](const char* words, float x) {
    draw->AddRectFilled({x, corner.y + height - 26.0F},
                        {x + ImGui::CalcTextSize(words).x + 20.0F, corner.y + height}, IM_COL32(0, 0, 0, 190));
    draw->AddText({x + 10.0F, corner.y + height - 22.0F}, kMonitorWords, words);
  };
  if (picture_.width_px() == 0 || shown_.picture.width_px == 0) {
    draw->AddRectFilled(corner, end, kNothing);
    draw->AddText({corner.x + 12.0F, corner.y + 10.0F}, kMonitorWords,
                  xray ? "no picture yet: hold the pedal (P)" : "no picture yet");
    return;
  }
  const float across = static_cast<float>(picture_.width_px()), down = static_cast<float>(picture_.height_px());
  const float zoom = std::min(width / across, height / down);
  const ImVec2 low{corner.x + 0.5F * (width - zoom * across), corner.y + 0.5F * (height - zoom * down)};
  const ImVec2 high{low.x + zoom * across, low.y + zoom * down};
  // Beside it only: under it, in software, a ground would cost as much again.
  draw->AddRectFilled(corner, {end.x, low.y}, kNothing);
  draw->AddRectFilled({corner.x, high.y}, end, kNothing);
  draw->AddRectFilled({corner.x, low.y}, {low.x, high.y}, kNothing);
  draw->AddRectFilled({high.x, low.y}, {end.x, high.y}, kNothing);
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture_.name())), low, high);
  if (shown_.pixel_mm > 0.0) {
    measure(low.x, low.y, zoom);  // first: it asks for the picture's own item
    draw_marks(low.x, low.y, zoom, corner.x + width - 8.0F);
  }
  if (xray && state.fluoroscopy.beam_on) {
    draw->AddCircleFilled({corner.x + width - 24.0F, corner.y + 22.0F}, 10.0F, kBeam);
    draw->AddText({corner.x + width - 118.0F, corner.y + 13.0F}, kBeam, "X-RAYS ON");
  }
  char words[160];
  std::snprintf(words, sizeof words, "%s  %.0f /s  (%s, %.0f ms)",
                shown_.live ? "LIVE" : (xray ? "LAST IMAGE" : "FROZEN"), shown_.rate_hz, monitor.method().c_str(),
                1e3 * shown_.drawn_in_s);
  strip(words, corner.x);
  if (!note_.empty() && session::clock_s() < note_until_s_)
    strip(note_.c_str(), corner.x + width - ImGui::CalcTextSize(note_.c_str()).x - 20.0F);
}

void MonitorPanel::take_late(session::Monitor& monitor) {
  if (picture_.width_px() > 0 && monitor.take(shown_) && shown_.picture.width_px > 0)
    picture_.show(shown_.picture.width_px, shown_.picture.height_px, shown_.picture.grey);
}

void MonitorPanel::draw(session::Monitor& monitor, const cases::State& state, bool frozen, const Keys& keys,
                        HandsTold* told) {
  if (monitor.take(shown_) && shown_.picture.width_px > 0)
    picture_.show(shown_.picture.width_px, shown_.picture.height_px, shown_.picture.grey);
  machine_state_ = state.fluoroscopy;
  if (frozen_ && !frozen) calipers_.clear();  // what was measured moves on
  frozen_ = frozen;
  if (told == nullptr) knobs_.stand(state.probe.console);
  cases::FluoroscopeInputs asked;
  if (told != nullptr) {
    asked = told->fluoroscope;
  } else {
    asked.collimator = machine_state_.collimator;
    asked.magnification = machine_state_.magnification;
    asked.pulse_rate = machine_state_.pulse_rate;
    asked.hand_away = machine_state_.hand_away;
  }
  read_keys(monitor, frozen, told == nullptr, keys);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  draw_picture(monitor, state, room.x, room.y - console_height(asked));
  if (notches_ != 0) roll(monitor, notches_, frozen, told == nullptr);
  if (kind_.modality == cases::Modality::ultrasound) draw_ultrasound(monitor, frozen, told != nullptr);
  if (kind_.modality == cases::Modality::mpr) draw_slices(monitor, frozen, told != nullptr);
  if (kind_.modality == cases::Modality::xray) {
    ImGui::BeginDisabled(told == nullptr);
    draw_fluoroscope(state, keys, asked);
    ImGui::EndDisabled();
  }
  if (told == nullptr) return;
  told->console = knobs_.asked();
  told->fluoroscope = asked;
}

}  // namespace seldinger::app
