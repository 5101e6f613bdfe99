// A line of a card by its name.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "reports/words/card.h"

namespace seldinger::reports {

// Empty if there is none.
inline std::string line_of(const Card& card, std::string_view name) {
  const auto found =
      std::find_if(card.lines.begin(), card.lines.end(), [&](const CardLine& line) { return line.name == name; });
  return found == card.lines.end() ? "" : found->text;
}

}  // namespace seldinger::reports
