// One attempt: what came of it, its metrics, its steps, the picture at the moment of firing, and what it was made
// with.
#pragma once

#include <string>

#include "reports/pages/page.h"
#include "reports/words/attempt_words.h"

namespace seldinger::reports {

// `recording` may be null: then there is no chart over time, and the page says so.
std::string attempt_page(const Visitor& visitor, const AttemptView& attempt, const cases::Recording* recording);

}  // namespace seldinger::reports
