// Spatial compounding: the same place is looked at from the middle and from either side, and what the screen shows
// is the mean square of the looks. Where they differ, in speckle and in shadows of edges, it is evened out (Trahey,
// Smith and von Ramm, IEEE Trans. Ultrason. Ferroelectr. Freq. Control 33 (1986) 257; Entrekin, Porter, Sillesen,
// Wong, Cooperberg and Fix, Semin. Ultrasound CT MR 22 (2001) 50); what moves is blurred, as a machine makes one
// look a picture and shows the last three (docs/decisions/0090).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

constexpr int kLooks = 3;  // the middle one, then from the side of the first beam, and of the last
// What the console offers, and how it begins (design; machines steer by 5 to 15°).
constexpr double kMostCompoundDeg = 15.0, kCompoundDeg = 12.0;

// A view that is compounded (view.compound_deg > 0), as one of its looks is made: the face turned about its middle,
// and so far into the body that no beam begins above it. The middle one is the view itself, uncompounded.
UltrasoundView look_of(const UltrasoundView& view, int look) noexcept;

// As how many independent looks so many that show a place, the middle one first, count in the speckle at its depth:
// the mean of n pictures whose intensities correlate by r has 1/n² · Σr of one's variance. By the closed form of a
// Gaussian beam of width σ, whose lateral phase is turned by 4π/λ·sin θ a mm: r = exp(−½·(4π/λ·sin θ·σ)²). Looks
// from the side are told between their samples, which evens them out once more.
double independent_looks(const UltrasoundView& view, double depth_mm, int looks = kLooks) noexcept;

// A look as it was received, with the depths below the skin that it was made with (ultrasound_polar).
struct Look {
  PolarPicture picture;
  std::vector<float> depth_below_skin_mm;
};

// Lays looks of one probe and depth over each other, in the probe's own frame.
class Compounder {
 public:
  Compounder() = default;
  explicit Compounder(const UltrasoundView& view);
  bool is_of(const UltrasoundView& view) const noexcept;
  // Into `picture`, in the middle look's grid, the mean square of the looks that show the place; at least the
  // middle one. What that shows in air stays as it is.
  void mean(const UltrasoundView& view, std::span<const Look, kLooks> looks, PolarPicture& picture) const;

 private:
  // Where a sample of the middle look lies in one from the side: between which beams and samples.
  struct Source {
    std::int16_t near = -1, upper = 0;               // the ones before; a beam of −1: nowhere
    float beam = 0.0F, sample = 0.0F, level = 0.0F;  // level: what loss makes of it
  };
  UltrasoundView view_;
  std::array<std::vector<Source>, kLooks - 1> sources_;
};

}  // namespace seldinger::imaging
