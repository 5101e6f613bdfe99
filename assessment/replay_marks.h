// What happened when in an attempt: the marks along a replay, and the words that stand under it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {

struct ReplayMark {
  double t_s = 0.0;
  std::string words;
  bool fault = false;  // it spoke against the attempt
};

// By time: the telling moments (moments.h), what was said, what the patient did, what a mentor made happen, and
// where the needle came into what it is to keep out of.
std::vector<ReplayMark> replay_marks(const Signals& signals);

// Of marks by time: the words of those that happened within `within_s` before, the latest last; empty: none did.
std::string words_at(const std::vector<ReplayMark>& marks, double t_s, double within_s);

// When the needle first went through the skin; nothing: it never did.
std::optional<double> first_puncture_s(const Signals& signals);

}  // namespace seldinger::assessment
