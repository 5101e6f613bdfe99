// The audit log for whoever runs the server: who did what to which thing, and whether every row is as it was
// written.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "casedb/database/audit.h"
#include "reports/pages/page.h"

namespace seldinger::reports {

struct AuditView {
  std::vector<casedb::AuditRow> rows;        // newest first
  std::map<std::string, std::string> names;  // log-in names, by person id
  int days = 30;                             // that the rows are of
  bool more = false;                         // there are older ones of these days
  std::vector<std::string> problems;         // of the whole log; none: it stands as it was written
  std::int64_t count = 0;                    // of the whole log
};

std::string audit_page(const Visitor& visitor, const AuditView& view);

}  // namespace seldinger::reports
