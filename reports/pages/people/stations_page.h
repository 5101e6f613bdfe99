// Workstations: what the own programmes did at each, for a director; how well each keeps time, for an admin.
#pragma once

#include <span>
#include <string>

#include "casedb/attempts/stations.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

std::string stations_page(const Visitor& visitor, std::span<const casedb::StationUse> stations);
// Shares and times alone: how much was done where is not an admin's to read.
std::string station_timing_page(const Visitor& visitor, std::span<const casedb::StationTiming> stations);

std::string station_text(const std::string& station);  // of '': "not recorded"

// A class of the servo's lateness, or of a window's frames a second, and its share; in order.
struct TimingShare {
  std::string label;
  double share = 0.0;
};
std::vector<TimingShare> lateness_shares(const cases::TimeHistogram& latency);
std::vector<TimingShare> frame_shares(std::span<const double> window_hz);
double middle_of(std::vector<double> values);  // their median; CHECKs that there is one

}  // namespace seldinger::reports
