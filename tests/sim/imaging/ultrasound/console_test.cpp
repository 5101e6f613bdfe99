// What is set, frozen and measured at the console.
#include "sim/imaging/ultrasound/console.h"

#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

PolarPicture ramp(int beams, int samples, float first) {
  PolarPicture polar{beams, samples, {}};
  for (int i = 0; i < beams * samples; ++i)
    polar.envelope.push_back(first * std::pow(10.0F, -3.0F * static_cast<float>(i % 997) / 997.0F));
  return polar;
}

TEST(Console, FrameRateIsThatOfSound) {
  // c / (2 · depth · beams): 60 mm and 128 lines 100, 150/128 40, 150/192 26.7, 200/256 15.
  EXPECT_NEAR(frame_rate_hz(60.0, 128), 100.0, 0.5);
  EXPECT_NEAR(frame_rate_hz(150.0, 128), 40.1, 0.1);
  EXPECT_NEAR(frame_rate_hz(150.0, 192), 26.7, 0.1);
  EXPECT_NEAR(frame_rate_hz(200.0, 256), 15.0, 0.1);
  Console console(*console_preset_named("liver"));
  EXPECT_DOUBLE_EQ(console.frame_rate_hz(), frame_rate_hz(150.0, 128));
}

TEST(Console, PresetsAreWithinItsRange) {
  ASSERT_EQ(console_presets().size(), 5U);
  for (const ConsolePreset& preset : console_presets()) {
    const Console console(preset);
    EXPECT_EQ(console.view().depth_mm, preset.depth_mm) << preset.name;
    EXPECT_EQ(console.view().focus_mm, preset.focus_mm);
    EXPECT_EQ(console.view().frequency_mhz, preset.frequency_mhz);
    EXPECT_EQ(console.knobs().dynamic_range_db, preset.dynamic_range_db);
    EXPECT_EQ(console.view().probe.name, preset.probe.name);
    EXPECT_EQ(console_preset_named(preset.name), &preset);
  }
  EXPECT_EQ(console_preset_named("brain"), nullptr);
}

TEST(Console, TakesWhatIsInRangeAndNoNaN) {
  Console console(*console_preset_named("liver"));
  console.set_depth_mm(1000.0);
  EXPECT_EQ(console.view().depth_mm, kC52v.most_depth_mm);
  console.set_depth_mm(0.0);
  EXPECT_EQ(console.view().depth_mm, kC52v.least_depth_mm);
  EXPECT_LE(console.view().focus_mm, kC52v.least_depth_mm);  // it went with the edge
  console.set_depth_mm(std::nan(""));
  EXPECT_EQ(console.view().depth_mm, kC52v.least_depth_mm);
  console.set_gain_db(std::nan(""));
  EXPECT_EQ(console.knobs().gain_db, 0.0);
  console.set_gain_db(-1e9);
  EXPECT_EQ(console.knobs().gain_db, -kMostGainDb);
  console.set_tgc_db(7, 55.0);
  EXPECT_EQ(console.knobs().tgc_db[7], kMostTgcDb);
  console.set_frequency_mhz(20.0);
  EXPECT_EQ(console.view().frequency_mhz, kC52v.most_mhz);
  console.set_preset(*console_preset_named("vessel"));
  EXPECT_EQ(console.view().frequency_mhz, 0.0);  // the new probe's own
  console.set_dynamic_range_db(0.0);
  EXPECT_EQ(console.knobs().dynamic_range_db, kLeastRangeDb);
}

TEST(Console, EveryProbeIsOfferedWithinItsBand) {
  for (const Probe& probe : kProbes) {
    EXPECT_LT(probe.least_mhz, probe.frequency_mhz) << probe.name;
    EXPECT_GT(probe.most_mhz, probe.frequency_mhz) << probe.name;
    // −6 dB of the pulse: beyond it the transducer hardly rings.
    EXPECT_GT(probe.least_mhz, probe.frequency_mhz * (1.0 - 0.8 * probe.bandwidth)) << probe.name;
    EXPECT_LT(probe.most_mhz, probe.frequency_mhz * (1.0 + 0.8 * probe.bandwidth)) << probe.name;
    EXPECT_LT(probe.least_depth_mm, probe.most_depth_mm) << probe.name;
  }
}

TEST(Console, AViewIsSetAsAskedWithinWhatItsProbeCan) {
  UltrasoundView as_is = UltrasoundView{};
  as_is.probe = kL115v;
  as_is.depth_mm = 130.0;  // deeper than is offered, as a case may have it
  const auto set = [&](const cases::ConsoleSetting& asked) {
    UltrasoundView view = as_is;
    set_view(asked, view);
    return view;
  };
  for (const cases::ConsoleSetting& nothing :
       {cases::ConsoleSetting{}, cases::ConsoleSetting{-5.0, -1.0, -2.0, 4.0},
        cases::ConsoleSetting{std::nan(""), std::nan(""), std::nan(""), 0.0}}) {
    EXPECT_EQ(set(nothing).depth_mm, 130.0);
    EXPECT_EQ(set(nothing).focus_mm, 0.0);
    EXPECT_EQ(set(nothing).frequency_mhz, 0.0);
  }
  EXPECT_EQ(set({60.0, 30.0, 9.0}).depth_mm, 60.0);
  EXPECT_EQ(set({60.0, 30.0, 9.0}).focus_mm, 30.0);
  EXPECT_EQ(set({60.0, 30.0, 9.0}).frequency_mhz, 9.0);
  EXPECT_EQ(set({500.0, 0.0, 0.0}).depth_mm, kL115v.most_depth_mm);
  EXPECT_EQ(set({1.0, 0.0, 0.0}).depth_mm, kL115v.least_depth_mm);
  EXPECT_EQ(set({60.0, 90.0, 50.0}).focus_mm, 60.0) << "not below the picture";
  EXPECT_EQ(set({60.0, 1.0, 50.0}).focus_mm, kLeastFocusMm);
  EXPECT_EQ(set({60.0, 1.0, 50.0}).frequency_mhz, kL115v.most_mhz);
  EXPECT_EQ(set({60.0, 1.0, 0.1}).frequency_mhz, kL115v.least_mhz);
}

TEST(Console, FrozenItKeepsItsPictureWhileTheProbeMoves) {
  Console console(*console_preset_named("vessel"));
  EXPECT_FALSE(console.shown());
  UltrasoundView view = console.view();
  for (std::uint64_t n = 0; n < 5; ++n) {
    view.origin_lps_mm.x = static_cast<double>(n);
    console.show(0.1 * static_cast<double>(n), n, view, ramp(4, 16, 1.0F + static_cast<float>(n)));
  }
  console.set_frozen(true);
  view.origin_lps_mm.x = 99.0;
  console.show(9.9, 99, view, ramp(4, 16, 1e3F));
  EXPECT_EQ(console.shown()->number, 4U);
  EXPECT_EQ(console.shown()->view.origin_lps_mm.x, 4.0);
  console.scroll(3);
  EXPECT_EQ(console.shown()->number, 1U);
  console.scroll(50);
  EXPECT_EQ(console.shown()->number, 0U);
  console.scroll(-2);
  EXPECT_EQ(console.shown()->number, 4U);
  console.set_frozen(false);
  EXPECT_FALSE(console.shown());  // the next picture is the first of the new loop
  console.show(10.0, 100, view, ramp(4, 16, 1.0F));
  EXPECT_EQ(console.shown()->number, 100U);
  console.scroll(1);
  EXPECT_EQ(console.shown()->number, 100U);  // live there is nothing to scroll
}

TEST(CineLoop, KeepsTheLastPicturesAndTheirGreys) {
  CineLoop loop;
  const UltrasoundView view = [] {
    UltrasoundView v = straight_view();
    v.beams = 32, v.samples = 64;
    return v;
  }();
  const int shown = CineLoop::kPictures + 7;
  for (int n = 0; n < shown; ++n)
    loop.push(n, static_cast<std::uint64_t>(n), view, ramp(32, 64, static_cast<float>(n + 1)));
  EXPECT_EQ(loop.size(), CineLoop::kPictures);
  EXPECT_FALSE(loop.back(CineLoop::kPictures));
  EXPECT_FALSE(loop.back(-1));
  const ScanConverter converter(view, {64, 64});
  for (const int back : {0, 1, CineLoop::kPictures - 1}) {
    const auto kept = loop.back(back);
    ASSERT_TRUE(kept);
    EXPECT_EQ(kept->number, static_cast<std::uint64_t>(shown - 1 - back));
    std::vector<unsigned char> live, later;
    converter.grey(view, {}, ramp(32, 64, static_cast<float>(shown - back)), live);
    converter.grey(view, {}, kept->picture, later);
    for (std::size_t i = 0; i < live.size(); ++i) ASSERT_NEAR(live[i], later[i], 1.0);
  }
}

TEST(Calipers, MeasureMillimetresOfThePictureFlippedOrNot) {
  UltrasoundView view = curved_view();
  const ScanConverter converter(view, {400, 300});
  for (const bool flip : {false, true}) {
    UltrasoundKnobs knobs;
    knobs.flip = flip;
    const glm::dvec2 a = picture_mm(converter, knobs, {100.0, 50.0}),
                     b = picture_mm(converter, knobs, {130.0, 90.0});
    EXPECT_NEAR(caliper_mm(a, b), 50.0 * converter.pixel_mm(), 1e-9);
    // The middle of the upper edge of a curved picture lies above the face's centre.
    EXPECT_NEAR(picture_mm(converter, knobs, {199.5, -0.5}).x, 0.0, 1e-9);
    EXPECT_NEAR(picture_mm(converter, knobs, {199.5, -0.5}).y, converter.top_mm(), 1e-9);
    EXPECT_EQ(a.x > 0.0, flip);
  }
  EXPECT_NEAR(ellipse_area_mm2(20.0, 10.0), 157.0796327, 1e-6);
}

TEST(Display, FlipTurnsLeftToRightAndMapsKeepTheirEnds) {
  const UltrasoundView view = straight_view();
  PolarPicture polar = ramp(view.beams, view.samples, 1.0F);
  const ScanConverter converter(view, {101, 60});
  UltrasoundKnobs knobs;
  std::vector<unsigned char> plain, other;
  converter.grey(view, knobs, polar, plain);
  knobs.flip = true;
  converter.grey(view, knobs, polar, other);
  for (std::size_t r = 0; r < 60; ++r)
    for (std::size_t c = 0; c < 101; ++c) ASSERT_EQ(plain[r * 101 + c], other[r * 101 + 100 - c]);
  EXPECT_NE(plain, other);
  for (const GreyMap map : {GreyMap::linear, GreyMap::lifted, GreyMap::contrast}) {
    const auto table = grey_table(map);
    EXPECT_EQ(table[0], 0);
    EXPECT_EQ(table[255], 255);
    EXPECT_TRUE(std::is_sorted(table.begin(), table.end()));
  }
  for (int i = 0; i < 256; ++i) EXPECT_EQ(grey_table(GreyMap::linear)[static_cast<std::size_t>(i)], i);
  EXPECT_GT(grey_table(GreyMap::lifted)[64], 120);
  EXPECT_LT(grey_table(GreyMap::contrast)[64], 50);
  knobs = {};
  knobs.grey_map = GreyMap::lifted;
  converter.grey(view, knobs, polar, other);
  for (std::size_t i = 0; i < plain.size(); ++i) ASSERT_EQ(other[i], grey_table(GreyMap::lifted)[plain[i]]);
}

TEST(Display, EnvelopeHasItsPlaceAndPixelSize) {
  const UltrasoundView view = straight_view();
  const PolarPicture polar = ramp(view.beams, view.samples, 100.0F);
  const ScanConverter converter(view, {40, 50, 0.5});
  EXPECT_EQ(converter.pixel_mm(), 0.5);
  const std::vector<float> db = converter.envelope_db(polar);
  std::vector<unsigned char> grey;
  converter.grey(view, {}, polar, grey);
  for (int r = 0; r < 50; ++r)
    for (int c = 0; c < 40; ++c) {
      const auto i = static_cast<std::size_t>(r * 40 + c);
      ASSERT_GT(db[i], kLeastDb);
      const double shown = db[i] + display_gain_db(view, {}, (r + 0.5) * 0.5) - (kWhiteDb - 60.0);
      ASSERT_NEAR(grey[i], std::clamp(255.0 * shown / 60.0, 0.0, 255.0), 0.6);
    }
  // A picture wider than the field: nothing there.
  EXPECT_EQ(ScanConverter(view, {400, 50, 0.5}).envelope_db(polar)[0], kLeastDb);
}

}  // namespace
}  // namespace seldinger::imaging
