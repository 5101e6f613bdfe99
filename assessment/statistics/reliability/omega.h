// McDonald's omega: the share of a scale's variance that one factor behind its items explains.
#pragma once

#include <cstddef>
#include <cstdint>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/complete_table.h"
#include "assessment/statistics/reliability/alpha.h"

namespace seldinger::assessment::statistics {

// Total, of standardised items and of items as scored, by one factor. The interval is normal on the logit scale,
// with the spread that `resamples` draws of persons have, from `seed`; none for 0.
Answer omega(CompleteTable items, const ItemScale& scale, std::size_t resamples, std::uint64_t seed);

}  // namespace seldinger::assessment::statistics
