#include <cmath>
#include <nlohmann/json.hpp>

#include "app/goals_answer.h"

namespace seldinger::app {

std::string json_of_goals(const std::vector<GoalsOfMethod>& measured) {
  using Json = nlohmann::ordered_json;
  const auto number = [](double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); };
  Json document = Json::array();
  for (const GoalsOfMethod& one : measured) {
    Json rows = Json::array();
    for (const goals::Reading& reading : one.readings)
      rows.push_back({{"goal", reading.goal},
                      {"what", reading.what},
                      {"probe", reading.probe},
                      {"measured", number(reading.off)},
                      {"unit", reading.unit},
                      {"tolerance_fast", reading.fast},
                      {"tolerance_reference", reading.reference},
                      {"measured_over_tolerance", number(reading.share(one.quality))},
                      {"holds", reading.holds(one.quality)}});
    document.push_back({{"method", one.method},
                        {"quality", one.quality == goals::Quality::fast ? "fast" : "reference"},
                        {"readings", rows}});
  }
  return document.dump(2) + "\n";
}

}  // namespace seldinger::app
