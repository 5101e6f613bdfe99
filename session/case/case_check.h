// What a case must hold to be worth an attempt (docs/mentor.md).
#pragma once

#include <string>
#include <vector>

#include "casedb/cases/authoring.h"
#include "casedb/cases/case_checks.h"
#include "casedb/cases/cases.h"
#include "sim/base/result.h"
#include "sim/case/case.h"

namespace seldinger::session {

using casedb::CaseCheck;
using casedb::Check;

// Each lesion inside the body and not in bone; a straight way of the instrument's length from uncut skin that meets
// no bone, gas, nor critical or major structure, and leads through what must be crossed (not asked where the right
// decision is to defer); a planned entry on the skin; drawn structures within the volume; a rule whose metrics are
// known and mean something under the case's guidance, and whose criteria can be met, each and together. Refused:
// `no_case`, damaged assets.
base::Result<CaseCheck> check_case(casedb::Library& library, const std::string& case_id);

// The same of a case that is built already, with classes and without a lesion. `content_mark`: of the case before
// row, lesions and structures were read.
CaseCheck check_loaded_case(std::string content_mark, const cases::Case& scene, const casedb::CaseRow& row,
                            const std::vector<casedb::LesionRow>& lesions,
                            const std::vector<casedb::StructureRow>& structures);

}  // namespace seldinger::session
