// Needle and lesions in an X-ray picture, by closed-form chords laid over the finished path lengths: a needle is a
// hollow iron cylinder with an empty lumen, a lesion a sphere of its HU. Each displaces what lies on its chord
// (needle over lesion over volume; the first lesion that contains a point wins); the volume is not touched, and a
// moving needle needs no new projection.
#pragma once

#include "sim/imaging/inserted.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

// Where a ray (from + t·(to − from), 0 ≤ t ≤ 1) is inside something; empty when enter ≥ leave.
struct Chord {
  double enter = 0.0, leave = 0.0;  // t
};

// The finite cylinder tip − s·direction, 0 ≤ s ≤ length.
Chord cylinder_chord(const RaySegment& ray, const glm::dvec3& tip_lps_mm, const glm::dvec3& direction,
                     double length_mm, double radius_mm) noexcept;
Chord sphere_chord(const RaySegment& ray, const glm::dvec3& center_lps_mm, double radius_mm) noexcept;

// What one ray sees of the instruments: what to add to the volume's lengths (negative where tissue is displaced).
struct OverlaidLengths {
  double water_mm = 0.0, mineral_mm = 0.0, iron_mm = 0.0;
};
OverlaidLengths overlaid_lengths(const volume::Volume& volume, const RaySegment& ray, const Inserted& inserted,
                                 ProjectionMethod method);

// Lays `inserted` over `lengths`, which were projected by `method` in this geometry. Touches only the pixels in
// the shadow of an instrument. A pose that is not finite is not shown.
void overlay_instruments(const volume::Volume& volume, const XrayGeometry& geometry, const Inserted& inserted,
                         ProjectionMethod method, PathLengths& lengths);

}  // namespace seldinger::imaging
