// Permuted blocks: balanced at the end of each, the same for a seed, another for another seed or stratum, and each
// arrangement of a block as likely as the next.
#include "assessment/study/randomisation.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <string>

#include "tests/assessment/study/sample_plan.h"

namespace seldinger::assessment::study {
namespace {

Plan arms(const char* block_sizes) {
  return sample_plan("", std::string(R"("arms": [{"name": "few"}, {"name": "many"}], "randomisation": {"strata": [],
    "block_sizes": )") + block_sizes +
                             "}");
}

std::string sequence(const Plan& plan, std::uint64_t seed, const char* stratum, std::size_t length) {
  std::string all;
  for (std::size_t i = 0; i < length; ++i) all += static_cast<char>('a' + allocated(plan, seed, stratum, i));
  return all;
}

TEST(Randomisation, BlocksAreBalancedInTheRatioOfTheArms) {
  const Plan plan = sample_plan("", kArms);  // 2 : 1, blocks of 3 and 6
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    int most_off = 0, sum = 0;
    for (std::size_t i = 0; i < 60; ++i) {
      sum += allocated(plan, seed, "s", i) == 0 ? 1 : -2;
      most_off = std::max(most_off, std::abs(sum));
    }
    EXPECT_LE(most_off, 4) << "within a block of 6 two seconds before the four firsts, or the firsts before them";
    EXPECT_LE(std::abs(sum), 4);
  }
}

TEST(Randomisation, IsAPureFunctionOfSeedStratumAndPlace) {
  const Plan plan = arms("[2, 4]");
  EXPECT_EQ(sequence(plan, 7, "s", 40), sequence(plan, 7, "s", 40));
  EXPECT_EQ(sequence(plan, 7, "s", 40).substr(0, 10), sequence(plan, 7, "s", 10));
  EXPECT_NE(sequence(plan, 7, "s", 40), sequence(plan, 8, "s", 40));
  EXPECT_NE(sequence(plan, 7, "handedness=left", 40), sequence(plan, 7, "handedness=right", 40));
}

// Blocks of 4 of two arms: six arrangements, each as likely; by χ² with 5 degrees of freedom, whose 99.9 % is 20.5.
TEST(Randomisation, EveryArrangementOfABlockIsAsLikely) {
  const Plan plan = arms("[4]");
  std::map<std::string, int> counts;
  constexpr int kSeeds = 6000;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) ++counts[sequence(plan, seed, "s", 4)];
  ASSERT_EQ(counts.size(), 6U);
  double chi_squared = 0.0;
  for (const auto& [arrangement, count] : counts) chi_squared += std::pow(count - kSeeds / 6.0, 2) / (kSeeds / 6.0);
  EXPECT_LT(chi_squared, 20.5);
}

// How often whoever guesses the arm with fewer people so far is right, wherever one has fewer.
double guessed_share(const Plan& plan) {
  int right = 0, guessed = 0;
  for (std::uint64_t seed = 0; seed < 2000; ++seed) {
    int ahead = 0;
    for (std::size_t i = 0; i < 24; ++i) {
      const bool first = allocated(plan, seed, "s", i) == 0;
      if (ahead != 0) {
        ++guessed;
        right += first == (ahead < 0) ? 1 : 0;
      }
      ahead += first ? 1 : -1;
    }
  }
  return static_cast<double>(right) / guessed;
}

// By enumeration: in a block of 2 always; in one of 4 two of three times after the first, and certainly where two
// of an arm came first and at the end: 1 of 1, and 2 of 2 1/3. Drawn between the two, 3 of 3 1/3.
TEST(Randomisation, BlocksOfSeveralSizesHideTheNextPlaceAsWellAsBlocksCan) {
  EXPECT_EQ(guessed_share(arms("[2]")), 1.0) << "why one small size is no concealment";
  EXPECT_NEAR(guessed_share(arms("[4]")), 2.0 / (7.0 / 3.0), 0.01);
  EXPECT_NEAR(guessed_share(arms("[2, 4]")), 3.0 / (10.0 / 3.0), 0.01);
}

}  // namespace
}  // namespace seldinger::assessment::study
