#include "sim/imaging/ultrasound/console.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/check.h"
#include "sim/imaging/ultrasound/compound.h"

namespace seldinger::imaging {
namespace {

constexpr std::array<ConsolePreset, 5> kPresets = {{
    {"liver", kC52v, 150.0, 80.0, 60.0},
    {"kidney", kC52v, 120.0, 60.0, 60.0},
    {"deep", kC52v, 220.0, 140.0, 65.0, 2.5},
    {"vessel", kL115v, 40.0, 15.0, 55.0},
    {"surface", kL115v, 30.0, 12.0, 60.0, 10.0},
}};

}  // namespace

std::span<const ConsolePreset> console_presets() noexcept {
  return kPresets;
}

const ConsolePreset* console_preset_named(std::string_view name) noexcept {
  for (const ConsolePreset& preset : kPresets)
    if (preset.name == name) return &preset;
  return nullptr;
}

double frame_rate_hz(double depth_mm, int beams) noexcept {
  return 1e6 * shaders::kUsSpeedMmPerUs / (2.0 * depth_mm * beams);
}

void set_view(const cases::ConsoleSetting& asked, UltrasoundView& view) noexcept {
  const Probe& probe = view.probe;
  view.depth_mm = taken_depth_mm(probe, asked.depth_mm, view.depth_mm);
  if (asked.frequency_mhz > 0.0)
    view.frequency_mhz = taken(asked.frequency_mhz, probe.least_mhz, probe.most_mhz, view.frequency_mhz);
  if (asked.focus_mm > 0.0)
    view.focus_mm = taken(asked.focus_mm, std::min(kLeastFocusMm, view.depth_mm), view.depth_mm, view.focus_mm);
  view.compound_deg = taken(asked.compound_deg, 0.0, kMostCompoundDeg, 0.0);
}

glm::dvec2 picture_mm(const ScanConverter& converter, const UltrasoundKnobs& knobs,
                      const glm::dvec2& pixel) noexcept {
  const double x = (pixel.x - 0.5 * (converter.width_px() - 1)) * converter.pixel_mm();
  return {knobs.flip ? -x : x, converter.top_mm() + (pixel.y + 0.5) * converter.pixel_mm()};
}

double caliper_mm(const glm::dvec2& from_mm, const glm::dvec2& to_mm) noexcept {
  return glm::length(to_mm - from_mm);
}

double ellipse_area_mm2(double axis_mm, double other_axis_mm) noexcept {
  return 0.25 * std::numbers::pi * axis_mm * other_axis_mm;
}

Console::Console(const ConsolePreset& preset) {
  set_preset(preset);
}

void Console::set_preset(const ConsolePreset& preset) {
  knobs_ = {};
  view_ = {};
  view_.probe = preset.probe;
  view_.range_error = true;
  set_depth_mm(preset.depth_mm);
  set_focus_mm(preset.focus_mm);
  if (preset.frequency_mhz > 0.0) set_frequency_mhz(preset.frequency_mhz);
  set_dynamic_range_db(preset.dynamic_range_db);
}

void Console::set_depth_mm(double depth_mm) {
  view_.depth_mm = taken(depth_mm, view_.probe.least_depth_mm, view_.probe.most_depth_mm, view_.depth_mm);
  view_.focus_mm = std::min(view_.focus_mm, view_.depth_mm);
}

void Console::set_frequency_mhz(double frequency_mhz) {
  view_.frequency_mhz = taken(frequency_mhz, view_.probe.least_mhz, view_.probe.most_mhz, view_.frequency_mhz);
}

void Console::set_focus_mm(double focus_mm) {
  view_.focus_mm = taken(focus_mm, 0.0, view_.depth_mm, view_.focus_mm);
}

void Console::set_gain_db(double gain_db) {
  knobs_.gain_db = taken(gain_db, -kMostGainDb, kMostGainDb, knobs_.gain_db);
}

void Console::set_tgc_db(std::size_t slider, double db) {
  CHECK(slider < knobs_.tgc_db.size());
  knobs_.tgc_db[slider] = taken(db, -kMostTgcDb, kMostTgcDb, knobs_.tgc_db[slider]);
}

void Console::set_dynamic_range_db(double range_db) {
  knobs_.dynamic_range_db = taken(range_db, kLeastRangeDb, kMostRangeDb, knobs_.dynamic_range_db);
}

void Console::set_frozen(bool frozen) {
  if (frozen_ && !frozen) loop_.clear();
  frozen_ = frozen;
  scrolled_ = 0;
}

void Console::show(double t_s, std::uint64_t number, const UltrasoundView& view, const PolarPicture& picture,
                   std::optional<ColourPicture> colour) {
  if (!frozen_) loop_.push(t_s, number, view, picture, std::move(colour));
}

void Console::scroll(int pictures_back) noexcept {
  scrolled_ = frozen_ ? std::clamp(pictures_back, 0, std::max(0, loop_.size() - 1)) : 0;
}

std::optional<CinePicture> Console::shown() const {
  return loop_.back(scrolled_);
}

}  // namespace seldinger::imaging
