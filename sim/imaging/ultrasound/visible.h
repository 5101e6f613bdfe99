// What an ultrasound picture shows (docs/decisions/0013), from expected levels without speckle: nothing is rendered
// and no seed matters. The laws are the picture's own: its beam (probe.h), its needle (needle_echo.h), its tissue.
//
// Needle: the echo, weakened by how far it lies off the plane (and a tip by how far off its nearest beam), against
// the speckle around it under the same loss, clutter and the receiver's noise. Target: see docs/decisions/0013.
// Left out: the needle's own weak shadow and its tail, echoes of interfaces, the speed of sound.
#pragma once

#include <span>

#include "sim/case/record/recording.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"
#include "sim/imaging/visible.h"

namespace seldinger::imaging {

// Our judgement (docs/decisions/0013).
constexpr double kNeedleAboveDb = 6.0;
constexpr double kLeastTransmissionDb = -12.0;
// By the law of sight: of half_slice over kCellsSeen cells, of echo over the target's own.
constexpr double kLeastCnr = 1.0, kLeastCnrBySize = 2.5;

// Standard deviation of speckle on the log picture: 10·π/(√6·ln 10) dB, a cell (closed form of Rayleigh's).
constexpr double kSpeckleDb = 5.57;
// Over so many cells of speckle the eye averages: of half_slice 2 × 2 (design; decision 0013); of echo those of the
// target's section, for what is seen grows with their root (Smith and Wagner, IEEE Trans. Sonics Ultrason. 30
// (1983) 164), but not beyond a few (judgement): from there on 2.8 dB are enough, as of old.
constexpr double kCellsSeen = 4.0, kMostCellsSeen = 25.0;

struct UltrasoundVisible {
  Visible visible;
  cases::NearPlane near_plane;
};

// The target is inserted.lesions[0]. depth_below_skin_mm: as ultrasound_polar. Poses that are not finite show
// nothing. The shaft is looked at every kShaftStepMm. Of a
// patient who moves: tissue and target are where the displacement puts them, to kSightMm of a grid.
constexpr double kShaftStepMm = 2.0, kSightMm = 5.0;
UltrasoundVisible ultrasound_visible(const TissueVolume& tissue, const UltrasoundView& view,
                                     const Inserted& inserted, std::span<const float> depth_below_skin_mm,
                                     const tissue::Displacement& displacement = {});

// The numbers behind it.
struct NeedleLevel {
  bool in_field = false;
  double off_plane_mm = 0.0;
  double echo_db = 0.0;        // as it arrives; liver's speckle at the face is 0
  double background_db = 0.0;  // likewise, with what lies over it: clutter and the receiver's noise
  bool stands_out() const noexcept { return in_field && echo_db >= background_db + kNeedleAboveDb; }
};
// At a point of the shaft `behind_tip_mm`, ≥ 0; 0: the tip, which shows as the bevel or as the shaft's end.
NeedleLevel needle_level(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                         std::span<const float> depth_below_skin_mm, double behind_tip_mm,
                         const tissue::Displacement& displacement = {});

struct TargetLevel {
  bool in_field = false;
  double off_plane_mm = 0.0;
  double transmission_db = 0.0;  // two-way, beyond what the scanner makes up for depth; may be above 0
  double contrast_db = 0.0;      // of its mean level to that beside it, noise included
  double cells = kCellsSeen;     // of speckle over which it is looked at
  double least_cnr = kLeastCnr;
  double cnr() const noexcept;
  bool stands_out() const noexcept { return in_field && cnr() >= least_cnr; }
};
TargetLevel target_level(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                         std::span<const float> depth_below_skin_mm, const tissue::Displacement& displacement = {});

}  // namespace seldinger::imaging
