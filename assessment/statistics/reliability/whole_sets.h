// Every set of whole numbers that has a reported mean and standard deviation: where there is one alone, a summary
// tells what its respondents answered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "assessment/statistics/reliability/grim.h"

namespace seldinger::assessment::statistics {

struct WholeSets {
  std::size_t count = 0;            // found
  bool all = true;                  // false: the search ended early, there may be more
  std::vector<std::int64_t> first;  // ascending; persons' scores times `items`; empty where there is none
};
// Of at least two persons; `sd` is there. Finds up to `most` sets, and gives up where they lie too far apart.
WholeSets whole_sets_of(const ReportedScale& reported, std::size_t most = 100'000);

}  // namespace seldinger::assessment::statistics
