#include "sim/imaging/room/c_arm_forms.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace seldinger::imaging {
namespace {

const RoomColour kHousing(0.74F, 0.75F, 0.75F), kDark(0.16F, 0.17F, 0.18F);

}  // namespace

RoomMesh c_arm_tube_form(const cases::Fluoroscope& fluoroscope) {
  const double source_mm = fluoroscope.source_isocentre_mm;
  RoomMesh mesh = box({-130.0, -160.0, -source_mm - 120.0}, {130.0, 160.0, -source_mm + 60.0}, 25.0, kHousing);
  const std::vector<TurnedPart> collimator = {{{0.0, -source_mm + 60.0}, {95.0, -source_mm + 60.0}, kDark},
                                              {{95.0, -source_mm + 60.0}, {80.0, -source_mm + 130.0}, kDark},
                                              {{80.0, -source_mm + 130.0}, {0.0, -source_mm + 131.0}, kDark}};
  mesh.append(turned(collimator, 24), glm::dmat4(1.0));
  // A half circle by way of the patient's head.
  std::vector<glm::dvec3> arc;
  const double radius_mm = source_mm + 40.0;
  constexpr int kSteps = 28;
  for (int i = 0; i <= kSteps; ++i) {
    const double angle = std::numbers::pi * (i - 0.5 * kSteps) / kSteps;
    arc.push_back({0.0, 120.0 + (radius_mm - 120.0) * std::cos(angle), radius_mm * std::sin(angle)});
  }
  mesh.append(swept(arc, 55.0, 14, kHousing), glm::dmat4(1.0));
  return mesh;
}

RoomMesh c_arm_detector_form(const cases::Fluoroscope& fluoroscope) {
  const double half_mm = 0.5 * fluoroscope.detector_side_mm + 25.0;
  RoomMesh mesh = box({-half_mm, -half_mm, 0.0}, {half_mm, half_mm, 70.0}, 15.0, kHousing);
  const double face_mm = 0.5 * fluoroscope.detector_side_mm;
  mesh.append(box({-face_mm, -face_mm, -3.0}, {face_mm, face_mm, 1.0}, 0.5, kDark), glm::dmat4(1.0));
  mesh.append(box({-80.0, -80.0, 60.0}, {80.0, 80.0, 420.0}, 12.0, kHousing), glm::dmat4(1.0));
  return mesh;
}

}  // namespace seldinger::imaging
