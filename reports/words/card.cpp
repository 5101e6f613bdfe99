#include "reports/words/card.h"

namespace seldinger::reports {

std::string version_words(const Card& card, int asked, const char* told) {
  std::string text = std::to_string(card.version) + " (" + card.id + ")";
  if (asked > 0 && asked != card.version)
    text += "; this " + std::string(told) + " by version " + std::to_string(asked);
  return text;
}

}  // namespace seldinger::reports
