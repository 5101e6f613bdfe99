#include "app/train/panel_monitor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/train/panels.h"

namespace seldinger::app {
namespace {

constexpr ImU32 kCaliper = IM_COL32(255, 220, 90, 255), kWords = IM_COL32(200, 220, 230, 255),
                kNothing = IM_COL32(0, 0, 0, 255);

// A knob that turns by dragging; double click types a number.
bool knob(const char* label, double& value, double low, double high, const char* format, float width) {
  auto shown = static_cast<float>(value);
  ImGui::SetNextItemWidth(width);
  const bool turned = ImGui::SliderFloat(label, &shown, static_cast<float>(low), static_cast<float>(high), format);
  if (turned) value = shown;
  return turned;
}

}  // namespace

void MonitorPanel::begin(const cases::Case& scene) {
  kind_ = scene.picture;
  shown_ = {};
  knobs_ = {};
  calipers_px_.clear();
  measuring_ = false;
}

void MonitorPanel::measure(const std::array<float, 2>& at_px) {
  if (calipers_px_.size() >= 4) calipers_px_.clear();
  calipers_px_.push_back(at_px);
}

void MonitorPanel::draw_picture(const Monitor& monitor, float width, float height) {
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::InvisibleButton("picture", {width, height});
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImVec2 end{corner.x + width, corner.y + height};
  if (picture_.width_px() == 0) {
    draw->AddRectFilled(corner, end, kNothing);
    draw->AddText({corner.x + 12.0F, corner.y + 10.0F}, kWords, "no picture yet");
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
  if (shown_.pixel_mm > 0.0) {  // depth marks every centimetre
    const auto depth_px = [&](double mm) {
      return low.y + zoom * static_cast<float>((mm - shown_.top_mm) / shown_.pixel_mm);
    };
    const float x = corner.x + width - 8.0F;
    for (int cm = 0; 10.0 * cm <= kind_.depth_mm; ++cm) {
      const float y = depth_px(10.0 * cm), long_px = cm % 5 == 0 ? 10.0F : 5.0F;
      draw->AddLine({x - long_px, y}, {x, y}, kWords);
      if (cm % 5 == 0 && cm > 0) draw->AddText({x - 34.0F, y - 9.0F}, kWords, std::to_string(cm).c_str());
    }
    // The mark of the probe's marker side (lateral) stands left.
    draw->AddCircleFilled({low.x + (knobs_.flip ? zoom * across - 14.0F : 14.0F), corner.y + 14.0F}, 5.0F,
                          kCaliper);
  }
  char words[160];
  std::snprintf(words, sizeof words, "%s  %.0f /s  (%s, %.0f ms)",
                shown_.live ? "LIVE" : (kind_.modality == cases::Modality::xray ? "LAST IMAGE" : "FROZEN"),
                shown_.rate_hz, monitor.method().c_str(), 1e3 * shown_.drawn_in_s);
  const ImVec2 size = ImGui::CalcTextSize(words);
  draw->AddRectFilled({corner.x, corner.y + height - 26.0F}, {corner.x + size.x + 20.0F, corner.y + height},
                      IM_COL32(0, 0, 0, 190));
  draw->AddText({corner.x + 10.0F, corner.y + height - 22.0F}, kWords, words);
  if (ImGui::IsItemClicked() && measuring_) {
    const ImVec2 mouse = ImGui::GetMousePos();
    measure({(mouse.x - low.x) / zoom, (mouse.y - low.y) / zoom});
  }
  for (std::size_t i = 0; i < calipers_px_.size(); ++i) {
    const ImVec2 at{low.x + zoom * calipers_px_[i][0], low.y + zoom * calipers_px_[i][1]};
    draw->AddLine({at.x - 6.0F, at.y}, {at.x + 6.0F, at.y}, kCaliper, 1.5F);
    draw->AddLine({at.x, at.y - 6.0F}, {at.x, at.y + 6.0F}, kCaliper, 1.5F);
    if (i % 2 == 0 || shown_.pixel_mm <= 0.0) continue;
    const ImVec2 from{low.x + zoom * calipers_px_[i - 1][0], low.y + zoom * calipers_px_[i - 1][1]};
    draw->AddLine(from, at, kCaliper, 1.0F);
    const double mm = shown_.pixel_mm * std::hypot(calipers_px_[i][0] - calipers_px_[i - 1][0],
                                                   calipers_px_[i][1] - calipers_px_[i - 1][1]);
    std::snprintf(words, sizeof words, "%.1f mm", mm);
    draw->AddText({at.x + 8.0F, at.y - 18.0F}, kCaliper, words);
  }
}

void MonitorPanel::draw_ultrasound(Monitor& monitor, bool frozen) {
  const float wide = ImGui::GetContentRegionAvail().x;
  bool turned =
      knob("##gain", knobs_.gain_db, -imaging::kMostGainDb, imaging::kMostGainDb, "gain %.0f dB", 0.32F * wide);
  ImGui::SameLine();
  turned = knob("##range", knobs_.dynamic_range_db, imaging::kLeastRangeDb, imaging::kMostRangeDb, "range %.0f dB",
                0.32F * wide) ||
           turned;
  ImGui::SameLine();
  static constexpr const char* kMaps[] = {"linear", "lifted", "contrast"};
  int map = static_cast<int>(knobs_.grey_map);
  ImGui::SetNextItemWidth(0.20F * wide);
  if (ImGui::Combo("##map", &map, kMaps, 3)) {
    knobs_.grey_map = static_cast<imaging::GreyMap>(map);
    turned = true;
  }
  ImGui::SameLine();
  turned = ImGui::Checkbox("flip", &knobs_.flip) || turned;
  for (std::size_t i = 0; i < knobs_.tgc_db.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));
    turned = knob("##tgc", knobs_.tgc_db[i], -imaging::kMostTgcDb, imaging::kMostTgcDb, "%.0f",
                  wide / static_cast<float>(knobs_.tgc_db.size()) - 9.0F) ||
             turned;
    ImGui::PopID();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("time gain, from the skin to the depth");
  }
  if (turned)
    monitor.set_console([knobs = knobs_](imaging::Console& console) {
      console.set_gain_db(knobs.gain_db);
      console.set_dynamic_range_db(knobs.dynamic_range_db);
      console.set_grey_map(knobs.grey_map);
      console.set_flip(knobs.flip);
      for (std::size_t i = 0; i < knobs.tgc_db.size(); ++i) console.set_tgc_db(i, knobs.tgc_db[i]);
    });
  ImGui::BeginDisabled(!frozen || shown_.cine_pictures < 2);
  int back = -shown_.cine_back;
  ImGui::SetNextItemWidth(0.45F * wide);
  if (ImGui::SliderInt("##cine", &back, -std::max(1, shown_.cine_pictures - 1), 0, "cine %d"))
    monitor.set_console([back](imaging::Console& console) { console.scroll(-back); });
  ImGui::EndDisabled();
  ImGui::SameLine();
  if (ImGui::Button(measuring_ ? "Done" : "Calipers")) {
    measuring_ = !measuring_;
    if (measuring_) calipers_px_.clear();
  }
  ImGui::SameLine();
  char words[96];
  std::snprintf(words, sizeof words, "%s  %.0f mm", kind_.probe.c_str(), kind_.depth_mm);
  quiet(words);
}

void MonitorPanel::draw_fluoroscope(const cases::State& state, cases::FluoroscopeInputs& asked) {
  const cases::FluoroscopyState& machine = state.fluoroscopy;
  ImGui::Button("Pedal (P)");
  asked.pedal = ImGui::IsItemActive();
  ImGui::SameLine();
  ImGui::Checkbox("hand away (H)", &asked.hand_away);
  ImGui::SameLine();
  ImGui::Checkbox("automatic", &asked.automatic_exposure);
  const float wide = ImGui::GetContentRegionAvail().x;
  static constexpr const char* kRates[] = {"3 /s", "7.5 /s", "15 /s"};
  ImGui::SetNextItemWidth(0.22F * wide);
  ImGui::Combo("##rate", &asked.pulse_rate, kRates, 3);
  ImGui::SameLine();
  static constexpr const char* kFields[] = {"30 cm", "20 cm", "15 cm"};
  ImGui::SetNextItemWidth(0.22F * wide);
  ImGui::Combo("##field", &asked.magnification, kFields, 3);
  ImGui::SameLine();
  knob("##across", asked.collimator.open_u, cases::kCollimatorMin, 1.0, "across %.2f", 0.25F * wide);
  ImGui::SameLine();
  knob("##along", asked.collimator.open_v, cases::kCollimatorMin, 1.0, "along %.2f", 0.25F * wide);
  if (!asked.automatic_exposure) {
    knob("##kv", asked.kv, 50.0, 120.0, "%.0f kV", 0.48F * wide);
    ImGui::SameLine();
    knob("##ma", asked.ma, 2.0, 250.0, "%.0f mA", 0.48F * wide);
  }
  ImGui::Text("%s %.0f°  %s %.0f°   %.0f kV %.0f mA", machine.arm.lao_deg < 0.0 ? "RAO" : "LAO",
              std::abs(machine.arm.lao_deg), machine.arm.cranial_deg < 0.0 ? "CAUD" : "CRAN",
              std::abs(machine.arm.cranial_deg), machine.last_technique.kv, machine.last_technique.ma);
  ImGui::Text("beam %.1f s   %.2f mGy   %.0f mGy·cm²", machine.fluoroscopy_time_s, machine.air_kerma_mgy,
              machine.dap_mgy_cm2);
}

void MonitorPanel::take_late(Monitor& monitor) {
  if (picture_.width_px() > 0 && monitor.take(shown_) && shown_.picture.width_px > 0)
    picture_.show(shown_.picture.width_px, shown_.picture.height_px, shown_.picture.grey);
}

void MonitorPanel::draw(Monitor& monitor, const cases::State& state, bool frozen,
                        cases::FluoroscopeInputs& fluoroscope) {
  if (monitor.take(shown_) && shown_.picture.width_px > 0)
    picture_.show(shown_.picture.width_px, shown_.picture.height_px, shown_.picture.grey);
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const float console = kind_.modality == cases::Modality::mpr ? 4.0F : 116.0F;
  draw_picture(monitor, room.x, room.y - console);
  if (kind_.modality == cases::Modality::ultrasound) draw_ultrasound(monitor, frozen);
  if (kind_.modality == cases::Modality::xray) draw_fluoroscope(state, fluoroscope);
}

}  // namespace seldinger::app
