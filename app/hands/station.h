// What is known of one workstation: how its two haptic devices stand, which they are, and how they are set. A JSON
// file, since it belongs to the machine and its desk, not to a library of cases.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>

#include "sim/base/result.h"
#include "sim/devices/arms/calibration.h"
#include "sim/devices/arms/device_gains.h"
#include "sim/devices/arms/haply.h"

namespace seldinger::app {

struct StationDevice {
  devices::Calibration calibration{};  // of no points: as if the arm's axes were the template's
  devices::HaplyIds ids{};             // which arm and grip it is; empty: nobody said
  devices::DeviceGains gains{};
};

// By name of haptics::Side.
inline constexpr std::array<const char*, 2> kSideNames = {"left", "right"};
using Station = std::map<std::string, StationDevice>;

// Refused: what read_text refuses, `bad_station` (no station file, or one of another format).
base::Result<Station> read_station(const std::filesystem::path& path);

std::string json_of_station(const Station& station);

// Changes what the file holds, and makes it where there is none; what is there now. Two programs may do so at once.
// Refused as read_station, and nothing is changed; throws base::Failure("disk").
base::Result<Station> change_station(const std::filesystem::path& file,
                                     const std::function<void(Station&)>& change);

// Where the trainer's window keeps it unless told: $XDG_CONFIG_HOME/seldinger/station.json, or ~/.config's. Empty:
// there is no home.
std::filesystem::path usual_station_file();

}  // namespace seldinger::app
