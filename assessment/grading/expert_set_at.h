// What consultants do at a case of an older law of sight.
#pragma once

#include <vector>

#include "assessment/grading/standard.h"
#include "sim/case/case.h"

namespace seldinger::assessment {

// As expert_set, of attempts whose pictures were told by that law: metrics of sight are of its versions.
ExpertSet expert_set_at(cases::SightLaw law, std::vector<ExpertAttempt> attempts);

}  // namespace seldinger::assessment
