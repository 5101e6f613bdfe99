// How long a one-sided cumulative sum of normal values, S ← max(0, S + z − k), runs until it reaches a limit.
#pragma once

namespace seldinger::assessment::statistics {

// On average, from S = 0, where z has the given mean and SD 1; k and limit in SDs, limit above 0.
double normal_run_length(double k, double limit, double mean);
// The limit with which the sum runs that long while the mean is 0; NaN where there is none up to 20 SDs.
double normal_limit(double k, double run_length);

}  // namespace seldinger::assessment::statistics
