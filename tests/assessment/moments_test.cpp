// Telling moments of a needle whose way is known: where each must be, which are left out, and that there are
// enough.
#include "assessment/moments.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assessment/registry.h"
#include "tests/assessment/metrics/sample_attempts.h"

namespace seldinger::assessment {
namespace {

// Straight down at these depths; the picture shows the tip where `seen` says so, the target from 1 s on.
Signals signals_of(const std::vector<Knot>& depth_mm, double seconds, const std::function<bool(double)>& seen,
                   bool fires = true) {
  StraightDown made = straight_down(depth_mm, seconds);
  for (cases::FrameTruth& frame : made.recording.frames) {
    frame.target = frame.t_s >= 1.0;
    frame.needle_tip = seen(frame.t_s);
  }
  if (!fires) made.recording.endpoint.reset();
  return made.signals();
}

std::vector<double> times_of(const std::vector<Moment>& moments, MomentKind kind) {
  std::vector<double> times;
  for (const Moment& moment : moments)
    if (moment.kind == kind) times.push_back(moment.t_s);
  return times;
}

// In to 40 mm, back to 20, in to 55 unseen between 8 and 9 s, fire at 12 s.
const std::vector<Knot> kWay = {{0.0, -20.0}, {2.0, -20.0}, {4.0, 40.0},  {5.0, 40.0},
                                {6.0, 20.0},  {8.0, 20.0},  {10.0, 55.0}, {12.0, 55.0}};

TEST(TellingMoments, AreWhereTheyMustBe) {
  const auto moments =
      telling_moments(signals_of(kWay, 12.0, [](double t_s) { return t_s > 2.0 && (t_s < 8.0 || t_s > 9.0); }));
  ASSERT_GE(moments.size(), kLeastMoments);
  ASSERT_LE(moments.size(), kMostMoments);
  for (std::size_t i = 1; i < moments.size(); ++i)
    EXPECT_GE(moments[i].t_s - moments[i - 1].t_s, kMomentsApart_s - 1e-9);
  EXPECT_EQ(times_of(moments, MomentKind::fire), std::vector<double>{12.0});
  EXPECT_TRUE(times_of(moments, MomentKind::end).empty());
  const auto target = times_of(moments, MomentKind::target_seen);
  ASSERT_EQ(target.size(), 1U);
  EXPECT_NEAR(target[0], 1.0, 0.041);
  const auto puncture = times_of(moments, MomentKind::puncture);
  ASSERT_EQ(puncture.size(), 1U);
  EXPECT_NEAR(reach(kWay, puncture[0]), 2.0, 1.0);
  const auto withdrawal = times_of(moments, MomentKind::withdrawal);
  ASSERT_EQ(withdrawal.size(), 1U);
  EXPECT_NEAR(reach(kWay, withdrawal[0]), 40.0, 0.5);
  EXPECT_LT(withdrawal[0], 5.3);
  const auto blind = times_of(moments, MomentKind::blind_run);
  ASSERT_EQ(blind.size(), 1U);
  EXPECT_NEAR(blind[0], 9.0, 0.1);
}

TEST(TellingMoments, AFullWithdrawalIsShownBeforeIt) {
  const auto moments =
      telling_moments(signals_of({{0.0, -20.0}, {2.0, 30.0}, {4.0, 30.0}, {6.0, -20.0}, {8.0, 45.0}, {10.0, 45.0}},
                                 10.0, [](double) { return true; }));
  EXPECT_EQ(times_of(moments, MomentKind::puncture).size(), 2U);
  const auto out = times_of(moments, MomentKind::full_withdrawal);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_GE(out[0], 1.9);
  EXPECT_LE(out[0], 4.3);
  EXPECT_TRUE(times_of(moments, MomentKind::blind_run).empty()) << "all was seen";
}

TEST(TellingMoments, ManyWithdrawalsDoNotPushTheEndOut) {
  std::vector<Knot> way = {{0.0, -20.0}, {1.0, 40.0}};
  for (int i = 0; i < 20; ++i) {
    way.push_back({2.0 + i, 40.0 - (i % 2 == 0 ? 15.0 : 0.0)});
  }
  const auto moments = telling_moments(signals_of(way, 22.0, [](double) { return false; }));
  EXPECT_EQ(moments.size(), kMostMoments);
  EXPECT_EQ(times_of(moments, MomentKind::fire).size(), 1U);
  EXPECT_EQ(times_of(moments, MomentKind::puncture).size(), 1U);
  EXPECT_EQ(times_of(moments, MomentKind::blind_run).size(), 1U);
}

TEST(TellingMoments, OfAShortOneThereAreFewerAndItsEndIsThere) {
  const auto moments = telling_moments(signals_of(
      {{0.0, -20.0}, {1.0, -19.0}}, 1.0, [](double) { return false; }, false));
  EXPECT_LT(moments.size(), kLeastMoments);
  EXPECT_EQ(times_of(moments, MomentKind::end), std::vector<double>{1.0});
  for (const Moment& moment : moments) EXPECT_STRNE(words_for(moment.kind, cases::Modality::xray), "");
}

// The counts of the metrics and the moments are of the same events.
TEST(TellingMoments, AreWhatTheMetricsCount) {
  const Signals signals = signals_of(kWay, 12.0, [](double t_s) { return t_s < 8.0; });
  const auto values = measure_all(signals);
  const auto value = [&](const std::string& id) {
    return std::find_if(values.begin(), values.end(), [&](const MetricValue& v) { return v.id == id; })->value;
  };
  const auto moments = telling_moments(signals);
  EXPECT_EQ(value("skin_punctures"), static_cast<double>(times_of(moments, MomentKind::puncture).size()));
  EXPECT_EQ(value("withdrawals_partial"), static_cast<double>(times_of(moments, MomentKind::withdrawal).size()));
}

}  // namespace
}  // namespace seldinger::assessment
