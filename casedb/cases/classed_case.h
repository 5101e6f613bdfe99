// A new case whose classes are there already, since who adds it tells or shows them too: looking for organs takes
// seconds.
#pragma once

#include <string>
#include <vector>

#include "casedb/cases/cases.h"
#include "sim/volume/classes.h"

namespace seldinger::casedb {

// Classes: as volume::classes_with_organs makes them of its volume and labels, one for each voxel (CHECK).
std::string add_case(Library& library, const NewCase& new_case, const std::vector<volume::TissueClass>& classes);

}  // namespace seldinger::casedb
