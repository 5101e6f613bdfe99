// Whether a force-feedback arm is fit for an attempt, asked step by step with somebody at its stylus: does it
// answer, does it reach, does it push where it is told to, how late is it? Pure: readings go in, forces come out; a
// window says what to do next.
#pragma once

#include <array>
#include <glm/vec3.hpp>

#include "sim/case/record/time_histogram.h"
#include "sim/devices/haptic_arm.h"

namespace seldinger::devices {

enum class CheckStep { answer, reach, push, done };

// What came of a push along +x, −x, +y, … of the device's axes.
enum class PushFound { not_yet, right, still, wrong_way };

// What an attempt needs (design): a hand's breadth each way; to feel 1 N; the laws' most delay (haptics:
// kMostDelayTicks, 3 ms).
inline constexpr double kCheckReachMm = 100.0, kCheckForceN = 1.0, kCheckLateS = 0.003;
// Before a push the stylus is at rest, within kRestMm for kPushRestS: until then the user is waited for. A push is
// let in over kPushRiseS and judged after kPushS. A held stylus gives way by some mm to 1 N; one that moves by less
// than kPushMovedMm is held fast or has no motor, and one whose way is more than 45° off has its axes wrong.
inline constexpr double kPushRiseS = 0.2, kPushS = 0.6, kPushRestS = 0.4, kRestMm = 0.3, kPushMovedMm = 0.8;
inline constexpr double kCheckWaitS = 10.0;     // for an answer, each time
inline constexpr std::uint64_t kMostLost = 20;  // then it is as unfit as it can be shown to be

class ArmCheck {
 public:
  // One tick: what the motors are to give, N in the device's axes. Of an arm that is not healthy: nothing, and
  // the step waits, for kCheckWaitS and kMostLost times. Allocates nothing.
  glm::dvec3 advance(const ArmReading& reading, double elapsed_s) noexcept;
  // Goes on to the pushes without the whole reach: the user cannot, or need not.
  void enough_reach() noexcept;

  CheckStep step() const noexcept { return step_; }
  std::size_t pushing() const noexcept { return push_; }  // in step push: which, 0 to 5
  bool answered() const noexcept { return answered_; }
  glm::dvec3 reached_mm() const noexcept;
  const std::array<PushFound, 6>& pushes() const noexcept { return pushes_; }
  // From a force to the state that answered it and is read: round trip and age.
  const cases::TimeHistogram& lateness() const noexcept { return lateness_; }
  std::uint64_t lost() const noexcept { return lost_; }  // how often it stopped answering

  bool reach_holds() const noexcept;
  bool pushes_hold() const noexcept;
  bool lateness_holds() const noexcept;  // 99 of 100 readings
  bool holds() const noexcept;           // all of it, once done

 private:
  glm::dvec3 push(const ArmReading& reading) noexcept;

  CheckStep step_ = CheckStep::answer;
  double in_step_s_ = 0.0, silent_s_ = 0.0;
  bool answered_ = false, was_healthy_ = false;
  std::uint64_t lost_ = 0, last_count_ = 0;
  glm::dvec3 least_mm_{0.0}, most_mm_{0.0}, from_mm_{0.0};
  std::size_t push_ = 0;
  std::array<PushFound, 6> pushes_{};
  cases::TimeHistogram lateness_;
};

}  // namespace seldinger::devices
