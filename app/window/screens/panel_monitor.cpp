#include "app/window/screens/panel_monitor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "app/window/hands/act_words.h"
#include "app/window/hands/console_picture.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"

namespace seldinger::app {
namespace {

constexpr ImU32 kCaliper = IM_COL32(255, 220, 90, 255), kMonitorWords = IM_COL32(200, 220, 230, 255),
                kBeam = IM_COL32(240, 70, 50, 255), kNothing = IM_COL32(0, 0, 0, 255),
                kLit = IM_COL32(80, 220, 110, 255), kFired = IM_COL32(255, 220, 90, 255),
                kGuideLine = IM_COL32(90, 220, 255, 200);
constexpr float kCaliperReachPx = 9.0F;  // of a caliper's end, for a hand
constexpr float kRulerPx = 48.0F;        // beside the picture: focus, marks and numbers
constexpr double kNoteS = 4.0;

// In a line of words, before them.
void lamp(ImU32 colour, bool lit) {
  constexpr float kLampPx = 5.0F;
  const float high = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos(), middle{at.x + kLampPx + 1.0F, at.y + 0.5F * high + 1.0F};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (lit)
    draw->AddCircleFilled(middle, kLampPx, colour);
  else
    draw->AddCircle(middle, kLampPx, colour);
  ImGui::Dummy({2.0F * kLampPx + 2.0F, high});
  ImGui::SameLine();
}

}  // namespace

void MonitorPanel::begin(const cases::Case& scene) {
  kind_ = scene.picture;
  fire_words_ = fire_words(scene.instrument);
  machine_ = scene.fluoroscope;
  machine_state_ = {};
  panel_ = 0;
  shown_ = {};
  knobs_.begin(scene.picture);
  colour_words_ = colour_words(scene.structures);
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
  kept_ = console_picture(shown_, knobs_.screen.flip, calipers_, {text, "Simulated", kTrainingOnly});
}

// Depths in centimetres and focus, beside the picture; the probe's marker, in its corner.
void MonitorPanel::draw_marks(float left, float top, float zoom) {
  constexpr float kFocusPx = 9.0F, kShortPx = 4.0F, kLongPx = 7.0F;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const auto y_of = [&](double mm) {
    return top + zoom * static_cast<float>(pixel_of(shown_, false, {0.0, mm}).y + 0.5);
  };
  const float across = zoom * static_cast<float>(shown_.picture.width_px), face = y_of(0.0);
  note_part("depth below the face", left, face, across, y_of(shown_.console.depth_mm) - face);
  const float ruler = left + across + kFocusPx + 2.0F, half = 0.5F * ImGui::GetTextLineHeight();
  const int every = numbered_every(10.0 * zoom / shown_.pixel_mm);
  for (const double mm : depth_marks_mm(shown_)) {
    const long cm = std::lround(0.1 * mm);
    const bool is_long = cm % every == 0;
    const float y = y_of(mm);
    draw->AddLine({ruler, y}, {ruler + (is_long ? kLongPx : kShortPx), y}, kMonitorWords);
    if (!is_long) continue;
    const std::string number = cm == 0 ? "cm" : std::to_string(cm);
    const float words_y = std::max(y - half, top);  // a straight face stands at the picture's edge
    draw->AddText({ruler + kLongPx + 2.0F, words_y}, kMonitorWords, number.c_str());
    note_part(("depth " + number).c_str(), ruler, words_y, scaled(kRulerPx) - kFocusPx, 2.0F * half);
  }
  if (kind_.modality != cases::Modality::ultrasound) return;
  if (shown_.console.focus_mm > 0.0) {
    const float y = y_of(shown_.console.focus_mm);
    draw->AddTriangleFilled({ruler - kFocusPx, y}, {ruler - 1.0F, y - 6.0F}, {ruler - 1.0F, y + 6.0F}, kCaliper);
    note_part("focus mark", ruler - kFocusPx, y - 6.0F, kFocusPx, 12.0F);
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

// How the picture comes, what was fired, and a note, in a row of their own: nothing lies over the picture.
void MonitorPanel::draw_status(const session::Monitor& monitor, const cases::State& state) {
  const bool xray = kind_.modality == cases::Modality::xray;
  const bool noted = !note_.empty() && session::clock_s() < note_until_s_;
  const char* how = shown_.live ? "LIVE" : (xray ? "LAST IMAGE" : "FROZEN");
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 8.0F);
  if (shown_.picture.width_px < 1)
    ImGui::TextUnformatted(xray ? "no picture yet: hold the pedal (P)" : "no picture yet");
  else
    ImGui::Text("%s  %.0f /s", how, shown_.rate_hz);
  if (state.fire.fired && state.needle.skin.in_body) {
    ImGui::SameLine();
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(kFired), "%s", fire_words_.c_str());
    note_item((fire_words_ + " at the picture").c_str());
  }
  if (xray && state.fluoroscopy.beam_on) {
    ImGui::SameLine();
    lamp(kBeam, true);
    ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(kBeam), "X-RAYS ON");
    note_item("X-RAYS ON");
  }
  if (noted) {
    ImGui::SameLine();
    ImGui::TextUnformatted(note_.c_str());
    note_item("note");
  } else if (shown_.picture.width_px > 0) {
    ImGui::SameLine();
    ImGui::TextDisabled("%s, %.0f ms", monitor.method().c_str(), 1e3 * shown_.drawn_in_s);
  }
}

// What is recorded of the newest picture, for who is still helped.
void MonitorPanel::draw_lamps(const std::optional<cases::FrameTruth>& frame) {
  constexpr float kLampsLetters = 25.0F;  // wide: both with their whole words
  const bool whole = ImGui::GetContentRegionAvail().x > kLampsLetters * ImGui::GetFontSize();
  const auto tell = [&](bool lit, const char* what, const char* words) {
    lamp(lit ? kLit : kMonitorWords, lit);
    ImGui::TextUnformatted(whole ? words : what);
    note_item(words);
  };
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + 8.0F);
  if (!frame || !frame->live) {
    const char* words = frame ? "the picture is frozen" : "no picture yet";
    ImGui::TextDisabled("%s", words);
    note_item(words);
    return;
  }
  tell(frame->needle_tip, "tip", frame->needle_tip ? "tip in the picture" : "tip not in the picture");
  ImGui::SameLine(0.0F, 20.0F);
  tell(frame->target, "target", frame->target ? "target in the picture" : "target not in the picture");
}

// The guide's line, as a machine draws it of a guide that it knows: by the probe alone, whatever the needle does.
// Two dotted lines, so that neither lies over the needle between them; a larger dot each centimetre.
void MonitorPanel::draw_guide(const devices::ProbeGuide& guide, float left, float top, float zoom) {
  constexpr double kStepMm = 2.5, kAsideMm = 3.0;
  constexpr int kStepsPerDot = 4;
  const double angle = guide.angle_deg * (std::numbers::pi / 180.0);
  const glm::dvec2 along{-std::copysign(std::sin(angle), guide.offset_mm), std::cos(angle)};
  const glm::dvec2 aside{along.y, -along.x};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float across = zoom * static_cast<float>(shown_.picture.width_px),
              down = zoom * static_cast<float>(shown_.picture.height_px);
  for (int step = 0; kStepMm * step * along.y <= shown_.console.depth_mm; ++step)
    for (const double side_mm : {-kAsideMm, kAsideMm}) {
      const glm::dvec2 at_mm = glm::dvec2(guide.offset_mm, 0.0) + kStepMm * step * along + side_mm * aside;
      const glm::dvec2 px = pixel_of(shown_, knobs_.screen.flip, at_mm) + 0.5;
      const ImVec2 at{left + zoom * static_cast<float>(px.x), top + zoom * static_cast<float>(px.y)};
      if (at.x < left || at.x > left + across || at.y > top + down) continue;
      draw->AddCircleFilled(at, step % kStepsPerDot == 0 ? 2.5F : 1.2F, kGuideLine);
    }
  note_part("guide line", left, top, across, down);
}

// The picture's item is the last one. Dragged, colour's box has its middle there; twice clicked, it is nearly all
// of the picture again.
void MonitorPanel::move_colour_box(float left, float top, float zoom) {
  if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
    return knobs_.place_box(0.0, 0.0);
  if (!ImGui::IsItemActive() || !ImGui::IsMouseDragging(ImGuiMouseButton_Left)) return;
  const ImVec2 mouse = ImGui::GetMousePos();
  const glm::dvec2 at_mm =
      mm_of(shown_, knobs_.screen.flip, {(mouse.x - left) / zoom - 0.5F, (mouse.y - top) / zoom - 0.5F});
  const imaging::UltrasoundView view = knobs_.view();
  const imaging::BeamAndDepth at = imaging::beam_and_depth(view, at_mm.x, at_mm.y);
  constexpr double kInside = 0.01;  // 0 would be all of it
  knobs_.place_box(std::clamp((at.beam + 0.5) / view.beams, kInside, 1.0),
                   std::clamp(at.depth_mm / view.depth_mm, kInside, 1.0));
}

void MonitorPanel::draw_picture(const Seen& seen, float width, float height, bool turns) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("picture", {width, height});
  note_item("picture");
  notches_ = ImGui::IsItemHovered() ? static_cast<int>(std::lround(ImGui::GetIO().MouseWheel)) : 0;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + height};
  if (picture().width_px() == 0 || shown_.picture.width_px == 0) {
    draw->AddRectFilled(corner, end, kNothing);
    return;
  }
  const float across = static_cast<float>(picture().width_px()), down = static_cast<float>(picture().height_px());
  const float ruler = shown_.pixel_mm > 0.0 ? scaled(kRulerPx) : 0.0F;
  const float zoom = std::min((width - ruler) / across, height / down);
  const ImVec2 low{corner.x + 0.5F * (width - ruler - zoom * across), corner.y + 0.5F * (height - zoom * down)};
  const ImVec2 high{low.x + zoom * across, low.y + zoom * down};
  // Beside it only: under it, in software, a ground would cost as much again.
  draw->AddRectFilled(corner, {end.x, low.y}, kNothing);
  draw->AddRectFilled({corner.x, high.y}, end, kNothing);
  draw->AddRectFilled({corner.x, low.y}, {low.x, high.y}, kNothing);
  draw->AddRectFilled({high.x, low.y}, {end.x, high.y}, kNothing);
  draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(picture().name())), low, high);
  if (shown_.pixel_mm > 0.0) {
    if (turns && !frozen_ && !measuring_ && kind_.modality == cases::Modality::ultrasound &&
        knobs_.asked().colour_mm_s > 0.0)
      move_colour_box(low.x, low.y, zoom);  // first: both ask for the picture's own item
    measure(low.x, low.y, zoom);
    draw_marks(low.x, low.y, zoom);
    if (seen.guide) draw_guide(*seen.guide, low.x, low.y, zoom);
  }
  draw_flash(seen.moment.state, corner.x, corner.y, width, height);
}

// A frame about the picture that fades: what the picture shows of the throw stays to be seen.
void MonitorPanel::draw_flash(const cases::State& state, float left, float top, float width, float height) {
  constexpr float kFramePx = 8.0F;
  const double since_s = state.t_s - state.fire.t_s;
  if (!state.fire.fired || since_s < 0.0 || since_s >= kFlashS) return;
  ImVec4 colour = ImGui::ColorConvertU32ToFloat4(kFired);
  colour.w = static_cast<float>(1.0 - since_s / kFlashS);
  const float half = 0.5F * kFramePx;
  ImGui::GetWindowDrawList()->AddRect({left + half, top + half}, {left + width - half, top + height - half},
                                      ImGui::ColorConvertFloat4ToU32(colour), 0.0F, 0, kFramePx);
  note_part("flash", left, top, width, height);
}

void MonitorPanel::put_on_screen() {
  const session::GreyPicture& shown = shown_.picture;
  if (shown.colour.empty())
    picture_.show(shown.width_px, shown.height_px, shown.grey);
  else
    coloured_.show(shown.width_px, shown.height_px, session::rgba_of(shown));
}

void MonitorPanel::take_late(session::Monitor& monitor) {
  if (picture().width_px() > 0 && monitor.take(shown_) && shown_.picture.width_px > 0) put_on_screen();
}

void MonitorPanel::draw(session::Monitor& monitor, const Seen& seen, bool lamps, const Keys& keys,
                        HandsTold* told) {
  const cases::State& state = seen.moment.state;
  const bool frozen = seen.frozen;
  if (monitor.take(shown_) && shown_.picture.width_px > 0) put_on_screen();
  machine_state_ = state.fluoroscopy;
  if (frozen_ && !frozen) calipers_.clear();  // what was measured moves on
  frozen_ = frozen;
  if (told == nullptr) knobs_.stand(state.probe.console);
  const bool xray = kind_.modality == cases::Modality::xray;
  read_keys(monitor, frozen, told == nullptr, keys);
  if (xray && told != nullptr) read_fluoroscope(keys, told->fluoroscope);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float lines = 1.0F + (lamps ? 1.0F : 0.0F) + (xray ? 2.0F : 0.0F);
  draw_picture(seen, room.x, room.y - lines * ImGui::GetTextLineHeightWithSpacing(), told != nullptr);
  draw_status(monitor, state);
  if (lamps) draw_lamps(seen.frame);
  if (xray) draw_exposure(machine_state_);
  if (notches_ != 0) roll(monitor, notches_, frozen, told == nullptr);
  if (told != nullptr) told->console = knobs_.asked();
}

cases::FluoroscopeInputs MonitorPanel::asked_of(const HandsTold* told) const {
  if (told != nullptr) return told->fluoroscope;
  cases::FluoroscopeInputs asked;
  asked.collimator = machine_state_.collimator;
  asked.magnification = machine_state_.magnification;
  asked.pulse_rate = machine_state_.pulse_rate;
  asked.hand_away = machine_state_.hand_away;
  return asked;
}

void MonitorPanel::draw_console(session::Monitor& monitor, const Seen& seen, HandsTold* told) {
  const bool turns = told != nullptr;
  if (kind_.modality == cases::Modality::ultrasound) draw_ultrasound(monitor, seen.frozen, turns);
  if (kind_.modality == cases::Modality::mpr) draw_slices(monitor, seen.frozen, turns);
  cases::FluoroscopeInputs asked = asked_of(told);
  if (kind_.modality == cases::Modality::xray) {
    ImGui::BeginDisabled(!turns);
    draw_fluoroscope(monitor, asked);
    ImGui::EndDisabled();
  }
  if (!turns) return;
  told->console = knobs_.asked();
  told->fluoroscope = asked;
}

}  // namespace seldinger::app
