// The consoles of the three machines below the picture: knobs, and the keys that do the same.
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "app/window/screens/panel_monitor.h"
#include "app/window/screens/panels.h"
#include "app/window/surface/panel_items.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/imaging/ultrasound/colour.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::app {
namespace {

struct TurningKey {
  int key;
  ConsoleTurn turn;
};
constexpr std::array<TurningKey, 15> kUltrasoundKeys = {{{kUp, ConsoleTurn::depth_less},
                                                         {kDown, ConsoleTurn::depth_more},
                                                         {'[', ConsoleTurn::focus_less},
                                                         {']', ConsoleTurn::focus_more},
                                                         {',', ConsoleTurn::frequency_less},
                                                         {'.', ConsoleTurn::frequency_more},
                                                         {'9', ConsoleTurn::gain_less},
                                                         {'0', ConsoleTurn::gain_more},
                                                         {';', ConsoleTurn::range_less},
                                                         {'\'', ConsoleTurn::range_more},
                                                         {'B', ConsoleTurn::next_map},
                                                         {'X', ConsoleTurn::flip},
                                                         {'V', ConsoleTurn::colour},
                                                         {'Z', ConsoleTurn::compound},
                                                         {'C', ConsoleTurn::next_preset}}};
constexpr std::array<TurningKey, 3> kSliceKeys = {
    {{kUp, ConsoleTurn::slice_back}, {kDown, ConsoleTurn::slice_on}, {'C', ConsoleTurn::next_window}}};

// A press of a key at the fluoroscope (design).
constexpr double kBladeStep = 0.05, kKvStep = 5.0, kMaStep = 1.25;  // the current: times
constexpr double kDoseOverS = 0.5;                                  // of beam, over which its rate is told

// A knob that turns by dragging; Ctrl and a click types a number.
bool knob(const char* label, double& value, double low, double high, const char* format, float width) {
  auto shown = static_cast<float>(value);
  ImGui::SetNextItemWidth(width);
  const bool turned = ImGui::SliderFloat(label, &shown, static_cast<float>(low), static_cast<float>(high), format,
                                         ImGuiSliderFlags_AlwaysClamp);
  note_item("knob");
  if (turned) value = shown;
  return turned;
}

void tip(const char* words) {
  if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) ImGui::SetTooltip("%s", words);
}

// Whether a console so wide has its knobs in half as many rows: below that numbers are cut, or lie under handles.
bool in_two_rows(float width) {
  return width >= 52.0F * ImGui::GetFontSize();
}
bool in_one_row(float width) {
  return width >= 68.0F * ImGui::GetFontSize();
}

}  // namespace

float MonitorPanel::console_height(float width, const HandsTold* told) const {
  const float row = ImGui::GetFrameHeightWithSpacing();
  switch (kind_.modality) {
    case cases::Modality::ultrasound:
      return (in_two_rows(width) ? 2.0F : 4.0F) * row;
    case cases::Modality::mpr:
      return row;
    case cases::Modality::xray:
      return ((in_one_row(width) ? 1.0F : 2.0F) + (asked_of(told).automatic_exposure ? 0.0F : 1.0F)) * row;
  }
  return 0.0F;
}

void MonitorPanel::tell(session::Monitor& monitor) const {
  if (kind_.modality == cases::Modality::ultrasound)
    monitor.set_console([knobs = knobs_](imaging::Console& console) { knobs.apply(console); });
  if (kind_.modality == cases::Modality::mpr) monitor.set_window(session::kHuWindows[knobs_.window]);
  if (kind_.modality == cases::Modality::xray) monitor.set_panel(static_cast<imaging::Panel>(panel_));
}

void MonitorPanel::read_keys(session::Monitor& monitor, bool frozen, bool watched, const Keys& keys) {
  if (keys.pressed('T')) keep();
  if (kind_.modality == cases::Modality::xray) return;
  if (keys.pressed('R')) {
    measuring_ = !measuring_;
    if (measuring_) calipers_.clear();
  }
  bool turned = false;
  const auto read = [&](const auto& table) {
    for (const TurningKey& one : table)
      if (keys.pressed(one.key)) {
        knobs_.turn(one.turn, frozen || watched);
        turned = true;
      }
  };
  if (kind_.modality == cases::Modality::ultrasound)
    read(kUltrasoundKeys);
  else
    read(kSliceKeys);
  if (turned) tell(monitor);
  if (!frozen || watched || kind_.modality != cases::Modality::ultrasound) return;
  const int back = (keys.pressed(kLeft) ? 1 : 0) - (keys.pressed(kRight) ? 1 : 0);
  if (back != 0)
    monitor.set_console([back](imaging::Console& console) { console.scroll(console.scrolled() + back); });
}

void MonitorPanel::roll(session::Monitor& monitor, int notches, bool frozen, bool watched) {
  if (watched) return;
  if (kind_.modality == cases::Modality::mpr && !frozen) knobs_.set_slice_mm(knobs_.asked().slice_mm - notches);
  if (kind_.modality == cases::Modality::ultrasound && frozen)
    monitor.set_console([notches](imaging::Console& console) { console.scroll(console.scrolled() + notches); });
}

void MonitorPanel::draw_calipers_and_keep(bool calipers) {
  if (calipers) {
    if (ImGui::Button(measuring_ ? "Done (R)" : "Calipers (R)")) {
      measuring_ = !measuring_;
      if (measuring_) calipers_.clear();
    }
    tip("click both ends, drag to correct; two lines also give the ellipse they span");
    ImGui::SameLine();
  }
  if (ImGui::Button("Save (T)")) keep();
  tip("keeps this picture as PNG, with its scale and no patient data");
}

bool MonitorPanel::draw_beam_knobs(float wide) {
  const imaging::UltrasoundView view = knobs_.view();
  bool turned = false;
  ImGui::SetNextItemWidth(0.20F * wide);
  const std::vector<imaging::ConsolePreset>& presets = knobs_.presets();
  if (ImGui::BeginCombo("##preset", knobs_.preset() < 0
                                        ? "own"
                                        : presets[static_cast<std::size_t>(knobs_.preset())].name.data())) {
    for (int i = 0; i < static_cast<int>(presets.size()); ++i)
      if (ImGui::Selectable(presets[static_cast<std::size_t>(i)].name.data(), i == knobs_.preset())) {
        knobs_.choose(i);
        turned = true;
      }
    ImGui::EndCombo();
  }
  tip("preset (C)");
  ImGui::SameLine();
  double depth_mm = view.depth_mm, focus_mm = view.focus_mm, frequency_mhz = imaging::working_mhz(view);
  if (knob("##depth", depth_mm, std::min(view.probe.least_depth_mm, view.depth_mm),
           std::max(view.probe.most_depth_mm, view.depth_mm), "depth %.0f mm", 0.26F * wide))
    knobs_.set_depth_mm(std::round(depth_mm));
  tip("depth (↑ ↓): what lies deeper is not seen, a deeper picture is a slower one");
  ImGui::SameLine();
  if (knob("##focus", focus_mm, 0.0, view.depth_mm, focus_mm > 0.0 ? "focus %.0f mm" : "focus: all", 0.26F * wide))
    knobs_.set_focus_mm(std::round(focus_mm));
  tip("focus ([ ]): where the beam is narrow; at the left end at every depth");
  ImGui::SameLine();
  if (knob("##frequency", frequency_mhz, view.probe.least_mhz, view.probe.most_mhz, "%.1f MHz", 0.20F * wide))
    knobs_.set_frequency_mhz(0.1 * std::round(10.0 * frequency_mhz));
  tip("frequency (, .): high resolves, low goes deep");
  return turned;
}

void MonitorPanel::draw_colour_knobs(float wide) {
  bool compound = knobs_.asked().compound_deg > 0.0;
  if (ImGui::Checkbox("compound", &compound)) knobs_.set_compounding(compound);
  note_item("compound");
  tip("spatial compounding (Z): three looks, from the middle and from either side, are averaged.\n"
      "Speckle and the shadows of edges are evened out; what moves is blurred: each picture is\n"
      "one new look, shown with the last two");
  ImGui::SameLine();
  bool colour = knobs_.asked().colour_mm_s > 0.0;
  if (ImGui::Checkbox("colour", &colour)) knobs_.turn(ConsoleTurn::colour, false);
  note_item("colour");
  tip(colour_words_.c_str());
  ImGui::SameLine();
  if (!colour) return;
  double scale_cm_s = 0.1 * imaging::colour_scale_mm_s(knobs_.view(), knobs_.asked().colour_mm_s);
  if (knob("##scale", scale_cm_s, 0.1 * imaging::kLeastColourMmS, 0.1 * imaging::most_colour_mm_s(knobs_.view()),
           "± %.0f cm/s", 0.19F * wide))
    knobs_.set_colour_mm_s(10.0 * std::round(scale_cm_s));
  tip("the speed at which colours wrap around; a deeper picture allows less");
  ImGui::SameLine();
  const double most_lean_deg = imaging::most_lean_deg(knobs_.view());
  if (most_lean_deg == 0.0) return;
  double lean_deg = knobs_.asked().lean_deg;
  if (knob("##lean", lean_deg, -most_lean_deg, most_lean_deg, "lean %+.0f°", 0.19F * wide))
    knobs_.set_lean_deg(std::round(lean_deg));
  note_item("lean");
  tip("colour's beams lean, + to the right of a picture that is not flipped: then flow along the face shows, too");
  ImGui::SameLine();
}

bool MonitorPanel::draw_screen_knobs(float wide) {
  bool turned = false;
  imaging::UltrasoundKnobs& screen = knobs_.screen;
  turned =
      knob("##gain", screen.gain_db, -imaging::kMostGainDb, imaging::kMostGainDb, "gain %.0f dB", 0.30F * wide) ||
      turned;
  tip("gain (9 0)");
  ImGui::SameLine();
  turned = knob("##range", screen.dynamic_range_db, imaging::kLeastRangeDb, imaging::kMostRangeDb, "range %.0f dB",
                0.30F * wide) ||
           turned;
  tip("dynamic range (; ')");
  ImGui::SameLine();
  static constexpr const char* kMaps[] = {"linear", "lifted", "contrast"};
  int map = static_cast<int>(screen.grey_map);
  ImGui::SetNextItemWidth(0.20F * wide);
  if (ImGui::Combo("##map", &map, kMaps, 3)) {
    screen.grey_map = static_cast<imaging::GreyMap>(map);
    turned = true;
  }
  tip("grey map (B)");
  ImGui::SameLine();
  turned = ImGui::Checkbox("flip", &screen.flip) || turned;
  tip("left for right (X)");
  // Time gain compensation, one slider for each layer of depth.
  for (std::size_t i = 0; i < screen.tgc_db.size(); ++i) {
    if (i > 0) ImGui::SameLine();
    ImGui::PushID(static_cast<int>(i));
    turned = knob("##tgc", screen.tgc_db[i], -imaging::kMostTgcDb, imaging::kMostTgcDb, "%.0f",
                  wide / static_cast<float>(screen.tgc_db.size()) - 9.0F) ||
             turned;
    ImGui::PopID();
    tip("time gain, from the skin to the depth");
  }
  return turned;
}

void MonitorPanel::draw_ultrasound(session::Monitor& monitor, bool frozen, bool turns) {
  const float all = ImGui::GetContentRegionAvail().x;
  const bool two_rows = in_two_rows(all);
  const float wide = two_rows ? 0.47F * all : all;  // of half a row
  ImGui::BeginDisabled(frozen || !turns);
  bool turned = draw_beam_knobs(wide);
  ImGui::EndDisabled();

  if (two_rows) ImGui::SameLine();
  turned = draw_screen_knobs(wide) || turned;
  if (turned) tell(monitor);

  if (two_rows) ImGui::SameLine();
  ImGui::BeginDisabled(frozen || !turns);
  draw_colour_knobs(wide);
  ImGui::EndDisabled();
  // Cine, as long as the picture is frozen.
  ImGui::BeginDisabled(!frozen || shown_.cine_pictures < 2);
  int back = -shown_.cine_back;
  // It gives way to what follows in its row.
  const ImGuiStyle& style = ImGui::GetStyle();
  const float rest = ImGui::CalcTextSize("Calipers (R)").x + ImGui::CalcTextSize("Save (T)").x +
                     ImGui::CalcTextSize(kind_.probe.c_str()).x + 4.0F * style.FramePadding.x +
                     4.0F * style.ItemSpacing.x;
  ImGui::SetNextItemWidth(std::clamp(ImGui::GetContentRegionAvail().x - rest, 0.11F * wide, 0.17F * wide));
  if (ImGui::SliderInt("##cine", &back, -std::max(1, shown_.cine_pictures - 1), 0, "cine %d"))
    monitor.set_console([back](imaging::Console& console) { console.scroll(-back); });
  ImGui::EndDisabled();
  tip("frozen (F), back through the last pictures (← →)");
  ImGui::SameLine();
  draw_calipers_and_keep(true);
  ImGui::SameLine();
  ImGui::TextDisabled("%s", kind_.probe.c_str());
}

void MonitorPanel::draw_slices(session::Monitor& monitor, bool frozen, bool turns) {
  const float wide = ImGui::GetContentRegionAvail().x;
  ImGui::SetNextItemWidth(0.26F * wide);
  if (ImGui::BeginCombo("##window", session::kHuWindows[knobs_.window].name)) {
    for (std::size_t i = 0; i < session::kHuWindows.size(); ++i) {
      char words[64];
      std::snprintf(words, sizeof words, "%s  %.0f / %.0f", session::kHuWindows[i].name,
                    session::kHuWindows[i].center_hu, session::kHuWindows[i].width_hu);
      if (ImGui::Selectable(words, i == knobs_.window)) {
        knobs_.window = i;
        tell(monitor);
      }
    }
    ImGui::EndCombo();
  }
  tip("which HU are shown, level and width (C)");
  ImGui::SameLine();
  ImGui::BeginDisabled(frozen || !turns);
  double slice_mm = knobs_.asked().slice_mm;
  if (knob("##slice", slice_mm, -session::kMostSliceMm, session::kMostSliceMm, "%+.0f mm beside the probe",
           0.36F * wide))
    knobs_.set_slice_mm(std::round(slice_mm));
  ImGui::EndDisabled();
  tip("scrolls through the slices beside the probe's (↑ ↓)");
  ImGui::SameLine();
  draw_calipers_and_keep(true);
}

void MonitorPanel::read_fluoroscope(const Keys& keys, cases::FluoroscopeInputs& asked) const {
  // Held keys drive the C-arm, with shift the table.
  const auto axis = [&](int more, int less) {
    return (keys.held(more) ? 1.0 : 0.0) - (keys.held(less) ? 1.0 : 0.0);
  };
  asked.pedal = keys.held('P');
  asked.lao_speed = keys.shift ? 0.0 : axis(kRight, kLeft);
  asked.cranial_speed = keys.shift ? 0.0 : axis(kUp, kDown);
  asked.table_speed = keys.shift ? glm::dvec3(axis(kRight, kLeft), 0.0, axis(kUp, kDown)) : glm::dvec3(0.0);
  asked.sid_speed = axis('V', 'B');
  // Pressed keys step the collimator, field and rate.
  const auto pressed = [&](int more, int less) {
    return (keys.pressed(more) ? 1 : 0) - (keys.pressed(less) ? 1 : 0);
  };
  const double blades = kBladeStep * pressed(']', '[');
  for (double* open : {&asked.collimator.open_u, &asked.collimator.open_v})
    *open = std::clamp(*open + blades, cases::kCollimatorMin, 1.0);
  asked.magnification = std::clamp(asked.magnification + pressed('0', '9'), 0, 2);
  asked.pulse_rate = std::clamp(asked.pulse_rate + pressed('.', ','), 0, 2);
  if (keys.pressed('H')) asked.hand_away = !asked.hand_away;
  if (keys.pressed('X')) expose_automatically(!asked.automatic_exposure, asked);
  if (asked.automatic_exposure) return;
  asked.kv = std::clamp(asked.kv + kKvStep * pressed('\'', ';'), machine_.kv_min, machine_.kv_max);
  asked.ma = std::clamp(asked.ma * std::pow(kMaStep, pressed('C', 'Z')), machine_.ma_min, machine_.ma_max);
}

// By hand: from where the machine had it.
void MonitorPanel::expose_automatically(bool automatic, cases::FluoroscopeInputs& asked) const {
  if (!automatic && asked.automatic_exposure) {
    asked.kv = machine_state_.technique.kv;
    asked.ma = machine_state_.technique.ma;
  }
  asked.automatic_exposure = automatic;
}

void MonitorPanel::draw_fluoroscope(session::Monitor& monitor, cases::FluoroscopeInputs& asked) {
  const float all = ImGui::GetContentRegionAvail().x;
  const bool one_row = in_one_row(all);
  const float wide = one_row ? 0.48F * all : all;
  // Pedal, hand and automatic exposure.
  ImGui::Button("Pedal (P)");
  asked.pedal = asked.pedal || ImGui::IsItemActive();
  tip("held, it makes pulses; let go, the last image stays");
  ImGui::SameLine();
  ImGui::Checkbox("hand away (H)", &asked.hand_away);
  tip("lets go of the needle and takes the hand out of the beam");
  ImGui::SameLine();
  bool automatic = asked.automatic_exposure;
  if (ImGui::Checkbox("automatic", &automatic)) expose_automatically(automatic, asked);
  tip("automatic exposure (X); without it kV and mA are yours");
  ImGui::SameLine();
  draw_calipers_and_keep(false);
  if (one_row) ImGui::SameLine();
  // Pulse rate, field and collimator.
  static constexpr const char* kRates[] = {"3 /s", "7.5 /s", "15 /s"};
  ImGui::SetNextItemWidth(0.16F * wide);
  ImGui::Combo("##rate", &asked.pulse_rate, kRates, 3);
  tip("pulses a second (, .): each costs dose");
  ImGui::SameLine();
  std::array<char[16], 3> fields;
  for (std::size_t i = 0; i < fields.size(); ++i)
    std::snprintf(fields[i], sizeof fields[i], "%.0f cm", 0.1 * machine_.field_side_mm[i]);
  const char* const names[] = {fields[0], fields[1], fields[2]};
  ImGui::SetNextItemWidth(0.16F * wide);
  ImGui::Combo("##field", &asked.magnification, names, 3);
  tip("field (9 0): a smaller one is magnified, at more dose to the skin");
  ImGui::SameLine();
  knob("##across", asked.collimator.open_u, cases::kCollimatorMin, 1.0, "across %.2f", 0.21F * wide);
  tip("collimator ([ ] both): what is shut off gets no dose, and blurs nothing");
  ImGui::SameLine();
  knob("##along", asked.collimator.open_v, cases::kCollimatorMin, 1.0, "along %.2f", 0.21F * wide);
  ImGui::SameLine();
  static constexpr const char* kPanels[] = {"ideal", "panel", "II"};
  static_assert(std::size(kPanels) == imaging::kPanelNames.size());
  ImGui::SetNextItemWidth(0.17F * wide);
  if (ImGui::Combo("##panel", &panel_, kPanels, static_cast<int>(std::size(kPanels)))) tell(monitor);
  note_item("panel");
  tip("detector: an ideal one; a flat panel, in which 5 % of the picture before is left; an image intensifier "
      "(II), "
      "whose glare veils 5 %");
  if (asked.automatic_exposure) return;
  // Technique, by hand.
  knob("##kv", asked.kv, machine_.kv_min, machine_.kv_max, "%.0f kV", 0.48F * wide);
  tip("tube's voltage (; ')");
  ImGui::SameLine();
  knob("##ma", asked.ma, machine_.ma_min, machine_.ma_max, "%.0f mA", 0.48F * wide);
  tip("tube's current (Z C)");
}

void MonitorPanel::draw_exposure(const cases::FluoroscopyState& machine) {
  // Dose rate, averaged over kDoseOverS of beam time; begun again when an attempt is watched from its start.
  if (machine.fluoroscopy_time_s < dose_from_s_) dose_from_s_ = dose_from_mgy_ = 0.0;
  if (machine.fluoroscopy_time_s >= dose_from_s_ + kDoseOverS) {
    dose_mgy_min_ = 60.0 * (machine.air_kerma_mgy - dose_from_mgy_) / (machine.fluoroscopy_time_s - dose_from_s_);
    dose_from_s_ = machine.fluoroscopy_time_s;
    dose_from_mgy_ = machine.air_kerma_mgy;
  }
  // What the machine shows: angles, technique, beam time and dose.
  ImGui::Text("%s %.0f°  %s %.0f°  SID %.0f cm   %.0f kV %.0f mA", machine.arm.lao_deg < 0.0 ? "RAO" : "LAO",
              std::abs(machine.arm.lao_deg), machine.arm.cranial_deg < 0.0 ? "CAUD" : "CRAN",
              std::abs(machine.arm.cranial_deg), 0.1 * machine.arm.sid_mm, machine.last_technique.kv,
              machine.last_technique.ma);
  const int whole_s = static_cast<int>(machine.fluoroscopy_time_s);
  ImGui::Text("beam %d:%04.1f   %.2f mGy (%.1f mGy/min)   %.0f mGy·cm²", whole_s / 60,
              machine.fluoroscopy_time_s - 60.0 * (whole_s / 60), machine.air_kerma_mgy,
              machine.beam_on ? dose_mgy_min_ : 0.0, machine.dap_mgy_cm2);
}

}  // namespace seldinger::app
