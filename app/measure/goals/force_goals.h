// What the needle's force is held to (docs/touch.md, S3-S5), as figures: driven by an ideal hand into
// tissues with a published line. `seldinger goals haptics` prints them, beside what haptics stability finds.
#pragma once

#include <vector>

#include "app/measure/rigs/force_reading.h"
#include "app/measure/stability/stability_survey.h"

namespace seldinger::measure {

std::vector<ForceReading> force_readings();

// Of the proxies: on a bumpy sphere of 200,704 triangles with and without radius and friction, at so many ticks and
// a tenth as many sweeps each (S8, S10), and on solids in a noisy CT (S7).
std::vector<ForceReading> proxy_readings(int ticks);

// How many trials, and with which least margin, do not come to rest.
std::vector<ForceReading> stability_readings(const StabilitySurvey& survey);

}  // namespace seldinger::measure
