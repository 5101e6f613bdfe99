#include "reports/words/step_card.h"

#include <algorithm>
#include <array>

#include "assessment/grading/plain_words.h"
#include "assessment/grading/reason_words.h"
#include "assessment/signals/need_words.h"
#include "reports/words/metric_card.h"
#include "reports/words/metric_words.h"

namespace seldinger::reports {
namespace {

using assessment::Evidence;
using assessment::StepHow;
using assessment::StepInfo;
using assessment::StepResult;
using assessment::StepState;

enum Mark : std::size_t { kShown, kSaid, kDone, kLeftOut, kSaidOnly, kLate, kWrong, kNotAsked, kMarks };

constexpr std::array<StepMark, kMarks> kStepMarks = {{
    {"✓", "shown", false, "your action showed it, in time"},
    {"✓", "said", true, "said in time; no action can show it"},
    {"✓", "done", true, "done or said in time, stored before the two were distinguished"},
    {"–", "left out", false, "never done"},
    {"–", "said, not shown", true, "said only, where an action would show it: as left out"},
    {"–", "too late", true, "done after its time was over: as left out"},
    {"✗", "wrong", false, "done wrongly, whatever else was done"},
    {"", "not asked for", false, "the guidance, the needle, the case or the recording lacks what it needs"},
}};

Mark mark_of(const StepResult& step) {
  switch (step.state) {
    case StepState::done:
      return !step.how ? kDone : *step.how == StepHow::shown ? kShown : kSaid;
    case StepState::skipped:
      return step.t_s ? kLate : step.how == StepHow::said ? kSaidOnly : kLeftOut;
    case StepState::violated:
      return kWrong;
    case StepState::not_asked:
      break;
  }
  return kNotAsked;
}

std::string words_of(Evidence evidence) {
  return with_labels(assessment::about(evidence).words);
}

std::string definition_of(const StepInfo& step) {
  if (!step.shown())
    return "It counts as said: no action can show it, and the trainee is taken at his or her word.";
  std::string text = "It is shown by an action: hands, pictures and patient are the evidence.";
  if (step.said != Evidence::none) text += " Saying it (" + words_of(step.said) + ") is listed and does not count.";
  return text;
}

}  // namespace

const StepMark& step_mark(const StepResult& step) {
  return kStepMarks[mark_of(step)];
}

std::vector<const StepMark*> step_legend(std::span<const StepResult> steps) {
  std::vector<const StepMark*> legend;
  for (std::size_t mark = 0; mark < kNotAsked; ++mark)
    if (std::any_of(steps.begin(), steps.end(), [&](const StepResult& step) { return mark_of(step) == mark; }))
      legend.push_back(&kStepMarks[mark]);
  return legend;
}

std::string step_label(std::string_view id) {
  const StepInfo* info = assessment::find_step(id);
  return info != nullptr ? info->words : assessment::plain_code(id);
}

std::string step_text(const StepResult& step) {
  const StepMark& mark = step_mark(step);
  return step_label(step.id) + (mark.told ? " (" + std::string(mark.words) + ")" : "");
}

std::string step_result_text(const StepResult& step) {
  const StepMark& mark = step_mark(step);
  std::string text = *mark.sign != '\0' ? std::string(mark.sign) + " " + mark.words : std::string(mark.words);
  if (step.t_s) text += " at " + number_text(*step.t_s, 1) + " s";
  if (!step.reason.empty()) return text + ": " + assessment::reason_words(step.reason);
  // Bone that was never met was kept off: what is missing is the way to the target.
  const StepInfo* info = assessment::find_step(step.id);
  const bool on_the_way = info != nullptr && info->completes == Evidence::at_target;
  return text + ": " + (mark_of(step) == kLeftOut && on_the_way ? "the target was not reached" : mark.meaning);
}

std::string step_fault_text(const StepResult& step) {
  const StepInfo* info = assessment::find_step(step.id);
  const Mark mark = mark_of(step);
  if (info == nullptr || !step.t_s) return "";
  if (mark == kWrong) return words_of(info->violates);
  return mark == kLate ? "done only now: in time until " + words_of(info->by) : "";
}

Card step_card(std::string_view id, int version) {
  Card card{std::string(id), step_label(id), 0, "", {}};
  const StepInfo* info = assessment::find_step(id);
  if (info == nullptr) {
    card.definition = "This program does not know the step: another version of the program stored the result.";
    return card;
  }
  card.version = assessment::kStepsVersion;
  card.definition = definition_of(*info);
  std::string asked = assessment::words_of_needs(info->needs);
  if (info->asked_when != Evidence::none) asked += "; where " + words_of(info->asked_when);
  card.lines.push_back({"Needs", asked});
  card.lines.push_back({"Done when", words_of(info->completes)});
  card.lines.push_back(
      {"In time until", info->by == Evidence::none ? "the end: any time will do" : words_of(info->by)});
  card.lines.push_back({"Wrong when", info->violates == Evidence::none ? "never: it is done, or left out"
                                                                       : words_of(info->violates)});
  card.lines.push_back(
      {"Counts",
       info->graded_with == 0
           ? "wherever it is asked for, in " + with_labels("steps_done") + " and " + with_labels("steps_violated")
           : "only with " + assessment::words_of_needs(info->graded_with) + "; elsewhere it is only listed"});
  card.lines.push_back({"Version", version_words(card, version, "result was judged")});
  card.lines.push_back({"Source", info->source});
  return card;
}

}  // namespace seldinger::reports
