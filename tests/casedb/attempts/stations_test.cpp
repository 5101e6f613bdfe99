// What is told of workstations, against attempts whose sums are worked out here.
#include "casedb/attempts/stations.h"

#include <gtest/gtest.h>

#include <cmath>

#include "casedb/attempts/attempts.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

TEST(StationName, IsShortAndPlain) {
  for (const char* good : {"this computer", "A", "Lab 2", "US-1_b.c", "0123456789012345678901234567890123456789"})
    EXPECT_TRUE(check_station_name(good)) << good;
  for (const char* bad : {"", " ", " Lab", "Lab ", "-", "Lab\n2", "Lab/2", "<b>", "Bär", "Lab,2",
                          "01234567890123456789012345678901234567890"}) {
    const auto checked = check_station_name(bad);
    ASSERT_FALSE(checked) << bad;
    EXPECT_EQ(checked.error().code, "bad_station_name");
  }
  EXPECT_TRUE(check_station_name(kUnnamedStation));
}

class StationsTest : public testing::Test {
 protected:
  std::string add(const std::string& person_id, const std::optional<std::string>& station, double duration_s,
                  std::optional<double> target_mm, std::int64_t started_us) {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.operator_name = operator_name_;
    made.person_id = person_id;
    made.duration_s = duration_s;
    made.started_us = started_us;
    made.conditions.station = station;
    made.metrics.clear();
    if (target_mm) {
      made.metrics.push_back({"hit", 1, 0.0, "bool", ""});
      made.metrics.push_back({"hit", 3, *target_mm < 3.0 ? 1.0 : 0.0, "bool", ""});
      made.metrics.push_back({"tip_target_dist", 1, *target_mm, "mm", ""});
    }
    made.servo = servo_;
    return add_attempt(library_, made).value();
  }
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  std::string ann_ = add_user(library_, "ann", Role::trainee, "correct horse battery").value();
  std::string bob_ = add_user(library_, "bob", Role::trainee, "correct horse battery").value();
  std::string other_ = add_user(library_, "other", Role::trainee, "correct horse battery").value();
  std::optional<cases::ServoRecord> servo_;
  std::string operator_name_{kPersonOperator};
};

constexpr std::int64_t kDay = 86'400'000'000;

TEST_F(StationsTest, SumsWhatSomePeopleDidAtEach) {
  add(ann_, "Lab 1", 30.0, 2.0, 10 * kDay);
  add(ann_, "Lab 1", 60.5, 5.0, 10 * kDay + 1);
  add(bob_, "Lab 1", 9.5, std::nullopt, 12 * kDay);
  add(bob_, "Lab 2", 20.0, 1.0, 13 * kDay);
  add(bob_, std::nullopt, 40.0, 1.0, 5 * kDay);
  add(other_, "Lab 1", 1000.0, 0.1, 14 * kDay);
  const auto use = list_station_use(library_, {ann_, bob_});
  ASSERT_EQ(use.size(), 3U);
  EXPECT_EQ(use[0].station, "") << "not recorded";
  EXPECT_EQ(use[1].station, "Lab 1");
  EXPECT_EQ(use[2].station, "Lab 2");
  EXPECT_EQ(use[1].attempts, 3U) << "without somebody else's";
  EXPECT_EQ(use[1].people, 2U);
  EXPECT_EQ(use[1].days, 2U);
  for (const StationUse& one : use) EXPECT_FALSE(one.simulated);
  EXPECT_DOUBLE_EQ(use[1].duration_s, 100.0);
  EXPECT_EQ(use[1].last_us, 12 * kDay);
  ASSERT_EQ(use[1].results.size(), 3U);
  EXPECT_FALSE(use[1].results[0].target_mm) << "the newest, which came to no endpoint";
  EXPECT_EQ(use[1].results[1].target_mm, 5.0);
  EXPECT_FALSE(use[1].results[0].hit) << "neither hit nor missed";
  EXPECT_EQ(use[1].results[1].hit, false);
  EXPECT_EQ(use[1].results[2].hit, true) << "by the newest version of hit";
  EXPECT_EQ(list_station_use(library_, {other_}).size(), 1U);
  EXPECT_TRUE(list_station_use(library_, {}).empty());
}

TEST_F(StationsTest, WhatIsSimulatedIsCountedApart) {
  add(ann_, "Lab 1", 30.0, 5.0, 10 * kDay);
  operator_name_ = "novice";
  for (int i = 0; i < kStationResults + 1; ++i) add(bob_, "Lab 1", 10.0, 1.0, 20 * kDay + i);
  add(ann_, "Lab 1", 10.0, 1.0, 22 * kDay);
  add(bob_, std::nullopt, 10.0, 1.0, 22 * kDay);
  const auto use = list_station_use(library_, {ann_, bob_});
  ASSERT_EQ(use.size(), 3U);
  EXPECT_EQ(use[0].station, "");
  EXPECT_TRUE(use[0].simulated) << "nobody sat where it was not recorded";
  EXPECT_FALSE(use[1].simulated);
  EXPECT_EQ(use[1].attempts, 1U);
  EXPECT_EQ(use[1].people, 1U);
  EXPECT_DOUBLE_EQ(use[1].duration_s, 30.0);
  EXPECT_EQ(use[1].last_us, 10 * kDay);
  ASSERT_EQ(use[1].results.size(), 1U) << "newer simulated ones push nobody's out";
  EXPECT_EQ(use[1].results[0].target_mm, 5.0);
  EXPECT_EQ(use[2].station, "Lab 1");
  EXPECT_TRUE(use[2].simulated);
  EXPECT_EQ(use[2].attempts, static_cast<std::size_t>(kStationResults) + 2);
  EXPECT_EQ(use[2].people, 2U);
  EXPECT_EQ(use[2].days, 2U);
  EXPECT_EQ(use[2].results.size(), static_cast<std::size_t>(kStationResults));
}

TEST_F(StationsTest, TimingIsThatOfAllItsAttemptsInRealTime) {
  add(ann_, "Lab 1", 30.0, 2.0, 1);
  servo_.emplace();
  servo_->ticks = 900;
  servo_->missed = 100;
  for (int i = 0; i < 900; ++i) servo_->latency.add(5'000);
  add(ann_, "Lab 1", 30.0, 2.0, 2);
  servo_->scheduler = cases::ServoScheduler::fifo;
  servo_->missed = 0;
  servo_->latency = {};
  for (int i = 0; i < 900; ++i) servo_->latency.add(50'000);
  add(bob_, "Lab 1", 30.0, 2.0, 3);
  add(bob_, "Lab 2", 30.0, 2.0, 3);
  const auto timing = list_station_timing(library_);
  ASSERT_EQ(timing.size(), 2U);
  EXPECT_EQ(timing[0].station, "Lab 1");
  EXPECT_EQ(timing[0].ticks, 1800U);
  EXPECT_EQ(timing[0].missed, 100U);
  EXPECT_TRUE(timing[0].real_time) << "as the newest ran";
  EXPECT_EQ(timing[0].latency.n, 1800U);
  EXPECT_EQ(timing[0].latency.most_ns, 50'000U);
  EXPECT_LT(timing[0].latency.quantile_ns(0.49), 6'000U);
  EXPECT_GT(timing[0].latency.quantile_ns(0.51), 40'000U);
  EXPECT_EQ(timing[1].latency.n, 900U);
  EXPECT_TRUE(timing[1].window_hz.empty()) << "they were in no window";
}

TEST_F(StationsTest, PicturesAreToldByHowTheyWereMade) {
  servo_.emplace();
  for (const auto& [simplified, rate] : {std::pair{false, 20.0}, {false, 22.0}, {true, 55.0}}) {
    NewAttempt made = sample_attempt(case_id_, lesion_id_);
    made.operator_name = kPersonOperator;
    made.servo = servo_;
    made.conditions.station = "Lab 1";
    made.conditions.window_rate_hz = 60.0;
    made.conditions.picture_rate_hz = rate;
    made.conditions.picture_method = "scatterers, CPU";
    made.conditions.speckle_fallback = simplified;
    ASSERT_TRUE(add_attempt(library_, made));
  }
  const auto timing = list_station_timing(library_);
  ASSERT_EQ(timing.size(), 1U);
  EXPECT_EQ(timing[0].window_hz, (std::vector<double>{60.0, 60.0, 60.0}));
  ASSERT_EQ(timing[0].pictures.size(), 2U);
  EXPECT_FALSE(timing[0].pictures[0].simplified);
  EXPECT_EQ(timing[0].pictures[0].shown_hz.size(), 2U);
  EXPECT_EQ(timing[0].pictures[1].shown_hz, std::vector<double>{55.0});
}

}  // namespace
}  // namespace seldinger::casedb
