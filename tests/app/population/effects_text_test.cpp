// What simulated people would have shown in published studies.
#include "app/population/effects_text.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

namespace population = assessment::population;

const population::ReferenceEffect& row_of(std::string_view source, std::string_view what) {
  for (const population::ReferenceEffect& row : population::reference_effects())
    if (row.source.find(source) != row.source.npos && row.what.find(what) != row.what.npos) return row;
  throw std::runtime_error("there is no such row");
}

SimulatedEffects made_up() {
  SimulatedEffects made;
  // Metrics that tell nothing of one attempt and everything of two.
  made.metrics = {{.metric = "hit", .difference = 0.0},
                  {.metric = "path_tip", .difference = 0.0, .novices = 50.0, .practised = 40.0},
                  {.metric = "path_inefficiency", .difference = 0.0, .novices = 0.0, .practised = 1.0},
                  {.metric = "first_pass_success", .difference = 0.0, .novices = 0.6, .practised = 0.9}};
  made.of_two = {{.metric = "hit", .difference = 3.0}};
  made.answers.resize(6);
  return made;
}

TEST(PredictedEffects, AShareIsOfAsManyPerformancesAsTheStudyLookedAt) {
  const SimulatedEffects made = made_up();
  EXPECT_NEAR(*predicted(made, row_of("Johnson", "metrics that told")), 0.05, 0.01) << "α where nothing differs";
  EXPECT_GT(*predicted(made, row_of("Madsen", "metrics that told")), 0.99);
}

TEST(PredictedEffects, PracticeIsARatioAndALevelIsANovices) {
  const SimulatedEffects made = made_up();
  EXPECT_NEAR(*predicted(made, row_of("Xia", "needle's path")), 0.8, 1e-12);
  EXPECT_FALSE(predicted(made, row_of("Xia", "path inefficiency")).has_value()) << "of nothing there is no ratio";
  EXPECT_FALSE(predicted(made, row_of("Xia", "probe's path")).has_value()) << "no metric of ours";
  EXPECT_NEAR(*predicted(made, row_of("BMC", "first pass")), 0.6, 1e-12);
  EXPECT_FALSE(predicted(made, row_of("BMC", "complications")).has_value());
}

TEST(PredictedEffects, AreWithinByFifteenHundredthsOrTheInterval) {
  SimulatedEffects made = made_up();
  const auto& path = row_of("Xia", "needle's path");  // 41.1 / 58.0 = .709, of no interval; made up .8
  EXPECT_EQ(is_within(made, path), true);
  made.metrics[1].practised = 50.0 * (0.709 + 0.16);
  EXPECT_EQ(is_within(made, path), false);
  EXPECT_FALSE(is_within(made, row_of("Xia", "probe's path")).has_value());
  // .52, with an interval of -.57 to 1.61: 1.5 is far off and within, 1.7 is not.
  const auto& touch = row_of("table 6.3", "touch was accurate");
  made.answers[1].difference = 1.5;
  EXPECT_EQ(is_within(made, touch), true);
  made.answers[1].difference = 1.7;
  EXPECT_EQ(is_within(made, touch), false);
}

// The non-central t distribution's: .652 and .523 (R's pt).
TEST(PredictedEffects, ThePowerOfStudiesOfThatSizeIsTold) {
  EXPECT_NEAR(population::selected_of(0.8, 26, 14).power, 0.652, 0.01);
  EXPECT_NEAR(population::selected_of(0.8, 16, 12).power, 0.523, 0.01);
  const std::string text = text_of_effects(made_up());
  EXPECT_NE(
      text.find("0.8 becomes significant in 65 % of studies of 26 and 14 people and in 52 % of studies of 16"),
      std::string::npos)
      << text;
}

}  // namespace
}  // namespace seldinger::app
