// An answer of a statistical procedure as `seldinger stats --json` prints it.
#pragma once

#include <string>

#include "assessment/statistics/answer.h"

namespace seldinger::app {

// {"test","status","reason","reason_words","n","missing","method","groups","statistic","df","p_value","estimate",
// "estimate_name","ci95","notes","rows", …}: what is not there is null, a list is empty; `df` is a number, or a
// list where it has several. Further numbers stand after these, and in rows after "name", by their own names.
// `answer` is settled.
std::string json_of_answer(const assessment::statistics::Answer& answer);

}  // namespace seldinger::app
