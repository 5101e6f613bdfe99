#include "app/window/hands/console_knobs.h"

#include <algorithm>
#include <cmath>

#include "session/guidance/ultrasound_sight.h"
#include "sim/imaging/ultrasound/colour.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/view/view.h"
#include "sim/tissue/blood_flow.h"

namespace seldinger::app {
namespace {

// A press of a key (design): steps that one sees, and that lead to round numbers.
constexpr double kFineDepthMm = 5.0, kDepthMm = 10.0, kFineToMm = 60.0;
constexpr double kFocusMm = 5.0, kFrequencyMhz = 0.5, kSliceMm = 1.0, kGainDb = 2.0, kRangeDb = 5.0;
constexpr double kColourMmS = 200.0;  // to begin with
constexpr double kAlready = 1e-6;     // of a step: where it stands, it is not led to again

// The next multiple of a step above or below.
double next(double value, double step, bool more) {
  return (more ? std::floor(value / step + kAlready) + 1.0 : std::ceil(value / step - kAlready) - 1.0) * step;
}

double turned_db(double value, double by_db, double least_db, double most_db) {
  return std::clamp(value + by_db, least_db, most_db);
}

}  // namespace

std::string colour_words(std::span<const cases::Structure> structures) {
  const tissue::BloodFlow flow(structures);
  const auto list = [](std::string words, std::span<const std::string> names) {
    for (std::size_t i = 0; i < names.size(); ++i) words += (i > 0 ? ", " : " ") + names[i];
    return words;
  };
  std::string words =
      "colour Doppler (V): red flows towards the probe, blue away from it; flow across the beam does not show";
  if (flow.empty()) return words + "\nthe flow is not known in any vessel of this case";
  words += list("\nit shows the flow in", flow.names());
  if (!flow.unknown().empty()) words = list(words + "\nhow blood flows is not known in", flow.unknown());
  return words + "\ndrag its box over the picture; a double click makes it large again";
}

void ConsoleKnobs::begin(const cases::Picture& picture) {
  picture_ = picture;
  presets_.clear();
  if (picture.modality == cases::Modality::ultrasound) {
    const imaging::UltrasoundView own = session::console_view(picture, {});
    presets_.push_back({"case", own.probe, own.depth_mm, own.focus_mm, imaging::UltrasoundKnobs{}.dynamic_range_db,
                        own.frequency_mhz});
    for (const imaging::ConsolePreset& preset : imaging::console_presets())
      if (preset.probe.name == own.probe.name) presets_.push_back(preset);
  }
  screen = {};
  window = 0;
  choose(0);
}

imaging::UltrasoundView ConsoleKnobs::view() const {
  return session::console_view(picture_, asked_);
}

void ConsoleKnobs::choose(int preset) {
  const bool flip = screen.flip;  // how somebody stands is no part of a preset
  screen = {};
  asked_ = {};
  screen.flip = flip;
  preset_ = preset;
  if (preset <= 0) return;
  const imaging::ConsolePreset& chosen = presets_[static_cast<std::size_t>(preset)];
  asked_ = {chosen.depth_mm, chosen.focus_mm, chosen.frequency_mhz};
  screen.dynamic_range_db = chosen.dynamic_range_db;
}

void ConsoleKnobs::set_depth_mm(double depth_mm) {
  const imaging::Probe probe = view().probe;
  asked_.depth_mm = std::clamp(depth_mm, probe.least_depth_mm, probe.most_depth_mm);
  preset_ = -1;
}

void ConsoleKnobs::set_focus_mm(double focus_mm) {
  asked_.focus_mm = focus_mm < imaging::kLeastFocusMm ? 0.0 : std::min(focus_mm, view().depth_mm);
  preset_ = -1;
}

void ConsoleKnobs::set_frequency_mhz(double frequency_mhz) {
  const imaging::Probe probe = view().probe;
  asked_.frequency_mhz = std::clamp(frequency_mhz, probe.least_mhz, probe.most_mhz);
  preset_ = -1;
}

void ConsoleKnobs::set_slice_mm(double slice_mm) {
  asked_.slice_mm = std::clamp(slice_mm, -session::kMostSliceMm, session::kMostSliceMm);
}

void ConsoleKnobs::set_colour_mm_s(double colour_mm_s) {
  asked_.colour_mm_s = colour_mm_s > 0.0 ? imaging::colour_scale_mm_s(view(), colour_mm_s) : 0.0;
}

void ConsoleKnobs::set_lean_deg(double lean_deg) {
  const double most_deg = imaging::most_lean_deg(view());
  asked_.lean_deg = std::clamp(lean_deg, -most_deg, most_deg);
}

void ConsoleKnobs::place_box(double across, double down) {
  asked_.box_across = std::clamp(across, 0.0, 1.0);
  asked_.box_down = std::clamp(down, 0.0, 1.0);
}

void ConsoleKnobs::set_compounding(bool on) {
  asked_.compound_deg = on ? imaging::kCompoundDeg : 0.0;
}

void ConsoleKnobs::turn(ConsoleTurn turned, bool frozen) {
  if (frozen && turned <= ConsoleTurn::compound) return;
  const bool ultrasound = picture_.modality == cases::Modality::ultrasound;
  const imaging::UltrasoundView stands = ultrasound ? view() : imaging::UltrasoundView{};
  const auto depth_step_mm = [&](bool more) {
    return stands.depth_mm < kFineToMm || (!more && stands.depth_mm <= kFineToMm) ? kFineDepthMm : kDepthMm;
  };
  const auto focus_mm = [&](bool more) {
    return stands.focus_mm > 0.0 ? next(stands.focus_mm, kFocusMm, more)
                                 : next(0.5 * stands.depth_mm, kFocusMm, more);
  };
  switch (turned) {
    case ConsoleTurn::depth_less:
      return set_depth_mm(next(stands.depth_mm, depth_step_mm(false), false));
    case ConsoleTurn::depth_more:
      return set_depth_mm(next(stands.depth_mm, depth_step_mm(true), true));
    case ConsoleTurn::focus_less:
      return set_focus_mm(focus_mm(false));
    case ConsoleTurn::focus_more:
      return set_focus_mm(focus_mm(true));
    case ConsoleTurn::frequency_less:
      return set_frequency_mhz(next(imaging::working_mhz(stands), kFrequencyMhz, false));
    case ConsoleTurn::frequency_more:
      return set_frequency_mhz(next(imaging::working_mhz(stands), kFrequencyMhz, true));
    case ConsoleTurn::slice_back:
      return set_slice_mm(next(asked_.slice_mm, kSliceMm, false));
    case ConsoleTurn::slice_on:
      return set_slice_mm(next(asked_.slice_mm, kSliceMm, true));
    case ConsoleTurn::colour:
      return set_colour_mm_s(asked_.colour_mm_s > 0.0 ? 0.0 : kColourMmS);
    case ConsoleTurn::compound:
      return set_compounding(asked_.compound_deg == 0.0);
    case ConsoleTurn::gain_less:
    case ConsoleTurn::gain_more:
      screen.gain_db = turned_db(screen.gain_db, turned == ConsoleTurn::gain_more ? kGainDb : -kGainDb,
                                 -imaging::kMostGainDb, imaging::kMostGainDb);
      return;
    case ConsoleTurn::range_less:
    case ConsoleTurn::range_more:
      screen.dynamic_range_db =
          turned_db(screen.dynamic_range_db, turned == ConsoleTurn::range_more ? kRangeDb : -kRangeDb,
                    imaging::kLeastRangeDb, imaging::kMostRangeDb);
      return;
    case ConsoleTurn::next_map:
      screen.grey_map = static_cast<imaging::GreyMap>((static_cast<int>(screen.grey_map) + 1) % 3);
      return;
    case ConsoleTurn::flip:
      screen.flip = !screen.flip;
      return;
    case ConsoleTurn::next_preset:
      if (!frozen && !presets_.empty()) choose((preset_ + 1) % static_cast<int>(presets_.size()));
      return;
    case ConsoleTurn::next_window:
      window = (window + 1) % session::kHuWindows.size();
      return;
  }
}

void ConsoleKnobs::apply(imaging::Console& console) const {
  console.set_gain_db(screen.gain_db);
  console.set_dynamic_range_db(screen.dynamic_range_db);
  console.set_grey_map(screen.grey_map);
  console.set_flip(screen.flip);
  for (std::size_t i = 0; i < screen.tgc_db.size(); ++i) console.set_tgc_db(i, screen.tgc_db[i]);
}

}  // namespace seldinger::app
