// What is told of an ultrasound picture: closed forms of its beam, needle and losses, and the rendered picture.
#include "sim/imaging/ultrasound/visible.h"

#include <cmath>
#include <limits>

#include "shaders/shared/ultrasound.glsl.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

const Scene& liver() {
  static const Scene kLiver = all_of(TissueClass::liver);
  return kLiver;
}

// Tip on beam 64's axis at a depth, rising towards the first beam at `tilt_deg` to the face, off the plane.
Inserted needle_at(const UltrasoundView& view, double depth_mm, double tilt_deg, double off_mm = 0.0) {
  const double a = tilt_deg * M_PI / 180.0;
  Inserted inserted;
  inserted.needle = NeedlePose{};
  inserted.needle->tip_lps_mm = point_of(view, 64.0, depth_mm) + off_mm * glm::dvec3(0, 0, 1);
  inserted.needle->direction = {std::cos(a), std::sin(a), 0.0};
  return inserted;
}

Inserted target_at(const glm::dvec3& center_mm, double radius_mm, double hu) {
  Inserted inserted;
  inserted.lesions.push_back({center_mm, radius_mm, hu});
  return inserted;
}

UltrasoundVisible seen(const Scene& s, const UltrasoundView& view, const Inserted& inserted,
                       std::span<const float> below = {}) {
  return ultrasound_visible(s.tissue(), view, inserted, below);
}

double excess_db(const NeedleLevel& level) {
  return level.echo_db - level.background_db;
}

// Of a tip at a tilt to the beam, over liver: docs/decisions/0106, along the picture.
double tip_db(double tilt_deg, double fade_db_per_deg = kPlainFadeDbPerDeg) {
  return std::max(kNeedlePointDb, kNeedleMirrorDb - fade_db_per_deg * tilt_deg);
}

UltrasoundView by_half_slice(UltrasoundView view) {
  view.sight_law = cases::SightLaw::half_slice;
  return view;
}

TEST(NeedleTruth, FallsOffThePlaneAsTheBeamDoesAndEndsWhereItsEchoDoes) {
  for (const UltrasoundView& view : {curved_view(), straight_view()})
    for (const double depth_mm : {0.2 * view.depth_mm, 0.5 * view.depth_mm}) {
      const double fwhm_mm = elevation_fwhm_mm(view.probe, view.probe.frequency_mhz, depth_mm);
      const auto level = [&](double off_mm) {
        return needle_level(liver().tissue(), view, needle_at(view, depth_mm, 20.0, off_mm), {}, 0.0).echo_db;
      };
      EXPECT_NEAR(level(0.5 * fwhm_mm) - level(0.0), -6.0206, 1e-3);
      EXPECT_NEAR(level(fwhm_mm) - level(0.0), -4.0 * 6.0206, 1e-3);
      // 20·log10 of the slice's exp(−y²/2σ²) takes off what the tip has beyond 6 dB at:
      const double sigma_mm = fwhm_mm / shaders::kUsFwhmPerSigma;
      const double spare_db = tip_db(20.0) - kNeedleAboveDb;
      const double last_mm = sigma_mm * std::sqrt(2.0 * spare_db * std::log(10.0) / 20.0);
      EXPECT_GT(last_mm, 0.7 * fwhm_mm);
      for (const double share : {0.99, 1.01})
        EXPECT_EQ(seen(liver(), view, needle_at(view, depth_mm, 20.0, share * last_mm)).visible.needle_tip,
                  share < 1.0);
      const UltrasoundView old = by_half_slice(view);
      EXPECT_TRUE(seen(liver(), old, needle_at(view, depth_mm, 20.0, 0.499 * fwhm_mm)).visible.needle_tip);
      EXPECT_FALSE(seen(liver(), old, needle_at(view, depth_mm, 20.0, 0.501 * fwhm_mm)).visible.needle_tip);
    }
}

TEST(NeedleTruth, TheTipFadesWithItsTiltAndAnEchogenicOneLater) {
  UltrasoundView view = straight_view();
  const Scene fluid = all_of(TissueClass::fluid);
  for (const bool echogenic : {false, true}) {
    view.echogenic_needle = echogenic;
    for (double tilt_deg = 0.0; tilt_deg <= 85.0; tilt_deg += 5.0) {
      const double loss_db = 0.2 * 0.002 * 7.6 * 7.6 * 20.0;
      EXPECT_NEAR(needle_level(fluid.tissue(), view, needle_at(view, 20.0, tilt_deg), {}, 0.0).echo_db,
                  tip_db(tilt_deg, echogenic ? kEchogenicFadeDbPerDeg : kPlainFadeDbPerDeg) - loss_db, 0.1)
          << tilt_deg;
    }
  }
}

// Nichols 2003: of 60 to 76 units at 0° a plain needle keeps 5.0 at 75°, Echotip 40: on a picture of 60 dB a fall
// of 55 and of 27 dB; linear (Schafhalter-Zoppoth 2004). In fluid, drawn, down to what the point alone bends back.
TEST(NeedleTruth, TheDrawnTipFollowsTheMeasuredFallWithin3Db) {
  UltrasoundView view = straight_view();
  const Scene fluid = all_of(TissueClass::fluid);
  for (const auto& [echogenic, fallen_db] : {std::pair{false, 55.0}, {true, 27.0}}) {
    view.echogenic_needle = echogenic;
    const auto drawn_db = [&](double tilt_deg, double across_mm) {
      Inserted inserted = needle_at(view, 20.0, tilt_deg);
      inserted.needle->tip_lps_mm.x += across_mm;
      inserted.needle->length_mm = 0.01;  // its tip alone
      const PolarPicture picture = polar_of(fluid, view, inserted);
      float most = 0.0F;
      for (int k = sample_at(view, 19.0); k < sample_at(view, 21.0); ++k)
        most = std::max({most, at(picture, 64, k), at(picture, 65, k)});
      return decibels(static_cast<double>(most));
    };
    const double squarely_db = drawn_db(0.0, 0.0);
    for (double tilt_deg = 5.0; tilt_deg <= 85.0; tilt_deg += 5.0) {
      const double cited_db = -fallen_db * tilt_deg / 75.0;
      const double bent_db = kNeedlePointDb - kNeedleMirrorDb;
      EXPECT_NEAR(drawn_db(tilt_deg, 0.0) - squarely_db, std::max(cited_db, bent_db), 3.0) << tilt_deg;
    }
    // Wherever between two lines it lies: at most 3 dB less.
    for (double share = 0.0; share <= 1.0; share += 0.125) {
      const double off_db = drawn_db(30.0, 0.3 * share) - drawn_db(30.0, 0.0);
      EXPECT_GT(off_db, -kMidwayDb - 0.3) << share;
      EXPECT_LT(off_db, 0.3) << share;
    }
  }
}

// Across the picture tips show best where they are steep (Schafhalter-Zoppoth 2004): never gone before 75°.
TEST(NeedleTruth, AcrossThePictureASteepTipIsStillSeen) {
  const UltrasoundView view = straight_view();
  const auto level = [&](double tilt_deg, double turned_deg) {
    const double tilt = tilt_deg * M_PI / 180.0, turned = turned_deg * M_PI / 180.0;
    Inserted inserted = needle_at(view, 20.0, 0.0);
    inserted.needle->direction = {std::cos(tilt) * std::cos(turned), std::sin(tilt),
                                  std::cos(tilt) * std::sin(turned)};
    return needle_level(liver().tissue(), view, inserted, {}, 0.0);
  };
  for (const double tilt_deg : {30.0, 60.0, 74.0}) {
    EXPECT_TRUE(level(tilt_deg, 90.0).stands_out()) << tilt_deg;
    EXPECT_NEAR(excess_db(level(tilt_deg, 90.0)), kNeedleMirrorDb - 30.0 * tilt_deg / 75.0, 0.2);
    double before_db = -100.0;
    for (double turned_deg = 0.0; turned_deg <= 90.0; turned_deg += 15.0) {
      EXPECT_GE(level(tilt_deg, turned_deg).echo_db, before_db) << turned_deg;
      before_db = level(tilt_deg, turned_deg).echo_db;
    }
  }
  EXPECT_FALSE(level(76.0, 90.0).stands_out());
  EXPECT_FALSE(level(60.0, 0.0).stands_out());
}

TEST(NeedleTruth, OfEarlierLawsTheTipStaysAsItWas) {
  UltrasoundView view = curved_view();
  for (const auto law : {cases::SightLaw::echo, cases::SightLaw::material}) {
    view.sight_law = law;
    for (const double tilt_deg : {0.0, 40.0, 70.0})
      EXPECT_NEAR(excess_db(needle_level(liver().tissue(), view, needle_at(view, 60.0, tilt_deg), {}, 0.0)),
                  kNeedleMirrorDb - 30.0 * tilt_deg / 75.0, 0.5);
    // Midway between two lines as much less as a beam's own width leaves there.
    Inserted midway = needle_at(view, 60.0, 20.0);
    midway.needle->tip_lps_mm = point_of(view, 64.5, 60.0);
    midway.needle->length_mm = 0.01;
    const BeamWidth width = beam_width(view.probe, view.probe.frequency_mhz, 0.0, 60.0);
    const double off = 0.5 * fan_of(view).beam_spacing_mm(60.0) / width.lateral_sigma_mm;
    const double lost_db = 20.0 / std::log(10.0) * 0.5 * off * off;
    EXPECT_GT(lost_db, 10.0);
    UltrasoundView newest = view;
    newest.sight_law = cases::SightLaw::tilt;
    const double old_db = needle_level(liver().tissue(), view, midway, {}, 0.0).echo_db;
    const double new_db = needle_level(liver().tissue(), newest, midway, {}, 0.0).echo_db;
    const double faded_db = 20.0 * (kPlainFadeDbPerDeg - 0.4);
    EXPECT_NEAR(new_db - old_db, lost_db - kMidwayDb - faded_db, 1.0);
  }
}

TEST(NeedleTruth, ATipTurnedAwayIsWeakerAndNeverBrighter) {
  const UltrasoundView view = straight_view();
  const auto level_db = [&](double turn_deg) {
    Inserted inserted = needle_at(view, 20.0, 30.0);
    inserted.needle->bevel_turn_rad = turn_deg * M_PI / 180.0;
    return needle_level(liver().tissue(), view, inserted, {}, 0.0).echo_db;
  };
  EXPECT_NEAR(level_db(0.0) - level_db(90.0), kBevelSideDb, 1e-9);
  EXPECT_NEAR(level_db(0.0), level_db(180.0), 1e-9);
  EXPECT_NEAR(level_db(45.0), level_db(-45.0), 1e-9);
  for (double turn_deg = 0.0; turn_deg < 90.0; turn_deg += 10.0)
    EXPECT_GT(level_db(turn_deg), level_db(turn_deg + 10.0));
}

TEST(NeedleTruth, APlainShaftDropsOutAtTheAngleOfItsLaw) {
  // Liver is 0 dB, the rough shaft 25 dB less its fade; outside the mirror's cone 6 dB are left at:
  const double plain_deg = (kNeedleRoughDb - kNeedleAboveDb) / kPlainFadeDbPerDeg,
               echogenic_deg = (kNeedleRoughDb - kNeedleAboveDb) / kEchogenicFadeDbPerDeg;
  EXPECT_NEAR(plain_deg, 25.8, 0.1);
  UltrasoundView view = straight_view();
  const auto shaft_mm = [&](double tilt_deg) {
    return seen(liver(), view, needle_at(view, 30.0, tilt_deg)).visible.needle_length_mm;
  };
  // From the tip to the field's border, 64.5 elements towards the first beam.
  const double in_field_mm = 64.5 * 0.3 / std::cos((plain_deg - 0.5) * M_PI / 180.0);
  EXPECT_NEAR(shaft_mm(plain_deg - 0.5), in_field_mm, kShaftStepMm);
  EXPECT_EQ(shaft_mm(plain_deg + 0.5), 0.0);
  const double tip_deg = (kNeedleMirrorDb - kNeedleAboveDb) / kPlainFadeDbPerDeg;
  EXPECT_NEAR(tip_deg, 40.8, 0.1);
  for (const double tilt_deg : {tip_deg - 0.5, tip_deg + 0.5})
    EXPECT_EQ(seen(liver(), view, needle_at(view, 30.0, tilt_deg)).visible.needle_tip, tilt_deg < tip_deg);
  EXPECT_TRUE(seen(liver(), by_half_slice(view), needle_at(view, 30.0, 80.0)).visible.needle_tip)
      << "of half_slice the bevel shows at any angle";
  view.echogenic_needle = true;
  EXPECT_GT(shaft_mm(echogenic_deg - 0.5), 10.0);
  EXPECT_EQ(shaft_mm(echogenic_deg + 0.5), 0.0);
}

TEST(NeedleTruth, ShowsTheShaftToTheFieldsEnd) {
  const UltrasoundView view = straight_view();
  EXPECT_NEAR(seen(liver(), view, needle_at(view, 20.0, 0.0)).visible.needle_length_mm, 64.5 * 0.3, kShaftStepMm);
  Inserted shorter = needle_at(view, 20.0, 0.0);
  shorter.needle->length_mm = 11.0;
  EXPECT_NEAR(seen(liver(), view, shorter).visible.needle_length_mm, 11.0, 1e-9);
  const Inserted below = needle_at(view, 51.0, 0.0);
  EXPECT_EQ(seen(liver(), view, below).visible.needle_length_mm, 0.0);
  EXPECT_FALSE(seen(liver(), view, below).visible.needle_tip);
}

TEST(NeedleTruth, DrownsInTheReceiversNoise) {
  UltrasoundView view = curved_view(170.0);
  view.attenuation_db_cm_mhz = 1.0;
  // The tip's level less 2·1·3.57 dB a cm reaches 6 dB above the receiver's −60 at:
  const double drowned_mm = (tip_db(20.0) - kReceiverNoiseDb - kNeedleAboveDb) / (0.2 * 3.57);
  ASSERT_LT(drowned_mm, 120.0);
  for (const double off_mm : {-1.0, 1.0})
    EXPECT_EQ(seen(liver(), view, needle_at(view, drowned_mm + off_mm, 20.0)).visible.needle_tip, off_mm < 0.0);
  const NeedleLevel level = needle_level(liver().tissue(), view, needle_at(view, 40.0, 20.0), {}, 0.0);
  // Speckle, clutter and noise add up.
  const auto power = [](double db) { return std::pow(10.0, 0.1 * db); };
  EXPECT_NEAR(
      level.background_db,
      10.0 * std::log10(power(-0.2 * 3.57 * 40.0) + power(clutter_db(view, 40.0)) + power(kReceiverNoiseDb)), 1e-6);
  EXPECT_NEAR(level.echo_db, tip_db(20.0) - 0.2 * 3.57 * 40.0, 0.25);  // half a beam off the middle: 0.3° more
}

TEST(NeedleTruth, BehindBoneAndGasNothingIsSeen) {
  for (const TissueClass screen : {TissueClass::bone, TissueClass::gas}) {
    // Over the right half of the picture.
    const Scene s = scene(
        [=](const glm::dvec3& p) { return p.x > 0.0 && p.y > 10.0 && p.y < 20.0 ? screen : TissueClass::liver; });
    const UltrasoundView view = straight_view();
    Inserted inserted = needle_at(view, 30.0, 0.0);
    EXPECT_FALSE(seen(s, view, inserted).visible.needle_tip);
    EXPECT_NEAR(seen(s, view, inserted).visible.needle_length_mm, 19.2, 1.5 * kShaftStepMm);
    inserted.needle->tip_lps_mm.x = -5.0 + 0.05;  // on a beam
    EXPECT_TRUE(seen(s, view, inserted).visible.needle_tip);
  }
}

TEST(Truth, ElementsInAirSeeNothing) {
  const UltrasoundView view = straight_view();
  Inserted inserted = needle_at(view, 20.0, 0.0);
  inserted.lesions.push_back({point_of(view, 64.0, 30.0), 6.0, 5.0});
  std::vector<float> below(128, 0.0F);
  EXPECT_TRUE(seen(liver(), view, inserted, below).visible.joint);
  for (std::size_t i = 40; i < below.size(); ++i) below[i] = -1.5F;
  const UltrasoundVisible half = seen(liver(), view, inserted, below);
  EXPECT_FALSE(half.visible.needle_tip || half.visible.target);
  EXPECT_NEAR(half.visible.needle_length_mm, 40 * 0.3, kShaftStepMm);
  EXPECT_TRUE(half.near_plane.tip_2_mm && half.near_plane.target_2_mm) << "geometry asks for no contact";
}

TEST(TargetTruth, TransmissionIsWhatTheScannerDoesNotMakeUpFor) {
  UltrasoundView view = curved_view();
  const Inserted cyst = target_at({0, 100, 0}, 0.01, 5.0);
  view.attenuation_db_cm_mhz = 0.5;
  EXPECT_NEAR(target_level(liver().tissue(), view, cyst, {}).transmission_db, 0.0, 1e-2);
  // 0.1 dB/cm/MHz more, two ways, 3.57 MHz: 12 dB at 168 mm; 0.2 more: at 84 mm.
  view.attenuation_db_cm_mhz = 0.6;
  EXPECT_NEAR(target_level(liver().tissue(), view, cyst, {}).transmission_db, -7.14, 0.02);
  view.attenuation_db_cm_mhz = 0.7;
  for (const double off_mm : {-2.0, 2.0}) {
    const Inserted at = target_at({0, 12.0 / (0.2 * 0.2 * 3.57) + off_mm, 0}, 0.5, 5.0);
    EXPECT_EQ(target_level(liver().tissue(), view, at, {}).transmission_db >= kLeastTransmissionDb, off_mm < 0.0);
  }
}

TEST(TargetTruth, ACystIsSeenAndWhatIsLikeItsSurroundingsIsNot) {
  const Scene soft = all_of(TissueClass::soft_tissue);
  const UltrasoundView view = curved_view(100.0);
  EXPECT_TRUE(seen(soft, view, target_at({0, 50, 0}, 6.0, 5.0)).visible.target);
  EXPECT_FALSE(seen(soft, view, target_at({0, 50, 0}, 6.0, 60.0)).visible.target) << "the same class";
  EXPECT_NEAR(target_level(soft.tissue(), view, target_at({0, 50, 0}, 6.0, 60.0), {}).contrast_db, 0.0, 1e-6);
  // Fat of −4 dB in liver: of half_slice two cells' width of speckle are not enough to hide it, one would be.
  const TargetLevel fat =
      target_level(liver().tissue(), by_half_slice(view), target_at({0, 50, 0}, 6.0, -90.0), {});
  EXPECT_GT(fat.cnr(), 1.0);
  EXPECT_LT(fat.cnr(), 2.0);
  // A cyst in liver at 50 mm: only clutter, the receiver's noise and the slice fill it.
  const double liver_db = -0.2 * 0.5 * 3.57 * 50.0;
  EXPECT_LT(target_level(liver().tissue(), view, target_at({0, 50, 0}, 6.0, 5.0), {}).contrast_db, -25.0);
  EXPECT_GT(target_level(liver().tissue(), view, target_at({0, 50, 0}, 6.0, 5.0), {}).contrast_db,
            clutter_db(view, 50.0) - liver_db - 3.0);
}

TEST(TargetTruth, WhatIsFaintIsSeenWhereItIsLarge) {
  const UltrasoundView view = curved_view(100.0);
  const BeamWidth width = beam_width(view.probe, view.probe.frequency_mhz, 0.0, 50.0);
  const auto fat = [&](double radius_mm) {
    return target_level(liver().tissue(), view, target_at({0, 50, 0}, radius_mm, -90.0), {});
  };
  // Sections of 1, 9 and many cells of √(2π)·σ by √(2π)·σ: the root of their number, up to the cap.
  const double one_mm = std::sqrt(2.0 * width.lateral_sigma_mm * width.axial_sigma_mm);
  EXPECT_NEAR(fat(0.5 * one_mm).cells, 1.0, 1e-9);
  EXPECT_NEAR(fat(3.0 * one_mm).cells, 9.0, 1e-6);
  EXPECT_NEAR(fat(30.0).cells, kMostCellsSeen, 1e-9);
  EXPECT_NEAR(fat(3.0 * one_mm).cnr(), std::abs(fat(3.0 * one_mm).contrast_db) * 3.0 / kSpeckleDb, 1e-9);
  EXPECT_TRUE(fat(12.0).stands_out());
  EXPECT_FALSE(fat(1.5 * one_mm).stands_out()) << "four decibels in two cells of speckle are speckle";
}

TEST(TargetTruth, TheSliceFillsACystFromItsSides) {
  const UltrasoundView view = curved_view(100.0);
  const double depth_mm = 60.0, radius_mm = 1.0;
  const double sigma_mm = elevation_fwhm_mm(view.probe, 3.57, depth_mm) / shaders::kUsFwhmPerSigma;
  // Power weight exp(−(y/σ)²): of a slice centred on it, the share 1 − erf(r/σ) is tissue.
  const double filled = 1.0 - std::erf(radius_mm / sigma_mm);
  const TargetLevel level = target_level(liver().tissue(), view, target_at({0, depth_mm, 0}, radius_mm, 5.0), {});
  EXPECT_NEAR(level.contrast_db, 10.0 * std::log10(filled), 1.0);  // less absorption in the cyst above its centre
  // Moved out of the slice it is neither in it nor dark.
  const double limit_mm = radius_mm + 0.5 * elevation_fwhm_mm(view.probe, 3.57, depth_mm);
  EXPECT_FALSE(seen(liver(), view, target_at({0, depth_mm, limit_mm + 0.01}, radius_mm, 5.0)).visible.target);
  double before = 1e9;
  for (const double off_mm : {0.0, 0.5, 1.0, 1.5, 2.0}) {
    const double cnr =
        target_level(liver().tissue(), view, target_at({0, depth_mm, off_mm}, radius_mm, 5.0), {}).cnr();
    EXPECT_LT(cnr, before) << off_mm;
    before = cnr;
  }
}

TEST(TargetTruth, BehindBoneItIsGoneAndBesideARibItIsNot) {
  const UltrasoundView view = curved_view(100.0);
  const Inserted cyst = target_at({0, 60, 0}, 6.0, 5.0);
  const auto rib = [&](double half_mm) {
    return scene([=](const glm::dvec3& p) {
      return std::abs(p.x) < half_mm && p.y > 20.0 && p.y < 28.0 ? TissueClass::bone : TissueClass::liver;
    });
  };
  EXPECT_FALSE(seen(rib(12.0), view, cyst).visible.target);
  EXPECT_TRUE(seen(rib(1.0), view, cyst).visible.target) << "its sides are clear";
}

TEST(Truth, NearThePlaneIsGeometryAlone) {
  const Scene bone = all_of(TissueClass::bone);
  const UltrasoundView view = curved_view(100.0);
  for (const double off_mm : {1.9, 2.1, 4.9, 5.1}) {
    Inserted inserted = needle_at(view, 40.0, 0.0, off_mm);
    inserted.lesions.push_back({{0, 60, -off_mm}, 6.0, 5.0});
    const UltrasoundVisible told = seen(bone, view, inserted);
    EXPECT_EQ(told.near_plane.tip_2_mm, off_mm < 2.0);
    EXPECT_EQ(told.near_plane.target_2_mm, off_mm < 2.0);
    EXPECT_EQ(told.near_plane.tip_5_mm, off_mm < 5.0);
    EXPECT_EQ(told.near_plane.target_5_mm, off_mm < 5.0);
    EXPECT_FALSE(told.visible.needle_tip || told.visible.target || told.visible.joint);
  }
  EXPECT_EQ(seen(bone, view, target_at({0, 101, 0}, 6.0, 5.0)).near_plane, cases::NearPlane{}) << "below the field";
}

TEST(Truth, PosesThatAreNoneShowNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const UltrasoundView view = curved_view();
  Inserted inserted = needle_at(view, 40.0, 10.0);
  inserted.lesions.push_back({{0, 60, 0}, 6.0, 5.0});
  ASSERT_TRUE(seen(liver(), view, inserted).visible.joint);
  UltrasoundView lost = view;
  lost.origin_lps_mm.y = nan;
  for (const UltrasoundView& one : {view, lost}) {
    Inserted bad = inserted;
    if (one.origin_lps_mm.y == 0.0) {
      bad.needle->tip_lps_mm.z = nan;
      bad.lesions[0].center_lps_mm.x = nan;
    }
    const UltrasoundVisible told = seen(liver(), one, bad);
    EXPECT_FALSE(told.visible.needle_tip || told.visible.target || told.visible.joint);
    EXPECT_EQ(told.visible.needle_length_mm, 0.0);
    EXPECT_EQ(told.near_plane, cases::NearPlane{});
  }
  EXPECT_EQ(seen(liver(), view, {}).near_plane, cases::NearPlane{});
}

// A slanted body: skin, fat, muscle, a vessel, a rib at one side, gas below.
TEST(Truth, LosesWhatTheLinesOfThePictureLose) {
  const Scene s = scene(
      [](const glm::dvec3& p) {
        const double d = p.y + 0.2 * p.x;
        if (d < 1.0) return TissueClass::air;  // blurred skin, in contact
        if (d < 3.0) return TissueClass::skin;
        if (d < 18.0) return TissueClass::fat;
        if (d > 22.0 && d < 28.0 && p.x > 20.0) return TissueClass::bone;
        if (d < 35.0) return TissueClass::muscle;
        if (glm::length(p - glm::dvec3(-10, 60, 0)) < 8.0) return TissueClass::vessel;
        return d > 100.0 ? TissueClass::gas : TissueClass::liver;
      },
      {300, 240, 10}, 1.0);
  const UltrasoundView view = curved_view();
  double worst_db = 0.0;
  int compared = 0;
  for (int beam = 4; beam < 128; beam += 7) {
    const Line line = line_of(s, view, beam);
    for (double depth_mm = 6.3; depth_mm < 140.0; depth_mm += 4.0) {
      const auto k = static_cast<std::size_t>(sample_at(view, depth_mm));
      const double loss_db = static_cast<double>(line.loss_db[k]);
      // A needle so thick that nothing hides it tells the loss above it.
      Inserted inserted;
      inserted.needle = NeedlePose{};
      inserted.needle->tip_lps_mm = point_of(view, beam, (static_cast<double>(k) + 0.5) * 150.0 / 1024.0);
      inserted.needle->direction = glm::normalize(point_of(view, beam, 10.0) - point_of(view, beam, 0.0));
      const NeedleLevel level = needle_level(s.tissue(), by_half_slice(view), inserted, {}, 0.0);
      ASSERT_TRUE(level.in_field);
      const double told_db = kNeedleTipDb - level.echo_db;
      if (loss_db > 100.0) {
        EXPECT_GT(told_db, 60.0) << beam << " " << depth_mm;
        continue;
      }
      worst_db = std::max(worst_db, std::abs(told_db - loss_db));
      ++compared;
    }
  }
  printf("truth's loss against the picture's: at most %.2f dB apart at %d places\n", worst_db, compared);
  EXPECT_GT(compared, 200);
  // Two-way, bone takes 5.7 dB a mm: a quarter of a mm of it either way.
  EXPECT_LE(worst_db, 2.0);
}

// The picture's own answer: power averaged over seeds, its peak where the needle is, against the tissue around it.
double rendered_excess_db(const UltrasoundView& view, const Inserted& inserted, const glm::dvec3& p_lps_mm,
                          double background_db) {
  constexpr int kSeeds = 10;
  const glm::dvec3 d = p_lps_mm - view.origin_lps_mm;
  const BeamAndDepth place = beam_and_depth(view, d.x, d.y);
  const int beam = static_cast<int>(std::lround(place.beam)), middle = sample_at(view, place.depth_mm), reach = 6;
  std::vector<double> power(2 * reach + 1, 0.0);
  UltrasoundView seeded = view;
  for (int seed = 1; seed <= kSeeds; ++seed) {
    seeded.seed = static_cast<std::uint64_t>(seed);
    PolarPicture picture = polar_of(liver(), seeded, inserted);
    add_clutter(seeded, {}, picture);
    add_receiver_noise(seeded.seed, 1, picture);
    for (int k = -reach; k <= reach; ++k) {
      const double level = static_cast<double>(at(picture, beam, middle + k));
      power[static_cast<std::size_t>(k + reach)] += level * level / kSeeds;
    }
  }
  const double peak = *std::max_element(power.begin(), power.end()), around = std::pow(10.0, 0.1 * background_db);
  return 10.0 * std::log10(std::max(peak - around, 1e-3 * around) / around);
}

TEST(NeedleTruth, AgreesWithTheRenderedPicture) {
  int seen_places = 0, hidden_places = 0;
  double worst_db = 0.0;
  for (UltrasoundView view : {curved_view(90.0), straight_view(40.0)}) {
    // The middle of the probe is enough, and quicker.
    view.probe.elements = view.beams = 17;
    view.samples = view.probe.radius_mm > 0.0 ? 600 : 500;
    view.attenuation_db_cm_mhz = view.probe.radius_mm > 0.0 ? 1.4 : 1.6;  // near the noise, too
    for (const double share : {0.35, 0.65, 0.85})
      for (const double tilt_deg : {8.0, 20.0, 35.0, 60.0})
        for (const double off_share : {0.0, 0.8, 1.6}) {
          const double depth_mm = share * view.depth_mm;
          const double fwhm_mm = elevation_fwhm_mm(view.probe, view.probe.frequency_mhz, depth_mm);
          for (const bool tip : {false, true}) {
            // The tip beside the field for the shaft, in its middle for the tip.
            Inserted inserted = needle_at(view, depth_mm, tilt_deg, off_share * 0.5 * fwhm_mm);
            NeedlePose& needle = *inserted.needle;
            needle.tip_lps_mm = point_of(view, 8.0, depth_mm) + glm::dvec3(0, 0, off_share * 0.5 * fwhm_mm);
            const double behind_mm = tip ? 0.0 : 25.0;
            needle.tip_lps_mm += behind_mm * needle.direction;
            const NeedleLevel level = needle_level(liver().tissue(), view, inserted, {}, behind_mm);
            const double told_db = excess_db(level);
            const double drawn_db = rendered_excess_db(
                view, inserted, needle.tip_lps_mm - behind_mm * needle.direction, level.background_db);
            const std::string what = std::string(view.probe.name) + " " + std::to_string(depth_mm) + " mm " +
                                     std::to_string(tilt_deg) + " deg " + std::to_string(off_share);
            if (told_db > 6.0) worst_db = std::max(worst_db, std::abs(told_db - drawn_db));
            if (std::abs(told_db - kNeedleAboveDb) < 3.0) continue;  // speckle decides
            EXPECT_EQ(drawn_db > kNeedleAboveDb, told_db > kNeedleAboveDb)
                << what << ": told " << told_db << " dB, drawn " << drawn_db;
            ++(told_db > kNeedleAboveDb ? seen_places : hidden_places);
          }
        }
  }
  printf("needle above speckle, told and drawn: at most %.1f dB apart; %d seen, %d hidden\n", worst_db, seen_places,
         hidden_places);
  EXPECT_GE(seen_places, 15);
  EXPECT_GE(hidden_places, 10);
  EXPECT_LE(worst_db, 3.0);
}

TEST(TargetTruth, AgreesWithTheRenderedPicture) {
  constexpr int kSeeds = 6;
  UltrasoundView view = curved_view(90.0);
  view.probe.elements = view.beams = 41;
  view.samples = 600;
  double worst_db = 0.0;
  // Fat in liver, and cysts that the slice fills more and more.
  for (const auto& [hu, radius_mm, off_mm] : std::vector<std::tuple<double, double, double>>{
           {-90.0, 6.0, 0.0}, {5.0, 5.0, 4.0}, {5.0, 4.0, 2.5}, {5.0, 4.0, 4.0}, {60.0, 6.0, 0.0}}) {
    const double depth_mm = 75.0;
    const Inserted inserted = target_at({0, depth_mm, off_mm}, radius_mm, hu);
    const TargetLevel told = target_level(liver().tissue(), view, inserted, {});
    double inside = 0.0, beside = 0.0;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      view.seed = static_cast<std::uint64_t>(seed);
      PolarPicture picture = polar_of(liver(), view, inserted);
      add_clutter(view, {}, picture);
      add_receiver_noise(view.seed, 1, picture);
      const int from = sample_at(view, depth_mm - 0.5), to = sample_at(view, depth_mm + 0.5);
      inside += std::pow(10.0, 0.1 * level_db(picture, 20, 21, from, to)) / kSeeds;
      beside += 0.5 *
                (std::pow(10.0, 0.1 * level_db(picture, 0, 12, from, to)) +
                 std::pow(10.0, 0.1 * level_db(picture, 29, 41, from, to))) /
                kSeeds;
    }
    const double drawn_db = 10.0 * std::log10(inside / beside);
    worst_db = std::max(worst_db, std::abs(drawn_db - told.contrast_db));
    const double limit_db = told.least_cnr * kSpeckleDb / std::sqrt(told.cells);
    if (std::abs(std::abs(told.contrast_db) - limit_db) > 1.5) {
      EXPECT_EQ(std::abs(drawn_db) >= limit_db, told.stands_out())
          << hu << " HU " << radius_mm << " mm, told " << told.contrast_db << " dB, drawn " << drawn_db;
    }
  }
  printf("contrast told and drawn: at most %.1f dB apart\n", worst_db);
  EXPECT_LE(worst_db, 2.5);  // six pictures of a few cells of speckle
}

}  // namespace
}  // namespace seldinger::imaging
