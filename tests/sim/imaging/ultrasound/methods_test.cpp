// The methods that scatterers are compared with: lattice and thesis.
#include "sim/imaging/ultrasound/speckle/lattice.h"
#include "sim/imaging/ultrasound/thesis.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

UltrasoundView with(UltrasoundView view, UltrasoundMethod method, int beams) {
  view.method = method;
  view.beams = beams;
  return view;
}

// The lattice's gain is worked out, not fitted: liver's mean square is 1 without loss.
TEST(Lattice, LiverIsAtItsLevelAtEveryDepth) {
  for (UltrasoundView view : {curved_view(), straight_view()}) {
    view = with(view, UltrasoundMethod::lattice, 512);
    view.attenuation_db_cm_mhz = 0.0;
    const PolarPicture picture = polar_of(all_of(TissueClass::liver), view);
    for (int part = 0; part < 8; ++part)
      EXPECT_NEAR(level_db(picture, 8, 504, view.samples * part / 8 + 4, view.samples * (part + 1) / 8 - 4), 0.0,
                  0.5)
          << view.probe.name << " " << part;
  }
}

// Of so few samples each is longer than the pulse.
TEST(Lattice, FewSamplesShowTheSameLevel) {
  for (const int samples : {8, 64, 256})
    for (UltrasoundView view : {curved_view(), straight_view()}) {
      view = with(view, UltrasoundMethod::lattice, 512);
      view.attenuation_db_cm_mhz = 0.0;
      view.samples = samples;
      const PolarPicture picture = polar_of(all_of(TissueClass::liver), view);
      EXPECT_NEAR(level_db(picture, 8, 504, samples / 2, samples), 0.0, 1.0) << view.probe.name << " " << samples;
    }
}

TEST(Lattice, IsRayleighToWithinItsCells) {
  for (UltrasoundView view : {curved_view(), straight_view()}) {
    view = with(view, UltrasoundMethod::lattice, 512);
    view.attenuation_db_cm_mhz = 0.0;
    const PolarPicture picture = polar_of(all_of(TissueClass::liver), view);
    double sum = 0.0, square = 0.0, n = 0.0;
    for (int b = 8; b < 504; ++b)
      for (int k = 600; k < 700; ++k)
        sum += at(picture, b, k), square += std::pow(at(picture, b, k), 2.0), n += 1.0;
    const double mean = sum / n, snr = mean / std::sqrt(square / n - mean * mean);
    printf("lattice: %s SNR %.3f\n", std::string(view.probe.name).c_str(), snr);
    EXPECT_NEAR(snr, 1.913, 0.15);
  }
}

TEST(Lattice, HangsOnTissue) {
  const Scene liver = all_of(TissueClass::liver);
  UltrasoundView view = with(straight_view(), UltrasoundMethod::lattice, 128);
  const PolarPicture here = polar_of(liver, view);
  view.origin_lps_mm += 5.0 * view.probe.pitch_mm * view.lateral;
  const PolarPicture there = polar_of(liver, view);
  std::vector<double> a, b;
  for (int beam = 10; beam < 110; ++beam)
    for (int k = 100; k < 1000; ++k) a.push_back(at(here, beam + 5, k)), b.push_back(at(there, beam, k));
  EXPECT_GT(correlation(a, b), 0.99);
}

TEST(Lattice, SameBitsForAnyNumberOfThreads) {
  const Scene liver = all_of(TissueClass::liver);
  UltrasoundView view = with(curved_view(), UltrasoundMethod::lattice, 128);
  view.threads = 1;
  const PolarPicture one = polar_of(liver, view);
  view.threads = 3;
  EXPECT_EQ(polar_of(liver, view).envelope, one.envelope);
}

// HU 40 is the middle of its window; its noise has a mean of 3/4.
TEST(Thesis, GreyIsTheWindowTimesNoise) {
  Scene s = all_of(TissueClass::soft_tissue);
  std::fill(s.volume.hu.begin(), s.volume.hu.end(), std::int16_t{40});
  const UltrasoundView view = with(curved_view(), UltrasoundMethod::thesis, 128);
  const PolarPicture picture = polar_of(s, view);
  double sum = 0.0;
  for (const float v : picture.envelope) sum += (decibels(v) - (kWhiteDb - 60.0)) / 60.0;
  EXPECT_NEAR(sum / static_cast<double>(picture.envelope.size()), 0.5 * 0.75, 0.005);
  // What the console adds for depth would brighten a picture without loss.
  EXPECT_EQ(display_gain_db(view, {}, 150.0), 0.0);
}

TEST(Thesis, ContrastCastsTheFalseShadowThatItIsKnownFor) {
  Scene s = scene([](const glm::dvec3& p) {
    return std::abs(p.y - 40.0) < 6.0 && std::abs(p.x) < 10.0 ? TissueClass::vessel : TissueClass::liver;
  });
  for (std::size_t i = 0; i < s.classes.size(); ++i)
    s.volume.hu[i] = s.classes[i] == TissueClass::vessel ? 250 : 60;
  UltrasoundView view = curved_view();
  const auto behind_db = [&] {
    const PolarPicture picture = polar_of(s, view);
    const int from = sample_at(view, 60.0), to = sample_at(view, 80.0);
    return level_db(picture, 62, 66, from, to) - level_db(picture, 10, 14, from, to);
  };
  view.method = UltrasoundMethod::thesis;
  EXPECT_LT(behind_db(), -15.0);
  view.method = UltrasoundMethod::scatterers;
  EXPECT_GT(behind_db(), -3.0);  // blood takes less than liver
}

TEST(Thesis, OutsideTheVolumeItIsBlackAndFinite) {
  Scene s = all_of(TissueClass::liver);
  UltrasoundView view = with(curved_view(), UltrasoundMethod::thesis, 64);
  view.origin_lps_mm = {1e4, 0.0, 0.0};
  const PolarPicture picture = polar_of(s, view);
  for (const float v : picture.envelope) ASSERT_NEAR(decibels(v), kWhiteDb - 60.0, 1e-3);
}

}  // namespace
}  // namespace seldinger::imaging
