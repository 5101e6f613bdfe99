// Fresh random groups for oracles: unequal, sometimes tied, sometimes with values missing.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "assessment/statistics/data_table.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::statistics {

// SELDINGER_R_SEED, else 1.
inline std::uint64_t oracle_seed() {
  const char* asked = std::getenv("SELDINGER_R_SEED");
  return asked != nullptr ? std::strtoull(asked, nullptr, 10) : 1;
}

class RandomTables {
 public:
  explicit RandomTables(std::uint64_t seed) : rng_(seed) {}

  std::size_t from_to(std::size_t low, std::size_t high) {
    return low + static_cast<std::size_t>(rng_.uniform() * static_cast<double>(high - low + 1));
  }
  double normal() { return rng_.normal(); }
  double uniform() { return rng_.uniform(); }

  // `ties`: to whole numbers; `gaps`: one in eight is missing, but never the first two.
  std::vector<double> values(std::size_t n, double mean, double sd, bool ties, bool gaps) {
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i) {
      const double value = mean + sd * rng_.normal();
      values.push_back(ties ? std::round(value) : value);
      if (gaps && i >= 2 && rng_.uniform() < 0.125) values.back() = std::nan("");
    }
    // Nothing in R is asked about groups that do not vary.
    if (values.size() > 1 && values[0] == values[1]) values[1] += 1.0;
    return values;
  }
  std::vector<Group> groups(std::size_t k, std::size_t least, std::size_t most, bool ties, bool gaps) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < k; ++i)
      groups.push_back({std::string(1, static_cast<char>('a' + i)),
                        values(from_to(least, most), 5.0 + rng_.normal(), 1.0 + 2.0 * rng_.uniform(), ties, gaps)});
    return groups;
  }

 private:
  base::Rng rng_;
};

}  // namespace seldinger::assessment::statistics
