// The console: what a trainee sets, what it freezes and measures. It knows nothing of windows; whoever draws it
// reads its picture.
#pragma once

#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "sim/case/console.h"
#include "sim/imaging/ultrasound/cine_loop.h"

namespace seldinger::imaging {

// A state of the console to begin with.
struct ConsolePreset {
  std::string_view name;
  Probe probe;
  double depth_mm, focus_mm;  // focus 0: at every depth
  double dynamic_range_db;
  double frequency_mhz = 0.0;  // 0: the probe's
};
// Our judgement; deep: sound that gets through; surface: sound that resolves.
std::span<const ConsolePreset> console_presets() noexcept;
const ConsolePreset* console_preset_named(std::string_view name) noexcept;

constexpr double kMostGainDb = 40.0, kMostTgcDb = 40.0;  // either way
constexpr double kLeastRangeDb = 30.0, kMostRangeDb = 100.0;
constexpr double kLeastFocusMm = 5.0;  // nearer, the face itself is no wider

// A view as the console stands: what is asked with 0, or is no number, stays as it was; the rest is brought to what
// its probe can do, a focus into the picture.
void set_view(const cases::ConsoleSetting& asked, UltrasoundView& view) noexcept;

// Pictures a second that sound's way there and back allows: c/(2·depth·beams).
double frame_rate_hz(double depth_mm, int beams) noexcept;

// Where a point of the picture lies below the face's centre: x across, z down.
glm::dvec2 picture_mm(const ScanConverter& converter, const UltrasoundKnobs& knobs,
                      const glm::dvec2& pixel) noexcept;
double caliper_mm(const glm::dvec2& from_mm, const glm::dvec2& to_mm) noexcept;
// Of the ellipse whose axes two calipers measured.
double ellipse_area_mm2(double axis_mm, double other_axis_mm) noexcept;

class Console {
 public:
  explicit Console(const ConsolePreset& preset);

  // Settings as they are taken: out of range is brought to the nearest that is in range, NaN changes nothing.
  const UltrasoundView& view() const noexcept { return view_; }  // without a pose
  const UltrasoundKnobs& knobs() const noexcept { return knobs_; }
  void set_preset(const ConsolePreset& preset);  // and the sliders to the middle
  void set_depth_mm(double depth_mm);            // a focus below the picture goes to its lower edge
  void set_frequency_mhz(double frequency_mhz);
  void set_focus_mm(double focus_mm);
  void set_gain_db(double gain_db);
  void set_tgc_db(std::size_t slider, double db);
  void set_dynamic_range_db(double range_db);
  void set_grey_map(GreyMap map) { knobs_.grey_map = map; }
  void set_flip(bool flip) { knobs_.flip = flip; }
  double frame_rate_hz() const noexcept { return imaging::frame_rate_hz(view_.depth_mm, view_.beams); }

  // Frozen, the picture is the loop's; what comes meanwhile is not kept. Live again, the loop begins anew.
  bool frozen() const noexcept { return frozen_; }
  void set_frozen(bool frozen);
  // Live pictures enter here; `view` with its pose. Of a frozen console nothing changes.
  void show(double t_s, std::uint64_t number, const UltrasoundView& view, const PolarPicture& picture,
            std::optional<ColourPicture> colour = {});
  // Back from the newest, while frozen; clamped to what there is.
  void scroll(int pictures_back) noexcept;
  int scrolled() const noexcept { return scrolled_; }
  int cine_pictures() const noexcept { return loop_.size(); }
  // What is on the screen; nothing before the first picture.
  std::optional<CinePicture> shown() const;

 private:
  UltrasoundView view_;
  UltrasoundKnobs knobs_;
  CineLoop loop_;
  bool frozen_ = false;
  int scrolled_ = 0;
};

}  // namespace seldinger::imaging
