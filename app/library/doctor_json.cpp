#include "app/library/doctor_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::app {

std::string json_of_doctor(const DoctorAnswer& doctor) {
  auto json = nlohmann::ordered_json::object();
  for (const auto& [name, value] : doctor.facts) json[name] = value;
  json["can_train"] = name_of(doctor.fitness.fit);
  json["why"] = doctor.fitness.why;
  return casedb::text(json);
}

}  // namespace seldinger::app
