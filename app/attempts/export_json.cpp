#include "app/attempts/export_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::app {

std::string json_of_export(const reports::RawExport& done) {
  const nlohmann::ordered_json json = {{"attempts", done.attempts},
                                       {"synthetic", done.synthetic},
                                       {"people", done.people},
                                       {"metrics", done.metrics},
                                       {"files", done.files}};
  return json.dump(2) + "\n";
}

}  // namespace seldinger::app
