// Agreement of raters: against closed forms, what is planted, and the statistics' own procedures.
#include "assessment/rating/agreement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "sim/base/rng.h"

namespace seldinger::assessment::rating {
namespace {

// Raters "R1" … with severities and drifts that sum to 0, over an assignment; skill and error normal.
struct Planted {
  std::vector<double> severity, drift;  // drift by ten ratings
  double error_sd = 0.5;
};
std::vector<Rating> ratings_of(const Design& design, const Planted& planted, std::uint64_t seed) {
  std::vector<Rating> all;
  const auto plan = assigned(design);
  base::Rng rng(seed);
  for (std::size_t r = 0; r < plan.size(); ++r)
    for (std::size_t i = 0; i < plan[r].size(); ++i) {
      const Assigned& one = plan[r][i];
      const bool known = one.part == Part::calibration;
      const double skill = 3.0 + base::normal_at(seed + (known ? 1 : 0), one.view);
      Rating rating{"R" + std::to_string(r + 1), (known ? "C" : "V") + std::to_string(one.view), one.part, i + 1,
                    skill - planted.severity[r] + planted.drift[r] * static_cast<double>(i) / 10.0 +
                        planted.error_sd * rng.normal()};
      if (known) rating.known = skill;
      all.push_back(rating);
    }
  return all;
}

TEST(AgreementOf, FullyCrossedSeverityIsTheDifferenceOfMeans) {
  const Design design{12, 0, 3, 3, 0, 4};
  const auto ratings = ratings_of(design, {{0.5, 0.0, -0.5}, {0, 0, 0}}, 7);
  double means[3] = {}, all = 0.0;
  for (const Rating& one : ratings) {
    means[one.rater[1] - '1'] += one.score / 12.0;
    all += one.score / 36.0;
  }
  const Agreement agreement = agreement_of(ratings, 3);
  ASSERT_EQ(agreement.raters.size(), 3U);
  for (std::size_t r = 0; r < 3; ++r) {
    ASSERT_TRUE(agreement.raters[r].severity.has_value());
    EXPECT_NEAR(agreement.raters[r].severity->value, all - means[r], 1e-12);
    EXPECT_EQ(agreement.raters[r].rated, 12U);
  }
  EXPECT_EQ(agreement.ratings, 36U);
  EXPECT_EQ(agreement.one.n, 12U);
}

// In 1,000 rounds of an incomplete design the 95 % intervals hold what was planted in 95 % of them.
TEST(AgreementOf, IntervalsOfSeverityAndDriftCoverWhatWasPlanted) {
  const Planted planted{{0.8, 0.1, -0.3, -0.6}, {0.3, -0.1, 0.0, -0.2}};
  int severity = 0, drift = 0, rounds = 0;
  for (std::uint64_t seed = 0; seed < 250; ++seed) {
    const Design design{30, 0, 4, 2, 0, seed};
    // Severity is asked where nothing drifts: else it is that of the middle of one's ratings.
    const Agreement still = agreement_of(ratings_of(design, {planted.severity, {0, 0, 0, 0}}, seed), 2);
    const Agreement moving = agreement_of(ratings_of(design, planted, seed), 2);
    for (std::size_t r = 0; r < 4; ++r) {
      ASSERT_TRUE(still.raters[r].severity && moving.raters[r].drift) << seed;
      const auto covers = [](const Estimated& one, double truth) {
        return one.ci95.low <= truth && truth <= one.ci95.high;
      };
      severity += covers(*still.raters[r].severity, planted.severity[r]) ? 1 : 0;
      drift += covers(*moving.raters[r].drift, planted.drift[r]) ? 1 : 0;
      ++rounds;
    }
  }
  EXPECT_EQ(rounds, 1'000);
  EXPECT_NEAR(severity, 950, 35);
  EXPECT_NEAR(drift, 950, 35);
}

TEST(AgreementOf, ARaterIsHeldAgainstKnownScoresAndAgainstThemselves) {
  std::vector<Rating> ratings = {
      {"R1", "C0", Part::calibration, 1, 4.0, 3.0},
      {"R1", "C1", Part::calibration, 2, 2.0, 2.5},
      {"R1", "V0", Part::rated, 3, 3.0},
      {"R1", "V1", Part::rated, 4, 5.0},
      {"R1", "V0", Part::repeated, 5, 4.0},
      {"R1", "V1", Part::repeated, 6, 5.0},
  };
  const Agreement agreement = agreement_of(ratings, 2);
  ASSERT_EQ(agreement.raters.size(), 1U);
  const RaterResult& r1 = agreement.raters[0];
  EXPECT_EQ(r1.calibrated, 2U);
  EXPECT_DOUBLE_EQ(r1.off_known.value(), 0.25);
  EXPECT_EQ(r1.repeated, 2U);
  EXPECT_DOUBLE_EQ(r1.off_self.value(), std::sqrt(1.0 / 4.0));
  EXPECT_FALSE(r1.severity.has_value()) << "nobody to hold them against";
  EXPECT_FALSE(agreement.one.estimable());
  EXPECT_EQ(agreement.ratings, 2U) << "calibration and repeats are no evidence";
}

TEST(AgreementOf, NothingAndRatersWhoNeverMetHaveReasonsNotNumbers) {
  const Agreement none = agreement_of({}, 2);
  EXPECT_FALSE(none.one.estimable());
  EXPECT_FALSE(none.kappa.estimable());
  EXPECT_TRUE(none.raters.empty());
  std::vector<Rating> apart;
  for (int view = 0; view < 6; ++view)
    for (int rater = 0; rater < 2; ++rater)
      apart.push_back({"R" + std::to_string(rater + (view % 2 == 0 ? 1 : 3)), "V" + std::to_string(view),
                       Part::rated, static_cast<std::size_t>(view),
                       static_cast<double>((view * 7 + rater * 3) % 5)});
  for (const RaterResult& one : agreement_of(apart, 2).raters)
    EXPECT_FALSE(one.severity.has_value()) << "R1 and R2 were never beside R3 and R4";
}

// One-way: who is paired with whom, and in which order, says nothing; agreement of 1 where scores are the replay's.
TEST(AgreementOf, PerfectAgreementIsOne) {
  const Design design{20, 0, 4, 2, 0, 3};
  auto ratings = ratings_of(design, {{0, 0, 0, 0}, {0, 0, 0, 0}, 0.0}, 5);
  for (Rating& one : ratings) one.score = std::round(one.score);
  const Agreement agreement = agreement_of(ratings, 2);
  EXPECT_NEAR(agreement.one.estimate.value(), 1.0, 1e-12);
  EXPECT_NEAR(agreement.kappa.estimate.value(), 1.0, 1e-12);
}

}  // namespace
}  // namespace seldinger::assessment::rating
