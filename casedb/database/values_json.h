// Values as every JSON document here writes them: null where there is none, points as [x, y, z], metrics with the
// reason why they have no value.
#pragma once

#include <cmath>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "assessment/metrics/metric.h"

namespace seldinger::casedb {

inline nlohmann::ordered_json point(const glm::dvec3& p) {
  return nlohmann::ordered_json::array({p.x, p.y, p.z});
}

template <typename T>
nlohmann::ordered_json maybe(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}
inline nlohmann::ordered_json maybe(const std::string& text) {
  return text.empty() ? nlohmann::ordered_json(nullptr) : nlohmann::ordered_json(text);
}

// Id, version, value, unit and reason of each; a value that is no finite number is none.
inline nlohmann::ordered_json json_of_metrics(const std::vector<assessment::MetricValue>& metrics) {
  auto list = nlohmann::ordered_json::array();
  for (const assessment::MetricValue& metric : metrics) {
    const bool broken = metric.value && !std::isfinite(*metric.value);
    list.push_back({{"id", metric.id},
                    {"version", metric.version},
                    {"value", broken ? nlohmann::ordered_json(nullptr) : maybe(metric.value)},
                    {"unit", metric.unit},
                    {"reason", maybe(broken ? "not_finite" : metric.reason)}});
  }
  return list;
}

// A document as commands answer it, for people to read too; bytes that are no UTF-8 are replaced.
inline std::string text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}
// The same on one line, as the dashboard sends it.
inline std::string line(const nlohmann::ordered_json& json) {
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace seldinger::casedb
