// What is known of one workstation: how its two haptic devices stand. A JSON file, since it belongs to the machine
// and its desk, not to a library of cases.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/base/result.h"
#include "sim/devices/calibration.h"

namespace seldinger::app {

// By name, "left" or "right".
using Station = std::map<std::string, devices::Calibration>;

// Refused: what read_text refuses, `bad_station` (no station file, or one of another format).
base::Result<Station> read_station(const std::filesystem::path& path);

std::string json_of_station(const Station& station);

}  // namespace seldinger::app
