// A case that is not stored yet and whose classes are there already: looking for organs takes seconds.
#pragma once

#include <vector>

#include "session/case/case_build.h"

namespace seldinger::session {

// As build_case of it. Classes: as volume::classes_with_organs makes them of its volume and labels.
cases::Case build_case(const casedb::NewCase& made, const cases::Picture& picture, Needs needs,
                       std::vector<volume::TissueClass> classes);

}  // namespace seldinger::session
