#include "reports/pages/sections/beam_table.h"

#include <gtest/gtest.h>

namespace seldinger::reports {
namespace {

cases::FrameTruth pulse(double t_s, double lao_deg, double cranial_deg, bool moving = false) {
  cases::FrameTruth frame;
  frame.t_s = t_s;
  cases::BeamTruth beam;
  beam.lao_deg = lao_deg;
  beam.cranial_deg = cranial_deg;
  beam.kv = 74.0;
  beam.ma = 32.0;
  beam.beam_s = 0.25;
  beam.arm_moving = moving;
  frame.beam = beam;
  return frame;
}

TEST(BeamTable, PulsesFromOneDirectionAreOneLook) {
  cases::FrameTruth held;
  held.t_s = 0.6;
  held.live = false;
  const std::vector<cases::FrameTruth> frames = {
      pulse(0.0, 0, 0),       pulse(0.25, 0, 0.4),     held,
      pulse(1.0, 5, 0, true), pulse(1.25, 9, 0, true), pulse(2.0, -35, 10)};
  const auto looks = looks_of(frames);
  ASSERT_EQ(looks.size(), 3U);
  EXPECT_EQ(looks[0].pulses, 2);
  EXPECT_DOUBLE_EQ(looks[0].beam_s, 0.5);
  EXPECT_TRUE(looks[1].last.arm_moving);
  EXPECT_EQ(looks[2].pulses, 1);
  EXPECT_DOUBLE_EQ(looks[2].from_s, 2.0);
  EXPECT_EQ(image_text(frames, 0.7), "AP, 74 kV, 32 mA");
  EXPECT_EQ(image_text(frames, 9.0), "RAO 35°, cranial 10°, 74 kV, 32 mA");
  EXPECT_FALSE(image_text(frames, -1.0).has_value());
}

TEST(BeamTable, DirectionsSayTheirSide) {
  EXPECT_EQ(direction_text(*pulse(0, 30, 0).beam), "LAO 30°");
  EXPECT_EQ(direction_text(*pulse(0, 0, -12).beam), "caudal 12°");
  EXPECT_EQ(direction_text(*pulse(0, 0.2, -0.3).beam), "AP");
}

TEST(BeamTable, IsEmptyWithoutPulses) {
  EXPECT_TRUE(beam_table({}).empty());
}

}  // namespace
}  // namespace seldinger::reports
