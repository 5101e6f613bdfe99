// Workstations: the machines at which people make attempts, each by the name that it was given (the condition
// `station`). What follows is worked out from attempts; a station has no row of its own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "casedb/database/library.h"
#include "sim/base/result.h"
#include "sim/case/record/time_histogram.h"

namespace seldinger::casedb {

// What a station is called that nobody named. Never the machine's name in its network, which could tell whose it
// is.
inline constexpr const char* kUnnamedStation = "this computer";
// Refused (`bad_station_name`): not 1 to 40 letters, digits, spaces and - _ . with a letter or digit at both ends.
base::Result<void> check_station_name(const std::string& name);

struct StationResult {
  double duration_s = 0.0;
  std::optional<double> target_mm;  // tip_target_dist: from the tip to the target's centre at the endpoint
  std::optional<bool> hit;          // none: it came to no endpoint
};

// What some people did at a station, or what was simulated there.
struct StationUse {
  std::string station;  // empty: not recorded
  bool simulated = false;
  std::size_t attempts = 0, people = 0, days = 0;
  double duration_s = 0.0;               // of all attempts, without pauses
  std::int64_t last_us = 0;              // when the last one began
  std::vector<StationResult> results{};  // of the newest, at most kStationResults, newest first
};
inline constexpr int kStationResults = 200;
// By name, with what was not recorded first; of one name what people did first.
std::vector<StationUse> list_station_use(Library& library, const std::vector<std::string>& people);

// How well a station kept time in its newest attempts in real time, at most kStationResults of them.
struct StationTiming {
  std::string station;                  // empty: not recorded
  std::uint64_t ticks = 0, missed = 0;  // of the servo: done; never begun since the next was due already
  bool real_time = false;               // the newest ran under a real-time scheduler
  cases::TimeHistogram latency, compute;
  std::vector<double> window_hz;  // of each attempt in a window its frames a second
  struct Pictures {
    std::string method;            // "scatterers, GPU"
    bool simplified = false;       // the machine was too slow for what was asked
    std::vector<double> shown_hz;  // of each attempt
  };
  std::vector<Pictures> pictures;  // by method
};
std::vector<StationTiming> list_station_timing(Library& library);  // as list_station_use

}  // namespace seldinger::casedb
