// What a rehearsal found, for whoever wrote the rule: command line and case editor say the same.
#pragma once

#include <string>
#include <vector>

#include "session/attempt/rehearsal.h"

namespace seldinger::app {

struct RehearsalWords {
  std::string found;                // "It can be met: 11 of 24 passed."
  std::vector<std::string> levels;  // "expert: 8 of 8 passed (100 %)"
  std::vector<std::string> missed;  // what kept attempts from passing, the most often first
  std::string operators;            // which ones, and that they prove nothing about trainees
};

RehearsalWords words_of(const session::Rehearsal& rehearsal);

}  // namespace seldinger::app
