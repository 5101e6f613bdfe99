#include "assessment/signals/need_words.h"

namespace seldinger::assessment {

std::string words_of_needs(Needs needs) {
  std::string text;
  for (const NeedInfo& need : assessment::needs())
    if ((needs & need.need) != 0) text += (text.empty() ? "" : ", ") + std::string(need.words);
  return text;
}

}  // namespace seldinger::assessment
