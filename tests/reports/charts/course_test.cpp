// The course of an attempt whose way is known.
#include "reports/charts/course.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "assessment/procedure/steps.h"
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

  EXPECT_EQ(course.t1_s, 6.0) << "what comes after the endpoint belongs to it";
  EXPECT_EQ(course.points.back().t_s, 5.5);
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
  EXPECT_EQ(course.forces.back().t_s, 6.0);

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
  ASSERT_EQ(course.lanes.size(), 2U);
  const Lane &steps = course.lanes[0], &events = course.lanes[1];
  ASSERT_EQ(events.marks.size(), 3U);
  EXPECT_EQ(events.marks[0].kind, "mentor");
  EXPECT_EQ(events.marks[1].words, "fired");
  EXPECT_EQ(events.marks[2].t0_s, 5.8);
  const auto told = [](const std::vector<LaneMark>& marks, const std::string& kind, const std::string& words) {
    return std::any_of(marks.begin(), marks.end(), [&](const LaneMark& mark) {
      return mark.kind == kind && mark.words.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(told(steps.marks, "step", assessment::find_step("sign_out")->words));
  EXPECT_TRUE(told(steps.timeless, "skipped", assessment::find_step("sign_in")->words));
  for (std::size_t i = 1; i < steps.marks.size(); ++i) EXPECT_LE(steps.marks[i - 1].t0_s, steps.marks[i].t0_s);

  // What was not listened to is no omission.
  recording.events.reset();
  const auto unheard = assessment::make_signals(setting, recording);
  ASSERT_TRUE(unheard);
  for (const Lane& lane : course_of(*unheard, recording).lanes)
    EXPECT_FALSE(told(lane.timeless, "skipped", assessment::find_step("sign_in")->words));
}

}  // namespace
}  // namespace seldinger::reports
