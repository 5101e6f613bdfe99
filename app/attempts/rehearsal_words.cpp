#include "app/attempts/rehearsal_words.h"

#include <cmath>

#include "assessment/grading/debrief.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

std::string share_text(std::size_t part, std::size_t whole) {
  return std::to_string(part) + " of " + std::to_string(whole);
}

std::string found_text(const session::Rehearsal& rehearsal) {
  const std::size_t attempts = rehearsal.attempts(), passed = rehearsal.passed();
  if (attempts == 0) return "Stopped before anybody tried it.";
  const std::string of = share_text(passed, attempts) + " passed.";
  if (passed == 0) return "Nobody passed it: " + of;
  if (passed == attempts) return "It can be passed, by everybody: " + of;
  return "It can be passed: " + of;
}

}  // namespace

RehearsalWords words_of(const session::Rehearsal& rehearsal) {
  RehearsalWords words;
  words.found = found_text(rehearsal);
  if (rehearsal.stopped()) words.found += " It was stopped early.";
  for (const session::RehearsedLevel& one : rehearsal.levels) {
    std::string line = one.operator_name + ": " + share_text(one.passed, one.attempts) + " passed";
    if (one.attempts > 0)
      line +=
          " (" +
          std::to_string(std::lround(100.0 * static_cast<double>(one.passed) / static_cast<double>(one.attempts))) +
          " %)";
    words.levels.push_back(std::move(line));
  }
  for (const session::MissedCriterion& one : rehearsal.missed)
    words.missed.push_back(
        (one.of.of_the_time_limit ? "Time limit" : reports::metric_label(one.of.criterion.metric)) + ": " +
        assessment::limit_text(one.of.criterion, one.of.unit) + " – not met by " +
        share_text(one.missed, rehearsal.attempts()));
  words.operators = "Tried by the operators that come with this program (docs/operators.md), " +
                    std::to_string(rehearsal.people) + " different people of each level, seed " +
                    std::to_string(rehearsal.seed) + ", one attempt each; nothing is kept. " +
                    session::kRehearsalProves;
  return words;
}

}  // namespace seldinger::app
