// Distributions of simulated people beside published ones: what is drawn is what was drawn of the surrogate.
#include "app/population/distributions.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "app/cli/command.h"
#include "app/population/population_json.h"
#include "sim/engine/step.h"
#include "tests/assessment/population/known_attempts.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"

namespace seldinger::app {

Command surrogate_distributions_command();  // cmd_surrogate_distributions.cpp

namespace {

namespace population = assessment::population;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr std::size_t kPeople = 500;
const SimulatedDistributions& known() {
  static const SimulatedDistributions kMade = simulated_distributions(
      population::fitted(), {"tip_target_dist", "time_total", "withdrawals_full", "path_in_tissue"}, kPeople, 1);
  return kMade;
}

const MetricDistribution& metric_of(const SimulatedDistributions& made, std::string_view id) {
  for (const MetricDistribution& one : made.metrics)
    if (one.metric == id) return one;
  throw std::runtime_error("there is no such metric");
}

// The same people, drawn here again. A value is the quantile p where as many lie below as p says: nth_element, not
// the sorted array, and the line between two of them by hand.
TEST(Distributions, QuantilesAreThoseOfTheSameDraws) {
  for (const char* id : {"tip_target_dist", "time_total", "withdrawals_full"}) {
    const std::size_t index = population::fitted().index_of(id);
    for (const LevelDistribution& level : metric_of(known(), id).levels) {
      std::vector<double> values;
      for (std::size_t number = 1; number <= kPeople; ++number) {
        const auto person = population::drawn_person(*population::named_group(level.level), 1, number);
        const auto drawn = population::fitted().draw(person, {1, 0, 0.0});
        if (drawn[index]) values.push_back(*drawn[index]);
      }
      ASSERT_EQ(level.sorted.size(), values.size()) << id;
      EXPECT_LT(values.size(), kPeople) << "one in ten has none";
      double sum = 0.0;
      for (const double value : values) sum += value;
      EXPECT_NEAR(level.mean, sum / static_cast<double>(values.size()), 1e-9) << id;
      for (std::size_t q = 0; q < kDrawnPercentiles.size(); ++q) {
        const double place = kDrawnPercentiles[q] * static_cast<double>(values.size() - 1);
        const auto at = [&](double rank) {
          const auto nth = values.begin() + static_cast<std::ptrdiff_t>(rank);
          std::nth_element(values.begin(), nth, values.end());
          return *nth;
        };
        const double below = at(std::floor(place)), above = at(std::ceil(place));
        EXPECT_NEAR(level.quantiles[q], below + (place - std::floor(place)) * (above - below), 1e-9)
            << id << ", " << level.level << ", " << kDrawnPercentiles[q];
      }
    }
  }
}

TEST(Distributions, OfAMetricWithoutAValueNothingIsTold) {
  EXPECT_EQ(known().metrics.size(), 3U) << "no attempt has a path in tissue";
  EXPECT_EQ(known().case_title, "Ball");
  EXPECT_EQ(known().simulated_attempts, 2000U);
  EXPECT_THAT(text_of_distributions(known()), Not(HasSubstr("path_in_tissue")));
  EXPECT_TRUE(distribution_of("novice", {}).sorted.empty());
  EXPECT_EQ(distribution_of("novice", {3.0}).quantiles[2], 0.0);
}

// Four values, a published figure among and beside them.
TEST(Distributions, APublishedFigureLiesAboveThoseBelowIt) {
  MetricDistribution made{"time_puncture_to_target", "s", false, {}};
  made.levels.push_back(distribution_of("novice", {4.0, 8.0, 8.0, 30.0}));
  const auto published = beside_published(made);
  ASSERT_EQ(published.size(), 4U);
  for (const BesidePublished& one : published) {
    EXPECT_EQ(one.row->level, "novice");
    EXPECT_NEAR(one.simulated, 12.5, 1e-12) << "a mean beside a mean";
    if (one.row->value == 8.0) {  // ± 3: of four one below, two the same
      EXPECT_NEAR(one.below, 0.5, 1e-12);
      EXPECT_EQ(one.within_spread, false);
    }
    if (one.row->value == 16.0) {  // ± 8
      EXPECT_NEAR(one.below, 0.75, 1e-12);
      EXPECT_EQ(one.within_spread, true);
    }
    if (one.row->value == 52.8) {  // of no spread
      EXPECT_FALSE(one.within_spread.has_value());
    }
  }
  made.metric =
      "path_in_tissue";  // of residents, who are held against intermediates, and of novices without a spread
  for (const BesidePublished& one : beside_published(made)) EXPECT_EQ(one.row->level, "novice");
}

TEST(Distributions, TheChartHasEveryFigureAndItsSource) {
  const std::string svg = svg_of_distributions(known());
  for (const char* piece : {"<svg", "simulated novices", "simulated intermediates", "simulated experts",
                            "whole attempts", "published: none reported", "30 (20.4 to 95.4)", "2.6 ± 2.8"}) {
    EXPECT_THAT(svg, HasSubstr(piece));
  }
  for (const char* id : {"tip_target_dist", "time_total"})
    for (const BesidePublished& one : beside_published(metric_of(known(), id)))
      EXPECT_THAT(svg, HasSubstr(std::string("] ") + std::string(one.row->source)));
  const std::string text = text_of_distributions(known()), json = json_of_distributions(known());
  EXPECT_THAT(text, HasSubstr("Of `withdrawals_full` no published distribution was found."));
  EXPECT_THAT(text, HasSubstr("nothing here is about people"));
  EXPECT_THAT(json, HasSubstr("\"synthetic\": true"));
}

// A surrogate of a case that has none of what is drawn by default, and every default metric is a metric.
TEST(Distributions, AreDrawnOfMetricsOfTheRegistry) {
  const auto made = simulated_distributions(population::fitted(), drawn_metrics(), 100, 1);
  EXPECT_EQ(made.metrics.size(), 3U);
  for (const population::ReferenceDistribution& row : population::reference_distributions()) {
    const auto drawn = drawn_metrics();
    EXPECT_NE(std::find(drawn.begin(), drawn.end(), row.metric), drawn.end()) << row.metric << " is not drawn";
  }
}

// The command on a file of the known attempts, marked as of today's program.
class DistributionsCommand : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fixtures::fresh_test_folder("distributions");
    auto mark = population::mark_of_today(engine::kStepVersion, "case-1", "Ball", "x");
    std::ofstream(folder_ / "ball.json")
        << population::Surrogate::fit(std::move(mark), population::attempts_of({0.0, 0.6, 1.2}, 1, 90))->to_json();
  }
  int call(std::vector<std::string> words) {
    words.insert(words.begin(), {"--surrogate", (folder_ / "ball.json").string()});
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const Command command = surrogate_distributions_command();
    const int code = command.run(Arguments(command, words));
    out_ = testing::internal::GetCapturedStdout();
    err_ = testing::internal::GetCapturedStderr();
    return code;
  }
  // What it says of a wrong call.
  std::string refused(std::vector<std::string> words) const {
    words.insert(words.begin(), {"--surrogate", (folder_ / "ball.json").string()});
    const Command command = surrogate_distributions_command();
    try {
      command.run(Arguments(command, words));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }
  std::filesystem::path folder_;
  std::string out_, err_;
};

TEST_F(DistributionsCommand, WritesTheChartThatItTells) {
  const auto chart = folder_ / "chart.svg";
  ASSERT_EQ(call({"--chart", chart.string(), "--people", "200", "--metric", "time_total"}), kDone) << err_;
  EXPECT_THAT(out_, HasSubstr("first attempts of 200 people of each level at `Ball`"));
  EXPECT_THAT(out_, HasSubstr("surrogate of 90 whole attempts"));
  EXPECT_THAT(fixtures::whole_file(chart), HasSubstr("Time, s"));
  EXPECT_THAT(fixtures::whole_file(chart), Not(HasSubstr("Distance")));
}

TEST_F(DistributionsCommand, SaysWhatIsWrong) {
  EXPECT_THAT(refused({"--metric", "length"}), HasSubstr("there is no metric called \"length\""));
  EXPECT_THAT(refused({"--chart", "chart.png"}), HasSubstr("--chart ends in .svg"));
  EXPECT_THAT(refused({"--people", "3"}), HasSubstr("--people is a whole number from 100"));
  EXPECT_EQ(call({"--metric", "path_in_tissue", "--chart", (folder_ / "none.svg").string()}), kRefused);
  EXPECT_THAT(err_, HasSubstr("bad_surrogate: none of these metrics has a value"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "none.svg"));
  std::ofstream(folder_ / "ball.json") << "{}";
  EXPECT_EQ(call({}), kRefused);
  EXPECT_THAT(err_, HasSubstr("bad_surrogate"));
}

}  // namespace
}  // namespace seldinger::app
