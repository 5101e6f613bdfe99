// What every cut that persons were drawn again for says of its interval.
#pragma once

#include "assessment/statistics/answer.h"
#include "assessment/statistics/percentile_bootstrap.h"

namespace seldinger::assessment::statistics {

// The interval and what to know of it; nothing where there were no draws.
void say_of_draws(Answer& answer, const Bootstrapped& drawn);

}  // namespace seldinger::assessment::statistics
