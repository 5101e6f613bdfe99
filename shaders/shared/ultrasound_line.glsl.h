// What lies along one beam, formulas and numbers: interfaces, their echoes and what comes of them again.
#ifndef SELDINGER_SHADERS_SHARED_ULTRASOUND_LINE
#define SELDINGER_SHADERS_SHARED_ULTRASOUND_LINE

#include "ultrasound.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

SHARED_CONSTANT real kUsDeadDb = 400.0;  // nothing comes back; keeps sums finite

// Gel and lens are matched to the skin: only what reflects much shows at the face.
SHARED_CONSTANT real kUsMatchedMrayl = 1.65;
SHARED bool us_is_matched(real mrayl) {
  return mrayl > real(0.5) && mrayl < real(3.0);
}
// Air down to here under an element in contact is a CT's blurred skin, and coupled by gel.
SHARED_CONSTANT real kUsGelMm = 3.0;

// Where tissues meet between the middles of two samples is told by so many halvings: to a sixteenth of a sample. Of
// 7.6 MHz a sample of bone takes half a decibel.
SHARED_CONSTANT int kUsBorderHalvings = 4;

SHARED real us_amplitude(real db) {
  return pow(real(10.0), db / real(20.0));
}

// Level of the echo of a mirror across a thick interface, at normal incidence without loss, above liver's speckle.
// A mirror would be 61 dB above it: backscatter 3.7e-6·f^1.4 /mm/sr (calf liver), pulse 0.3 mm, F/2 by h/z; the
// interfaces of organs are rough and give 40 (design).
SHARED_CONSTANT real kUsInterfaceDb = 40.0;
SHARED_CONSTANT real kUsInterfaceConeRad = 0.2618;  // 15°: how far off the normal it still shines (design)
SHARED_CONSTANT real kUsInterfaceRoughDb = -26.0;   // of its part that goes everywhere, as the cosine (design)
// Interfaces whose echo is this far below liver's speckle are not worth their normal.
SHARED_CONSTANT real kUsLeastEchoDb = -10.0;
SHARED bool us_is_heard(real reflection) {
  return abs(reflection) >= us_amplitude(kUsLeastEchoDb - kUsInterfaceDb);
}
// Share of the echo that comes back at this cosine of the angle off the normal.
SHARED real us_interface_law(real cosine) {
  return us_mirror(acos(cosine), kUsInterfaceConeRad) + us_amplitude(kUsInterfaceRoughDb) * cosine;
}

// Echoes of strong reflectors come again from between them and the face, so much weaker each time (design, 10 to
// 15).
SHARED_CONSTANT real kUsRepeatDb = 12.0;
SHARED_CONSTANT real kUsRepeatsFrom = 0.9;  // |R|: gas
SHARED_CONSTANT int kUsMostAgain = 4;       // the echo itself is the first
SHARED real us_repeat(int again, real loss_db) {
  return us_amplitude(-real(again - 1) * (kUsRepeatDb + loss_db));
}
// A face in air shows its own lens: a line every 1.5 mm, half each time (design).
SHARED_CONSTANT real kUsLensMm = 1.5, kUsLensDb = 40.0, kUsLensDbPerLine = 6.0;
SHARED_CONSTANT int kUsLensLines = 20;
SHARED real us_lens_line(int line) {
  return us_amplitude(kUsLensDb - real(line - 1) * kUsLensDbPerLine);
}

// A sheet or a ball no wider than a voxel has the same on both sides, and rounding would tell its normal: where the
// sum of sides times ways is less than this share of what it can be, what is there is taken to face the beam
// (design). A plane has about a half.
SHARED_CONSTANT real kUsLeastSide = 1e-4;

// How far off the middle of a ball of weights 1 − r²/1.44R² a plane lies that leaves the sum `after` on one side
// (counted + and −): twice the way times the weight of a slice. `all`: of all weights; `square`: of them times the
// way along the normal, squared. A slice through the middle has 0.87 of what a Gaussian's of the same weight and
// spread would have.
SHARED real us_plane_off(real after, real all, real square) {
  return after / (real(2.0 * 0.87) * all / sqrt(real(6.283185307) * square / all));
}
// Of an interface in tissue that moved: cosine of the angle between the beam and its normal, from how much of the
// normal, as it is at rest, lies in the ways at rest along the beam, across it and out of the plane. (A normal is a
// covector: what it makes of a way does not change as the way is moved.)
SHARED real us_facing(real along, real across, real out_of_plane) {
  return abs(along) / max(sqrt(along * along + across * across + out_of_plane * out_of_plane), real(1e-9));
}

// A plane seen from its side says nothing of where along the beam it is.
SHARED_CONSTANT real kUsLeastPlaceCosine = 0.3;

// A round body that sound crosses at another speed is a lens, and behind its edges it is dark (Robinson, Wilson and
// Kossoff, J. Clin. Ultrasound 9 (1981) 181; LaFollette and Ziskin, Ultrasound Med. Biol. 12 (1986) 953). By
// Snell's law a ray that meets a ball at an angle θ leaves it turned towards the middle by 2(n − 1)·tan θ, to first
// order in n − 1, n = c outside / c inside; sin θ is how far off the middle it runs, in radii. One that runs by is
// not turned.
SHARED_CONSTANT real kUsMostSine = 0.98;  // a ray along the very edge
SHARED real us_turned_rad(real n_less_1, real off_radii) {
  real sine = clamp(off_radii, -kUsMostSine, kUsMostSine);
  return abs(off_radii) < real(1.0) ? real(2.0) * n_less_1 * sine / sqrt(real(1.0) - sine * sine) : real(0.0);
}
// How far the rays of a beam of this width part, a share of the width for each mm behind the body (negative: they
// meet); 0: of no round body. The ball is told by chord and cosine of the angle to the normal where the beam leaves
// it, by the law scatter, or by us_parting_by_width. Smaller ones are narrower than a beam, or single voxels of
// noise. What is left within 30° of squarely may be a layer, which voxels tell roughly; a ball hardly turns a ray
// there.
SHARED_CONSTANT real kUsLeastRoundMm = 3.0, kUsLeastChordMm = 2.0;
SHARED_CONSTANT real kUsLayerSine = 0.5, kUsRoundSine = 0.7;
SHARED real us_parting_per_mm(real shift_inside, real shift_outside, real chord_mm, real cosine, real width_mm) {
  real radius_mm = real(0.5) * chord_mm / max(cosine, real(1e-3));
  real n_less_1 = (real(1.0) + shift_inside) / (real(1.0) + shift_outside) - real(1.0);
  real off = sqrt(max(real(1.0) - cosine * cosine, real(0.0)));
  real side = real(0.5) * width_mm / radius_mm;
  bool is_round = chord_mm >= kUsLeastChordMm && radius_mm >= kUsLeastRoundMm;
  real at_edge = clamp((off - kUsLayerSine) / (kUsRoundSine - kUsLayerSine), real(0.0), real(1.0));
  return is_round ? at_edge * (us_turned_rad(n_less_1, off - side) - us_turned_rad(n_less_1, off + side)) / width_mm
                  : real(0.0);
}
// The same of a body that from the middle of the beam's way through it reaches so far to one side and to the other:
// half the sum is its radius, half the difference how far off its middle the beam runs. A layer reaches as far to
// both sides, at any tilt, and turns no ray. Never more than this (design): behind an edge the aperture looks past
// it on both sides, so that its shadow deepens with the way and is no bar that begins black.
SHARED_CONSTANT real kUsMostPartingPerMm = 0.08;
SHARED_CONSTANT real kUsReachStepMm = 0.5, kUsReachStepShare = 0.1;  // of looks for its end, and of the way so far
SHARED_CONSTANT real kUsMostReachMm = 40.0;
SHARED_CONSTANT int kUsReachHalvings = 5;
SHARED real us_parting_by_width(real shift_inside, real shift_outside, real one_mm, real other_mm, real width_mm) {
  real radius_mm = real(0.5) * (one_mm + other_mm);
  real off = abs(one_mm - other_mm) / max(one_mm + other_mm, real(1e-3));
  real cosine = sqrt(max(real(1.0) - off * off, real(0.0)));
  return clamp(us_parting_per_mm(shift_inside, shift_outside, real(2.0) * radius_mm * cosine, cosine, width_mm),
               -kUsMostPartingPerMm, kUsMostPartingPerMm);
}
// Of those across the beam and out of the plane the one that turns rays more.
SHARED real us_stronger(real one_per_mm, real other_per_mm) {
  return abs(one_per_mm) >= abs(other_per_mm) ? one_per_mm : other_per_mm;
}
// Share of the two-way amplitude that is left behind it: power falls as rays part, and an echo comes back the same
// way. Never more than 1: of how bright a focus is rays know nothing. Never less than this (design): what they
// leave empty, diffraction fills.
SHARED_CONSTANT real kUsMostEdgeDb = 12.0;
SHARED real us_behind_edge(real parting_per_mm, real behind_mm) {
  real parted = abs(real(1.0) + parting_per_mm * max(behind_mm, real(0.0)));
  return max(us_amplitude(-kUsMostEdgeDb), real(1.0) / max(parted, real(1.0)));
}

SHARED_END

#endif
