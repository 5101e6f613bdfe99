// A learner as whoever answers for them sees them.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "casedb/grading/learner_records.h"

namespace seldinger::reports {

// In the order of casedb::records_of.
using Records = std::shared_ptr<const std::vector<casedb::CurriculumRecord>>;

struct LearnerView {
  std::string person_id;
  std::string label;                 // the log-in name where the reader may read it, else a pseudonym
  std::vector<std::string> cohorts;  // titles of those that the reader may see
  bool simulated = false;
  Records records;
};

}  // namespace seldinger::reports
