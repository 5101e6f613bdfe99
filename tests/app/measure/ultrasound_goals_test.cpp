// The goals' measuring itself: it sees faults put into a picture on purpose, and what cannot be measured holds
// nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/measure/ultrasound_goals/goal.h"
#include "sim/imaging/ultrasound/view/fan.h"

namespace seldinger::measure {
namespace {

using imaging::Inserted;
using imaging::PolarPicture;
using imaging::TissueVolume;
using imaging::UltrasoundView;

Setting quick() {
  Setting setting = Setting::of(imaging::UltrasoundMethod::scatterers, imaging::kL115v, Quality::fast);
  setting.quick = true;
  return setting;
}

Readings readings_of(const Setting& setting, void (*measure)(const Setting&, Readings&)) {
  Readings readings;
  measure(setting, readings);
  return readings;
}

std::ptrdiff_t count_of(const Readings& readings, const char* word) {
  return std::count_if(readings.begin(), readings.end(),
                       [&](const Reading& one) { return one.what.find(word) != std::string::npos; });
}

TEST(Reading, NothingToMeasureHoldsNowhere) {
  const Reading none{1, "", "", std::nan(""), "", 1.0, 0.1};
  EXPECT_FALSE(none.holds(Quality::fast));
  EXPECT_EQ(none.share(Quality::fast), std::numeric_limits<double>::infinity());
  const Reading exact{15, "", "", 0.0, "", 0.0, 0.0}, one{15, "", "", 1.0, "", 0.0, 0.0};
  EXPECT_TRUE(exact.holds(Quality::fast));
  EXPECT_FALSE(one.holds(Quality::fast));
  const Reading between{2, "slope", "", 0.5, "%", 1.0, 0.1};
  EXPECT_TRUE(between.holds(Quality::fast));
  EXPECT_FALSE(between.holds(Quality::reference));
  const Readings some = {exact, between};
  EXPECT_EQ(worst_of(some, Quality::fast).what, "2 slope");
  EXPECT_DOUBLE_EQ(worst_of(some, Quality::reference).share, 5.0);
  EXPECT_EQ(worst_of(Readings{between, none}, Quality::fast).share, std::numeric_limits<double>::infinity());
}

TEST(UltrasoundGoals, AreSixteenInOrder) {
  int number = 0;
  for (const Goal& goal : ultrasound_goals()) EXPECT_EQ(goal.number, ++number);
  EXPECT_EQ(number, 16);
}

TEST(UltrasoundGoals, SeeAttenuationCountedOneWay) {
  Setting setting = quick();
  setting.paint = [paint = setting.paint](const TissueVolume& tissue, const UltrasoundView& view,
                                          const Inserted& inserted, PolarPicture& picture) {
    UltrasoundView half = view;
    if (half.attenuation_db_cm_mhz) *half.attenuation_db_cm_mhz *= 0.5;
    paint(tissue, half, inserted, picture);
  };
  const Readings readings = readings_of(setting, &measure_attenuation);
  ASSERT_EQ(readings.size(), 1U);
  EXPECT_NEAR(readings[0].off, 50.0, 1.0);
  EXPECT_FALSE(readings[0].holds(Quality::fast));
}

TEST(UltrasoundGoals, SeeANeedleInTheWrongPlace) {
  Setting setting = quick();
  setting.paint = [paint = setting.paint](const TissueVolume& tissue, const UltrasoundView& view,
                                          const Inserted& inserted, PolarPicture& picture) {
    Inserted wrong = inserted;
    wrong.needle->tip_lps_mm += 1.0 * wrong.needle->direction;  // a millimetre too far
    paint(tissue, view, wrong, picture);
  };
  const Readings readings = readings_of(setting, &measure_needle_place);
  EXPECT_EQ(count_of(readings, "tip"), 1);
  EXPECT_GT(readings.size(), 1U) << "and something that the tip's place leaves alone";
  for (const Reading& reading : readings) {
    const bool tip = reading.what.find("tip") != std::string::npos;
    EXPECT_EQ(reading.holds(Quality::fast), !tip) << reading.what;
    if (tip) {
      EXPECT_NEAR(reading.off, 1.0, 0.2);
    }
  }
}

TEST(UltrasoundGoals, SeeSpeckleBlurredAcross) {
  Setting setting = quick();
  setting.paint = [paint = setting.paint](const TissueVolume& tissue, const UltrasoundView& view,
                                          const Inserted& inserted, PolarPicture& picture) {
    UltrasoundView wide = view;
    wide.probe.f_number *= 1.5;
    wide.probe.aperture_mm /= 1.5;
    paint(tissue, wide, inserted, picture);
  };
  const Readings readings = readings_of(setting, &measure_widths);
  EXPECT_GE(count_of(readings, "width"), 1);
  EXPECT_GT(readings.size(), static_cast<std::size_t>(count_of(readings, "width")));
  for (const Reading& reading : readings) {
    const bool width = reading.what.rfind("width", 0) == 0;
    EXPECT_EQ(reading.holds(Quality::fast), !width) << reading.what << " " << reading.off;
    if (width) {
      EXPECT_NEAR(reading.off, 50.0, 8.0);
    }
  }
}

TEST(UltrasoundGoals, AnEmptyPictureHoldsNothing) {
  Setting setting = quick();
  setting.paint = [](const TissueVolume&, const UltrasoundView& view, const Inserted&, PolarPicture& picture) {
    picture = {view.beams, view.samples, {}};
    picture.envelope.assign(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples), 0.0F);
  };
  for (const Goal& goal : ultrasound_goals()) {
    // The display's goals make their own pictures, and nothing is the same bits as nothing.
    if (goal.number == 1 || goal.number == 14 || goal.number == 15) continue;
    const Readings readings = readings_of(setting, goal.measure);
    EXPECT_FALSE(readings.empty()) << "goal " << goal.number << " says nothing of it";
    for (const Reading& reading : readings)
      EXPECT_FALSE(reading.holds(Quality::fast)) << reading.goal << " " << reading.what << " " << reading.off;
  }
}

}  // namespace
}  // namespace seldinger::measure
