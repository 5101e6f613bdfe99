// What a needle sends back to the probe: the law behind the picture and behind what is told of it.
#pragma once

#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

// Levels above liver's speckle. The rough part fades linearly in dB with the tilt: on a picture of 60 dB that is
// grey falling linearly (Schafhalter-Zoppoth 2004) to 0.08 of white at 75° for a plain and 0.55 for an echogenic
// needle (Nichols 2003: echogenicity 5.0 and 40 of 60 to 76).
constexpr double kNeedleMirrorDb = 36.0;
constexpr double kNeedleRoughDb = 25.0;
constexpr double kPlainFadeDbPerDeg = 60.0 * 0.92 / 75.0, kEchogenicFadeDbPerDeg = 60.0 * 0.45 / 75.0;
// The tip's, by sight law (docs/decisions/0057). Of half_slice: at any tilt (design).
constexpr double kNeedleTipDb = 22.0;
// Of echo: of a bevel that faces the probe it starts where the mirror does and falls linearly (Schafhalter-Zoppoth
// 2004) to what is just seen in liver at 75°, where a plain needle is all but gone (Nichols 2003); an echogenic
// one's as much more slowly as its shaft's. Below, what the sharp point alone bends back (judgement: less than
// liver's speckle). A bevel turned to the side sends back less than one towards or away from the probe (Chin et
// al., Reg. Anesth. Pain Med. 33 (2008) 532); how much less: judgement.
constexpr double kTipGoneDeg = 75.0, kTipGoneDb = 6.0, kNeedlePointDb = -3.0, kBevelSideDb = 6.0;
// Of tilt: along the picture it falls as its shaft does, so that in liver a plain one is gone at 41° (below 45° to
// the skin a needle is seen, teaches the Royal College of Emergency Medicine; below 30°, Schafhalter-Zoppoth).
// Across it as by echo: there tips show best beyond 60° (Schafhalter-Zoppoth). docs/decisions/0106.

// Of tilt: midway between two lines of the picture what a needle sends back is weaker by this, as on machines whose
// beams overlap at half their power (design); of the laws before by as much as a beam's own width leaves there.
constexpr double kMidwayDb = 3.0;
// 20·log10 of exp(−d²/8σ²) is −kMidwayDb at a spacing d of so many σ.
constexpr double kSigmasPerLine = 1.66226;
// The levels are a 22-gauge needle's; a long hard cylinder's echo grows as the root of its radius (Morse and
// Ingard, Theoretical Acoustics, 8.1), so thinner needles show less (Schafhalter-Zoppoth 2004).
constexpr double kNeedleLevelRadiusMm = 0.36;

// What meets less of the beam than this is not drawn: 40 dB below what lies in its middle (design).
constexpr double kLeastNeedleWeight = 0.01;

// Standard deviation across the beam of what a picture's line sees of a needle, mm.
double needle_sigma_mm(const UltrasoundView& view, double beam_sigma_mm, double line_spacing_mm) noexcept;

// Amplitudes where the needle is: without loss on the way, and as if in the middle of the beam.
struct NeedleEcho {
  double mirror;  // of the straight shaft; with it come the lines from inside
  double rough;
  double tip;
  double shaft() const noexcept { return mirror > rough ? mirror : rough; }
};

// At this depth of a beam that goes that way, a unit vector.
NeedleEcho needle_echo(const UltrasoundView& view, const NeedlePose& needle, double depth_mm,
                       const glm::dvec3& beam) noexcept;

// Finite, with a length and a radius: one that can be shown.
bool is_usable(const NeedlePose& needle) noexcept;

}  // namespace seldinger::imaging
