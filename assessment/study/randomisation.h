// Whom chance sends to which arm: permuted blocks, a sequence for each stratum, a pure function of seed and
// stratum. Block sizes are drawn too, so that the last places of a block cannot be guessed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "assessment/study/plan.h"

namespace seldinger::assessment::study {

// The index of the group at a position (from 0) of the stratum's sequence. Whoever knows the seed knows them all.
std::size_t allocated(const Plan& plan, std::uint64_t seed, std::string_view stratum, std::size_t position);

}  // namespace seldinger::assessment::study
