// Targets by level and size: what is told of them against a detector that looks at rendered pictures only, and
// lesions by kind in the picture.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>
#include <vector>

#include "sim/base/rng.h"
#include "sim/imaging/ultrasound/compound.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/lesion_echo.h"
#include "sim/imaging/ultrasound/visible.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

const Scene& liver_about() {
  static const Scene kLiver = all_of(TissueClass::liver);
  return kLiver;
}

cases::Lesion lesion_of_level(const glm::dvec3& center_mm, double radius_mm, double level_db) {
  cases::Lesion lesion;
  lesion.center_lps_mm = center_mm;
  lesion.radius_mm = radius_mm;
  lesion.hu = 50.0;
  lesion.kind = cases::LesionKind::hcc;
  cases::LesionEcho echo;
  echo.inside = echo.rim = TissueClass::liver;
  echo.inside_db = echo.rim_db = level_db;
  lesion.echo = echo;
  return lesion;
}

// Mean level on the log picture, as an eye sees it, of the samples for which `take` says so.
template <typename Take>
double mean_level_db(const PolarPicture& picture, const UltrasoundView& view, const Take& take) {
  double sum = 0.0;
  int count = 0;
  for (int b = 0; b < view.beams; ++b)
    for (int k = 0; k < view.samples; ++k) {
      const double range_mm = (k + 0.5) * view.depth_mm / view.samples;
      const glm::dvec3 p = point_of(view, b, range_mm) - view.origin_lps_mm;
      if (!take(glm::dot(p, view.lateral), glm::dot(p, view.axial), range_mm)) continue;
      sum += static_cast<double>(level_db_of(at(picture, b, k)));
      ++count;
    }
  return count > 0 ? sum / count : std::nan("");
}

// As the screen has it: with clutter and the receiver's noise, and compounded where the view is.
PolarPicture on_screen(const Scene& s, const UltrasoundView& view, const Inserted& inserted) {
  std::array<Look, kLooks> looks;
  for (int i = 0; i < (view.compound_deg > 0.0 ? kLooks : 1); ++i) {
    const UltrasoundView look = look_of(view, i);
    PolarPicture& picture = looks[static_cast<std::size_t>(i)].picture;
    picture = polar_of(s, look, inserted);
    add_clutter(look, {}, picture);
    add_receiver_noise(view.seed, static_cast<std::uint64_t>(i) + 1, picture);
  }
  if (!(view.compound_deg > 0.0)) return looks[0].picture;
  PolarPicture mean;
  Compounder(view).mean(view, looks, mean);
  return mean;
}

// Somebody who looks at one picture only and is told where and how large: a matched filter, the mean over the
// lesion against that beside it as far from the face. The threshold is fixed in advance: 2.5 standard deviations of
// as many cells of speckle as the lesion has, at most the 25 that an eye takes in.
bool detected(const PolarPicture& picture, const UltrasoundView& view, const cases::Lesion& lesion) {
  const glm::dvec3 off = lesion.center_lps_mm - view.origin_lps_mm;
  const double depth_mm = off.y, r_mm = std::sqrt(lesion.radius_mm * lesion.radius_mm - off.z * off.z);
  const BeamWidth width = beam_width(view.probe, view.probe.frequency_mhz, view.focus_mm, depth_mm);
  const double cells = std::clamp(r_mm * r_mm / (2.0 * width.lateral_sigma_mm * width.axial_sigma_mm), 1.0, 25.0) *
                       independent_looks(view, depth_mm);
  const double inside =
      mean_level_db(picture, view, [&](double x, double z, double) { return std::hypot(x, z - depth_mm) <= r_mm; });
  const double beside = mean_level_db(picture, view, [&](double x, double, double range_mm) {
    return std::abs(x) > r_mm + 3.0 && std::abs(x) < r_mm + 12.0 &&
           std::abs(range_mm - depth_mm) <= std::max(6.0, r_mm);
  });
  return std::abs(inside - beside) >= 2.5 * 5.57 / std::sqrt(cells);
}

// Area under the curve of the rule's own number against what was found.
double roc_area(const std::vector<std::pair<double, bool>>& told) {
  double above = 0.0, pairs = 0.0;
  for (const auto& [found_cnr, found] : told)
    for (const auto& [missed_cnr, seen] : told)
      if (found && !seen) {
        above += found_cnr > missed_cnr ? 1.0 : found_cnr == missed_cnr ? 0.5 : 0.0;
        pairs += 1.0;
      }
  return above / pairs;
}

TEST(TargetTruth, IsWhatADetectorFindsWhoLooksAtThePictureOnly) {
  base::Rng rng(22);
  int far = 0, agree = 0, near = 0, near_seen = 0;
  std::vector<std::pair<double, bool>> told;
  const int scenes = std::getenv("SELDINGER_FUZZ") != nullptr ? 2000 : 300;  // the label `long`
  for (int i = 0; i < scenes; ++i) {
    UltrasoundView view = curved_view(100.0);
    view.probe.elements = view.beams = 96;
    view.samples = 400;
    view.seed = static_cast<std::uint64_t>(i) + 1;
    if (i % 4 == 0) view.compound_deg = kCompoundDeg;
    const double depth_mm = 45.0 + 25.0 * rng.uniform(), radius_mm = 1.5 * std::pow(40.0 / 3.0, rng.uniform());
    const double off_mm = 0.6 * radius_mm * (2.0 * rng.uniform() - 1.0);
    Inserted inserted;
    inserted.lesions.push_back(lesion_of_level({0.0, depth_mm, off_mm}, radius_mm, -10.0 + 18.0 * rng.uniform()));
    if (i % 3 == 0) {
      cases::LesionEcho& echo = *inserted.lesions[0].echo;
      echo.texture = {3.0 * rng.uniform(), 2.0 + 3.0 * rng.uniform()};
      echo.texture_db = texture_db(inserted.lesions[0], echo);
    }
    if (i % 5 < 2) inserted.lesions[0].echo->margin_mm = 3.0 * rng.uniform();
    const TargetLevel level = target_level(liver_about().tissue(), view, inserted, {});
    const PolarPicture picture = on_screen(liver_about(), view, inserted);
    const bool found = detected(picture, view, inserted.lesions.front());
    told.emplace_back(level.cnr(), found);
    const double limit_db = level.least_cnr * kSpeckleDb / std::sqrt(level.cells);
    const double above_db = std::abs(level.contrast_db) - limit_db;
    if (std::abs(above_db) > 3.0) {
      ++far;
      agree += found == (above_db > 0.0) ? 1 : 0;
    } else {
      ++near;
      near_seen += found ? 1 : 0;
    }
  }
  const double area = roc_area(told);
  printf(
      "target: detector and law agree in %d of %d pictures beyond 3 dB of the limit; within, %d of %d are found; "
      "ROC area %.3f\n",
      agree, far, near_seen, near, area);
  EXPECT_GE(agree, 0.95 * far);
  EXPECT_GE(near_seen, 0.35 * near);
  EXPECT_LE(near_seen, 0.65 * near);
  EXPECT_GE(area, 0.95);
}

UltrasoundVisible seen_of_kind(cases::LesionKind kind, double radius_mm) {
  Inserted inserted;
  cases::Lesion lesion = lesion_of_level({0.0, 60.0, 0.0}, radius_mm, 0.0);
  lesion.kind = kind;
  lesion.echo = lesion_echo(liver_about().tissue(), lesion);
  inserted.lesions.push_back(lesion);
  return ultrasound_visible(liver_about().tissue(), curved_view(100.0), inserted, {});
}

TEST(TargetTruth, AMassOfItsSurroundingsLevelIsNotSeenAndItsHaloIs) {
  for (const double radius_mm : {4.0, 8.0, 20.0}) {
    EXPECT_FALSE(seen_of_kind(cases::LesionKind::isoechoic, radius_mm).visible.target) << radius_mm;
    for (const auto kind : {cases::LesionKind::cyst, cases::LesionKind::metastasis, cases::LesionKind::haemangioma,
                            cases::LesionKind::abscess, cases::LesionKind::node})
      EXPECT_TRUE(seen_of_kind(kind, radius_mm).visible.target)
          << base::name_of(cases::kLesionKindNames, kind) << " " << radius_mm;
  }
  // As bright as liver, with a halo.
  cases::Lesion lesion = lesion_of_level({0.0, 60.0, 0.0}, 10.0, 0.0);
  lesion.echo->rim_mm = 2.5;
  lesion.echo->rim_db = -12.0;
  Inserted inserted;
  inserted.lesions.push_back(lesion);
  EXPECT_TRUE(ultrasound_visible(liver_about().tissue(), curved_view(100.0), inserted, {}).visible.target);
}

// The same speckle with the lesion and without it.
TEST(LesionPicture, EveryKindHasTheLevelOfItsRow) {
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    if (kind.kind == cases::LesionKind::by_hu || !kind.look.speckled) continue;
    UltrasoundView view = curved_view(100.0);
    view.probe.elements = view.beams = 96;
    view.samples = 400;
    Inserted inserted;
    cases::Lesion lesion = lesion_of_level({0.0, 60.0, 0.0}, 15.0, 0.0);
    lesion.kind = kind.kind;
    lesion.echo = lesion_echo(liver_about().tissue(), lesion);
    inserted.lesions.push_back(lesion);
    // Near its upper side: what sound does not lose within it is no level.
    const auto inside_db = [&](const PolarPicture& picture) {
      return mean_level_db(picture, view,
                           [](double x, double z, double) { return std::abs(x) < 6.0 && z > 49.0 && z < 52.0; });
    };
    const double over_liver_db =
        inside_db(polar_of(liver_about(), view, inserted)) - inside_db(polar_of(liver_about(), view));
    printf("%-26s %5.1f dB over liver, row %5.1f\n", kind.words, over_liver_db, kind.look.inside_db);
    EXPECT_NEAR(over_liver_db, kind.look.inside_db, 1.5) << kind.words;
  }
}

}  // namespace
}  // namespace seldinger::imaging
