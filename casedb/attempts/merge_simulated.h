// Attempts of simulated people out of one library and into another, so that many machines make them, each in a
// library of its own. Of anybody else nothing is looked at.
#pragma once

#include <cstddef>
#include <filesystem>

#include "casedb/database/library.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct Merged {
  std::size_t people = 0;               // added
  std::size_t attempts = 0, there = 0;  // added; were there already
};
// The other library, to be read only: as Library::open, and `older_schema` where that would migrate it.
base::Result<Library> open_to_merge(const std::filesystem::path& folder);
// All of it is looked at first: `damaged` (a person is not who their seed, group and number make), `person_differs`
// (other abilities were planted here under that name, or another model of people), `no_case`, `case_differs`. Then
// each attempt is stored by itself, so that a merge that was cut off is begun again. An attempt is there already
// when the same person has made it, of the same seed, at the same task; of two merges at once one adds it.
base::Result<Merged> merge_simulated(Library& into, Library& from);

}  // namespace seldinger::casedb
