// The marks along a replay, of a needle whose way is known.
#include "assessment/replay_marks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

const ReplayMark* mark_of(const std::vector<ReplayMark>& marks, const std::string& words) {
  const auto found =
      std::find_if(marks.begin(), marks.end(), [&](const ReplayMark& one) { return one.words == words; });
  return found == marks.end() ? nullptr : &*found;
}

TEST(ReplayMarksTest, TellInTimeWhatHappenedAndWhatWasSaid) {
  StraightDown made = straight_down({{0.0, -10.0}, {2.0, 0.0}, {6.0, 60.0}, {8.0, 60.0}}, 8.0);
  using cases::EventKind;
  made.recording.events = {
      {0.1, EventKind::needle_by_mouse}, {0.5, EventKind::aspirate}, {2.5, EventKind::pain_skin}};
  cases::Structure ball;
  ball.name = "artery";
  ball.rule = cases::StructureRule::critical;
  ball.shape = cases::Sphere{{0.0, -35.0, 0.0}, 5.0};
  const std::vector<cases::Structure> structures{ball};
  made.setting.structures = structures;
  const Signals signals = made.signals();
  const auto marks = replay_marks(signals);
  EXPECT_TRUE(std::is_sorted(marks.begin(), marks.end(),
                             [](const ReplayMark& a, const ReplayMark& b) { return a.t_s < b.t_s; }));
  const ReplayMark* fired = mark_of(marks, "Fired");
  ASSERT_NE(fired, nullptr);
  EXPECT_NEAR(fired->t_s, 8.0, 1e-9);
  EXPECT_FALSE(fired->fault);
  const ReplayMark* in = mark_of(marks, "Through the skin");
  ASSERT_NE(in, nullptr);
  ASSERT_TRUE(first_puncture_s(signals));
  EXPECT_NEAR(in->t_s, *first_puncture_s(signals), 1.0);
  EXPECT_GT(*first_puncture_s(signals), 1.9);
  const ReplayMark* artery = mark_of(marks, "The tip came into a structure to stay out of");
  ASSERT_NE(artery, nullptr);
  EXPECT_NEAR(artery->t_s, 4.0, 0.2) << "30 mm deep";
  EXPECT_TRUE(artery->fault);
  const std::string pain = cases::find_event(EventKind::pain_skin)->words;
  const auto hurt = std::find_if(marks.begin(), marks.end(), [](const ReplayMark& one) { return one.t_s == 2.5; });
  ASSERT_NE(hurt, marks.end());
  EXPECT_TRUE(hurt->fault);
  EXPECT_EQ(hurt->words.substr(1), pain.substr(1));
  EXPECT_EQ(std::count_if(marks.begin(), marks.end(), [](const ReplayMark& one) { return one.t_s == 0.1; }), 0)
      << "which hand it was is no event of the attempt";
  EXPECT_EQ(words_at(marks, 0.4, 3.0), "");
  EXPECT_NE(words_at(marks, 0.5, 3.0), "");
  EXPECT_TRUE(words_at(marks, 8.0, 3.0).ends_with("Fired")) << words_at(marks, 8.0, 3.0);
  EXPECT_EQ(words_at(marks, 11.1, 3.0), "");
}

TEST(ReplayMarksTest, ANeedleThatWasNeverInHasNoPuncture) {
  const Signals signals = straight_down({{0.0, -10.0}, {2.0, -5.0}, {4.0, -5.0}}, 4.0).signals();
  EXPECT_FALSE(first_puncture_s(signals));
  EXPECT_EQ(mark_of(replay_marks(signals), "Through the skin"), nullptr);
}

}  // namespace
}  // namespace seldinger::assessment
