// One attempt: what came of it, its metrics, its steps, the picture at the moment of firing, and what it was made
// with.
#pragma once

#include <string>

#include "reports/pages/page.h"
#include "reports/words/attempt_words.h"
#include "sim/base/result.h"

namespace seldinger::reports {

// `recording` may be null: then there is no chart over time, and the page says so.
std::string attempt_page(const Visitor& visitor, const AttemptView& attempt, const cases::Recording* recording);
// What was on the screen at its telling moments: markup that is kept (reports/sheets/moments_sheet.h), or why there
// is none.
std::string attempt_pictures_page(const Visitor& visitor, const AttemptView& attempt,
                                  const base::Result<std::string>& pictures);

}  // namespace seldinger::reports
