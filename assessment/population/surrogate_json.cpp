// A surrogate's file: its mark, and every attempt that it was fitted to. What is fitted is fitted again when it is
// read.
#include <cmath>
#include <nlohmann/json.hpp>

#include "assessment/population/surrogate.h"

namespace seldinger::assessment::population {
namespace {

using Ordered = nlohmann::ordered_json;

base::Error bad_surrogate() {
  return {"bad_surrogate", "the file is not a surrogate that `seldinger surrogate fit` wrote", {}};
}

Ordered points_json(const std::vector<SimulatedPoint>& points) {
  Ordered rows = Ordered::array();
  for (const SimulatedPoint& one : points) {
    Ordered row = Ordered::array();
    for (const double x : one.place) row.push_back(x);
    for (const auto& value : one.values) row.push_back(value ? Ordered(*value) : Ordered(nullptr));
    rows.push_back(std::move(row));
  }
  return rows;
}

bool read_point(const Ordered& row, std::size_t metrics, SimulatedPoint& point) {
  if (!row.is_array() || row.size() != kAxes + metrics) return false;
  for (std::size_t i = 0; i < row.size(); ++i) {
    if (row[i].is_null() && i >= kAxes) {
      point.values.emplace_back();
      continue;
    }
    if (!row[i].is_number() || !std::isfinite(row[i].get<double>())) return false;
    if (i < kAxes)
      point.place[i] = row[i].get<double>();
    else
      point.values.emplace_back(row[i].get<double>());
  }
  return true;
}

}  // namespace

std::string Surrogate::to_json() const {
  Ordered metrics = Ordered::array();
  for (const SurrogateMark::Metric& one : mark_.metrics) metrics.push_back({one.id, one.version});
  const Ordered json = {{"surrogate", 1},
                        {"synthetic", true},
                        {"people_version", mark_.people_version},
                        {"operator_version", mark_.operator_version},
                        {"step_version", mark_.step_version},
                        {"case_id", mark_.case_id},
                        {"case", mark_.case_title},
                        {"case_mark", mark_.case_mark},
                        {"metrics", metrics},
                        {"attempts", points_json(points_)}};
  return json.dump() + "\n";
}

base::Result<Surrogate> Surrogate::from_json(const std::string& text) {
  const Ordered json = Ordered::parse(text, nullptr, false);
  if (!json.is_object() || json.value("surrogate", Ordered()) != 1) return bad_surrogate();
  for (const char* key : {"people_version", "operator_version", "step_version"})
    if (!json.contains(key) || !json[key].is_number_integer()) return bad_surrogate();
  for (const char* key : {"case_id", "case", "case_mark"})
    if (!json.contains(key) || !json[key].is_string()) return bad_surrogate();
  for (const char* key : {"metrics", "attempts"})
    if (!json.contains(key) || !json[key].is_array()) return bad_surrogate();
  SurrogateMark mark;
  mark.people_version = json["people_version"].get<int>();
  mark.operator_version = json["operator_version"].get<int>();
  mark.step_version = json["step_version"].get<std::uint32_t>();
  mark.case_id = json["case_id"].get<std::string>();
  mark.case_title = json["case"].get<std::string>();
  mark.case_mark = json["case_mark"].get<std::string>();
  for (const Ordered& one : json["metrics"]) {
    if (!one.is_array() || one.size() != 2 || !one[0].is_string() || !one[1].is_number_integer())
      return bad_surrogate();
    mark.metrics.push_back({one[0].get<std::string>(), one[1].get<int>()});
  }
  std::vector<SimulatedPoint> points;
  for (const Ordered& row : json["attempts"])
    if (!read_point(row, mark.metrics.size(), points.emplace_back())) return bad_surrogate();
  if (points.size() > kMost) return bad_surrogate();
  return fit(std::move(mark), std::move(points));
}

}  // namespace seldinger::assessment::population
