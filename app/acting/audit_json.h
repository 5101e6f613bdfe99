// The audit log as JSON.
#pragma once

#include <string>
#include <vector>

#include "casedb/database/audit.h"

namespace seldinger::app {

std::string json_of_audit(const std::vector<casedb::AuditRow>& rows, const casedb::AuditHead& head);

}  // namespace seldinger::app
