// Spatial compounding: where looks lie over each other, how much of speckle they even out against the closed form,
// and what is told of a compounded picture.
#include "sim/imaging/ultrasound/compound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/base/rng.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/visible.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

const Scene& liver_to_compound() {
  static const Scene kLiver = all_of(TissueClass::liver);
  return kLiver;
}

UltrasoundView compounded(UltrasoundView view) {
  view.compound_deg = kCompoundDeg;
  return view;
}

PolarPicture compound_of(const Scene& s, const UltrasoundView& view, const Inserted& inserted = {},
                         const std::vector<float>& depths = {}) {
  std::array<Look, kLooks> looks;
  for (int i = 0; i < kLooks; ++i)
    looks[static_cast<std::size_t>(i)] = {polar_of(s, look_of(view, i), inserted, depths), depths};
  PolarPicture picture;
  Compounder(view).mean(view, looks, picture);
  return picture;
}

TEST(Compounding, LaysEachPlaceOverItself) {
  for (UltrasoundView view : {compounded(curved_view(120.0)), compounded(straight_view(40.0))}) {
    view.frequency_mhz = 1e-3;  // nothing is lost on the way
    view.beams = 64;
    view.samples = 256;
    // A level that rises to one side and with depth: the same in all looks, wherever each has its samples.
    const auto level = [](const glm::dvec3& p) { return std::sqrt(200.0 + p.x + 0.5 * p.y); };
    std::array<Look, kLooks> looks;
    for (int i = 0; i < kLooks; ++i) {
      const UltrasoundView look = look_of(view, i);
      PolarPicture& picture = looks[static_cast<std::size_t>(i)].picture;
      picture = {view.beams, view.samples, {}};
      for (int b = 0; b < view.beams; ++b)
        for (int k = 0; k < view.samples; ++k)
          picture.envelope.push_back(
              static_cast<float>(level(point_of(look, b, (k + 0.5) * view.depth_mm / view.samples))));
    }
    PolarPicture mean;
    Compounder(view).mean(view, looks, mean);
    for (int b = 0; b < view.beams; ++b)
      for (int k = 0; k < view.samples; ++k) {
        const glm::dvec3 p = point_of(view, b, (k + 0.5) * view.depth_mm / view.samples);
        ASSERT_NEAR(static_cast<double>(at(mean, b, k)), level(p), 2e-3 * level(p)) << b << ' ' << k;
      }
  }
}

TEST(Compounding, NoBeamOfALookBeginsAboveTheFace) {
  for (const UltrasoundView& view : {compounded(curved_view()), compounded(straight_view())})
    for (const int look : {1, 2})
      for (int b = 0; b < view.beams; ++b) {
        const glm::dvec3 start = point_of(look_of(view, look), b, 0.0);
        const BeamAndDepth at = beam_and_depth(view, glm::dot(start, view.lateral), glm::dot(start, view.axial));
        EXPECT_GE(at.depth_mm, -1e-9);
        EXPECT_LT(at.depth_mm, 16.0);
      }
}

// Without the loss: mean square, and the share of it that its standard deviation is.
std::pair<double, double> of_power(const PolarPicture& picture, const UltrasoundView& view, int first_beam,
                                   int end_beam, int first, int end) {
  const double loss_db_mm = shaders::us_loss_db_per_mm(kAssumedAttenuationDbCmMhz, 1.0, view.probe.frequency_mhz);
  double sum = 0.0, square = 0.0, count = 0.0;
  for (int b = first_beam; b < end_beam; ++b)
    for (int k = first; k < end; ++k) {
      const double depth_mm = (k + 0.5) * view.depth_mm / view.samples;
      const double power =
          std::pow(static_cast<double>(at(picture, b, k)), 2.0) * std::pow(10.0, 0.1 * loss_db_mm * depth_mm);
      sum += power;
      square += power * power;
      count += 1.0;
    }
  const double mean = sum / count;
  return {mean, std::sqrt(square / count - mean * mean) / mean};
}

TEST(Compounding, EvensSpeckleOutAsItsLooksAreIndependent) {
  for (const UltrasoundView& base : {curved_view(100.0), straight_view(40.0)}) {
    UltrasoundView view = compounded(base);
    view.attenuation_db_cm_mhz = kAssumedAttenuationDbCmMhz;
    const double middle_mm = 0.6 * view.depth_mm;
    const int first = sample_at(view, middle_mm - 6.0), end = sample_at(view, middle_mm + 6.0);
    double ratio = 0.0, off_db = 0.0;
    constexpr int kSeeds = 2;
    for (int seed = 1; seed <= kSeeds; ++seed) {
      view.seed = static_cast<std::uint64_t>(seed);
      const auto [one, one_spread] =
          of_power(polar_of(liver_to_compound(), look_of(view, 0)), view, 32, 96, first, end);
      const auto [mean, spread] = of_power(compound_of(liver_to_compound(), view), view, 32, 96, first, end);
      ratio += std::pow(one_spread / spread, 2.0) / kSeeds;
      off_db += decibels(std::sqrt(mean / one)) / kSeeds;
    }
    const double expected = independent_looks(view, middle_mm);
    printf("%s: %.2f independent looks, %.2f expected; speckle weaker by %.0f %%; level off by %.2f dB\n",
           std::string(view.probe.name).c_str(), ratio, expected, 100.0 * (1.0 - 1.0 / std::sqrt(ratio)), off_db);
    EXPECT_NEAR(ratio, expected, 0.15 * expected);
    EXPECT_NEAR(off_db, 0.0, 0.4);
  }
}

TEST(Compounding, MoreLooksFurtherApartCountMore) {
  UltrasoundView view = straight_view();
  EXPECT_EQ(independent_looks(view, 20.0), 1.0);
  double last = 1.0;
  for (const double deg : {0.5, 5.0, 10.0, 15.0}) {
    view.compound_deg = deg;
    EXPECT_GT(independent_looks(view, 20.0), last);
    last = independent_looks(view, 20.0);
    EXPECT_EQ(independent_looks(view, 20.0, 1), 1.0);
    EXPECT_GE(independent_looks(view, 20.0, 2), 1.0);
    EXPECT_GT(independent_looks(view, 20.0), independent_looks(view, 20.0, 2));
  }
}

// A cyst across the picture casts shadows behind its edges that each look has elsewhere.
TEST(Compounding, WeakensShadowsBehindEdges) {
  const glm::dvec3 middle(0.0, 45.0, 0.0);
  UltrasoundView view = compounded(curved_view(110.0));
  view.attenuation_db_cm_mhz = kAssumedAttenuationDbCmMhz;
  view.beams = 256;
  Inserted cyst;
  cyst.lesions.push_back({middle, 10.0, 8.0});
  // Darkest two beams, 35 to 55 mm behind the middle, to what they are without the cyst.
  const auto darkest_db = [&](const PolarPicture& with, const PolarPicture& without) {
    double least = 0.0;
    for (int b = 80; b < 176; ++b) {
      const int first = sample_at(view, 80.0), end = sample_at(view, 100.0);
      least = std::min(least, level_db(with, b, b + 2, first, end) - level_db(without, b, b + 2, first, end));
    }
    return least;
  };
  const UltrasoundView one = look_of(view, 0);
  const double alone_db = darkest_db(polar_of(liver_to_compound(), one, cyst), polar_of(liver_to_compound(), one));
  const double mean_db =
      darkest_db(compound_of(liver_to_compound(), view, cyst), compound_of(liver_to_compound(), view));
  printf("behind the edge %.1f dB in one look, %.1f dB compounded\n", alone_db, mean_db);
  EXPECT_LT(alone_db, -4.0);
  EXPECT_GT(mean_db, 0.6 * alone_db);
}

TEST(Compounding, BeamsInAirShowWhatOneLookShows) {
  const UltrasoundView view = compounded(straight_view());
  std::vector<float> depths(static_cast<std::size_t>(view.probe.elements), 0.0F);
  for (std::size_t i = 64; i < depths.size(); ++i) depths[i] = -5.0F;
  const PolarPicture mean = compound_of(liver_to_compound(), view, {}, depths);
  const PolarPicture one = polar_of(liver_to_compound(), look_of(view, 0), {}, depths);
  for (int k = 0; k < view.samples; ++k) ASSERT_EQ(at(mean, 100, k), at(one, 100, k));
  EXPECT_NE(mean.envelope, one.envelope);
}

TEST(Compounding, IsOfOneProbeAndDepth) {
  const UltrasoundView view = compounded(straight_view());
  const Compounder compounder(view);
  EXPECT_TRUE(compounder.is_of(view));
  UltrasoundView moved = view;
  moved.origin_lps_mm.x += 10.0;
  EXPECT_TRUE(compounder.is_of(moved)) << "in the probe's own frame";
  UltrasoundView deeper = view, off = view, other = view;
  deeper.depth_mm += 1.0;
  off.compound_deg = 0.0;
  other.probe = kC52v;
  for (const UltrasoundView& one : {deeper, off, other}) EXPECT_FALSE(compounder.is_of(one));
}

TEST(CompoundTruth, AFaintTargetIsSeenThatOneLookHides) {
  const UltrasoundView one = straight_view(40.0), view = compounded(one);
  Inserted inserted;
  cases::Lesion lesion;
  lesion.center_lps_mm = {0.0, 20.0, 0.0};
  lesion.radius_mm = 4.0;
  lesion.kind = cases::LesionKind::hcc;
  cases::LesionEcho echo;
  echo.inside = echo.rim = TissueClass::liver;
  echo.inside_db = echo.rim_db = -2.3;
  lesion.echo = echo;
  inserted.lesions.push_back(lesion);
  const TargetLevel alone = target_level(liver_to_compound().tissue(), one, inserted, {}),
                    mean = target_level(liver_to_compound().tissue(), view, inserted, {});
  EXPECT_NEAR(mean.cells / alone.cells, independent_looks(view, 20.0), 1e-9);
  EXPECT_NEAR(mean.contrast_db, alone.contrast_db, 0.3);
  EXPECT_FALSE(alone.stands_out());
  EXPECT_TRUE(mean.stands_out());
}

// The mean square of three looks at a needle that lies along the face: one meets it squarely.
TEST(CompoundTruth, ANeedleHasTheMeanOfItsLooks) {
  const UltrasoundView one = straight_view(40.0), view = compounded(one);
  Inserted inserted;
  inserted.needle = NeedlePose{};
  inserted.needle->tip_lps_mm = {0.0, 20.0, 0.0};
  inserted.needle->direction = {1.0, 0.0, 0.0};
  const auto level = [&](const UltrasoundView& by) {
    return needle_level(liver_to_compound().tissue(), by, inserted, {}, 5.0);
  };
  const double alone_db = level(one).echo_db, mean_db = level(view).echo_db;
  EXPECT_LT(mean_db, alone_db - 4.0);
  EXPECT_GT(mean_db, alone_db - 4.8);  // a third of the power, and what the sides add
  EXPECT_NEAR(level(view).background_db, level(one).background_db, 0.5);
  const UltrasoundVisible seen = ultrasound_visible(liver_to_compound().tissue(), view, inserted, {});
  EXPECT_TRUE(seen.visible.needle_tip);
  EXPECT_NEAR(seen.visible.needle_length_mm,
              ultrasound_visible(liver_to_compound().tissue(), one, inserted, {}).visible.needle_length_mm,
              kShaftStepMm);
}

// What is told of a needle walks down no more beams than it needs: the answer is that of all looks, place by place,
// in tissue of every level, beside bone, by every law, in one look and in three, of tissue that lies still and that
// is pressed, breathed and dragged.
TEST(CompoundTruth, IsToldByAFewLooksAsByAll) {
  const Scene s = scene([](const glm::dvec3& p) {
    if (std::abs(p.x + 12.0) < 2.0 && p.y > 8.0 && p.y < 12.0) return TissueClass::bone;
    if (glm::length(p - glm::dvec3(8, 20, 0)) < 7.0) return TissueClass::fluid;
    return p.y < 6.0 + 0.2 * p.x ? TissueClass::fat : TissueClass::liver;
  });
  const std::array<tissue::SkinPress, 1> press{
      {{.at_lps_mm = {0, 0, 0}, .inward = {0, 1, 0}, .radius_mm = 20.0, .depth_mm = 5.0}}};
  const tissue::NeedleDrag drag{.entry_lps_mm = {-20, 0, 0},
                                .direction = glm::normalize(glm::dvec3(1, 1, 0)),
                                .cut_mm = 30.0,
                                .tip_n = 1.0,
                                .tip_mm = 1.5,
                                .shaft_mm = 1.5};
  const tissue::Breath breath{{.back_y_mm = 200.0, .dome_z_mm = 10.0}, {2.0, 6.0, 9.0}};
  const std::array<tissue::Displacement, 3> moved{
      tissue::Displacement{}, tissue::displacement_of({.presses = press}),
      tissue::displacement_of({.presses = press, .needle = drag, .breath = breath})};
  base::Rng rng(22);
  std::array<int, 2> seen{}, hidden{};  // in one look, and in three
  for (int i = 0; i < 400; ++i) {
    UltrasoundView view = i % 2 == 0 ? straight_view(40.0) : curved_view(60.0);
    const bool three = i % 4 < 3;
    if (three) view = compounded(view);
    view.sight_law = static_cast<cases::SightLaw>((i / 4) % static_cast<int>(cases::kSightLawNames.size()));
    std::vector<float> below(128, 0.0F);
    if (i % 5 == 0) std::fill(below.begin() + 70, below.end(), -3.0F);
    const double tilt = 1.3 * rng.uniform();
    Inserted inserted;
    inserted.needle = NeedlePose{};
    inserted.needle->tip_lps_mm = {30.0 * rng.uniform() - 10.0, 8.0 + 30.0 * rng.uniform(), 2.0 * rng.uniform()};
    inserted.needle->direction = {std::cos(tilt), std::sin(tilt), 0.0};
    inserted.needle->length_mm = 20.0;
    const tissue::Displacement& displacement = moved[static_cast<std::size_t>(i % 3)];
    double told_mm = 0.0;
    for (double behind_mm = 1.0; behind_mm < 20.0; behind_mm += kShaftStepMm) {
      const bool shows = needle_level(s.tissue(), view, inserted, below, behind_mm, displacement).stands_out();
      told_mm += shows ? kShaftStepMm : 0.0;
      ++(shows ? seen : hidden)[three ? 1 : 0];
    }
    const UltrasoundVisible told = ultrasound_visible(s.tissue(), view, inserted, below, displacement);
    EXPECT_NEAR(told.visible.needle_length_mm, told_mm, 1e-9) << i;
    const NeedleLevel tip = needle_level(s.tissue(), view, inserted, below, 0.0, displacement);
    const bool by_echo = view.sight_law != cases::SightLaw::half_slice;  // by that one within the slice, too
    EXPECT_EQ(by_echo && told.visible.needle_tip, by_echo && tip.stands_out()) << i;
  }
  for (const std::size_t three : {0U, 1U}) {
    EXPECT_GT(seen[three], 100);
    EXPECT_GT(hidden[three], 100);
  }
}

}  // namespace
}  // namespace seldinger::imaging
