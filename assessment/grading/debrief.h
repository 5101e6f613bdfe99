// The three sentences that a trainee reads first: critical errors, then missed criteria, then the largest shortfall
// against what experts do, then what went well. Chosen by rule from numbers; of people they say nothing.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "assessment/grading/standard.h"

namespace seldinger::assessment {

constexpr std::size_t kSentences = 3;

enum class SentenceKind { not_gradable, critical_error, missed, not_measured, shortfall, well, fact };
std::string_view name_of(SentenceKind kind) noexcept;

struct Sentence {
  SentenceKind kind = SentenceKind::fact;
  std::string text;       // "Advanced 14 mm with the tip out of the picture; 9 consultants: 0–3 mm."
  std::string metric_id;  // what it is about; empty: the attempt
};

// At most three, and three where there are three things to say; of what is not gradable the one that says why.
// Two of one topic only where nothing else is left to say; null is never praised, nor what nobody did (estimand.h).
// Only a standard's numbers are told; of any other set none, and criteria alone speak.
std::vector<Sentence> debrief(const Grade& grade, const Gradable& attempt, const ExpertSet& set);

// "at most 5 mm", "at least 80 %", "exactly 1", "none" (at most 0 of what is never below), "yes".
std::string limit_text(const Criterion& criterion, std::string_view unit);

// Why an attempt is not graded, as a sentence; `reason` as of a Grade.
std::string not_gradable_text(std::string_view reason);

}  // namespace seldinger::assessment
