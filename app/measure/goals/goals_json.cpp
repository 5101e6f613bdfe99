#include <cmath>
#include <nlohmann/json.hpp>

#include "app/measure/goals/goals_answer.h"

namespace seldinger::measure {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

std::string json_of_goals(const std::vector<GoalsOfMethod>& measured) {
  Json document = Json::array();
  for (const GoalsOfMethod& one : measured) {
    Json rows = Json::array();
    for (const Reading& reading : one.readings)
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
                        {"quality", one.quality == Quality::fast ? "fast" : "reference"},
                        {"readings", rows}});
  }
  return document.dump(2) + "\n";
}

std::string json_of_goals(const std::vector<ForceReading>& readings) {
  Json rows = Json::array();
  for (const ForceReading& reading : readings)
    rows.push_back({{"what", reading.what},
                    {"of", reading.where},
                    {"measured", number(reading.measured)},
                    {"unit", reading.unit},
                    {reading.at_least ? "at_least" : "at_most", reading.limit},
                    {"holds", reading.holds()}});
  return rows.dump(2) + "\n";
}

}  // namespace seldinger::measure
