#include "web/json/attempt_json.h"

#include <cmath>

#include "casedb/database/values_json.h"
#include "casedb/json/grading_json.h"

namespace seldinger::web {
namespace {

using Json = nlohmann::ordered_json;

// To so many significant digits.
double rounded(double value, int digits) {
  if (value == 0.0 || !std::isfinite(value)) return value;
  const double unit = std::pow(10.0, std::floor(std::log10(std::abs(value))) + 1 - digits);
  return std::round(value / unit) * unit;
}

void round_all(Json& json) {
  for (Json& one : json)
    if (one.is_number_float()) one = rounded(one.get<double>(), 2);
}

// Mean and deviation of a standard and of the next, which one more consultant has made, tell that consultant's
// value; so does z beside a value when it has many digits. Without a standard, who towards one has done what is
// nobody's.
void leave_out_consultants(Json& json) {
  for (Json& part : json["score"]["parts"]) {
    for (const char* key : {"mean", "sd", "least_sd"}) part.erase(key);
    if (part["z"].is_number()) part["z"] = std::round(part["z"].get<double>() * 10.0) / 10.0;
  }
  Json& experts = json["experts"];
  if (!experts.is_object()) return;
  experts.erase("attempts");
  if (experts["standard"] == false)
    for (const char* key : {"set_id", "people", "newest_us"}) experts.erase(key);
  for (Json& band : experts["bands"]) {
    for (const char* key : {"mean", "sd"}) band.erase(key);
    for (const char* key : {"low", "high"})
      if (band[key].is_number()) band[key] = rounded(band[key].get<double>(), 2);
    if (band["tolerance"].is_array()) round_all(band["tolerance"]);
  }
}

}  // namespace

std::string metrics_json(const casedb::AttemptRow& row) {
  return casedb::line({{"attempt_id", row.attempt_id},
                       {"synthetic", row.synthetic()},
                       {"metrics", casedb::json_of_metrics(row.metrics)}});
}

std::string grade_json(const casedb::AttemptRow& row, const casedb::AttemptGrade& grade, bool with_experts) {
  nlohmann::ordered_json json = {{"attempt_id", row.attempt_id}};
  casedb::add_grade(grade, json);
  json["experts"] = casedb::json_of_experts(grade.experts);
  if (!with_experts) leave_out_consultants(json);
  return casedb::line(json);
}

std::string health_json(casedb::Health health, const std::string& program_version) {
  return casedb::line({{"status", casedb::name_of(health)}, {"version", program_version}});
}

}  // namespace seldinger::web
