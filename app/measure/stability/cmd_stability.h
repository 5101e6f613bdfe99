// `haptics stability`: what runs it. Options and help are the product's row (app/cmd_measure.cpp).
#pragma once

#include "app/cli/arguments.h"

namespace seldinger::measure {

int run_haptics_stability(const app::Arguments& arguments);

}  // namespace seldinger::measure
