// Gain, sliders, logarithm and grey (goal 14).
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

PolarPicture flat(const UltrasoundView& view, float level) {
  PolarPicture polar{view.beams, view.samples, {}};
  polar.envelope.assign(static_cast<std::size_t>(view.beams) * static_cast<std::size_t>(view.samples), level);
  return polar;
}

TEST(Goal14, ARampOfSixtyDecibelsIsAllGreys) {
  for (const Probe& probe : kProbes) {
    measure::Setting setting = practised(probe);
    setting.quality = measure::Quality::reference;  // half a level is rounding, and nothing beyond
    expect_holds(setting, &measure::measure_grey);
  }
}

TEST(Display, LiverIsMiddleGreyAtEveryDepth) {
  const UltrasoundView view = curved_view();
  const PolarPicture polar = polar_of(all_of(TissueClass::liver), view);
  const ScanConverter converter(view, {400, 350});
  std::vector<unsigned char> grey;
  converter.grey(view, {}, polar, grey);
  for (const int row : {60, 110, 160, 210}) {
    double sum = 0.0;
    for (int r = row - 10; r < row + 10; ++r)
      for (int c = 160; c < 240; ++c) sum += grey[static_cast<std::size_t>(r * 400 + c)];
    // 0 dB less what the mean of a Rayleigh logarithm lies below its mean square: 2.5 dB.
    EXPECT_NEAR(sum / 1600.0, 255.0 * (60.0 - kWhiteDb - 2.5) / 60.0, 6.0) << row;
  }
}

TEST(Display, SlidersActAtTheirDepthAndGainEverywhere) {
  const UltrasoundView view = curved_view();
  UltrasoundKnobs knobs;
  knobs.tgc_db[3] = 6.0;
  knobs.gain_db = 1.0;
  const auto added = [&](double depth_mm) {
    return display_gain_db(view, knobs, depth_mm) - display_gain_db(view, {}, depth_mm);
  };
  EXPECT_NEAR(added(150.0 * 3.0 / 7.0), 7.0, 1e-9);
  EXPECT_NEAR(added(150.0 * 2.5 / 7.0), 4.0, 1e-9);
  EXPECT_NEAR(added(150.0 * 2.0 / 7.0), 1.0, 1e-9);
  EXPECT_NEAR(added(150.0), 1.0, 1e-9);
  EXPECT_NEAR(added(400.0), 1.0, 1e-9);
}

TEST(Display, ReceiverNoiseIsRayleighAndStaysWithItsFrame) {
  UltrasoundView view = curved_view();
  view.beams = 512;
  const auto noisy = [&](std::uint64_t frame, float level) {
    PolarPicture picture = flat(view, level);
    add_receiver_noise(1, frame, picture);
    return picture;
  };
  const PolarPicture one = noisy(1, 0.0F);
  EXPECT_EQ(one.envelope, noisy(1, 0.0F).envelope);
  EXPECT_NE(one.envelope, noisy(2, 0.0F).envelope);
  EXPECT_NEAR(level_db(one, 0, 512, 0, view.samples), kReceiverNoiseDb, 0.05);
  double sum = 0.0, square = 0.0;
  for (const float v : one.envelope) sum += v, square += double{v} * v;
  const double n = static_cast<double>(one.envelope.size()), mean = sum / n;
  EXPECT_NEAR(mean / std::sqrt(square / n - mean * mean), 1.913, 0.02);
  // Powers add; what is loud does not notice.
  EXPECT_NEAR(level_db(noisy(1, 1e-3F), 0, 512, 0, view.samples), -60.0 + 3.01, 0.05);
  EXPECT_NEAR(level_db(noisy(1, 1.0F), 0, 512, 0, view.samples), 0.0, 0.001);
}

TEST(Display, NoiseEndsPenetration) {
  const Scene liver = all_of(TissueClass::liver);
  for (const auto& [frequency_mhz, reaches_mm] :
       std::vector<std::pair<double, double>>{{3.57, 168.0}, {7.6, 79.0}}) {
    UltrasoundView view = curved_view(200.0);
    view.frequency_mhz = frequency_mhz;
    PolarPicture picture = polar_of(liver, view);
    const PolarPicture clean = picture;
    add_receiver_noise(1, 1, picture);
    // Where liver and noise are equal their sum is 3 dB above either.
    double equal_mm = 0.0;
    for (int k = 0; k + 20 < view.samples && equal_mm == 0.0; k += 10)
      if (level_db(clean, 0, 128, k, k + 20) < kReceiverNoiseDb) equal_mm = (k + 10) * view.depth_mm / view.samples;
    EXPECT_NEAR(equal_mm, reaches_mm, 4.0);
    const int last = view.samples - 40;
    EXPECT_LT(level_db(picture, 0, 128, last, view.samples), kReceiverNoiseDb + 1.0);
  }
}

TEST(Display, NanShows) {
  const UltrasoundView view = straight_view();
  const ScanConverter converter(view, {100, 100});
  std::vector<unsigned char> grey;
  converter.grey(view, {}, flat(view, std::nanf("")), grey);
  EXPECT_EQ(grey[50 * 100 + 50], 255);
  converter.grey(view, {}, flat(view, 0.0F), grey);
  EXPECT_EQ(grey[50 * 100 + 50], 0);
}

TEST(Display, PolarDbHasARowADepthAndNoClipWithin120Db) {
  const PolarPicture polar{3, 2, {1.0F, 10.0F, 1e-6F, 1e6F, 0.5F, 0.0F}};
  const std::vector<float> db = polar_db(polar);
  const double wanted[] = {0.0, -120.0, -6.0206, 20.0, 120.0, -200.0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(db[i], wanted[i], 1e-3) << i;
}

}  // namespace
}  // namespace seldinger::imaging
