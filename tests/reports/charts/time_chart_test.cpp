// The chart over time: its numbers are the recording's, and broken samples do not reach the drawing.
#include "reports/charts/time_chart.h"

#include <gmock/gmock.h>

#include <limits>

#include "tests/reports/sample_attempt.h"

namespace seldinger::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const cases::Lesion kLesion{{12.0, -34.5, 100.0}, 8.0, 20.0};

TEST(DistanceOverTime, OfAStraightApproachFallsLinearlyToZero) {
  const cases::Recording recording = sample_recording(kLesion, 8.0);
  const auto points = distance_over_time(recording.poses, kLesion, 101);
  ASSERT_EQ(points.size(), 101U);
  EXPECT_EQ(points.front().t_s, recording.poses.front().t_s);
  EXPECT_EQ(points.back().t_s, recording.poses.back().t_s);
  for (const DistancePoint& point : points) EXPECT_NEAR(point.distance_mm, 60.0 * (1.0 - point.t_s / 8.0), 1e-9);
}

TEST(DistanceOverTime, LeavesOutSamplesThatAreNotFiniteOrGoBackInTime) {
  cases::Recording recording = sample_recording(kLesion, 1.0);
  recording.poses[5].tip_lps_mm.x = std::numeric_limits<double>::quiet_NaN();
  recording.poses[6].t_s = std::numeric_limits<double>::infinity();
  recording.poses[7].t_s = 0.0;
  const auto points = distance_over_time(recording.poses, kLesion, 1000);
  EXPECT_EQ(points.size(), recording.poses.size() - 3);
  for (std::size_t i = 1; i < points.size(); ++i) EXPECT_LT(points[i - 1].t_s, points[i].t_s);
}

TEST(VisibleSpans, JoinNeighbouringFramesAndLeaveOutFrozenOnes) {
  std::vector<cases::FrameTruth> frames(6);
  for (std::size_t i = 0; i < frames.size(); ++i) frames[i].t_s = 0.5 * static_cast<double>(i);
  frames[1].needle_tip = frames[2].needle_tip = frames[5].needle_tip = true;
  frames[4].needle_tip = true;
  frames[4].live = false;
  const auto spans = tip_visible_spans(frames);
  ASSERT_EQ(spans.size(), 2U);
  EXPECT_EQ(spans[0].from_s, 0.5);
  EXPECT_EQ(spans[0].to_s, 1.5);
  EXPECT_EQ(spans[1].from_s, 2.5);
  EXPECT_EQ(spans[1].to_s, 3.0);
}

TEST(TimeChart, HasATitleADescriptionAndATableWithTheSameEnds) {
  const std::string html = time_chart(sample_recording(kLesion, 8.0), kLesion).str();
  for (const char* piece :
       {"role=\"img\"", "<title id=\"chart-title\">", "From 60.0 mm at the start to 0.0 mm at the end",
        "class=\"fire\"", "class=\"seen\"", "60.0 mm</td><td>No", "0.0 mm</td><td>Yes"}) {
    EXPECT_THAT(html, HasSubstr(piece));
  }
}

TEST(TimeChart, IsLeftOutWhenThereIsNothingToDraw) {
  cases::Recording recording;
  EXPECT_TRUE(time_chart(recording, kLesion).empty());
  recording.poses.resize(1);
  EXPECT_TRUE(time_chart(recording, kLesion).empty());
  recording.poses.resize(5);  // all at one time
  EXPECT_TRUE(time_chart(recording, kLesion).empty());
}

TEST(TimeChart, NeverDrawsNanOrInfinity) {
  cases::Recording recording = sample_recording(kLesion, 2.0);
  recording.poses[3].tip_lps_mm.y = std::numeric_limits<double>::infinity();
  recording.frames[3].t_s = std::numeric_limits<double>::quiet_NaN();
  recording.frames[3].needle_tip = true;
  recording.endpoint->t_s = std::numeric_limits<double>::quiet_NaN();
  cases::Lesion lesion = kLesion;
  for (const double radius_mm : {8.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    lesion.radius_mm = radius_mm;
    const std::string html = time_chart(recording, lesion).str();
    EXPECT_THAT(html, HasSubstr("<svg"));
    for (const char* bad : {"nan", "inf,", "\"inf",
                            "-"
                            "nan"})
      EXPECT_THAT(html, Not(HasSubstr(bad)));
  }
}

}  // namespace
}  // namespace seldinger::reports
