// Where a learner stands: each rule at its edge, and the order in which the rules are asked.
#include "assessment/grading/standing.h"

#include <gmock/gmock.h>

namespace seldinger::assessment {
namespace {

constexpr std::int64_t kDay = kDay_us;
constexpr std::int64_t kNow = 20'000 * kDay;

GradedAttempt tried(Verdict verdict, std::int64_t days_ago, std::vector<std::string> missed = {}) {
  return {"id", kNow - days_ago * kDay, 60.0, verdict, std::move(missed)};
}

// Items as progress_of sees them, each after the one before it is passed.
std::vector<ItemRecord> records(const std::vector<std::vector<GradedAttempt>>& attempts,
                                std::optional<int> limit = std::nullopt) {
  std::vector<ItemPast> pasts;
  for (const auto& of_item : attempts) {
    ItemPast& past = pasts.emplace_back();
    for (const GradedAttempt& one : of_item) past.verdicts.push_back(one.verdict);
    past.limit = limit;
    past.begun = static_cast<int>(of_item.size());
    if (pasts.size() > 1) past.gates = {{pasts.size() - 2, Proficiency::passed}};
  }
  const auto progress = progress_of(pasts);
  std::vector<ItemRecord> all;
  for (std::size_t i = 0; i < attempts.size(); ++i) all.push_back({progress[i], attempts[i]});
  return all;
}

constexpr auto P = Verdict::passed, F = Verdict::failed, N = Verdict::not_gradable;

TEST(Standing, WhoHasDoneNothingHasNotStarted) {
  EXPECT_EQ(standing_of({}, kNow).standing, Standing::not_started);
  EXPECT_EQ(standing_of(records({{}, {}}), kNow).standing, Standing::not_started);
}

TEST(Standing, ReadyUntilTheOldestLastPassIsOlderThanTheRetentionTime) {
  const auto held_for = [](std::int64_t days) {
    return standing_of(records({{tried(P, days + 1), tried(P, days)}, {tried(P, 3), tried(P, 2)}}), kNow);
  };
  EXPECT_EQ(held_for(kRetentionDays).standing, Standing::ready);
  const StandingFound lapsed = held_for(kRetentionDays + 1);
  EXPECT_EQ(lapsed.standing, Standing::lapsed);
  EXPECT_EQ(lapsed.item, 0U);
  EXPECT_EQ(lapsed.last_us, kNow - (kRetentionDays + 1) * kDay);
  // A later pass renews it; a later miss does not.
  EXPECT_EQ(standing_of(records({{tried(P, 300), tried(P, 299), tried(P, 1)}}), kNow).standing, Standing::ready);
  EXPECT_EQ(standing_of(records({{tried(P, 300), tried(P, 299), tried(F, 1)}}), kNow).standing, Standing::lapsed);
}

TEST(Standing, AbsentFromTheFirstDayAfterFourWeeks) {
  EXPECT_EQ(standing_of(records({{tried(F, kAbsentAfterDays)}}), kNow).standing, Standing::under_way);
  const StandingFound absent = standing_of(records({{tried(F, 40), tried(F, kAbsentAfterDays + 1)}}), kNow);
  EXPECT_EQ(absent.standing, Standing::absent);
  EXPECT_EQ(absent.last_us, kNow - (kAbsentAfterDays + 1) * kDay);
}

TEST(Standing, StuckAfterFiveMissesRunningAtWhatIsDue) {
  std::vector<GradedAttempt> misses(kStuckAfter - 1, tried(F, 1, {"hit"}));
  EXPECT_EQ(standing_of(records({misses, {}}), kNow).standing, Standing::under_way);
  misses.push_back(tried(N, 1));  // what is not graded is no miss
  EXPECT_EQ(standing_of(records({misses, {}}), kNow).standing, Standing::under_way);
  misses.push_back(tried(F, 0, {"hit", "time_total"}));
  const StandingFound stuck = standing_of(records({misses, {}}), kNow);
  EXPECT_EQ(stuck.standing, Standing::stuck);
  EXPECT_EQ(stuck.item, 0U);
  EXPECT_EQ(stuck.misses, kStuckAfter);
  EXPECT_EQ(stuck.missed_most, "hit");
  EXPECT_EQ(stuck.missed_times, kStuckAfter);
  EXPECT_FALSE(stuck.no_attempts_left);
  misses.push_back(tried(P, 0));  // a pass ends the row
  EXPECT_EQ(standing_of(records({misses, {}}), kNow).standing, Standing::under_way);
}

TEST(Standing, StuckWithoutAttemptsLeft) {
  const StandingFound stuck = standing_of(records({{tried(F, 2, {"hit"}), tried(F, 1, {"hit"})}, {}}, 2), kNow);
  EXPECT_EQ(stuck.standing, Standing::stuck);
  EXPECT_TRUE(stuck.no_attempts_left);
  EXPECT_EQ(stuck.misses, 2);
}

TEST(Standing, NearlyIsOnePassRunningFromTheEnd) {
  const StandingFound nearly = standing_of(records({{tried(P, 3), tried(P, 2)}, {tried(P, 1)}}), kNow);
  EXPECT_EQ(nearly.standing, Standing::nearly);
  EXPECT_EQ(nearly.item, 1U);
  EXPECT_EQ(nearly.passes_missing, 1);
  // After a miss two are missing again.
  EXPECT_EQ(standing_of(records({{tried(P, 3), tried(P, 2)}, {tried(P, 1), tried(F, 0)}}), kNow).standing,
            Standing::under_way);
}

TEST(Standing, WhatIsMissedIsToldMostOftenFirst) {
  const auto missed =
      missed_in(std::vector{tried(F, 3, {"b"}), tried(F, 2, {"c", "b"}), tried(F, 1, {"c", "a"}), tried(P, 0)});
  ASSERT_EQ(missed.size(), 3U);
  EXPECT_EQ(missed[0].metric + missed[1].metric + missed[2].metric, "bca");
  EXPECT_EQ(missed[0].times, 2);
  EXPECT_EQ(missed[2].times, 1);
}

TEST(Standing, ProficientIsMadeByTheSecondOfTwoPassesRunning) {
  EXPECT_EQ(proficient_at(std::vector{P, F, P, N, P, F}), 4U) << "what is not graded breaks no run";
  EXPECT_FALSE(proficient_at(std::vector{P, F, P}).has_value());
}

TEST(Standing, NamesGoBothWaysAndEachHasARule) {
  for (const Standing one : kAllStandings) {
    EXPECT_EQ(standing_from(name_of(one)), one);
    EXPECT_FALSE(rule_of(one).empty());
  }
  EXPECT_FALSE(standing_from("Ready").has_value());
}

}  // namespace
}  // namespace seldinger::assessment
