// Attempts as xAPI 1.0.3 statements (ADL): somebody's pseudonym passed, failed, completed or terminated a case.
// Without a time, which the export does not tell: whoever stores a statement stamps it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/grading/grade.h"

namespace seldinger::reports {

struct XapiAttempt {
  std::string id;                          // a UUID, of this export
  std::string person, attempt, case_name;  // pseudonyms; `person` empty: a simulation of nobody
  bool synthetic = false;
  assessment::Verdict verdict = assessment::Verdict::no_rule;
  bool cut_off = false;     // it was ended by nobody: a lost device, the time limit, an interruption
  double duration_s = 0.0;  // as the export tells it
};
std::string xapi_statements(const std::vector<XapiAttempt>& attempts);

}  // namespace seldinger::reports
