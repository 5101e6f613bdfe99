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

}  // namespace
}  // namespace seldinger::app
