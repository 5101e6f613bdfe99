#include "sim/devices/arms/arm_mapping.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "sim/base/vectors.h"
#include "sim/devices/hands/turning.h"

namespace seldinger::devices {
namespace {

const glm::dvec3 kFeet(0.0, 0.0, -1.0);

// Along the table, the user's right.
glm::dvec3 to_the_right(StandsAt stands) noexcept {
  return stands == StandsAt::patients_right ? kFeet : -kFeet;
}

}  // namespace

StandsAt side_of(const glm::dvec3& entry_lps_mm, const glm::dvec3& middle_lps_mm,
                 cases::PatientPosition position) noexcept {
  // Towards a user who has the feet at the right.
  const glm::dvec3 towards = glm::cross(to_the_right(StandsAt::patients_right), cases::upwards(position));
  return glm::dot(entry_lps_mm - middle_lps_mm, towards) >= 0.0 ? StandsAt::patients_right
                                                                : StandsAt::patients_left;
}

Placement patient_from_template(cases::PatientPosition position, StandsAt stands, const glm::dvec3& entry_lps_mm,
                                double motion_scale) {
  const glm::dvec3 x = to_the_right(stands), y = cases::upwards(position);
  Placement placement;
  placement.rotation = glm::dmat3(x, y, glm::cross(x, y));
  placement.scale = motion_scale;
  placement.translation_mm =
      entry_lps_mm - motion_scale * (placement.rotation * glm::dvec3(0.0, kEntryAboveMm, 0.0));
  return placement;
}

ArmMapping::ArmMapping(const Placement& template_from_device, const Placement& patient_from_template,
                       const DeviceGains& gains) noexcept
    : template_from_device_(template_from_device), patient_from_template_(patient_from_template), gains_(gains) {}

cases::ToolPose ArmMapping::pose_of(const ArmReading& reading) const noexcept {
  const glm::dmat3 rotation =
      patient_from_template_.rotation * template_from_device_.rotation * reading.orientation;
  cases::ToolPose pose{patient_from_template_(template_from_device_(reading.position_mm)), rotation * kToolAxis,
                       rotation * kToolSide};
  square_up(pose);
  return pose;
}

const cases::ToolPose& ArmMapping::advance(const ArmReading& reading, bool free, double elapsed_s) noexcept {
  const bool sound = reading.healthy && base::is_finite(reading.position_mm) &&
                     base::is_finite(reading.orientation[0]) && base::is_finite(reading.orientation[1]) &&
                     base::is_finite(reading.orientation[2]);
  if (!sound) let_go();
  if (!healthy_) silent_s_ += elapsed_s;
  const bool asked_before = begun_ && !healthy_ && !(reading.age_s + reading.round_trip_s <= silent_s_);
  if (!sound || asked_before) return pose_;
  cases::ToolPose pose = pose_of(reading);
  if (begun_ && !healthy_) {
    offset_lps_mm_ = pose_.position_lps_mm - pose.position_lps_mm;
    // The turn from the hand to the tool: of the axes first, then about the axis.
    offset_rad_ = turn_between(pose.axis, pose_.axis);
    const glm::dvec3 side = turned(pose.side, offset_rad_);
    spin_rad_ = glm::dot(turn_between(side, pose_.side), pose_.axis);
  }
  begun_ = healthy_ = true;
  if (free && elapsed_s > 0.0) {
    offset_lps_mm_ -= limited(offset_lps_mm_, kMeltMmS * elapsed_s);
    offset_rad_ -= limited(offset_rad_, kMeltRadS * elapsed_s);
    spin_rad_ -= std::copysign(std::min(std::abs(spin_rad_), kMeltRadS * elapsed_s), spin_rad_);
  }
  if (offset_rad_ != glm::dvec3(0.0)) turn(offset_rad_, pose);
  if (spin_rad_ != 0.0) turn(pose.axis * spin_rad_, pose);
  pose.position_lps_mm += offset_lps_mm_;
  pose_ = pose;
  return pose_;
}

void ArmMapping::let_go() noexcept {
  if (healthy_) silent_s_ = 0.0;
  healthy_ = false;
}

void ArmMapping::leave_at(const cases::ToolPose& pose) noexcept {
  if (healthy_) return;
  pose_ = pose;
  begun_ = true;
}

double ArmMapping::offset_mm() const noexcept {
  return glm::length(offset_lps_mm_);
}

glm::dvec3 ArmMapping::device_force(const glm::dvec3& force_lps_n) const noexcept {
  const double share = usable_share(gains_, patient_from_template_.scale * template_from_device_.scale);
  return limited(
      share * (glm::transpose(patient_from_template_.rotation * template_from_device_.rotation) * force_lps_n),
      gains_.most_force_n);
}

ArmReading ArmMapping::reading_of(const cases::ToolPose& pose) const noexcept {
  ArmReading reading;
  reading.position_mm = inverse_of(template_from_device_)(inverse_of(patient_from_template_)(pose.position_lps_mm));
  cases::ToolPose held = pose;
  square_up(held);
  // kToolSide and kToolAxis are the stylus' x and −z.
  const glm::dmat3 lps_from_stylus(held.side, glm::cross(-held.axis, held.side), -held.axis);
  reading.orientation =
      glm::transpose(patient_from_template_.rotation * template_from_device_.rotation) * lps_from_stylus;
  return reading;
}

}  // namespace seldinger::devices
