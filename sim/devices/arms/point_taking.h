// The template's points (calibration.h), taken one after another with an arm's stylus: its button, or somebody at a
// key, says when it stands on the point that is asked for; then it is held still for a moment, and the mean counts.
// Pure; allocates nothing while it is advanced.
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sim/devices/arms/calibration.h"
#include "sim/devices/haptic_arm.h"

namespace seldinger::devices {

// A stylus on a board stays within kTakeStillMm of where it was put while it is read for kTakeS (design: half of
// what a calibration may be off).
inline constexpr double kTakeS = 0.4, kTakeStillMm = 0.5;
inline constexpr std::size_t kTemplatePoints = 6;

enum class Taking { waiting, reading, moved, lost };  // moved, lost: the last time; it waits again

class PointTaking {
 public:
  // One tick. The stylus' first button takes a point when it goes down; `told` does the same. Of an arm that is not
  // healthy nothing is taken.
  void advance(const ArmReading& reading, bool told, double elapsed_s) noexcept;

  // Which of template_points() is to be touched; nothing: all were.
  std::optional<std::size_t> asked() const noexcept;
  Taking state() const noexcept { return state_; }
  const std::array<std::optional<glm::dvec3>, kTemplatePoints>& taken_mm() const noexcept { return taken_mm_; }
  std::vector<TakenPoint> points() const;  // for calibrate()

  void again(std::size_t point) noexcept;  // it is asked for next; what was taken there is forgotten
  void leave_out() noexcept;               // goes on without the point that is asked for, where it is not required

 private:
  std::array<std::optional<glm::dvec3>, kTemplatePoints> taken_mm_{};
  std::array<bool, kTemplatePoints> left_out_{};
  Taking state_ = Taking::waiting;
  bool was_down_ = true;  // a button that is down at first was not meant
  glm::dvec3 from_mm_{0.0}, sum_mm_{0.0};
  double read_s_ = 0.0;
  std::size_t readings_ = 0;
};

}  // namespace seldinger::devices
