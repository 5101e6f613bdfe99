// A surrogate against attempts of a known law: that it keeps what they are, follows abilities as they do, and is
// refused for anything else.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <vector>

#include "assessment/population/agreement.h"
#include "assessment/population/streams.h"
#include "assessment/population/surrogate.h"
#include "assessment/registry.h"
#include "tests/assessment/population/known_attempts.h"

namespace seldinger::assessment::population {
namespace {

TEST(Surrogate, AgreesWithAttemptsThatItDoesNotKnow) {
  for (const double shift : {0.0, 1.2}) {
    const auto agreement = agreement_of(fitted(), attempts_of({shift}, 77, 1000), 20, 3);
    EXPECT_EQ(agreement.metrics.size(), 4U);
    EXPECT_EQ(agreement.pairs, 3U) << "one is the same in all";
    EXPECT_EQ(agreement.beyond_chance.quantiles, 0U);
    EXPECT_LT(agreement.quantile_own_sd, 0.06);
    EXPECT_LT(agreement.rank_correlation_own, 0.05);
    EXPECT_EQ(agreement.beyond_chance.shares, 0U);
    EXPECT_EQ(agreement.off.pairs, 0U) << agreement.worst_pair << agreement.worst_rank_correlation;
    // Shares of nulls and of zeros of four metrics, three quantiles of three of them, three pairs.
    EXPECT_EQ(agreement.comparisons, 4U * 2U + 3U * 3U + 3U);
    EXPECT_LT(agreement.furthest_errors, 3.0);
  }
}

// Of sixty attempts chance takes quantiles beyond .1 SD and correlations beyond .1 whatever the surrogate is:
// what is found of a right one is no more than that.
TEST(Surrogate, WhatChanceTakesBeyondTheBoundsIsTold) {
  const auto few = agreement_of(fitted(), attempts_of({0.0}, 77, 60), 20, 3);
  EXPECT_GE(few.off_without_fault.quantiles, 1U);
  EXPECT_GE(few.most_off_without_fault.pairs, 1U);
  EXPECT_LE(few.off.quantiles, few.most_off_without_fault.quantiles);
  EXPECT_LE(few.off.pairs, few.most_off_without_fault.pairs);
  EXPECT_LE(few.off.shares, few.most_off_without_fault.shares);
}

// Of a tracking rate that is 100 Hz in all but its last digits, nothing is a difference.
TEST(Surrogate, WhatRoundingAloneMakesDifferIsOneValue) {
  const auto with_rate = [](std::vector<SimulatedPoint> points) {
    for (std::size_t p = 0; p < points.size(); ++p)
      for (std::size_t m = 0; m < points[p].values.size(); ++m)
        if (known_mark().metrics[m].id == "sample_rate_p5")
          points[p].values[m] = 100.0 - 1e-11 * double(p % 7 * p % 5);
    return points;
  };
  const auto all = with_rate(attempts_of({-0.6, 0.0, 0.6, 1.2, 1.8}, 1, 2000));
  const auto surrogate = Surrogate::fit(known_mark(), all);
  ASSERT_TRUE(surrogate);
  const auto less = with_rate(attempts_of({0.0}, 77, 300)), more = with_rate(attempts_of({1.2}, 78, 300));
  const auto agreement = agreement_of(*surrogate, more, 20, 3);
  EXPECT_EQ(agreement.metrics.size(), 5U);
  EXPECT_EQ(agreement.pairs, 3U) << "no pair is with what is the same in all";
  for (const EffectAgreement& one : effects_of(*surrogate, less, more, 20, 3))
    EXPECT_NE(one.metric, "sample_rate_p5");
  Values values{100.0 - 2e-10, 0.0, std::nullopt, -1.23456789012e-3, 1e300, 1e-310, 1.7976931348623157e308};
  drop_rounding(values);
  EXPECT_EQ(*values[0], 100.0);
  EXPECT_EQ(*values[3], -1.23456789e-3);
  EXPECT_EQ(values[1], 0.0);
  EXPECT_FALSE(values[2]);
  EXPECT_TRUE(std::isfinite(*values[4]));
  EXPECT_GT(*values[5], 0.0);
  EXPECT_TRUE(std::isfinite(*values[6]));
  Values again = values;
  drop_rounding(again);
  EXPECT_EQ(again, values);
}

TEST(Surrogate, AttemptsThatItWasFittedToAreKnownAgain) {
  std::vector<SimulatedPoint> some = attempts_of({0.0, 1.2}, 77, 50);
  EXPECT_FALSE(was_fitted_to(fitted(), some));
  some.push_back(fitted().attempts()[1234]);
  EXPECT_TRUE(was_fitted_to(fitted(), some));
}

// Parts may overlap, and a part that was made by other laws is no part.
TEST(Surrogate, PartsAddUpToWhatAllOfThemAre) {
  const std::vector<SimulatedPoint> all = attempts_of({0.0, 1.2}, 77, 90);
  std::vector<SimulatedPoint> added;
  EXPECT_TRUE(add_once({all.begin(), all.begin() + 50}, added));
  EXPECT_TRUE(add_once({all.begin() + 20, all.end()}, added));
  ASSERT_EQ(added.size(), all.size());
  for (std::size_t p = 0; p < all.size(); ++p) EXPECT_EQ(added[p].values, all[p].values);
  std::vector<SimulatedPoint> other = {all[7]};
  other[0].values[known_mark().metrics.size() - 1] = 123.0;
  EXPECT_FALSE(add_once(other, added));
}

TEST(Surrogate, AWrongOneIsFoundOut) {
  // Of attempts in which ability does the opposite.
  std::vector<SimulatedPoint> points = attempts_of({0.0, 1.2}, 1, 2000);
  for (SimulatedPoint& one : points) one.place[1] = 1.2 - one.place[1];
  const auto wrong = Surrogate::fit(known_mark(), points);
  const auto agreement = agreement_of(*wrong, attempts_of({1.8}, 77, 1000), 20, 3);
  EXPECT_GT(agreement.beyond_chance.quantiles, 0U);
  EXPECT_GT(agreement.furthest_errors, 5.0);
  EXPECT_GT(agreement.quantile_own_sd, 0.1);
  EXPECT_GT(agreement.off.quantiles, agreement.most_off_without_fault.quantiles) << "not by chance";
}

// What groups differ by, in 300 attempts of each that it does not know; and the same of the other way round is
// found out.
TEST(Surrogate, GroupsDifferAsTheirWholeAttemptsDo) {
  const auto less = attempts_of({0.0}, 78, 300), more = attempts_of({0.8}, 79, 300);
  const auto effects = effects_of(fitted(), less, more, 20, 3);
  ASSERT_EQ(effects.size(), 3U) << "one is the same in all";
  for (const EffectAgreement& one : effects) {
    EXPECT_LT(std::abs(one.area_drawn - one.area), 3.0 * one.area_error) << one.metric;
    EXPECT_LT(std::abs(one.d_drawn - one.d), 3.0 * one.d_error) << one.metric;
    EXPECT_LT(std::abs(one.pairs), 0.2) << one.metric;  // of people of other seeds, 3.4 errors
  }
  const auto distance = std::find_if(effects.begin(), effects.end(),
                                     [](const EffectAgreement& one) { return one.metric == "tip_target_dist"; });
  ASSERT_NE(distance, effects.end());
  EXPECT_LT(distance->d_drawn, 0.0) << "the able are nearer";
  EXPECT_NEAR(distance->d_error, std::sqrt(2.0 / 270.0), 0.01);
  // A surrogate whose people do the opposite draws the opposite difference.
  std::vector<SimulatedPoint> points = attempts_of({0.0, 1.2}, 1, 2000);
  for (SimulatedPoint& one : points) one.place[1] = 1.2 - one.place[1];
  const auto wrong = Surrogate::fit(known_mark(), points);
  for (const EffectAgreement& one : effects_of(*wrong, less, more, 20, 3)) {
    if (one.metric != "tip_target_dist") continue;
    EXPECT_GT(one.area_drawn - one.area, 3.0 * one.area_error);
    EXPECT_GT(one.d_drawn - one.d, 3.0 * one.d_error);
  }
}

// 48 and 52 of 100 are 1, the others 0: plain medians are a whole unit apart, those of grouped data .04 / .5.
TEST(Surrogate, AShareThatPassesAMarkIsNoJump) {
  const auto held = [](std::size_t ones) {
    std::vector<SimulatedPoint> points = attempts_of({0.0}, 1, 100);
    for (std::size_t p = 0; p < points.size(); ++p)
      for (std::size_t m = 0; m < points[p].values.size(); ++m)
        points[p].values[m] = known_mark().metrics[m].id == "withdrawals_full"
                                  ? std::optional<double>(p * 37 % 100 < ones ? 1.0 : 0.0)
                                  : std::nullopt;
    return points;
  };
  const auto surrogate = Surrogate::fit(known_mark(), held(48));
  const auto agreement = agreement_of(*surrogate, held(52), 200, 3);
  ASSERT_EQ(agreement.metrics.size(), 1U);
  EXPECT_LT(std::abs(agreement.metrics[0].quantile_sd), 0.35)
      << "of an SD of .5, with what draws are off by chance";
  EXPECT_GT(agreement.metrics[0].quantile_error_sd, 0.05);
  EXPECT_LT(agreement.quantile_own_sd, 0.2);
}

// Between two kinds of attempts lies nothing: whether 8 or 12 of 100 are of the rarer one moves the quantile of 90
// % from one kind to the other, and is chance all the same; 30 are not.
TEST(Surrogate, AGapBesideAQuantileIsNoFault) {
  const auto held = [](std::size_t of_100, std::size_t count) {
    std::vector<SimulatedPoint> points = attempts_of({0.0}, 1, count);
    for (std::size_t p = 0; p < points.size(); ++p)
      for (std::size_t m = 0; m < points[p].values.size(); ++m)
        points[p].values[m] =
            known_mark().metrics[m].id == "time_total"
                ? std::optional((p * 37 % 100 < of_100 ? 260.0 : 60.0) + 0.01 * static_cast<double>(p % 97))
                : std::nullopt;
    return points;
  };
  const auto checked = [&](std::size_t of_100) {
    return agreement_of(*Surrogate::fit(known_mark(), held(of_100, 1000)), held(8, 500), 20, 3);
  };
  const auto right = checked(12), wrong = checked(30);
  EXPECT_GT(right.metrics.at(0).quantile_sd, 2.0) << "from one kind to the other";
  // Of the share of .9 where .88 and .7 were to be: 2 √500 (asin √.9 − asin √.88), with √500/√10000 of it by
  // chance.
  EXPECT_NEAR(right.metrics.at(0).quantile_errors, 1.43, 0.9);
  EXPECT_EQ(right.beyond_chance.quantiles, 0U);
  EXPECT_NEAR(wrong.metrics.at(0).quantile_errors, 11.5, 0.9);
  EXPECT_GT(wrong.furthest_errors, 8.0);
}

// E ln distance is .5 − .4 E θ: between the shifts it falls by .4 times the shift.
TEST(Surrogate, FollowsAbilityByTheRightAmount) {
  const std::size_t distance = fitted().index_of("tip_target_dist");
  std::map<double, double> mean;
  constexpr std::size_t kPeople = 20'000;
  for (const double shift : {0.0, 0.8}) {
    double sum = 0.0, count = 0.0;
    for (std::size_t number = 1; number <= kPeople; ++number) {
      const auto values = fitted().draw(drawn_person(shifted_group(shift), 5, number), {5, 0, 0.0});
      if (!values[distance]) continue;
      sum += std::log(*values[distance]);
      count += 1.0;
    }
    EXPECT_NEAR(count / kPeople, 1.0 - kNullShare, 0.03);
    mean[shift] = sum / count;
  }
  // One attempt's ln has the SD √(.16 + .36) = .72; the fit's slope, of 1,800 points with θ of SD 1.3, an error of
  // .013.
  EXPECT_NEAR(mean[0.8] - mean[0.0], -0.32, 3.0 * std::hypot(0.72 * std::sqrt(2.0 / 18'000.0), 0.8 * 0.013));
}

// Attempts of kinds: who draws back n times goes 60 + 110 n mm, give or take 4. The able draw back less. Were
// counts moved apart from ways, the rank correlation of the two would be .06 too small.
TEST(Surrogate, KindsOfAttemptsStayKinds) {
  const SurrogateMark mark = known_mark();
  const auto of_kinds = [&](const std::vector<double>& shifts, std::uint64_t seed, std::size_t count) {
    std::vector<SimulatedPoint> points = attempts_of(shifts, seed, count);
    for (std::size_t p = 0; p < points.size(); ++p) {
      const auto drawn = [&](std::uint64_t what) { return stream_of(seed, Drawn::attempt, p, what); };
      const double mean = std::exp(-0.4 * points[p].place[1]);
      double n = 0.0;  // Poisson's, by the time that lies between two
      for (double t = -std::log(uniform_of(drawn(0))); t < mean && n < 9.0; n += 1.0)
        t -= std::log(uniform_of(drawn(1 + static_cast<std::uint64_t>(n))));
      for (std::size_t m = 0; m < mark.metrics.size(); ++m) {
        points[p].values[m].reset();
        if (mark.metrics[m].id == "withdrawals_partial") points[p].values[m] = n;
        if (mark.metrics[m].id == "path_in_tissue")
          points[p].values[m] = 60.0 + 110.0 * n + 4.0 * normal_of(drawn(99));
      }
    }
    return points;
  };
  const auto surrogate = Surrogate::fit(mark, of_kinds({-0.6, 0.0, 0.6, 1.2, 1.8}, 1, 3000));
  const std::size_t count = surrogate->index_of("withdrawals_partial");
  for (const double shift : {0.0, 1.2}) {
    const auto held_out = of_kinds({shift}, 77, 1000);
    const auto agreement = agreement_of(*surrogate, held_out, 5, 3);
    EXPECT_EQ(agreement.pairs, 1U);
    EXPECT_LT(agreement.worst_rank_correlation, 0.03) << shift;
    EXPECT_EQ(agreement.beyond_chance.quantiles, 0U) << shift;
    double whole = 0.0, drawn = 0.0;
    for (std::size_t p = 0; p < held_out.size(); ++p) {
      const Values values = surrogate->draw(held_out[p].place, stream_of(9, Drawn::surrogate, p));
      whole += *held_out[p].values[count];
      drawn += *values[count];
    }
    const auto n = static_cast<double>(held_out.size());
    // Three errors of 1,000 whole and drawn ones, and of the 3,000, with a variance of about .8.
    EXPECT_NEAR(drawn / n, whole / n, 0.13) << shift;
  }
}

TEST(Surrogate, PeopleOfTwoGroupsAreNobodysTwins) {
  const std::size_t distance = fitted().index_of("tip_target_dist"), time = fitted().index_of("time_total");
  for (const std::size_t metric : {distance, time}) {
    double x = 0, y = 0, xx = 0, yy = 0, xy = 0, n = 0;
    for (std::size_t number = 1; number <= 5000; ++number) {
      const auto a = fitted().draw(drawn_person(shifted_group(0.0), 5, number), {5, 0, 0.0})[metric];
      const auto b = fitted().draw(drawn_person(shifted_group(0.8), 5, number), {5, 0, 0.0})[metric];
      if (!a || !b) continue;
      x += *a, y += *b, xx += *a * *a, yy += *b * *b, xy += *a * *b, n += 1;
    }
    EXPECT_LT(std::abs((xy - x * y / n) / std::sqrt((xx - x * x / n) * (yy - y * y / n))), 0.06);
  }
}

TEST(Surrogate, AttemptsOfOnePersonAreAlike) {
  const std::size_t time = fitted().index_of("time_total");
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0, n = 0;
  for (std::size_t number = 1; number <= 5000; ++number) {
    const Person one = drawn_person(shifted_group(0.0), 5, number);
    const auto a = fitted().draw(one, {5, 0, 0.0})[time], b = fitted().draw(one, {5, 1, 0.0})[time];
    if (!a || !b) continue;
    x += *a, y += *b, xx += *a * *a, yy += *b * *b, xy += *a * *b, n += 1;
  }
  // With .16 of both attempts the person's own leftover is the same; strategy adds to that.
  EXPECT_GT((xy - x * y / n) / std::sqrt((xx - x * x / n) * (yy - y * y / n)), 0.16);
}

TEST(Surrogate, CountsStayCountsAndNothingIsBeyondWhatWasSeen) {
  const std::size_t count = fitted().index_of("withdrawals_full"), distance = fitted().index_of("tip_target_dist");
  double most = 0.0;
  for (const SimulatedPoint& one : fitted().attempts()) most = std::max(most, one.values[distance].value_or(0.0));
  for (std::uint64_t i = 0; i < 2000; ++i) {
    Place place{};
    place.fill(i % 2 == 0 ? 9.0 : -9.0);  // where nobody was
    const auto values = fitted().draw(place, stream_of(1, Drawn::surrogate, i));
    EXPECT_TRUE(!values[count] || *values[count] == 0.0 || *values[count] == 1.0);
    EXPECT_LE(values[distance].value_or(0.0), most);
  }
}

TEST(Surrogate, ItsFileDrawsTheSame) {
  const auto again = Surrogate::from_json(fitted().to_json());
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->mark(), fitted().mark());
  for (std::uint64_t i = 0; i < 100; ++i) EXPECT_EQ(again->draw({}, i), fitted().draw({}, i));
}

TEST(Surrogate, AFileOfSomethingElseIsRefused) {
  const std::string good = fitted().to_json();
  for (
      const std::string& bad :
      {std::string("[]"), std::string("{"), std::string(R"({"surrogate": 1})"), good.substr(0, good.size() / 2),
       std::string(
           R"({"surrogate":1,"people_version":1,"operator_version":1,"step_version":1,"case_id":"c","case":"a","case_mark":"b",)") +
           R"("metrics":[["hit",1]],"attempts":[[0,0,0,0,0,1]]})"}) {
    const auto refused = Surrogate::from_json(bad);
    ASSERT_FALSE(refused.has_value()) << bad.substr(0, 80);
    EXPECT_EQ(refused.error().code, "bad_surrogate");
  }
}

TEST(Surrogate, AnyDifferenceOfItsMarkIsTold) {
  const SurrogateMark mark = known_mark();
  EXPECT_EQ(difference(mark, mark), "");
  EXPECT_EQ(mark.metrics.size(), registry().size());
  SurrogateMark other = mark;
  ++other.metrics.back().version;
  EXPECT_NE(difference(mark, other), "");
  other = mark;
  other.metrics.pop_back();
  EXPECT_NE(difference(mark, other), "");
  EXPECT_NE(difference(other, mark), "");
  EXPECT_NE(difference(mark, mark_of_today(kStep + 1, "case-1", "Ball", "x")), "");
  EXPECT_NE(difference(mark, mark_of_today(kStep, "case-1", "Ball", "y")), "");
  // At a case of an older law of sight what is told by sight is of its version.
  other = mark_of_today(kStep, "case-1", "Ball", "x", cases::SightLaw::echo);
  EXPECT_NE(difference(mark, other), "");
  const std::size_t sight = fitted().index_of("vis_joint");
  EXPECT_EQ(other.metrics.at(sight).version, mark.metrics.at(sight).version - 4);
  other = mark;
  ++other.people_version;
  EXPECT_NE(difference(mark, other), "");
  other = mark;
  ++other.operator_version;
  EXPECT_NE(difference(mark, other), "");
}

}  // namespace
}  // namespace seldinger::assessment::population
