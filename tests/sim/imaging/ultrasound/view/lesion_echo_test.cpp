// What a lesion of a kind is to sound in the tissue it lies in, drawn by the picture or written into the volume.
#include "sim/imaging/ultrasound/view/lesion_echo.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "sim/base/rng.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"

namespace seldinger::imaging {
namespace {

cases::Lesion in_the_middle(cases::LesionKind kind, double radius_mm = 12.0) {
  cases::Lesion lesion;
  lesion.center_lps_mm = {0.0, 60.0, 0.0};
  lesion.radius_mm = radius_mm;
  lesion.hu = 40.0;
  lesion.kind = kind;
  return lesion;
}

double level_at(const TissueAt& tissue_at, const glm::dvec3& p) {
  return 20.0 * std::log10(static_cast<double>(tissue_at.speckle(p)));
}

TEST(LesionEcho, IsRelativeToWhatLiesAboutIt) {
  for (const TissueClass about : {TissueClass::liver, TissueClass::kidney, TissueClass::muscle}) {
    const double about_db = acoustic_table()[static_cast<std::size_t>(about)].scatter_db;
    const Scene s = all_of(about);
    for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
      if (kind.kind == cases::LesionKind::by_hu || !kind.look.speckled) continue;
      const cases::LesionEcho echo = lesion_echo(s.tissue(), in_the_middle(kind.kind));
      EXPECT_NEAR(echo.inside_db, about_db + kind.look.inside_db, 1e-4) << kind.words;
      EXPECT_NEAR(echo.rim_db, about_db + kind.look.rim_db, 1e-4) << kind.words;
      EXPECT_EQ(echo.rim, about) << kind.words;
    }
  }
}

TEST(LesionEcho, ACystIsBlackWhereverItLies) {
  const cases::LesionEcho echo =
      lesion_echo(all_of(TissueClass::kidney).tissue(), in_the_middle(cases::LesionKind::cyst));
  EXPECT_EQ(echo.inside, TissueClass::fluid);
  EXPECT_LE(echo.inside_db, -50.0);
}

// Before there were kinds, and by HU still: the class's level, no rim.
TEST(LesionEcho, ByHuIsItsTissueAlone) {
  const cases::Lesion lesion = in_the_middle(cases::LesionKind::by_hu);
  const cases::LesionEcho echo = echo_of(lesion);
  EXPECT_EQ(echo.inside, cases::tissue_of_lesion(lesion.hu));
  EXPECT_EQ(inner_radius_mm(lesion, echo), lesion.radius_mm);
  const Scene s = all_of(TissueClass::liver);
  Inserted inserted;
  inserted.lesions.push_back(lesion);
  EXPECT_EQ(TissueAt(s.tissue(), inserted).speckle(lesion.center_lps_mm),
            speckle_amplitudes()[static_cast<std::size_t>(echo.inside)]);
}

TEST(LesionEcho, WrittenIntoTheVolumeItIsWhatThePictureWouldDraw) {
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    if (kind.kind == cases::LesionKind::by_hu) continue;
    Scene s = all_of(TissueClass::liver);
    std::vector<std::uint8_t> levels(s.classes.size(), kNoEchoOffset);
    std::vector<cases::Lesion> drawn = {in_the_middle(kind.kind)};
    settle_lesions(s.volume, s.classes, levels, drawn);
    EXPECT_EQ(std::count(levels.begin(), levels.end(), kNoEchoOffset), std::ssize(levels)) << "only settled";
    const TissueVolume before{&s.volume, s.classes, levels};
    Inserted inserted;
    inserted.lesions = drawn;
    const TissueAt as_drawn(before, inserted);

    std::vector<TissueClass> classes = s.classes;
    std::vector<cases::Lesion> painted = {in_the_middle(kind.kind)};
    painted[0].shape = std::make_shared<const cases::Shape>(cases::shape_of(painted[0]));
    settle_lesions(s.volume, classes, levels, painted);
    const TissueVolume after{&s.volume, classes, levels};
    inserted.lesions = painted;
    const TissueAt as_painted(after, inserted);
    for (const double along_mm : {0.0, 5.0, 10.6, 11.4, 20.0}) {
      // In the middle of a voxel: its texture is that of the whole voxel.
      const glm::dvec3 along = painted[0].center_lps_mm + glm::dvec3(along_mm, 0.0, 0.0);
      const glm::dvec4 voxel = glm::round(volume::voxel_from_lps(s.volume) * glm::dvec4(along, 1.0));
      const glm::dvec3 p(s.volume.lps_from_voxel * voxel);
      EXPECT_NEAR(level_at(as_drawn, p), level_at(as_painted, p), 0.5 * kEchoStepDb + 1e-3)
          << kind.words << " at " << along_mm;
      EXPECT_EQ(as_drawn(p), as_painted(p)) << kind.words << " at " << along_mm;
    }
  }
}

TEST(LesionEcho, ARimLiesWithinTheLesion) {
  const Scene s = all_of(TissueClass::liver);
  std::vector<cases::Lesion> lesions = {in_the_middle(cases::LesionKind::metastasis)};
  lesions[0].echo = lesion_echo(s.tissue(), lesions[0]);
  lesions[0].echo->texture = {}, lesions[0].echo->texture_db = 0.0;
  lesions[0].echo->margin_mm = 0.0;
  Inserted inserted;
  inserted.lesions = lesions;
  const TissueAt tissue_at(s.tissue(), inserted);
  const cases::LesionLook& look = cases::about(cases::LesionKind::metastasis).look;
  const auto level = [&](double along_mm) {
    return level_at(tissue_at, lesions[0].center_lps_mm + glm::dvec3(along_mm, 0.0, 0.0));
  };
  EXPECT_NEAR(level(0.0), look.inside_db, 1e-3);
  EXPECT_NEAR(level(12.0 - look.rim_mm - 0.1), look.inside_db, 1e-3);
  EXPECT_NEAR(level(12.0 - look.rim_mm + 0.1), look.rim_db, 1e-3);
  EXPECT_NEAR(level(11.9), look.rim_db, 1e-3);
  EXPECT_NEAR(level(12.1), 0.0, 1e-3);
}

// Mean square echo, from the lesion's own to what lies about it as straight as a line.
TEST(LesionEcho, PassesIntoItsSurroundingsOverItsMargin) {
  const Scene s = all_of(TissueClass::kidney);
  const double about =
      std::pow(10.0, 0.1 * acoustic_table()[static_cast<std::size_t>(TissueClass::kidney)].scatter_db);
  for (const double margin_mm : {0.7, 2.0, 5.0})
    for (const double level_db : {-10.0, 6.0}) {
      cases::Lesion lesion = in_the_middle(cases::LesionKind::node);
      lesion.echo = lesion_echo(s.tissue(), lesion);
      lesion.echo->margin_mm = margin_mm;
      lesion.echo->inside_db += level_db - cases::about(lesion.kind).look.inside_db;
      Inserted inserted;
      inserted.lesions = {lesion};
      const TissueAt tissue_at(s.tissue(), inserted);
      double own_mm = 0.0;
      for (int i = 0; i < 1200; ++i) {
        const double out_mm = 0.01 * (i + 0.5), depth_mm = lesion.radius_mm - out_mm;
        const double power = std::pow(
            static_cast<double>(tissue_at.speckle(lesion.center_lps_mm + glm::dvec3(0.0, 0.0, out_mm))), 2.0);
        const double share = (power / about - 1.0) / (std::pow(10.0, 0.1 * level_db) - 1.0);
        EXPECT_NEAR(share, std::min(1.0, depth_mm / margin_mm), 1e-4) << margin_mm << " " << depth_mm;
        own_mm += 0.01 * share;
      }
      EXPECT_NEAR(own_mm, seen_radius_mm(lesion, *lesion.echo), 0.01);
    }
}

TEST(LesionEcho, OfOneThatIsAllMarginLessIsSeen) {
  cases::Lesion lesion = in_the_middle(cases::LesionKind::node, 2.0);
  cases::LesionEcho echo;
  for (const auto& [margin_mm, seen_mm] : {std::pair{0.0, 2.0}, {1.0, 1.5}, {2.0, 1.0}, {4.0, 0.5}}) {
    echo.margin_mm = margin_mm;
    EXPECT_NEAR(seen_radius_mm(lesion, echo), seen_mm, 1e-12) << margin_mm;
  }
}

// Speckle of a part of a picture asks its lesions only where one can be: no place within reach of it may lie in one
// that was left out, whatever part it is.
TEST(LesionEcho, NoneIsLeftOutThatLiesNear) {
  const Scene s = all_of(TissueClass::liver);
  Inserted inserted;
  base::Rng rng(7);
  const auto any = [&](double half_mm) {
    return glm::dvec3(0.0, 60.0, 0.0) +
           half_mm * (2.0 * glm::dvec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0);
  };
  for (const double radius_mm : {2.0, 6.0, 12.0}) {
    inserted.lesions.push_back(in_the_middle(cases::LesionKind::hcc, radius_mm));
    inserted.lesions.back().center_lps_mm = any(15.0);
  }
  const TissueAt tissue_at(s.tissue(), inserted);
  int near = 0, left_out = 0;
  for (int i = 0; i < 2000; ++i) {
    const glm::dvec3 middle = any(25.0);
    const double reach_mm = 8.0 * rng.uniform();
    const bool asked = tissue_at.has_lesions_near(middle, reach_mm);
    bool met = false;
    for (int j = 0; j < 50; ++j) {
      const glm::dvec3 way = any(1.0) - glm::dvec3(0.0, 60.0, 0.0);
      met |= tissue_at.speckle_of_lesion(middle + reach_mm * way / std::max(1.0, glm::length(way))).has_value();
    }
    if (met) {
      EXPECT_TRUE(asked);
    }
    ++(asked ? near : left_out);
  }
  EXPECT_GT(near, 200);
  EXPECT_GT(left_out, 200);
}

// A cyst of a few mm is black wherever it lies between the parts that a picture is made of.
TEST(LesionEcho, ASmallCystIsBlackAcrossThePicturesParts) {
  const Scene s = all_of(TissueClass::liver);
  for (const UltrasoundView& view : {curved_view(100.0), straight_view(50.0)}) {
    const PolarPicture without = polar_of(s, view);
    for (int i = 0; i < 12; ++i) {
      const double beam = 30.0 + 5.7 * i, depth_mm = (0.25 + 0.035 * i) * view.depth_mm;
      Inserted inserted;
      inserted.lesions = {in_the_middle(cases::LesionKind::cyst, 5.0)};
      inserted.lesions[0].center_lps_mm = point_of(view, beam, depth_mm);
      inserted.lesions[0].echo = lesion_echo(s.tissue(), inserted.lesions[0]);
      const PolarPicture with = polar_of(s, view, inserted);
      const int b = static_cast<int>(beam), first = sample_at(view, depth_mm - 1.0),
                end = sample_at(view, depth_mm + 1.0);
      EXPECT_LT(level_db(with, b - 1, b + 2, first, end), level_db(without, b - 1, b + 2, first, end) - 12.0)
          << beam << " " << depth_mm;
    }
  }
}

// Which of them have one is the table's to say; by the older laws none has.
TEST(LesionEcho, HasItsKindsTextureAndMarginByTheNewestLaw) {
  Scene s = all_of(TissueClass::liver);
  std::vector<std::uint8_t> levels(s.classes.size(), kNoEchoOffset);
  int textured = 0, soft = 0;
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    if (kind.kind == cases::LesionKind::by_hu) continue;
    std::vector<cases::Lesion> lesions = {in_the_middle(kind.kind)};
    settle_lesions(s.volume, s.classes, levels, lesions, cases::SightLaw::clutter);
    EXPECT_EQ(lesions[0].echo->texture.sd_db, 0.0) << kind.words;
    settle_lesions(s.volume, s.classes, levels, lesions, cases::SightLaw::material);
    EXPECT_EQ(lesions[0].echo->margin_mm, 0.0) << kind.words;
    settle_lesions(s.volume, s.classes, levels, lesions);
    EXPECT_EQ(lesions[0].echo->margin_mm, kind.look.margin_mm) << kind.words;
    soft += kind.look.margin_mm > 0.0 ? 1 : 0;
    EXPECT_EQ(lesions[0].echo->texture.sd_db, kind.look.texture.sd_db) << kind.words;
    EXPECT_EQ(lesions[0].echo->texture.grain_mm, kind.look.texture.grain_mm) << kind.words;
    textured += kind.look.texture.sd_db > 0.0 ? 1 : 0;
  }
  EXPECT_EQ(textured, 3);
  EXPECT_EQ(soft, 2);
}

// A small one has few grains, whose mean square is by chance another than of many.
TEST(LesionEcho, OfATextureTheMeanSquareIsThatOfItsRowInEachLesion) {
  const Scene s = all_of(TissueClass::liver);
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    if (kind.look.texture.sd_db == 0.0) continue;
    for (const double radius_mm : {4.0, 7.5, 15.0})
      for (int at = 0; at < 6; ++at) {
        cases::Lesion lesion = in_the_middle(kind.kind, radius_mm);
        lesion.center_lps_mm.x += 1.7 * at;
        lesion.echo = lesion_echo(s.tissue(), lesion);
        Inserted inserted;
        inserted.lesions.push_back(lesion);
        const TissueAt tissue_at(s.tissue(), inserted);
        const double inner_mm = inner_radius_mm(lesion, *lesion.echo) - 1e-6;
        double power = 0.0;
        int count = 0;
        for (double x = -inner_mm; x <= inner_mm; x += 0.37)
          for (double y = -inner_mm; y <= inner_mm; y += 0.37)
            for (double z = -inner_mm; z <= inner_mm; z += 0.37) {
              if (x * x + y * y + z * z > inner_mm * inner_mm) continue;
              power +=
                  std::pow(static_cast<double>(tissue_at.speckle(lesion.center_lps_mm + glm::dvec3(x, y, z))), 2.0);
              ++count;
            }
        EXPECT_NEAR(10.0 * std::log10(power / count), lesion.echo->inside_db, 0.25)
            << kind.words << ", " << radius_mm;
      }
  }
}

// Levels in dB of a textured lesion's inside, relative to its own, on a grid of a tenth of a grain.
TEST(LesionEcho, ATextureSpreadsAsItsRowSaysAndKeepsTheMeanSquare) {
  constexpr int kSide = 60;
  for (const cases::LesionKindRow& kind : cases::lesion_kinds()) {
    const auto& [sd_db, grain_mm] = kind.look.texture;
    if (sd_db == 0.0) continue;
    double power = 0.0, sum = 0.0, squares = 0.0, near = 0.0, far = 0.0;
    int count = 0;
    for (int seed = 0; seed < 8; ++seed) {
      cases::Lesion lesion = in_the_middle(kind.kind, 40.0);
      lesion.center_lps_mm.x += seed;
      const Texture texture(lesion, {.texture = kind.look.texture});
      const auto db = [&](double x, double y, double z) {
        return 20.0 * std::log10(static_cast<double>(texture.at(0.1 * grain_mm * glm::dvec3(x, y, z))));
      };
      for (int i = 0; i < kSide; i += 3)
        for (int j = 0; j < kSide; j += 3)
          for (int k = 0; k < kSide; k += 3, ++count) {
            const double here = db(i, j, k);
            power += std::pow(10.0, 0.1 * here);
            sum += here, squares += here * here;
            near += std::pow(here - db(i + 1.0, j, k), 2.0), far += std::pow(here - db(i + 25.0, j, k), 2.0);
          }
    }
    EXPECT_NEAR(10.0 * std::log10(power / count), 0.0, 0.15) << kind.words;
    const double variance = squares / count - std::pow(sum / count, 2.0);
    EXPECT_NEAR(std::sqrt(variance), sd_db, 0.1 * sd_db) << kind.words;
    EXPECT_LT(near / count, 0.1 * variance) << kind.words << ": a tenth of a grain away it is nearly the same";
    EXPECT_NEAR(far / count, 2.0 * variance, 0.2 * variance) << kind.words << ": beyond two grains another";
  }
}

}  // namespace
}  // namespace seldinger::imaging
