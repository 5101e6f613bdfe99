// Intervals by drawing persons again: the bias-corrected and accelerated bootstrap of means and medians.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "assessment/statistics/answer.h"
#include "assessment/statistics/data_table.h"
#include "assessment/statistics/procedure.h"

namespace seldinger::assessment::statistics {

// Who is drawn: a pure function of seed, draw and place, so that others can be given the same matrix.
class Resamples {
 public:
  Resamples(std::size_t persons, std::size_t draws, std::uint64_t seed)
      : persons_(persons), draws_(draws), seed_(seed) {}
  std::size_t draws() const noexcept { return draws_; }
  // Of 0 … persons − 1.
  std::size_t at(std::size_t draw, std::size_t place) const noexcept;

 private:
  std::size_t persons_, draws_;
  std::uint64_t seed_;
};

enum class Centre { kMean, kMedian };

struct Bca {
  double estimate = 0.0;
  double bias = 0.0, acceleration = 0.0;  // z₀ and a
  Interval ci95;
  bool at_the_ends = false;  // a limit is the most extreme draw
};
// Of one group's centre, or of the first's minus the second's; each group is drawn by itself. Nothing where the
// draws do not vary or all lie on one side.
std::optional<Bca> bca_of(std::span<const std::vector<double>> groups, std::span<const Resamples> resamples,
                          Centre centre);

// Value, by two groups where there are some.
Answer bootstrap(const DataTable& table, const ProcedureOptions& options);

}  // namespace seldinger::assessment::statistics
