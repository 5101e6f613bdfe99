// The commands of seldinger-measure. Their rows (options, help) are the product's, in app/command.h; only what runs
// them is here.
#pragma once

#include "app/arguments.h"

namespace seldinger::measure {

int run_bench(const app::Arguments& arguments);
int run_goals_ultrasound(const app::Arguments& arguments);
int run_goals_haptics(const app::Arguments& arguments);
int run_haptics_stability(const app::Arguments& arguments);

}  // namespace seldinger::measure
