// What somebody reads who asks about a step: complete, in words; and a mark for every result, each in the legend.
#include "reports/words/step_card.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "reports/words/metric_words.h"
#include "tests/reports/words/card_line.h"

namespace seldinger::reports {
namespace {

using assessment::StepHow;
using assessment::StepResult;
using assessment::StepState;

StepResult result(StepState state, std::optional<double> t_s = {}, std::optional<StepHow> how = {}) {
  return {"sign_out", assessment::kStepsVersion, state, t_s, "", how};
}

TEST(StepCardTest, EveryStepTellsAllThereIsToAskInWords) {
  const std::regex code("[a-z0-9]+(_[a-z0-9]+)+");
  for (const assessment::StepInfo& info : assessment::procedure_steps()) {
    const Card card = step_card(info.id, assessment::kStepsVersion);
    EXPECT_EQ(card.label, info.words);
    EXPECT_NE(card.definition.find(info.shown() ? "shown by an action" : "counts as said"), std::string::npos)
        << info.id;
    EXPECT_FALSE(std::regex_search(card.definition, code)) << card.definition;
    for (const char* name : {"Needs", "Done when", "In time until", "Wrong when", "Counts", "Version", "Source"}) {
      const std::string text = line_of(card, name);
      EXPECT_FALSE(text.empty()) << info.id << " " << name;
      const bool names_the_code = std::string_view(name) == "Version";
      EXPECT_TRUE(names_the_code || !std::regex_search(text, code)) << text;
    }
    EXPECT_EQ(line_of(card, "Source"), info.source);
    EXPECT_EQ(line_of(card, "Version").find("this result"), std::string::npos);
  }
  EXPECT_NE(line_of(step_card("nick", 2), "Version").find("this result was judged by version 2"),
            std::string::npos);
}

TEST(StepCardTest, WhatIsSaidOfADeedIsToldAsNotCounting) {
  EXPECT_NE(step_card("check_probe").definition.find("does not count"), std::string::npos);
  EXPECT_EQ(step_card("place_probe").definition.find("does not count"), std::string::npos);
  EXPECT_EQ(line_of(step_card("jiggle"), "Counts"), "only with tissue that yields; elsewhere it is only listed");
}

TEST(StepCardTest, OfAnUnknownStepSaysThatItIsUnknown) {
  const Card card = step_card("of_tomorrow", 9);
  EXPECT_EQ(card.label, "of tomorrow");
  EXPECT_TRUE(card.lines.empty());
  EXPECT_NE(card.definition.find("does not know"), std::string::npos);
}

// Before, who met no bone and did not reach the target was told of "Keep off bone": "never done".
TEST(StepCardTest, WhatIsDoneAtTheTargetIsLeftOutForWantOfIt) {
  StepResult step = result(StepState::skipped);
  EXPECT_EQ(step_result_text(step), "– left out: never done");
  step.id = "keep_off_bone";
  EXPECT_EQ(step_result_text(step), "– left out: the target was not reached");
  step.t_s = 4.0;
  EXPECT_EQ(step_result_text(step).find("not reached"), std::string::npos) << "too late is told as that";
}

TEST(StepCardTest, WhatWentWrongSaysWhatItWas) {
  const auto of = [](const char* id, StepState state, std::optional<double> t_s) {
    StepResult step = result(state, t_s);
    step.id = id;
    return step_fault_text(step);
  };
  EXPECT_EQ(of("aim_along_beam", StepState::violated, 41.3), "a pulse met the hand");
  EXPECT_EQ(of("nick", StepState::skipped, 9.0).find("done only now: in time until the skin was first"), 0U);
  EXPECT_EQ(of("nick", StepState::skipped, {}), "") << "never done: there is no moment";
  EXPECT_EQ(of("aim_along_beam", StepState::done, 3.0), "");
  EXPECT_EQ(of("of_tomorrow", StepState::violated, 3.0), "");
  EXPECT_EQ(clock_text(41.3), "0:41");
  EXPECT_EQ(clock_text(125.0), "2:05");
}

// Before, what came too late had the mark of what was left out, and no mark had a legend.
TEST(StepMarkTest, EveryResultHasItsOwnAndTheLegendHasThemAll) {
  const std::vector<StepResult> results = {result(StepState::done, 1.0, StepHow::shown),
                                           result(StepState::done, 1.0, StepHow::said),
                                           result(StepState::done, 1.0),
                                           result(StepState::skipped),
                                           result(StepState::skipped, {}, StepHow::said),
                                           result(StepState::skipped, 9.0),
                                           result(StepState::violated, 9.0)};
  std::set<std::string> words, shown;  // as a legend says them, as a list shows them
  for (const StepResult& one : results) {
    const StepMark& mark = step_mark(one);
    EXPECT_STRNE(mark.sign, "");
    words.insert(mark.words);
    shown.insert(mark.sign + step_text(one));
    const auto legend = step_legend({&one, 1});
    ASSERT_EQ(legend.size(), 1U);
    EXPECT_EQ(legend.front(), &mark);
  }
  EXPECT_EQ(words.size(), results.size());
  EXPECT_EQ(shown.size(), results.size());
  EXPECT_EQ(step_legend(results).size(), results.size());
  const StepResult not_asked = result(StepState::not_asked);
  EXPECT_TRUE(step_legend({&not_asked, 1}).empty());
  EXPECT_STREQ(step_mark(result(StepState::skipped, 9.0, StepHow::said)).words, "too late") << "it was done";
  EXPECT_EQ(step_result_text(results[1]), "✓ said at 1.0 s: said in time; no action can show it");
}

}  // namespace
}  // namespace seldinger::reports
