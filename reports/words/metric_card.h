// What a metric measures, for somebody who asks about a number: its definition, unit, direction, when it has no
// value, version and source, in words. From the registry alone; window and pages show the same.
#pragma once

#include <string>
#include <string_view>

#include "reports/words/card.h"

namespace seldinger::reports {

// `version`: of the value that is asked about; where the program has another definition by now, the card says so.
// 0: no value is asked about. An id that the registry does not know has a card that says no more than that.
Card metric_card(std::string_view id, int version = 0);

// A text in which metrics stand by their ids, with their labels in quotes instead.
std::string with_labels(std::string_view text);

// "mm", "percent", "yes or no", "number of times": a unit as one says it.
std::string unit_words(std::string_view unit);

}  // namespace seldinger::reports
