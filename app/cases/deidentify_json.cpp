#include "app/cases/deidentify_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::app {

std::string json_of_deidentified(const casedb::Deidentified& done) {
  nlohmann::ordered_json elements = nlohmann::ordered_json::object(), left_out = nlohmann::ordered_json::object();
  for (const auto& [what, count] : done.counts) elements[what] = count;
  for (const auto& [code, count] : done.left_out) left_out[code] = count;
  return nlohmann::ordered_json{{"files", done.files},
                                {"method", casedb::kDeidentificationMethod},
                                {"elements", elements},
                                {"left_out", left_out}}
             .dump(2) +
         "\n";
}

}  // namespace seldinger::app
