// From a device's reading to a tool's pose in the patient, and from a force there back to the device's motors.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "sim/case/inputs.h"
#include "sim/case/patient_position.h"
#include "sim/devices/arms/calibration.h"
#include "sim/devices/arms/device_gains.h"
#include "sim/devices/haptic_arm.h"

namespace seldinger::devices {

// Where the user stands beside the table.
enum class StandsAt { patients_right, patients_left };
// On whose side the entry is.
StandsAt side_of(const glm::dvec3& entry_lps_mm, const glm::dvec3& middle_lps_mm,
                 cases::PatientPosition position) noexcept;

// Where the template lies in the patient: its up is away from the table; its x, the user's right, runs along the
// table, to the feet of a patient on whose right the user stands, who then faces the patient; kEntryAboveMm above
// its middle is the planned entry, so that the device's reach is around it. motion_scale: mm of the patient for a
// mm of the hand, about the entry.
inline constexpr double kEntryAboveMm = 70.0;  // half the box (143 mm): there is way up and down
Placement patient_from_template(cases::PatientPosition position, StandsAt stands, const glm::dvec3& entry_lps_mm,
                                double motion_scale = 1.0);

// How a tool lies in the stylus, in its axes: a needle points along the stylus' −z, a probe's face looks along it;
// side is the stylus' x (design: until a real grip says otherwise).
inline const glm::dvec3 kToolAxis{0.0, 0.0, -1.0}, kToolSide{1.0, 0.0, 0.0};

// Slow beside a hand, soon done beside a puncture (design).
inline constexpr double kMeltMmS = 50.0, kMeltRadS = 0.8;

class ArmMapping {
 public:
  ArmMapping(const Placement& template_from_device, const Placement& patient_from_template,
             const DeviceGains& gains = {}) noexcept;

  // The tool's pose of this tick. Of a device that is not healthy: the last, it stays where it was. When the device
  // comes back its hand may be anywhere: the tool goes on from where it stayed, as if the hand had re-gripped it
  // once it answers what was asked since (an answer that waited out a stall tells where the hand was before it),
  // and what lies between the two melts at kMeltMmS and kMeltRadS while `free` (the tool is outside the body, where
  // that disturbs nothing).
  const cases::ToolPose& advance(const ArmReading& reading, bool free, double elapsed_s) noexcept;
  bool healthy() const noexcept { return healthy_; }
  // Of a hand that is not healthy: something else holds its tool, here; from here it goes on.
  void leave_at(const cases::ToolPose& pose) noexcept;
  // Not followed until it answers what is asked from now on, which is a re-grip: so after a pause or a stall.
  void let_go() noexcept;
  // Between hand and tool; 0 but for a re-grip.
  double offset_mm() const noexcept;

  // Newtons are the patient's and the hand's alike, as far as the gains and rest allow (usable_share).
  glm::dvec3 device_force(const glm::dvec3& force_lps_n) const noexcept;
  // Where the device is, in its own axes, when its tool is held so and nothing was re-gripped: the way back of a
  // reading's pose, for hands that are themselves simulated.
  ArmReading reading_of(const cases::ToolPose& pose) const noexcept;

 private:
  cases::ToolPose pose_of(const ArmReading& reading) const noexcept;

  Placement template_from_device_, patient_from_template_;
  DeviceGains gains_;
  cases::ToolPose pose_;
  glm::dvec3 offset_lps_mm_{0.0}, offset_rad_{0.0};  // the turn of the axis, and then
  double spin_rad_ = 0.0;                            // about it
  double silent_s_ = 0.0;                            // since it was last healthy
  bool begun_ = false, healthy_ = false;
};

}  // namespace seldinger::devices
