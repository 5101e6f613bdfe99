// Simulated people against the population that they are drawn from: closed forms, and statistics with their own
// errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "assessment/population/group_json.h"
#include "assessment/population/person.h"
#include "assessment/population/streams.h"

namespace seldinger::assessment::population {
namespace {

constexpr std::size_t kCrowd = 20'000;

std::vector<OperatorProfile> profiles_of(const std::vector<Person>& people) {
  std::vector<OperatorProfile> profiles;
  for (const Person& one : people) profiles.push_back(profile_on(one, {}));
  return profiles;
}

std::vector<Person> people_of(const Group& group, std::size_t count = kCrowd) {
  std::vector<Person> people;
  for (std::size_t number = 1; number <= count; ++number) people.push_back(drawn_person(group, 7, number));
  return people;
}

double mean_of(const std::vector<double>& x) {
  double sum = 0.0;
  for (const double one : x) sum += one / static_cast<double>(x.size());
  return sum;
}

double correlation(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean_of(x), my = mean_of(y);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
  }
  return xy / std::sqrt(xx * yy);
}

TEST(Streams, AMillionKeysAreAllDifferent) {
  std::vector<std::uint64_t> keys;
  for (const char* group : {"novice", "expert"})
    for (std::uint64_t seed = 1; seed <= 5; ++seed)
      for (std::uint64_t person = 1; person <= 1000; ++person)
        for (std::uint64_t attempt = 0; attempt < 100; ++attempt) {
          Person one;
          one.key = person_key(seed, group, person);
          keys.push_back(attempt_seed(one, {11, attempt, 0.0}));
        }
  ASSERT_EQ(keys.size(), 1'000'000U);
  std::sort(keys.begin(), keys.end());
  EXPECT_EQ(std::adjacent_find(keys.begin(), keys.end()), keys.end());
  EXPECT_LT(keys.back(), 1ULL << 53U);
}

TEST(Streams, ANameIsNotTheBeginningOfAnother) {
  EXPECT_NE(person_key(1, "ab", 1), person_key(1, "a", 1));
  EXPECT_NE(person_key(1, "", 1), person_key(1, std::string_view("\0", 1), 1));
  EXPECT_NE(stream_of(1, Drawn::ability, 1, 2), stream_of(1, Drawn::ability, 2, 1));
}

// A mean of N standard normals has the error 1/√N, a correlation ρ has (1 − ρ²)/√N; five of each.
TEST(People, AbilitiesHaveThePlannedMeansAndCovariance) {
  const double error = 5.0 / std::sqrt(static_cast<double>(kCrowd));
  for (const double shift : {0.0, 0.8}) {
    std::array<std::vector<double>, kAbilities> ability;
    std::vector<double> strategy;
    for (const Person& one : people_of(shifted_group(shift))) {
      for (std::size_t a = 0; a < kAbilities; ++a) ability[a].push_back(one.ability[a]);
      strategy.push_back(one.strategy);
    }
    for (std::size_t a = 0; a < kAbilities; ++a) {
      EXPECT_NEAR(mean_of(ability[a]), shift, error);
      double square = 0.0;
      for (const double x : ability[a]) square += (x - shift) * (x - shift) / static_cast<double>(kCrowd);
      EXPECT_NEAR(square, 1.0, std::sqrt(2.0) * error);
      EXPECT_NEAR(correlation(ability[a], strategy), 0.0, error);
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_NEAR(correlation(ability[a], ability[b]), ability_correlation(a, b), 0.75 * error);
    }
  }
}

TEST(People, TheSameNumberOfTwoGroupsIsNobodysTwin) {
  const auto novices = profiles_of(people_of(*named_group("novice"), 5000)),
             experts = profiles_of(people_of(*named_group("expert"), 5000));
  for (const SkillRow& row : skill_rows()) {
    std::vector<double> a, b;
    for (std::size_t i = 0; i < novices.size(); ++i) {
      a.push_back(novices[i].*row.value);
      b.push_back(experts[i].*row.value);
    }
    EXPECT_LT(std::abs(correlation(a, b)), 0.06);
  }
}

// ln s of one whose only parts are normal: its difference between groups is the loadings' sum times the shift.
TEST(People, SkillsMoveByTheirLoadingsAndNoMore) {
  const auto novices = profiles_of(people_of(*named_group("novice"), 10'000)),
             experts = profiles_of(people_of(*named_group("expert"), 10'000));
  std::size_t telling = 0;
  for (const SkillRow& row : skill_rows()) {
    double loading = 0.0, variance = 0.0;
    for (std::size_t a = 0; a < kAbilities; ++a) {
      loading += row.loading[a];
      for (std::size_t b = 0; b < kAbilities; ++b)
        variance += row.loading[a] * row.loading[b] * ability_correlation(a, b);
    }
    telling += loading == 0.0 ? 0U : 1U;
    const bool is_share = row.own_sd > 0.5;  // a logit's
    const auto score = [&](const OperatorProfile& one) {
      const double value = one.*row.value;
      EXPECT_GT(value, 0.0);
      EXPECT_TRUE(!is_share || value < 1.0);
      return is_share ? std::log(value / (1.0 - value)) : std::log(value);
    };
    // Medians: a lapse moves one in twenty of each group alike.
    std::vector<double> a, b;
    for (const OperatorProfile& one : novices) a.push_back(score(one));
    for (const OperatorProfile& one : experts) b.push_back(score(one));
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    const double sd = std::sqrt(variance + row.strategy * row.strategy + row.own_sd * row.own_sd +
                                row.case_sd * row.case_sd + row.occasion_sd * row.occasion_sd);
    // An error of a median is 1.2533 sd/√n.
    EXPECT_NEAR(b[b.size() / 2] - a[a.size() / 2], 1.2 * loading,
                5.0 * 1.2533 * sd * std::sqrt(2.0 / static_cast<double>(a.size())));
  }
  EXPECT_EQ(skill_rows().size(), skill_fields().size() - 3U);  // all but the three that are the same in all people
  EXPECT_GE(skill_rows().size() - telling, skill_rows().size() / 5U);
}

TEST(People, ThePersonsOwnPartStaysAndTheOccasionsDoesNot) {
  const Person one = drawn_person(*named_group("novice"), 1, 1);
  EXPECT_EQ(profile_on(one, {5, 3, 0.0}).sway_mm, profile_on(one, {5, 3, 0.0}).sway_mm);
  EXPECT_NE(profile_on(one, {5, 3, 0.0}).sway_mm, profile_on(one, {5, 4, 0.0}).sway_mm);
  std::vector<double> here, again, elsewhere;
  for (const Person& other : people_of(*named_group("novice"), 4000)) {
    here.push_back(std::log(profile_on(other, {5, 0, 0.0}).tremor_mm));
    again.push_back(std::log(profile_on(other, {5, 1, 0.0}).tremor_mm));
    elsewhere.push_back(std::log(profile_on(other, {6, 0, 0.0}).tremor_mm));
  }
  // Tremor loads on nothing: .35², .3² and .25² of own, case and occasion.
  const double all = 0.1225 + 0.09 + 0.0625, error = 5.0 / std::sqrt(4000.0);
  EXPECT_NEAR(correlation(here, again), (0.1225 + 0.09) / all, error);
  EXPECT_NEAR(correlation(here, elsewhere), 0.1225 / all, error);
}

TEST(Practice, GainsByItsRateAndLosesByHalves) {
  const Practice practice{std::log(2.0), 1.0, 30.0, 0.0};  // each attempt takes half of what is left
  EXPECT_EQ(gain_of(practice, {}, 10.0), 0.0);
  const double same_day[] = {0.0, 0.0, 0.0};
  EXPECT_NEAR(gain_of(practice, same_day, 0.0), 0.875, 1e-12);
  EXPECT_NEAR(gain_of(practice, same_day, 30.0), 0.4375, 1e-12);
  const double apart[] = {0.0, 30.0};
  EXPECT_NEAR(gain_of(practice, apart, 30.0), 0.25 + (1.0 - 0.25) / 2.0, 1e-12);
}

TEST(Practice, SomeDoNotLearnSomeLapseAndSomeLeave) {
  std::size_t still = 0, lapses = 0, gone_able = 0, gone_unable = 0, able = 0, unable = 0;
  for (const Person& one : people_of(*named_group("novice"))) {
    still += one.practice.ceiling == 0.0 ? 1U : 0U;
    lapses += ability_on(one, {3, 0, 0.0}) != one.ability ? 1U : 0U;
    double mean = 0.0;
    for (const double x : one.ability) mean += x / 4.0;
    (mean > 0.0 ? able : unable) += 1U;
    if (!comes_to(one, 3)) (mean > 0.0 ? gone_able : gone_unable) += 1U;
    EXPECT_TRUE(comes_to(one, 0));
    EXPECT_TRUE(!comes_to(one, 3) || comes_to(one, 2));
  }
  const auto share = [](std::size_t part, std::size_t of) {
    return static_cast<double>(part) / static_cast<double>(of);
  };
  const auto error = [](double p) { return 5.0 * std::sqrt(p * (1.0 - p) / static_cast<double>(kCrowd)); };
  EXPECT_NEAR(share(still, kCrowd), 1.0 / 12.0, error(1.0 / 12.0));
  EXPECT_NEAR(share(lapses, kCrowd), 0.05, error(0.05));
  EXPECT_GT(share(gone_unable, unable), share(gone_able, able) + 0.01);  // missing by ability, as planted
}

TEST(Practice, DevicesAreLostAtRandom) {
  for (const char* group : {"novice", "expert"}) {
    std::size_t lost = 0;
    for (const Person& one : people_of(*named_group(group))) {
      const Mishaps mishaps = mishaps_on(one, {2, 0, 0.0});
      lost += mishaps.device_lost_s ? 1U : 0U;
      EXPECT_GT(mishaps.patience_s, 60.0);
    }
    EXPECT_NEAR(static_cast<double>(lost) / kCrowd, 0.01, 5.0 * std::sqrt(0.01 / kCrowd));
  }
}

TEST(Groups, AreReadFromAFileOrRefused) {
  const auto group = group_from_json(R"({"name": "third year", "shift": {"spatial": 0.5}, "middle_years": 3})");
  ASSERT_TRUE(group.has_value());
  EXPECT_EQ(group->shift, (Abilities{0.0, 0.5, 0.0, 0.0}));
  EXPECT_TRUE(is_group_json(R"({"shift": 0.8})"));
  EXPECT_FALSE(is_group_json(R"({"tremor_mm": 0.8})"));
  for (const char* bad :
       {"[]", "{", R"({"shift": 1})", R"({"name": "a", "shift": "much"})", R"({"name": "a", "shift": 1e9})",
        R"({"name": "a", "shift": {"luck": 1}})", R"({"name": "person", "shift": 0})",
        R"({"name": "novice", "shift": 0})", R"({"name": "a", "shift": 0, "sway_mm": 1})",
        R"({"name": "a", "shift": 0, "middle_years": 0})"}) {
    const auto refused = group_from_json(bad);
    ASSERT_FALSE(refused.has_value()) << bad;
    EXPECT_EQ(refused.error().code, "bad_operator");
  }
}

}  // namespace
}  // namespace seldinger::assessment::population
