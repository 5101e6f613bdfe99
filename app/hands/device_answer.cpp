#include "app/hands/device_answer.h"

#include <cstdio>

#include "app/hands/formatted.h"
#include "app/hands/station.h"

namespace seldinger::app {
namespace {

double ms(std::uint64_t ns) {
  return 1e-6 * static_cast<double>(ns);
}

std::string spoken(const std::string& id) {
  return id.empty() ? "(none)" : id;
}

}  // namespace

std::string text_of_device_list(const DeviceListAnswer& answer) {
  std::string text;
  if (!answer.status.connected) {
    text += "No Haply Inverse service at " + answer.service + ".\n";
  } else {
    text += "Haply Inverse service at " + answer.service + ":\n";
    if (answer.status.arms.empty()) text += "  no arm\n";
    for (const std::string& id : answer.status.arms) {
      const bool left = id == answer.status.ids[0].arm, right = id == answer.status.ids[1].arm;
      text += "  arm " + id + (left ? ", left hand's" : right ? ", right hand's" : "") + "\n";
    }
    for (const std::string& id : answer.status.grips) text += "  grip " + id + "\n";
  }
  text += answer.space_mouse ? "A 3-D mouse, or spacenavd waiting for one.\n"
                             : "No 3-D mouse: spacenavd does not answer.\n";
  return text;
}

std::string text_of_device_probe(const DeviceProbeAnswer& answer) {
  std::string text;
  for (std::size_t side = 0; side < 2; ++side) {
    const ProbedArm& arm = answer.arms[side];
    text +=
        std::string(kSideNames[side]) + ": arm " + spoken(arm.ids.arm) + ", grip " + spoken(arm.ids.grip) + "\n";
    if (arm.readings == 0) {
      text += "  nothing was read\n";
      continue;
    }
    const glm::dvec3& p = arm.last.position_mm;
    text +=
        formatted("  at (%.2f, %.2f, %.2f) mm of its own axes; moved over %.1f x %.1f x %.1f mm\n", p.x, p.y, p.z,
                  arm.most_mm.x - arm.least_mm.x, arm.most_mm.y - arm.least_mm.y, arm.most_mm.z - arm.least_mm.z);
    text += formatted("  %.0f readings/s; between them %.2f ms (p50), %.2f (p99), %.2f (most)\n",
                      static_cast<double>(arm.readings) / answer.seconds, ms(arm.interval.quantile_ns(0.5)),
                      ms(arm.interval.quantile_ns(0.99)), ms(arm.interval.most_ns));
    text += formatted("  force to answer %.2f ms (p50), %.2f (p99)\n", ms(arm.round_trip.quantile_ns(0.5)),
                      ms(arm.round_trip.quantile_ns(0.99)));
  }
  return text;
}

}  // namespace seldinger::app
