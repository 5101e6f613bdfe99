// A metric's name that opens its definition, where it stands: no script, and a key opens it as a click does.
#pragma once

#include <string_view>

#include "reports/markup/html.h"
#include "reports/words/card.h"

namespace seldinger::reports {

// The card's definition and lines, as <p> and <dl>.
Html card_body(const Card& card);

// Words that open a card.
Html card_details(const Card& card, std::string_view words);

// `version`: of the value beside it, 0 for none. `words`: what is clicked on; empty: the metric's label. An id that
// the registry does not know stands as plain text.
Html metric_details(std::string_view id, int version = 0, std::string_view words = {});

}  // namespace seldinger::reports
