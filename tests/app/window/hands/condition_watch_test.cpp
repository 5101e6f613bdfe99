// What the window sees of an attempt's conditions.
#include "app/window/hands/condition_watch.h"

#include <gtest/gtest.h>

namespace seldinger::app {
namespace {

TEST(ConditionWatch, SaysNothingOfWhatItHasNotSeen) {
  ConditionWatch watch;
  watch.begin(cases::Modality::ultrasound);
  casedb::Conditions conditions;
  watch.put_into(conditions);
  EXPECT_FALSE(conditions.window_rate_hz || conditions.picture_rate_hz || conditions.picture_method);
  EXPECT_FALSE(conditions.sound || conditions.stereo || conditions.window_width_px || conditions.room_lag.p50_ms);
}

TEST(ConditionWatch, CountsFramesAndPicturesOutOfPauses) {
  ConditionWatch watch;
  watch.begin(cases::Modality::ultrasound);
  for (int i = 0; i <= 120; ++i)
    watch.shown({.now_s = 10.0 + i / 60.0, .new_picture = i % 2 == 0, .width_px = 1280, .height_px = 800});
  for (int i = 0; i < 600; ++i)
    watch.shown({.now_s = 12.0 + i / 60.0, .paused = true, .stereo = true, .width_px = 1280, .height_px = 800});
  for (int i = 0; i <= 60; ++i) watch.shown({.now_s = 30.0 + i / 60.0, .width_px = 1000, .height_px = 700});
  casedb::Conditions conditions;
  watch.put_into(conditions);
  ASSERT_TRUE(conditions.window_rate_hz && conditions.picture_rate_hz);
  EXPECT_NEAR(*conditions.window_rate_hz, 60.0, 0.1) << "three seconds";
  EXPECT_NEAR(*conditions.picture_rate_hz, 20.0, 0.1) << "30 a second in two of them, none in the third";
  EXPECT_EQ(conditions.window_width_px, 1000);
  EXPECT_EQ(conditions.window_height_px, 700);
  EXPECT_EQ(conditions.stereo, true) << "for a while";
  EXPECT_EQ(conditions.sound, false);
}

TEST(ConditionWatch, TellsTheLagsQuantiles) {
  ConditionWatch watch;
  watch.begin(cases::Modality::mpr);
  for (int i = 1; i <= 100; ++i)
    watch.shown({.now_s = 0.1 * i,
                 .force_lag_s = 0.001,
                 .room_lag_s = 0.001 * i,
                 .picture_lag_s = i % 2 == 0 ? std::optional(0.040) : std::nullopt,
                 .width_px = 1,
                 .height_px = 1});
  casedb::Conditions conditions;
  watch.put_into(conditions);
  ASSERT_TRUE(conditions.room_lag.p50_ms && conditions.picture_lag.p95_ms && conditions.force_lag.most_ms);
  EXPECT_NEAR(*conditions.room_lag.p50_ms, 50.0, 50.0 / 16.0);
  EXPECT_NEAR(*conditions.room_lag.p95_ms, 95.0, 95.0 / 16.0);
  EXPECT_NEAR(*conditions.room_lag.most_ms, 100.0, 1e-6);
  EXPECT_NEAR(*conditions.picture_lag.p95_ms, 40.0, 40.0 / 16.0);
  EXPECT_NEAR(*conditions.force_lag.most_ms, 1.0, 1e-6);
}

TEST(ConditionWatch, ASimplifiedSpeckleIsKeptInMindAndUltrasoundsAlone) {
  ConditionWatch watch;
  watch.begin(cases::Modality::ultrasound);
  watch.made_by("scatterers, CPU");
  casedb::Conditions conditions;
  watch.put_into(conditions);
  EXPECT_EQ(conditions.speckle_fallback, false);
  watch.made_by("lattice, CPU");
  watch.put_into(conditions);
  EXPECT_EQ(conditions.speckle_fallback, true);
  EXPECT_EQ(conditions.picture_method, "lattice, CPU");
  watch.begin(cases::Modality::xray);
  watch.made_by("fluoroscopy");
  casedb::Conditions xray;
  watch.put_into(xray);
  EXPECT_FALSE(xray.speckle_fallback);
  EXPECT_EQ(xray.picture_method, "fluoroscopy");
}

TEST(ConditionWatch, IsToldOnceASecond) {
  ConditionWatch watch;
  watch.begin(cases::Modality::mpr);
  EXPECT_TRUE(watch.due(5.0));
  EXPECT_FALSE(watch.due(5.9));
  EXPECT_TRUE(watch.due(6.0));
}

}  // namespace
}  // namespace seldinger::app
