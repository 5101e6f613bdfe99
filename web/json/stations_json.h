// What the pages of stations tell, as JSON. The station is null where it was not recorded.
#pragma once

#include <span>
#include <string>

#include "casedb/attempts/stations.h"

namespace seldinger::web {

std::string stations_json(std::span<const casedb::StationUse> stations);
std::string station_timing_json(std::span<const casedb::StationTiming> stations);

}  // namespace seldinger::web
