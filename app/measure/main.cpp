// seldinger-measure: benchmarks, goals and stability. `seldinger bench` and the others start it
// (app/cmd_measure.cpp).
#include <string_view>
#include <vector>

#include "app/commands.h"
#include "app/measure/bench/cmd_bench.h"
#include "app/measure/goals/cmd_goals.h"
#include "app/measure/stability/cmd_stability.h"
#include "app/run_program.h"
#include "sim/base/check.h"

namespace seldinger::measure {
namespace {

struct Measurement {
  std::string_view command;
  int (*run)(const app::Arguments&);
};
constexpr Measurement kMeasurements[] = {
    {"bench", &run_bench},
    {"goals ultrasound", &run_goals_ultrasound},
    {"goals haptics", &run_goals_haptics},
    {"haptics stability", &run_haptics_stability},
};

// The product's rows that start this program, each with what it starts.
std::vector<app::Command> commands() {
  std::vector<app::Command> rows;
  for (app::Command row : app::commands()) {
    if (row.run != &app::run_measure) continue;
    row.run = nullptr;
    for (const Measurement& measurement : kMeasurements)
      if (measurement.command == row.name) row.run = measurement.run;
    CHECK(row.run != nullptr);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace
}  // namespace seldinger::measure

int main(int argc, char** argv) {
  return seldinger::app::run_program(argc, argv, seldinger::measure::commands());
}
