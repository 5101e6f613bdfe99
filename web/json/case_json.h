// A case and its checks as JSON, in the form of the command line's `case show` and `case check`.
#pragma once

#include <string>

#include "casedb/cases/case_checks.h"
#include "casedb/json/case_json.h"

namespace seldinger::web {

std::string case_json(const casedb::CaseParts& parts);
std::string checks_json(const std::string& case_id, const casedb::CaseCheck& check);

}  // namespace seldinger::web
