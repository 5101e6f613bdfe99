// What is known of one workstation: how its two haptic devices stand, and which they are. A JSON file, since it
// belongs to the machine and its desk, not to a library of cases.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "sim/base/result.h"
#include "sim/devices/calibration.h"
#include "sim/devices/haply.h"

namespace seldinger::app {

struct StationDevice {
  devices::Calibration calibration;
  devices::HaplyIds ids{};  // which arm and grip it is; empty: nobody said
};

// By name, "left" or "right".
using Station = std::map<std::string, StationDevice>;

// Refused: what read_text refuses, `bad_station` (no station file, or one of another format).
base::Result<Station> read_station(const std::filesystem::path& path);

std::string json_of_station(const Station& station);

}  // namespace seldinger::app
