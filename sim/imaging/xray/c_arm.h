// A C-arm's picture as the geometry of a projection, and whether the operator's hand is in its beam.
#pragma once

#include "sim/case/c_arm.h"
#include "sim/case/fluoroscope.h"
#include "sim/case/patient_position.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

// The field of a magnification (0, 1, 2) on a square picture of size_px (> 0): u to the right, v down, as
// cases::BeamFrame has them. The collimator does not change it.
XrayGeometry c_arm_geometry(const cases::Fluoroscope& fluoroscope, const cases::CArm& arm, int magnification,
                            int size_px, cases::PatientPosition position);

// The hand at a needle: a ball about a place on the shaft, near the hub.
constexpr double kHandRadiusMm = 45.0;  // half of a closed hand's breadth: 85–90 mm for men (ISO 7250 statistics)
constexpr double kHandShare = 0.6;      // of the needle's length, from the tip
glm::dvec3 hand_at_needle(const glm::dvec3& tip_lps_mm, const glm::dvec3& direction, double length_mm) noexcept;

// Whether a ball meets the collimated beam: the pyramid from the source to the open part of the field on the
// detector. Exact, borders count.
bool meets_beam(const cases::BeamFrame& frame, double field_side_mm, const cases::Collimator& collimator,
                const glm::dvec3& center_lps_mm, double radius_mm) noexcept;

}  // namespace seldinger::imaging
