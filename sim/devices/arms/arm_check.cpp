#include "sim/devices/arms/arm_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::devices {
namespace {

glm::dvec3 direction(std::size_t push) noexcept {
  glm::dvec3 d(0.0);
  d[static_cast<int>(push / 2)] = push % 2 == 0 ? 1.0 : -1.0;
  return d;
}

}  // namespace

glm::dvec3 ArmCheck::reached_mm() const noexcept {
  return most_mm_ - least_mm_;
}

bool ArmCheck::reach_holds() const noexcept {
  const glm::dvec3 reached = reached_mm();
  return reached.x >= kCheckReachMm && reached.y >= kCheckReachMm && reached.z >= kCheckReachMm;
}

bool ArmCheck::pushes_hold() const noexcept {
  return std::all_of(pushes_.begin(), pushes_.end(), [](PushFound found) { return found == PushFound::right; });
}

bool ArmCheck::lateness_holds() const noexcept {
  return lateness_.n > 0 && static_cast<double>(lateness_.quantile_ns(0.99)) <= kCheckLateS * 1e9;
}

bool ArmCheck::holds() const noexcept {
  return step_ == CheckStep::done && answered_ && lost_ == 0 && reach_holds() && pushes_hold() && lateness_holds();
}

void ArmCheck::enough_reach() noexcept {
  if (step_ != CheckStep::reach) return;
  step_ = CheckStep::push;
  in_step_s_ = 0.0;
}

glm::dvec3 ArmCheck::advance(const ArmReading& reading, double elapsed_s) noexcept {
  if (!(elapsed_s > 0.0) || step_ == CheckStep::done) return glm::dvec3(0.0);
  if (!reading.healthy) {
    if (was_healthy_) ++lost_;
    was_healthy_ = false;
    // A push that was interrupted begins again; for who does not answer, or is lost again and again, there is an
    // end.
    in_step_s_ = 0.0;
    silent_s_ += elapsed_s;
    if (silent_s_ > kCheckWaitS || lost_ >= kMostLost) step_ = CheckStep::done;
    return glm::dvec3(0.0);
  }
  was_healthy_ = true;
  silent_s_ = 0.0;
  if (reading.count != last_count_) {
    last_count_ = reading.count;
    lateness_.add(static_cast<std::uint64_t>(std::max(0.0, reading.round_trip_s + reading.age_s) * 1e9));
  }
  if (step_ == CheckStep::answer) {
    answered_ = true;
    least_mm_ = most_mm_ = reading.position_mm;
    step_ = CheckStep::reach;
    in_step_s_ = 0.0;
  }
  in_step_s_ += elapsed_s;
  if (step_ == CheckStep::reach) {
    least_mm_ = glm::min(least_mm_, reading.position_mm);
    most_mm_ = glm::max(most_mm_, reading.position_mm);
    if (reach_holds()) enough_reach();
    return glm::dvec3(0.0);
  }
  return push(reading);
}

glm::dvec3 ArmCheck::push(const ArmReading& reading) noexcept {
  const double pushed_s = in_step_s_ - kPushRestS;
  if (pushed_s <= 0.0) {
    if (glm::length(reading.position_mm - from_mm_) > kRestMm) {
      from_mm_ = reading.position_mm;
      in_step_s_ = 0.0;
    }
    return glm::dvec3(0.0);
  }
  const glm::dvec3 along = direction(push_);
  if (pushed_s < kPushS) return along * (kCheckForceN * std::min(1.0, pushed_s / kPushRiseS));
  const glm::dvec3 moved_mm = reading.position_mm - from_mm_;
  const double way_mm = glm::length(moved_mm);
  constexpr double kCos45 = 0.7071067811865476;
  pushes_[push_] = way_mm < kPushMovedMm                          ? PushFound::still
                   : glm::dot(moved_mm, along) >= kCos45 * way_mm ? PushFound::right
                                                                  : PushFound::wrong_way;
  in_step_s_ = 0.0;
  if (++push_ == pushes_.size()) step_ = CheckStep::done;
  return glm::dvec3(0.0);
}

}  // namespace seldinger::devices
