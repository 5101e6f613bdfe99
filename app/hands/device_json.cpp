#include <nlohmann/json.hpp>

#include "app/hands/device_answer.h"
#include "app/hands/station.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

Json numbers(const glm::dvec3& v) {
  return {v.x, v.y, v.z};
}

Json id_or_null(const std::string& id) {
  return id.empty() ? Json(nullptr) : Json(id);
}

Json times_ms(const cases::TimeHistogram& histogram) {
  const auto ms = [](std::uint64_t ns) { return 1e-6 * static_cast<double>(ns); };
  return {{"n", histogram.n},
          {"p50_ms", ms(histogram.quantile_ns(0.5))},
          {"p99_ms", ms(histogram.quantile_ns(0.99))},
          {"max_ms", ms(histogram.most_ns)}};
}

}  // namespace

std::string json_of_device_list(const DeviceListAnswer& answer) {
  return Json{{"service", answer.service},
              {"connected", answer.status.connected},
              {"arms", answer.status.arms},
              {"grips", answer.status.grips},
              {"left", id_or_null(answer.status.ids[0].arm)},
              {"right", id_or_null(answer.status.ids[1].arm)},
              {"space_mouse", answer.space_mouse}}
             .dump(2) +
         "\n";
}

std::string json_of_device_probe(const DeviceProbeAnswer& answer) {
  Json document{{"seconds", answer.seconds}};
  for (std::size_t side = 0; side < 2; ++side) {
    const ProbedArm& arm = answer.arms[side];
    Json& json = document[kSideNames[side]];
    json = {{"arm", id_or_null(arm.ids.arm)}, {"grip", id_or_null(arm.ids.grip)}, {"readings", arm.readings}};
    if (arm.readings == 0) continue;
    Json rotation = Json::array();
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) rotation.push_back(arm.last.orientation[column][row]);
    json["position_mm"] = numbers(arm.last.position_mm);
    json["orientation"] = std::move(rotation);
    json["least_mm"] = numbers(arm.least_mm);
    json["most_mm"] = numbers(arm.most_mm);
    json["readings_per_s"] = static_cast<double>(arm.readings) / answer.seconds;
    json["interval"] = times_ms(arm.interval);
    json["round_trip"] = times_ms(arm.round_trip);
  }
  return document.dump(2) + "\n";
}

}  // namespace seldinger::app
