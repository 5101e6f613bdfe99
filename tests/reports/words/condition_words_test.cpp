// The conditions of an attempt in words.
#include "reports/words/condition_words.h"

#include <gtest/gtest.h>

namespace seldinger::reports {
namespace {

TEST(ConditionWords, ALineOfWhatIsKnown) {
  casedb::Conditions conditions;
  EXPECT_EQ(conditions_text(conditions, std::nullopt), "");
  EXPECT_EQ(conditions_text(conditions, 120.4), "interrupted for 120 s");
  EXPECT_EQ(conditions_text(casedb::simulated_conditions(), std::nullopt),
            "simulated hands; no needle guide; no pause");
  conditions.needle_hand = conditions.probe_hand = cases::HandKind::mouse;
  conditions.guide_used = true;
  conditions.guide_share = 0.341;
  conditions.pauses = 2;
  conditions.paused_s = 41.2;
  EXPECT_EQ(conditions_text(conditions, std::nullopt),
            "mouse for needle and probe; needle guide for 34 % of the time; 2 pauses, 41 s");
  conditions.needle_hand = cases::HandKind::arm;
  conditions.hand_changes = 1;
  conditions.guide_share = 0.002;
  conditions.help_level = 2;
  conditions.pauses = 1;
  conditions.speckle_fallback = true;
  EXPECT_EQ(
      conditions_text(conditions, 3.0),
      "arm with force feedback for the needle, mouse for the probe, changed once; needle guide for under 1 % of "
      "the time; help in the room; 1 pause, 41 s; interrupted for 3 s; simplified speckle");
}

TEST(ConditionWords, EachWithItsUnit) {
  casedb::Conditions conditions;
  const auto text = [&](const char* id) { return condition_text(*casedb::find_condition(id), conditions); };
  EXPECT_EQ(text("paused_s"), "not known");
  conditions.paused_s = 41.26;
  conditions.pauses = 2;
  conditions.guide_share = 0.341;
  conditions.guide_used = true;
  conditions.needle_hand = cases::HandKind::space_mouse;
  conditions.handedness = casedb::Handedness::left;
  conditions.window_width_px = 1280;
  EXPECT_EQ(text("paused_s"), "41.3 s");
  EXPECT_EQ(text("pauses"), "2");
  EXPECT_EQ(text("guide_share"), "34 %");
  EXPECT_EQ(text("guide_used"), "yes");
  EXPECT_EQ(text("needle_hand"), "3-D mouse");
  EXPECT_EQ(text("handedness"), "left");
  EXPECT_EQ(text("window_width_px"), "1280 px");
}

}  // namespace
}  // namespace seldinger::reports
