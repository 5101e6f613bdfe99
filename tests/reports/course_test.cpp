// The course of an attempt whose way is known.
#include "reports/course.h"

#include <gtest/gtest.h>

#include "tests/fixtures/meshes.h"

namespace seldinger::reports {
namespace {

TEST(Course, DepthSightTargetAndEvents) {
  const cases::MeshIndex skin(fixtures::box_mesh({-100.0, -100.0, -100.0}, {100.0, 0.0, 100.0}));
  assessment::AttemptSetting setting;
  setting.skin = &skin;
  setting.target = cases::Lesion{{0.0, -50.0, 0.0}, 5.0, 20.0};
  setting.modality = cases::Modality::ultrasound;
  cases::Recording recording;
  for (int i = 0; i <= 600; ++i) {  // 10 mm/s from 10 mm above the skin
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = {0.0, 10.0 - 0.1 * i, 0.0};
    pose.needle_direction = {0.0, -1.0, 0.0};
    recording.poses.push_back(pose);
    recording.forces.push_back({pose.t_s, 0.01 * i, 0.0, 0.0});
    cases::FrameTruth frame;
    frame.t_s = pose.t_s;
    frame.live = i < 500;
    frame.needle_tip = i >= 300;
    frame.target = true;
    recording.frames.push_back(frame);
  }
  recording.endpoint = cases::Endpoint{5.5, {0.0, -45.0, 0.0}, {0.0, -1.0, 0.0}};
  recording.events = {{2.0, cases::EventKind::cough}, {5.8, cases::EventKind::sign_out}};
  const auto signals = assessment::make_signals(setting, recording);
  ASSERT_TRUE(signals);
  const Course course = course_of(*signals, recording);

  EXPECT_EQ(course.t1_s, 5.5);
  EXPECT_EQ(course.fired_s, 5.5);
  ASSERT_FALSE(course.points.empty());
  EXPECT_FALSE(course.points.front().in_body);
  EXPECT_EQ(course.points.front().inserted_mm, 0.0);
  EXPECT_NEAR(course.points.back().inserted_mm, 45.0, 0.01);
  for (const CoursePoint& point : course.points) EXPECT_EQ(point.tip_seen, point.t_s >= 3.0 && point.t_s < 5.0);
  ASSERT_EQ(course.targets.size(), 1U);
  EXPECT_NEAR(course.targets[0].center_mm, 50.0, 0.1);
  EXPECT_NEAR(course.targets[0].span.from_s, 1.0, 0.02);
  EXPECT_EQ(course.targets[0].span.to_s, 5.5);
  EXPECT_EQ(course.forces.back().t_s, 5.5);

  const auto band = [&](const std::string& name) {
    for (const Band& one : course.bands)
      if (one.name == name) return one.spans;
    ADD_FAILURE() << name;
    return std::vector<Span>{};
  };
  ASSERT_EQ(band("Tip seen").size(), 1U);
  EXPECT_EQ(band("Tip seen")[0].from_s, 3.0);
  EXPECT_EQ(band("Tip seen")[0].to_s, 5.0);
  EXPECT_EQ(band("Picture live")[0].to_s, 5.0);
  ASSERT_EQ(course.lanes.size(), 1U);
  ASSERT_EQ(course.lanes[0].marks.size(), 2U) << "what came after the endpoint is not drawn";
  EXPECT_EQ(course.lanes[0].marks[0].kind, "mentor");
  EXPECT_EQ(course.lanes[0].marks[1].words, "fired");
}

}  // namespace
}  // namespace seldinger::reports
