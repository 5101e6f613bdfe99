#include "app/cli/error_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::app {

std::string json_of_error(const base::Error& error) {
  nlohmann::ordered_json about = {{"code", error.code}, {"text", error.text}};
  for (const base::Problem& finding : error.findings)
    about["findings"].push_back({{"code", finding.code}, {"text", finding.text}});
  return casedb::text({{"error", about}});
}

}  // namespace seldinger::app
