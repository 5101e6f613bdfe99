// An attempt of a simulated operator in virtual time: operator → virtual device → tick → guidance → operator, and
// its recording.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "assessment/operators/plan.h"
#include "assessment/operators/profile.h"
#include "sim/case/case.h"
#include "sim/case/event.h"
#include "sim/case/record/recording.h"

namespace seldinger::session {

constexpr double kMaxAttemptSeconds = 300.0;  // an operator who has not fired by then gives up

// What the hands of an operator who is nobody draw from: no two names and seeds have one in common, so attempts of
// two operators with the same seed have nothing to do with each other. People have streams of their own
// (assessment/population/streams.h).
std::uint64_t stream_of_operator(const std::string& name, std::uint64_t seed) noexcept;

// `stream`: what hands and eyes draw from. `scenario`: a mentor's events, by rising time. After `limit_s` it is
// over, whatever was done by then.
cases::Recording run_attempt(const cases::Case& scene, const assessment::PuncturePlan& plan,
                             const assessment::OperatorProfile& profile, std::uint64_t stream,
                             std::span<const cases::Event> scenario = {}, double limit_s = kMaxAttemptSeconds);

}  // namespace seldinger::session
