#include "casedb/cases/case_checks.h"

#include "casedb/cases/bundle_rows.h"
#include "casedb/database/library.h"

namespace seldinger::casedb {

base::Result<void> ready_to_publish(const CaseCheck& check) {
  if (check.holds()) return {};
  base::Error error{"checks_failed", "the case is not ready: what its check found must be mended first"};
  for (const Check& one : check.checks)
    if (!one.holds) error.findings.push_back({one.name, one.text});
  return error;
}

std::string content_mark(Library& library, const std::string& case_id) {
  return mark_of_rows(library.database(), case_id);
}

}  // namespace seldinger::casedb
