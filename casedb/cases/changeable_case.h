// Whether lesions, structures and setting of a case may be changed.
#pragma once

#include "casedb/cases/cases.h"

namespace seldinger::casedb {

// The case, when it may be: `no_case`, `not_a_draft`, `has_attempts`. To be asked within the transaction that
// changes it.
base::Result<CaseRow> changeable_case(Library& library, const std::string& case_id);

}  // namespace seldinger::casedb
