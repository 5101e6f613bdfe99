// The registry of `bench`: every stage with what it measures, what against, and what runs it.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "app/bench_stages.h"
#include "app/measure/bench/bench.h"

namespace seldinger::measure {

struct BenchStage {
  const app::BenchStageWords& about;
  base::Result<void> (*run)(const app::Arguments& arguments, bool quick, std::vector<BenchRow>& rows);
  // A page of the stage's own, beside results.csv; nullptr: none.
  const char* page_name = nullptr;
  std::string (*page)() = nullptr;
};

// In the order in which they run when none is named.
std::span<const BenchStage> bench_stages();
// nullptr for a name that is not in the table.
const BenchStage* find_bench_stage(std::string_view name);

}  // namespace seldinger::measure
