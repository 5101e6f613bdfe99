// The organ that a case's target lies in, where a CT without labels lets it be told.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "casedb/cases/cases.h"
#include "sim/volume/organs/find_organs.h"

namespace seldinger::session {

// Looked for in the CT as it is stored, without what is drawn into it; takes seconds. Nothing where no organ is
// named there, where the stored classes say another thing (the case is then older than today's rules: what is told
// of it is no more than it shows), for a block of gel, and for a CT with labels, whose case says what it holds.
std::optional<volume::OrganFound> organ_of_target(casedb::Library& library, const casedb::CaseRow& row,
                                                  const glm::dvec3& target_lps_mm);

}  // namespace seldinger::session
