// Published effects: that the rows are what the publications say, and that selection is undone as it is done.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "assessment/population/raters.h"
#include "assessment/population/reference_effects.h"
#include "assessment/population/streams.h"
#include "assessment/statistics/distributions.h"

namespace seldinger::assessment::population {
namespace {

TEST(ReferenceEffects, AreEnoughOfEnoughSourcesWithTheirSizes) {
  std::set<std::string_view> sources;
  std::size_t fitted = 0, without_error = 0;
  for (const ReferenceEffect& row : reference_effects()) {
    sources.insert(row.source.substr(0, row.source.find(",")));
    fitted += row.fitted ? 1U : 0U;
    EXPECT_TRUE(std::isfinite(row.value)) << row.what;
    EXPECT_FALSE(row.how.empty()) << row.what;
    if (row.kind == EffectKind::difference || row.kind == EffectKind::discriminating) {
      EXPECT_GT(row.n1, 1U);
      EXPECT_GT(row.n2, 1U);
    }
    // With an interval about the value, or said to have none.
    const auto interval = interval95(row);
    ASSERT_EQ(interval.has_value(), standard_error(row).has_value()) << row.what;
    if (!interval) {
      ++without_error;
      EXPECT_NE(row.kind, EffectKind::difference) << row.what;
      EXPECT_NE(row.kind, EffectKind::discriminating) << row.what;
      continue;
    }
    EXPECT_GT(*standard_error(row), 0.0) << row.what;
    EXPECT_LT(interval->low, row.value) << row.what;
    EXPECT_GT(interval->high, row.value) << row.what;
  }
  EXPECT_GE(reference_effects().size() - without_error, 20U);
  EXPECT_GE(sources.size(), 8U);
  EXPECT_LT(fitted, reference_effects().size() / 2);
}

// The t statistics that Johnson et al. print, and means and deviations of table 6.3.
TEST(ReferenceEffects, AreWhatTheirSourcesGive) {
  const auto rows = reference_effects();
  const auto value_of = [&](std::string_view what, std::string_view source) {
    for (const ReferenceEffect& row : rows)
      if (row.what == what && row.source.find(source) != std::string_view::npos) return row.value;
    ADD_FAILURE() << what;
    return 0.0;
  };
  EXPECT_NEAR(value_of("targeting", "Johnson"), difference_of_t(2.487, 26, 14), 1e-5);
  EXPECT_NEAR(value_of("targeting", "Johnson"), 0.8244324721, 1e-5);
  EXPECT_NEAR(value_of("level of realism", "table 6.3"),
              (3.67 - 2.44) / std::sqrt((9.0 * 0.73 * 0.73 + 4.0 * 0.58 * 0.58) / 13.0), 1e-12);
  // 52 and 64 % with p = .19 of 14 and 7 people.
  EXPECT_NEAR(value_of("score of a prostate biopsy, 52 and 64 %", "17159683"),
              difference_of_t(statistics::student_t_quantile(1.0 - 0.19 / 2.0, 19), 14, 7), 1e-3);
  // 398 errors in 520 blocks: √398/520.
  for (const ReferenceEffect& row : rows)
    if (row.what == "errors in a nerve block, 398 in 520") {
      EXPECT_NEAR(standard_error(row).value_or(0.0), std::sqrt(398.0) / 520.0, 1e-12);
    }
  // Of 48 in 153 metrics.
  EXPECT_NEAR(standard_error(rows[4]).value_or(0.0), std::sqrt(48.0 / 153.0 * 105.0 / 153.0 / 153.0), 1e-12);
  const double odds = std::log(0.889 / 0.111) - std::log(0.764 / 0.236);
  EXPECT_NEAR(value_of("first pass with needle guidance, 76.4 and 88.9 %", "PMC5318157"),
              odds * std::sqrt(3.0) / 3.14159265358979, 1e-3);
}

// Normal statistics drawn and kept where significant: how many are, and how large they look.
TEST(ReferenceEffects, SelectionMakesAsMuchOfADifferenceAsItIsSaid) {
  for (const double truth : {0.0, 0.3, 0.8}) {
    const std::size_t n1 = 26, n2 = 14;
    const double root = difference_of_t(1.0, n1, n2), critical = statistics::student_t_quantile(0.975, 38);
    double kept = 0.0, size = 0.0;
    constexpr std::size_t kDrawn = 200'000;
    for (std::size_t i = 0; i < kDrawn; ++i) {
      const double z = truth / root + normal_of(stream_of(17, Drawn::answer, i));
      if (std::abs(z) <= critical) continue;
      kept += 1.0;
      size += std::abs(z) * root;
    }
    const Selected told = selected_of(truth, n1, n2);
    EXPECT_NEAR(kept / kDrawn, told.power, 4.0 * std::sqrt(told.power / kDrawn));
    EXPECT_NEAR(size / kept, told.mean_size, 4.0 * root / std::sqrt(kept));
  }
}

TEST(ReferenceEffects, WhatWasJustSignificantIsShrunkAndWhatWasPlainIsNot) {
  EXPECT_LT(unselected(0.68, 26, 14), 0.34);  // z of 2.05 against 2.02: less than half of it
  const double some = unselected(0.8244, 26, 14);
  EXPECT_GT(some, 0.1);
  EXPECT_LT(some, 0.8244);
  EXPECT_NEAR(unselected(2.5, 26, 14), 2.5, 0.01);
  EXPECT_EQ(unselected(-0.8244, 26, 14), -some);
  // It is a maximum: the likelihood given selection is less on both sides.
  const double root = difference_of_t(1.0, 26, 14), critical = statistics::student_t_quantile(0.975, 38);
  const auto likelihood = [&](double d) {
    const double delta = d / root;
    return -0.5 * std::pow(0.8244 / root - delta, 2) -
           std::log(statistics::normal_cdf(delta - critical) + statistics::normal_cdf(-delta - critical));
  };
  EXPECT_GE(likelihood(some), likelihood(some + 0.02));
  EXPECT_GE(likelihood(some), likelihood(some - 0.02));
}

TEST(Raters, AreAsSevereAndAsBlindedByTheWholeAsTheyArePlanted) {
  Rater mild, severe, halo;
  severe.severity = 1.0;
  mild.halo = severe.halo = 0.0;
  halo.halo = 1.0;
  mild.key = 1, severe.key = 2, halo.key = 3;
  double mild_sum = 0.0, severe_sum = 0.0, mild_gap = 0.0, halo_gap = 0.0;
  constexpr std::size_t kPeople = 5000;
  for (std::size_t number = 1; number <= kPeople; ++number) {
    const Person one = drawn_person(*named_group("intermediate"), 3, number);
    mild_sum += rating_of(mild, one, one.ability, 0, 0);
    severe_sum += rating_of(severe, one, one.ability, 0, 0);
    // An able hand with no conduct: items apart to whom looks at each.
    const Abilities uneven{2.0, 0.0, 0.0, -2.0};
    mild_gap += rating_of(mild, one, uneven, 2, 0) - rating_of(mild, one, uneven, 5, 0);
    halo_gap += rating_of(halo, one, uneven, 2, 0) - rating_of(halo, one, uneven, 5, 0);
  }
  EXPECT_NEAR((mild_sum - severe_sum) / kPeople, 1.0, 0.1);  // held to 1 to 5 at the ends
  EXPECT_GT(mild_gap / kPeople, 1.5);
  EXPECT_NEAR(halo_gap / kPeople, 0.0, 0.1);
  Rater drifting = mild;
  drifting.drift = 1.0;
  const Person one = drawn_person(*named_group("intermediate"), 3, 1);
  double early = 0.0, late = 0.0;
  for (std::uint64_t order = 0; order < 200; ++order) {
    early += rating_of(drifting, one, {1.0, 1.0, 1.0, 1.0}, 0, order % 10);
    late += rating_of(drifting, one, {1.0, 1.0, 1.0, 1.0}, 0, 100 + order % 10);
  }
  EXPECT_NEAR((early - late) / 200.0, 1.0, 0.3);
}

TEST(Questionnaire, AnswersHaveThePublishedMeans) {
  for (const char* group : {"novice", "expert"}) {
    std::vector<double> sum(statements().size());
    std::size_t asked = 0;
    for (std::size_t number = 1; number <= 4000; ++number) {
      const Person one = drawn_person(*named_group(group), 3, number);
      if ((one.years >= 7.0) != (std::string_view(group) == "expert")) continue;
      ++asked;
      for (std::size_t s = 0; s < sum.size(); ++s) {
        const int points = answer_of(one, s);
        EXPECT_TRUE(points >= 1 && points <= 5);
        sum[s] += points;
      }
    }
    for (std::size_t s = 0; s < sum.size(); ++s) {
      const Statement& one = statements()[s];
      const bool expert = std::string_view(group) == "expert";
      const double mean = expert ? one.expert_mean : one.trainee_mean, sd = expert ? one.expert_sd : one.trainee_sd;
      // Rounded and held to 1 to 5: the mean of the points by their shares of the normal distribution.
      double expected = 1.0;
      for (int points = 2; points <= 5; ++points) expected += statistics::normal_cdf((mean - (points - 0.5)) / sd);
      EXPECT_NEAR(sum[s] / static_cast<double>(asked), expected, 4.5 * sd / std::sqrt(static_cast<double>(asked)))
          << one.words;
      EXPECT_NEAR(expected, mean, 0.25) << one.words;
    }
  }
}

}  // namespace
}  // namespace seldinger::assessment::population
