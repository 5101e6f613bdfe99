// A simulated study as tables that R and pandas read; each row says that it is synthetic.
#pragma once

#include <filesystem>

#include "assessment/population/studies/simulated_study.h"
#include "sim/base/result.h"

namespace seldinger::app {

// people.csv (with the planted truth), metrics.csv, ratings.csv, answers.csv in a new folder. `exists`.
base::Result<void> write_study(const std::filesystem::path& folder,
                               const assessment::population::SimulatedStudy& study);

}  // namespace seldinger::app
