// The lock of a study's data: from then on attempts that are begun are not analysed and nobody is enrolled, and
// what was analysed is known by its hash. Set once, for good.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "casedb/database/library.h"
#include "casedb/studies/plans.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct StudyLock {
  std::int64_t locked_us = 0;
  std::string actor;                     // "person", "operator", "nobody"
  std::optional<std::string> pseudonym;  // of the person, or in whose name the operator acted
  std::string data_hash;                 // as study_data.h makes it, of what was analysed then
  int people = 0;                        // with an outcome, a failure too, at a primary one
};
std::optional<StudyLock> find_lock(Library& library, const std::string& study_id);

// Tells no outcome, so that it is no look. `plan_not_frozen`, `data_locked`.
base::Result<StudyLock> lock_data(Library& library, const StoredPlan& stored);

}  // namespace seldinger::casedb
