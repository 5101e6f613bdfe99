// What no attempt can meet, however it is made: a limit that the metric never reaches, and two criteria of which
// one rules the other out. Asked by the case's check, before anybody tries.
#pragma once

#include <vector>

#include "assessment/grading/rule.h"

namespace seldinger::assessment {

// `never_met` of a criterion alone, `contradictory` of two, both named as they are typed and in words. What
// names a metric that is not known, or another version of it, is problems_of's to tell.
std::vector<base::Problem> contradictions_of(const PassRule& rule, const Guidance& guidance);

}  // namespace seldinger::assessment
