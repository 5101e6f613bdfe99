// The console of ultrasound or slices as somebody turns it at the desk, by knobs or by keys: what an attempt
// records (ConsoleSetting), and what acts on the screen alone. It knows nothing of windows.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "session/guidance/slice_picture.h"
#include "sim/case/case.h"
#include "sim/case/console.h"
#include "sim/case/structure.h"
#include "sim/imaging/ultrasound/console.h"

namespace seldinger::app {

// One press of a key.
enum class ConsoleTurn : std::uint8_t {
  depth_less,
  depth_more,
  focus_less,
  focus_more,
  frequency_less,
  frequency_more,  // what an attempt records of ultrasound; while it is frozen these do nothing
  slice_back,
  slice_on,  // and of slices, likewise
  colour,    // of ultrasound again
  compound,
  gain_less,
  gain_more,
  range_less,
  range_more,
  next_map,
  flip,
  next_preset,
  next_window,
};

// What colour Doppler shows of a case's vessels, and what it cannot.
std::string colour_words(std::span<const cases::Structure> structures);

class ConsoleKnobs {
 public:
  // As the case has it, sliders in the middle, the first window.
  void begin(const cases::Picture& picture);

  void turn(ConsoleTurn turned, bool frozen);

  const cases::ConsoleSetting& asked() const noexcept { return asked_; }
  // Of an attempt that is watched: as it was turned then.
  void stand(const cases::ConsoleSetting& console) noexcept { asked_ = console; }
  // By knobs, which are within what they offer.
  void set_depth_mm(double depth_mm);
  void set_focus_mm(double focus_mm);  // 0: at every depth
  void set_frequency_mhz(double frequency_mhz);
  void set_slice_mm(double slice_mm);
  void set_colour_mm_s(double colour_mm_s);  // 0: off
  void set_lean_deg(double lean_deg);        // of colour's beams
  // The middle of colour's box, as shares of the picture (ConsoleSetting::box_across); 0: nearly all of it.
  void place_box(double across, double down);
  void set_compounding(bool on);
  imaging::UltrasoundView view() const;  // as it stands, without a pose; ultrasound only (CHECKed)

  // Those of the probe at hand. What none of them is, the knobs made.
  const std::vector<imaging::ConsolePreset>& presets() const noexcept { return presets_; }
  int preset() const noexcept { return preset_; }  // −1: none
  void choose(int preset);

  // The screen's. Whoever changes them lets it be known (Monitor::set_console, set_window).
  imaging::UltrasoundKnobs screen;
  std::size_t window = 0;  // of kHuWindows
  void apply(imaging::Console& console) const;

 private:
  cases::Picture picture_;
  cases::ConsoleSetting asked_;
  std::vector<imaging::ConsolePreset> presets_;  // the first: the case's own
  int preset_ = 0;
};

}  // namespace seldinger::app
