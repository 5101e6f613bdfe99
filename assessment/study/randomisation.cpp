#include "assessment/study/randomisation.h"

#include <span>
#include <utility>
#include <vector>

#include "sim/base/check.h"
#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::study {
namespace {

// Without the bias of a remainder: uniform() has 53 bits.
std::size_t below(base::Rng& rng, std::size_t n) {
  return static_cast<std::size_t>(rng.uniform() * static_cast<double>(n));
}

}  // namespace

std::size_t allocated(const Plan& plan, std::uint64_t seed, std::string_view stratum, std::size_t position) {
  CHECK(plan.randomised && !plan.randomisation.block_sizes.empty());
  std::size_t places = 0;
  for (const PlannedGroup& arm : plan.groups) places += static_cast<std::size_t>(arm.ratio);
  base::Rng rng(base::hash_combine(seed, base::hash_bytes(std::as_bytes(std::span(stratum)))));
  std::vector<std::size_t> block;
  for (std::size_t first = 0;; first += block.size()) {
    const std::vector<int>& sizes = plan.randomisation.block_sizes;
    const auto size = static_cast<std::size_t>(sizes[below(rng, sizes.size())]);
    block.clear();
    for (std::size_t arm = 0; arm < plan.groups.size(); ++arm)
      block.insert(block.end(), static_cast<std::size_t>(plan.groups[arm].ratio) * (size / places), arm);
    CHECK(!block.empty());
    for (std::size_t i = block.size(); i > 1; --i)
      std::swap(block[i - 1], block[below(rng, i)]);  // Fisher and Yates
    if (position < first + block.size()) return block[position - first];
  }
}

}  // namespace seldinger::assessment::study
