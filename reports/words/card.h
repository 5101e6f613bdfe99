// What there is to tell somebody who asks what something on a screen or page means.
#pragma once

#include <string>
#include <vector>

namespace seldinger::reports {

struct CardLine {
  std::string name, text;  // "Better", "lower"
};

struct Card {
  std::string id, label;
  int version = 0;  // of the definition that is told: the program's
  std::string definition;
  std::vector<CardLine> lines;
};

// "3 (path_tip)", and by which other version what is asked about was told: "this " + `told` + that version. 0:
// nothing is asked about.
std::string version_words(const Card& card, int asked, const char* told);

}  // namespace seldinger::reports
