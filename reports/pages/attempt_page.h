// One attempt: what came of it, its metrics, its steps, the picture at the moment of firing, and what it was made
// with.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "reports/pages/page.h"
#include "reports/words/attempt_words.h"
#include "sim/base/result.h"

namespace seldinger::reports {

// `recording` may be null: then there is no chart over time, and the page says so.
std::string attempt_page(const Visitor& visitor, const AttemptView& attempt, const cases::Recording* recording);

// What was on the screen at the telling moments of an attempt: markup, and the pictures beside it, which it names
// by number from 1: `pictures.png?n=1`.
struct DrawnPictures {
  std::string markup;
  std::vector<std::vector<std::byte>> pngs;
};
// `markup`: of the drawn pictures, or why there are none.
std::string attempt_pictures_page(const Visitor& visitor, const AttemptView& attempt,
                                  const base::Result<std::string>& markup);

}  // namespace seldinger::reports
