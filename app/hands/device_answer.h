// Answers of `device list` and `device probe`.
#pragma once

#include <array>
#include <string>

#include "sim/case/record/time_histogram.h"
#include "sim/devices/arms/haply.h"

namespace seldinger::app {

struct DeviceListAnswer {
  std::string service;  // host and port that were asked
  devices::HaplyStatus status;
  bool space_mouse = false;
};

struct ProbedArm {
  devices::HaplyIds ids;
  std::uint64_t readings = 0;
  devices::ArmReading last;                   // the newest
  glm::dvec3 least_mm{0.0}, most_mm{0.0};     // of all, each axis, in the arm's own axes
  cases::TimeHistogram interval, round_trip;  // between readings that came one after another
};

struct DeviceProbeAnswer {
  double seconds = 0.0;
  std::array<ProbedArm, 2> arms;  // left, right
};

std::string text_of_device_list(const DeviceListAnswer& answer);
std::string text_of_device_probe(const DeviceProbeAnswer& answer);
std::string json_of_device_list(const DeviceListAnswer& answer);
std::string json_of_device_probe(const DeviceProbeAnswer& answer);

}  // namespace seldinger::app
