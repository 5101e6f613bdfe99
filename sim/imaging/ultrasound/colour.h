// Colour Doppler: how fast blood comes towards the probe, in a box over the grey picture. By the CPU whatever draws
// the grey below it, so that its bits are the same beside both (docs/decisions/0085).
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "sim/case/console.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"
#include "sim/tissue/blood_flow.h"

namespace seldinger::imaging {

// The speed from which on colours wrap around. Pulses follow each other no sooner than sound comes back from the
// picture's lower edge: c²/(8·f·depth) at most. What is asked is brought into range.
constexpr double kLeastColourMmS = 20.0;
double most_colour_mm_s(const UltrasoundView& view) noexcept;
double colour_scale_mm_s(const UltrasoundView& view, double asked_mm_s) noexcept;

// Slower than this share of the scale counts as tissue that moves: the wall filter takes it away.
constexpr double kColourWallShare = 0.06;

// What a speed towards the probe (< 0: away) is taken for: into −scale … scale by whole turns.
double aliased_mm_s(double towards_mm_s, double scale_mm_s) noexcept;
// What the wall filter leaves of its echo, 0 to 1; a half at kColourWallShare.
double past_wall_filter(double aliased_mm_s, double scale_mm_s) noexcept;

// The beams of a straight face can lean to either side, so that flow along the face shows, too.
constexpr double kMostLeanDeg = 20.0;
double most_lean_deg(const UltrasoundView& view) noexcept;  // of a curved face 0: its beams differ anyway

// The box: nearly all of the picture, or a smaller one where the console has put it (ConsoleSetting::box_across).
// As it leans its sides follow its beams, about the middle of its depth; beams are counted there.
struct ColourBox {
  int first_beam = 0, end_beam = 0;
  double from_mm = 0.0, to_mm = 0.0;
  double beams_per_mm = 0.0;  // of lean
  double lean_deg = 0.0;
  // The beam of the grey picture at a depth of one of its own.
  double grey_beam(double beam, double depth_mm) const noexcept {
    return beam + beams_per_mm * (depth_mm - 0.5 * (from_mm + to_mm));
  }
  bool operator==(const ColourBox&) const = default;
};
ColourBox colour_box(const UltrasoundView& view, const cases::ConsoleSetting& asked) noexcept;

// One complex number a cell, cells of one beam together, from the box's upper edge down: its angle is π times the
// share of the scale, > 0 towards the probe; its length how sure it is, 0 to 1. So cells may be averaged, though
// speeds wrap around (Kasai et al., IEEE Trans. Sonics Ultrason. 32 (1985) 458).
struct ColourPicture {
  ColourBox box;
  int rows = 0;
  double scale_mm_s = 0.0;
  std::vector<glm::vec2> cells;
};

// As ultrasound_polar's, as the console asks (colour_mm_s, lean_deg, box_across, box_down). Where blood's echo
// drowns, or nothing touches the skin, there is no colour.
void colour_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                  std::span<const float> depth_below_skin_mm, const tissue::BloodFlow& flow,
                  const cases::ConsoleSetting& asked, double t_s, ColourPicture& picture,
                  const tissue::Displacement& displacement = {});

}  // namespace seldinger::imaging
