// One case as its author, its reviewer and its readers see it; and the list of cases.
#pragma once

#include <span>
#include <string>

#include "casedb/json/case_json.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

std::string case_page(const Visitor& visitor, const casedb::CaseParts& parts);
std::string cases_page(const Visitor& visitor, std::span<const casedb::CaseRow> rows);

}  // namespace seldinger::reports
