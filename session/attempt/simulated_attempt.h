// An attempt of a simulated operator in virtual time: operator → virtual device → tick → guidance → operator, and
// its recording.
#pragma once

#include <cstdint>
#include <span>

#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "sim/case/case.h"
#include "sim/case/event.h"
#include "sim/case/record/recording.h"

namespace seldinger::session {

constexpr double kMaxAttemptSeconds = 300.0;  // an operator who has not fired by then gives up

// `scenario`: a mentor's events, by rising time. After `limit_s` it is over, whatever was done by then.
cases::Recording run_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                             const assessment::OperatorProfile& profile, std::uint64_t seed,
                             std::span<const cases::Event> scenario = {}, double limit_s = kMaxAttemptSeconds);

}  // namespace seldinger::session
