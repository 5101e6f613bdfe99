#include "app/acting/audit_json.h"

#include "casedb/database/values_json.h"

namespace seldinger::app {

std::string json_of_audit(const std::vector<casedb::AuditRow>& rows, const casedb::AuditHead& head) {
  auto list = nlohmann::ordered_json::array();
  for (const casedb::AuditRow& one : rows)
    list.push_back({{"sequence", one.sequence},
                    {"at_us", one.at_us},
                    {"actor", one.actor},
                    {"person_id", casedb::maybe(one.person_id)},
                    {"act", one.act},
                    {"object", casedb::maybe(one.object)},
                    {"object_id", casedb::maybe(one.object_id)},
                    {"result", one.result},
                    {"hash", one.hash}});
  return casedb::text({{"audit", list}, {"count", head.count}, {"head", head.hash}});
}

}  // namespace seldinger::app
