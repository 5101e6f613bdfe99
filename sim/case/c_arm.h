// Where the rays of a C-arm run: the machine's angles as directions in the patient, and back. The same bits on
// every machine.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "sim/case/fluoroscope.h"
#include "sim/case/patient_position.h"

namespace seldinger::cases {

// Unit vector of travel of the central ray, tube to detector (LPS). LAO and cranial are named after the patient, so
// that LAO turns the detector to the patient's left whether he lies on his back or on his face; of one who lies on
// his left (right) side it turns it to his front (back).
glm::dvec3 beam_direction(double lao_deg, double cranial_deg, PatientPosition position) noexcept;

// The angles at which the central ray runs along `direction` (unit). Beyond a machine's limits for some.
struct BeamAngles {
  double lao_deg = 0.0, cranial_deg = 0.0;
};
BeamAngles angles_of_beam(const glm::dvec3& direction, PatientPosition position) noexcept;

// The machine's frame in the patient. The picture is seen from the detector with the head up: v points down the
// picture, towards the feet; u to its right, which is the left of a supine patient.
struct BeamFrame {
  glm::dvec3 source_lps_mm{0.0}, detector_center_lps_mm{0.0};
  glm::dvec3 direction{0.0, -1.0, 0.0}, u{1.0, 0.0, 0.0}, v{0.0, 0.0, -1.0};  // unit, v = u × direction
  double sid_mm = 0.0;
};
BeamFrame beam_frame(const Fluoroscope& fluoroscope, const CArm& arm, PatientPosition position) noexcept;

// The field's side on the detector at a magnification 0, 1, 2 (others count as the nearest).
double field_side_mm(const Fluoroscope& fluoroscope, int magnification) noexcept;

// Where a point is cast on the detector: mm from its middle along u and v, and how much larger than life things at
// the point's depth are there. Nothing for a point not in front of the source.
struct Shadow {
  glm::dvec2 detector_mm{0.0};
  double magnification = 1.0;
};
std::optional<Shadow> shadow_of(const BeamFrame& frame, const glm::dvec3& point_lps_mm) noexcept;

// Whether a place on the detector is inside the collimated field (borders count).
bool inside_field(const Fluoroscope& fluoroscope, int magnification, const Collimator& collimator,
                  const glm::dvec2& detector_mm) noexcept;

}  // namespace seldinger::cases
