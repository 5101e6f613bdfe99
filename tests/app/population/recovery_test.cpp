// What is found beside what was planted, of courses whose law is known.
#include "app/population/recovery.h"

#include <gmock/gmock.h>

#include <cmath>

#include "sim/base/rng.h"

namespace seldinger::app {
namespace {

using ::testing::HasSubstr;

// Down from 12 mm to a plateau, at the learner's own rate, with noise.
std::vector<LearnersCourse> known_courses(std::size_t learners, std::size_t attempts, double noise) {
  base::Rng rng(3);
  std::vector<LearnersCourse> courses;
  for (std::size_t l = 0; l < learners; ++l) {
    LearnersCourse& one = courses.emplace_back();
    one.learner = "novice-" + std::to_string(l + 1);
    one.practice.rate = 0.2 + 0.2 * rng.uniform();
    one.practice.ceiling = 8.0;
    const double plateau = 4.0 + rng.normal();
    for (std::size_t i = 0; i < attempts; ++i)
      one.values.push_back(plateau + 8.0 * std::exp(-one.practice.rate * static_cast<double>(i)) +
                           noise * rng.normal());
    for (std::size_t i = 0; i < 200; ++i) one.practised_values.push_back(plateau + noise * rng.normal());
  }
  return courses;
}

TEST(Recovery, FindsPlateausAndRatesOfAKnownLaw) {
  const auto courses = known_courses(200, 30, 0.5);
  // Tangent intervals of a curve that is one of two: 95 % less three standard errors and what choosing costs.
  const RecoverySection plateaus = plateaus_recovered("depth, mm", courses);
  EXPECT_GE(plateaus.with_interval(), 195U);
  EXPECT_GE(plateaus.held(), plateaus.with_interval() * 80 / 100);
  const RecoverySection rates = rates_recovered("depth, mm", courses);
  EXPECT_GE(rates.with_interval(), 195U);
  EXPECT_GE(rates.held(), rates.with_interval() * 90 / 100);
  const RecoverySection pooled = pooled_recovered("depth, mm", courses);
  ASSERT_EQ(pooled.numbers.size(), 2U);
  EXPECT_NEAR(*pooled.numbers[0].found, pooled.numbers[0].planted, 0.3);
  EXPECT_NEAR(*pooled.numbers[1].found, pooled.numbers[1].planted, 0.03);
}

TEST(Recovery, WhoDoesNotLearnHasNoRate) {
  auto courses = known_courses(2, 20, 0.1);
  courses[1].practice.ceiling = 0.0;
  EXPECT_EQ(rates_recovered("depth", courses).numbers.size(), 1U);
  courses[0].values.assign(20, std::nan(""));
  EXPECT_FALSE(plateaus_recovered("depth", courses).numbers[0].held().has_value());
}

// Truth and finding by the same model: intervals hold but for the halo, which they do not know of.
TEST(Recovery, FindsWhoIsSevere) {
  namespace population = assessment::population;
  std::vector<population::Person> people;
  for (std::uint64_t p = 1; p <= 60; ++p)
    people.push_back(population::drawn_person(*population::named_group("novice"), 5, p));
  const RecoverySection found = severities_recovered(people, 5, 4, 600, 11);
  ASSERT_EQ(found.numbers.size(), 20U);
  double off = 0.0, spread = 0.0;
  for (const PlantedNumber& one : found.numbers) {
    ASSERT_TRUE(one.found.has_value());
    off += (*one.found - one.planted) * (*one.found - one.planted);
    spread += one.planted * one.planted;
  }
  EXPECT_LT(off, 0.2 * spread) << "severe and lenient raters are told apart";
  EXPECT_GE(found.held(), 14U);
}

TEST(Recovery, AnErrorOfWhatIsPlantedWidensTheInterval) {
  PlantedNumber number{"x", 1.0, 0.0, 0.0, assessment::statistics::Interval{-0.5, 0.5}};
  EXPECT_EQ(number.held(), false);
  number.planted_error = 0.5;  // √(.25 + .96)
  EXPECT_EQ(number.held(), true);
  number.interval.reset();
  EXPECT_EQ(number.held(), std::nullopt);
}

TEST(Recovery, SaysFirstThatAllOfItIsSimulated) {
  const std::string text = text_of_recovery("Of nobody.", {{"How hard", "In words.", {{"a", 0.5, 0.0, 0.4, {}}}}});
  EXPECT_LT(text.find("SIMULATED:** nothing here is about people."), text.find("How hard"));
  EXPECT_THAT(text, HasSubstr("| How hard | 0 of 1 | 0 |"));
  EXPECT_THAT(text, HasSubstr("| a | 0.5 | 0.4 |  |  |"));
}

TEST(Recovery, SaysWhyNothingIsThere) {
  const RecoverySection cuts{"Cuts", "Of two groups.", {}, {"Drill, depth, mm: the groups are the same"}};
  EXPECT_THAT(text_of_recovery("A library.", {cuts}),
              HasSubstr("Of two groups.\n\nNot estimable:\n\n- Drill, depth, mm: the groups are the same\n"));
  EXPECT_THAT(text_of_recovery("A library.", {{"Cuts", "Of two groups.", {}}}),
              HasSubstr("Of two groups.\n\nNothing could be estimated.\n"));
}

}  // namespace
}  // namespace seldinger::app
