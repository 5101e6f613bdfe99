// How tissue gives way, each cause by a closed form of an incompressible elastic solid (ν = 1/2): what the CPU's
// touch and every picture add up (displacement.glsl.h). Compiled as GLSL in float and as C++ in double; nothing but
// + − × ÷ √, so that the CPU's bits are the same everywhere.
//
// Every form is a full solution from before 1972 and finite where there is tissue: a disk of pressure, a ball, a
// line that is asked for no nearer than its own radius. No kernel is smoothed.
#ifndef SELDINGER_SHADERS_SHARED_DISPLACEMENT_SOURCE
#define SELDINGER_SHADERS_SHARED_DISPLACEMENT_SOURCE

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

SHARED_CONSTANT int kMostDisplacementSources = 16;
SHARED_CONSTANT int kCavityHeights = 24;
SHARED_CONSTANT int kCavityWays = 32;  // directions about the axis
SHARED_CONSTANT int kCavityNodes = 768;

// One cause (std140, as everything here). Places are of tissue at rest, LPS, mm. What the rest holds is its kind's:
//   contact: place on the skin; along: unit, inwards; size: contact's radius a, depth of bone (0: none);
//            amount: mm, times the disk's potential
//   tip:     place of the tissue at the tip; along: unit, hub → tip; size: the ball's radius;
//            amount: mm it is moved
//   shaft:   place where it enters; along: unit, inwards; size: radius within which tissue moves as one, length;
//            amount: mm, of displacement_shaft's form
//   vein:    place of one end of its axis; along: unit; size: radius, length, length of its ends;
//            amount: share of its area that is gone
//   organ:   place: its middle; along: mm it is moved; size: radius; amount: how it is turned, about an axis, rad
//   breath:  place: x of the middle, y of the back, z of the diaphragm's dome;
//            size: half width, depth (back to front), from dome up to where it is still, from dome down to there;
//            amount: mm to the right, to the front, downwards, where it is most;
//            along: where organs slide, x and y of the cavity's axis, z of its lowest height, mm from height to
//            height; else 0
struct DisplacementSource {
  vec4 place_mm;
  vec4 along;
  vec4 size_mm;
  vec4 amount;
};

// All causes at once, kinds in the order above. A patient who lies still has none.
struct Displacement {
  int contact_end;  // sources [0, contact_end) are contacts, [contact_end, tip_end) are tips, …
  int tip_end;
  int shaft_end;
  int vein_end;
  int breath_end;  // = how many there are
  int organ_end;   // organs stand between shafts and veins
  int padding_0;
  int padding_1;
  DisplacementSource source[kMostDisplacementSources];
  vec4
      wall_mm[kCavityNodes / 4];  // where organs slide, from the axis to the cavity's wall: by height, by direction
};

// What displacement_points.comp is asked.
struct DisplacementPoints {
  int count;
  int to_rest;  // 1: X of x, 0: x of X
  int fixed_point_steps;
  int newton_steps;
};

// Of q > 0: x its arc tangent, to 1e-9, y q less that, to 1e-9 of itself: below 1/4 by its series, as the
// difference would leave float no digits. Both forms are computed and one is chosen, here and below: without
// branches compilers run several places at a time.
SHARED real4 atan_and_rest(real q) {
  real q_2 = q * q;
  real rest = q * q_2 *
              (real(1.0 / 3.0) -
               q_2 * (real(1.0 / 5.0) -
                      q_2 * (real(1.0 / 7.0) -
                             q_2 * (real(1.0 / 9.0) - q_2 * (real(1.0 / 11.0) -
                                                             q_2 * (real(1.0 / 13.0) - q_2 * real(1.0 / 15.0)))))));
  // atan q = 2 atan(q / (1 + √(1 + q²))), three times, which leaves at most tan(π/16); by 1/q, so that nothing
  // overflows.
  real inverse = real(1.0) / q;
  real t = real(1.0) / (inverse + sqrt(inverse * inverse + 1.0));
  t = t / (real(1.0) + sqrt(real(1.0) + t * t));
  t = t / (real(1.0) + sqrt(real(1.0) + t * t));
  real s = t * t;
  real angle = real(8.0) * t *
               (real(1.0) -
                s * (real(1.0 / 3.0) -
                     s * (real(1.0 / 5.0) - s * (real(1.0 / 7.0) - s * (real(1.0 / 9.0) - s * real(1.0 / 11.0))))));
  real4 both = real4(0.0);
  both.x = q < 0.25 ? q - rest : angle;
  both.y = q < 0.25 ? rest : q - angle;
  return both;
}

// The logarithm of x in [1, 1e6], to 4e-6: of its 16th root by the series of 2 artanh.
SHARED real log_by_roots(real x) {
  real root = sqrt(sqrt(sqrt(sqrt(x))));
  real t = (root - 1.0) / (root + 1.0);
  real s = t * t;
  return real(32.0) * t *
         (real(1.0) +
          s * (real(1.0 / 3.0) +
               s * (real(1.0 / 5.0) + s * (real(1.0 / 7.0) + s * (real(1.0 / 9.0) + s * (real(1.0 / 11.0) +
                                                                                         s * real(1.0 / 13.0)))))));
}

SHARED real eased(real t) {  // 0 up to 0, 1 from 1 on, without a kink
  real inside = clamp(t, real(0.0), real(1.0));
  return inside * inside * (real(3.0) - real(2.0) * inside);
}

// The potential of a disk of radius 1 under Hertz' pressure √(1 − r²), at r ≥ 0 and z > 0 from its middle, scaled
// to π/2 there: the limit of a homogeneous ellipsoid's (Kellogg, Foundations of Potential Theory, 1929, VII §6). l
// is the minor half-axis of the ellipsoid with the same foci that passes there.
struct DiskPotential {
  real value, by_r, by_z, by_zz, by_rz;
};
SHARED DiskPotential disk_potential(real r, real z) {
  real excess = r * r + z * z - 1.0;
  real root = sqrt(excess * excess + real(4.0) * z * z);
  // Either form keeps its digits on one side only.
  real l_2 = excess > 0.0 ? real(0.5) * (excess + root) : real(2.0) * z * z / (root - excess);
  real l = sqrt(l_2);
  real q = real(1.0) / l;
  real4 angle_and_rest = atan_and_rest(q);
  real angle = angle_and_rest.x;
  real k = angle_and_rest.y;
  real share = real(1.0) / (real(1.0) + q * q);  // l² / (1 + l²) = 1 / (1 + q²)
  real j = real(0.5) * (q < 0.25 ? q * q * q * share - k : angle - q * share);
  real inner = real(1.0) / (real(1.0) + l_2);
  real n = z * z + r * r * l_2 * l_2 * inner * inner;
  DiskPotential p;
  p.value = angle - r * r * j - z * z * k;
  p.by_r = real(-2.0) * r * j;
  p.by_z = real(-2.0) * z * k;
  p.by_zz = real(-2.0) * (k - z * z * inner / (l * n));
  p.by_rz = real(2.0) * r * z * l * inner * inner / n;
  return p;
}

// Of a disk pressed into a half space (Boussinesq 1885; Johnson, Contact Mechanics, 1985, §3.1 and §4.2 at ν =
// 1/2): x along r, y inwards; times the potential's amount in mm. With bone at depth h, in radii, the space ends
// there in a plane that does not move: the disk's image in it (Blake, Proc. Camb. Phil. Soc. 70, 1971, for slow
// flow, whose equations are an incompressible solid's), which is exact for every point of the disk, as all lie h
// above it. What the image does to the skin is not turned back once more. Above the skin (z ≤ 0) everything moves
// as the skin does.
SHARED real4 displacement_under_disk(real r, real z, real h) {
  real4 moved = real4(0.0);
  real deep = max(z, real(1e-5));  // on the disk itself l is 0; 1e-5 radii are nothing
  DiskPotential p = disk_potential(r, deep);
  moved.x = -deep * p.by_r;
  moved.y = p.value - deep * p.by_z;
  if (h > 0.0) {
    bool in_bone = deep >= h;
    real mirrored = in_bone ? h : real(2.0) * h - deep;
    DiskPotential image = disk_potential(r, mirrored);
    real twice = real(2.0) * h * (h - deep);
    moved.x += deep * image.by_r + twice * image.by_rz;
    moved.y += mirrored * image.by_z - image.value - twice * image.by_zz;
    moved.x = in_bone ? real(0.0) : moved.x;
    moved.y = in_bone ? real(0.0) : moved.y;
  }
  return moved;
}

SHARED real3 displacement_contact(DisplacementSource source, real3 p_mm) {
  real3 along = real3(source.along.x, source.along.y, source.along.z);
  real3 from_mm = p_mm - real3(source.place_mm.x, source.place_mm.y, source.place_mm.z);
  real per_radius = real(1.0) / real(source.size_mm.x);
  real z_mm = dot(from_mm, along);
  real3 across_mm = from_mm - z_mm * along;
  real r_mm = sqrt(dot(across_mm, across_mm));
  real4 moved = displacement_under_disk(r_mm * per_radius, z_mm * per_radius, real(source.size_mm.y) * per_radius);
  return real(source.amount.x) * (moved.y * along + (moved.x / max(r_mm, real(1e-6))) * across_mm);
}

// Tissue around a ball that is pushed along: the ball moves as it is pushed, and around it an incompressible solid
// gives way (the elastic reading of Stokes 1851; Lamb, Hydrodynamics, §335). F = 6 π G radius · amount.
SHARED real3 displacement_tip(DisplacementSource source, real3 p_mm) {
  real3 along = real3(source.along.x, source.along.y, source.along.z);
  real3 from_mm = p_mm - real3(source.place_mm.x, source.place_mm.y, source.place_mm.z);
  real distance_mm = max(sqrt(dot(from_mm, from_mm)), real(1e-6));
  real3 away = from_mm / distance_mm;
  real q = min(real(1.0), real(source.size_mm.x) / distance_mm);
  real cube = q * q * q;
  real forwards = dot(away, along);
  return real(source.amount.x) *
         ((real(0.75) * q + real(0.25) * cube) * along + (real(0.75) * (q - cube) * forwards) * away);
}

// Tissue around a line of equal forces along itself (Kelvin 1848, integrated from 0 to length), asked for no nearer
// than `radius_mm`: x along the line, y times the way across it.
SHARED real4 displacement_along_line(real along_mm, real across_mm, real radius_mm, real length_mm) {
  real rho_2 = max(across_mm, radius_mm) * max(across_mm, radius_mm);
  real to_end_mm = length_mm - along_mm;
  real r_0 = sqrt(along_mm * along_mm + rho_2);
  real r_1 = sqrt(to_end_mm * to_end_mm + rho_2);
  // r − t without losing its digits beside the line.
  real gap_0 = along_mm > 0.0 ? rho_2 / (r_0 + along_mm) : r_0 - along_mm;
  real gap_1 = to_end_mm > 0.0 ? rho_2 / (r_1 + to_end_mm) : r_1 - to_end_mm;
  real4 moved = real4(0.0);
  moved.x = real(2.0) * log_by_roots((r_0 + r_1 + length_mm) / (gap_0 + gap_1)) - to_end_mm / r_1 - along_mm / r_0;
  moved.y = real(1.0) / r_1 - real(1.0) / r_0;
  return moved;
}

SHARED real3 displacement_shaft(DisplacementSource source, real3 p_mm) {
  real3 along = real3(source.along.x, source.along.y, source.along.z);
  real3 from_mm = p_mm - real3(source.place_mm.x, source.place_mm.y, source.place_mm.z);
  real t_mm = dot(from_mm, along);
  real3 across_mm = from_mm - t_mm * along;
  real4 moved = displacement_along_line(t_mm, sqrt(dot(across_mm, across_mm)), real(source.size_mm.x),
                                        real(source.size_mm.y));
  return real(source.amount.x) * (moved.x * along + moved.y * across_mm);
}

// An organ goes along and turns as a whole, and what lies about it less and less, up to twice its radius: there the
// wall stays where it is, under which it slides (drawn, as breath is).
SHARED real3 displacement_organ(DisplacementSource source, real3 p_mm) {
  real3 from_mm = p_mm - real3(source.place_mm.x, source.place_mm.y, source.place_mm.z);
  real3 turned = real3(source.amount.x, source.amount.y, source.amount.z);
  real share = real(1.0) - eased(sqrt(dot(from_mm, from_mm)) / real(source.size_mm.x) - real(1.0));
  return share * (real3(source.along.x, source.along.y, source.along.z) +
                  real3(turned.y * from_mm.z - turned.z * from_mm.y, turned.z * from_mm.x - turned.x * from_mm.z,
                        turned.x * from_mm.y - turned.y * from_mm.x));
}

// A vein that loses part of its area: what lies around moves in so that areas across it stay what they were.
SHARED real3 displacement_vein(DisplacementSource source, real3 p_mm) {
  real3 along = real3(source.along.x, source.along.y, source.along.z);
  real3 from_mm = p_mm - real3(source.place_mm.x, source.place_mm.y, source.place_mm.z);
  real t_mm = dot(from_mm, along);
  real3 across_mm = from_mm - t_mm * along;
  real end_mm = real(source.size_mm.z);
  real gone = real(source.amount.x) * eased(t_mm / end_mm) * eased((real(source.size_mm.y) - t_mm) / end_mm);
  real q_2 =
      min(real(1.0), real(source.size_mm.x) * real(source.size_mm.x) / max(dot(across_mm, across_mm), real(1e-12)));
  return (sqrt(real(1.0) - gone * q_2) - 1.0) * across_mm;
}

// 1 at the dome, 0 from the apex and from the pelvis on.
SHARED real breath_level(DisplacementSource source, real up_mm) {
  return real(1.0) - (up_mm > 0.0 ? eased(up_mm / real(source.size_mm.z)) : eased(-up_mm / real(source.size_mm.w)));
}

// 0 in the spine and beside it in the back, 1 before them. The spine reaches further forwards than the back beside
// it, where the kidneys lie.
SHARED real before_the_spine(real side, real front) {
  real back = real(0.42) - real(0.32) * eased(abs(side) / 0.35);
  return eased((front - back) / 0.25);
}

// Breathing. Where it moves how much is drawn, not computed: no source gives a field (design). What it must show:
// most at the dome (how far: sim/case/breathing.h), a kidney 0.6 to 0.7 as
// far (Song 2011), nothing from the apex and from the pelvis on. Organs leave the wall of the trunk, the spine and
// the back where they are, here within the trunk's outer third (displacement_sliding parts them where the wall is);
// the front rises. LPS: x to the left, y to the back, z upwards.
SHARED real3 displacement_breath(DisplacementSource source, real3 p_mm) {
  real side = (p_mm.x - real(source.place_mm.x)) / real(source.size_mm.x);   // −1 right wall, 1 left wall
  real front = (real(source.place_mm.y) - p_mm.y) / real(source.size_mm.y);  // 0 back, 1 front
  real up_mm = p_mm.z - real(source.place_mm.z);
  real level = breath_level(source, up_mm);
  real middle = real(2.0) * front - 1.0;
  real from_middle = sqrt(side * side + middle * middle);  // 1 on the wall
  real inside = real(1.0) - eased((from_middle - 0.65) / 0.35);
  real organ = level * inside * before_the_spine(side, front);
  return real3(-real(source.amount.x) * organ, -real(source.amount.y) * level * eased(front),
               -real(source.amount.z) * organ);
}

SHARED_END

#endif
