// Skin of CTs whose field of view cuts the patient, against the skin of the whole patient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "casedb/import/import.h"
#include "casedb/import/privacy/face.h"
#include "casedb/import/skin/surface.h"
#include "sim/base/rng.h"
#include "sim/volume/analytic.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/body/field_of_view.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/casedb/import/cuts/cut_score.h"
#include "tests/casedb/import/cuts/ways.h"
#include "tests/casedb/import/head_phantom.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

const volume::Volume& torso() {
  static const volume::Volume made = volume::make_phantom({.spacing_mm = glm::dvec3(2, 2, 3)}).volume;
  return made;
}

// The torso drawn at that spacing, without partial volume.
volume::Volume quick_torso(const volume::Way& way) {
  volume::AnalyticVolume shapes = volume::phantom_shapes({.spacing_mm = glm::dvec3(way.spacing_mm)});
  volume::enhance(shapes, way.phase, way.metal);
  volume::LabelMap labels;
  volume::Volume made = volume::rasterize(shapes, labels);
  for (std::size_t at = 0; at < made.hu.size(); ++at)
    made.hu[at] = static_cast<std::int16_t>(
        std::max(double{volume::kAirHu},
                 made.hu[at] + (labels.label[at] == 0 ? 0.5 : 1.0) * way.noise_sd_hu * base::normal_at(7, at)));
  return made;
}

// Twelve of the sixty ways; all of them are run by `./run test --long`.
TEST(CutSkin, OfTheTorsoIsThatOfTheWhole) {
  using volume::TorsoPhase;
  struct Kind {
    int spacing_mm;
    TorsoPhase phase;
    double noise_sd_hu;
    bool metal;
    std::vector<std::string> crops;
  };
  const std::vector<Kind> kinds{
      {2, TorsoPhase::none, 0.0, false, {"left deep", "circle and left", "oblique left front"}},
      {3, TorsoPhase::arterial, 12.0, true, {"front deep", "sides and front", "circle", "all but left"}},
      {3, TorsoPhase::portal, 20.0, false, {"left half", "both sides deep", "a slab of lung"}},
      {5, TorsoPhase::excretory, 6.0, true, {"back, right and feet", "oblique and right"}},
  };
  for (const Kind& kind : kinds) {
    const WholePatient whole(quick_torso({{}, kind.spacing_mm, kind.phase, kind.noise_sd_hu, kind.metal}));
    for (const volume::Crop& crop : volume::crops(kind.crops)) expect_true_skin(whole, crop);
  }
}

// Smoothing moves the rim of a cap inwards where the skin is rough, over vertices within the cap, which stay. Such
// a cap lay double in the air, and all that was nearest to its edge, a hand's breadth below it, was in the body.
TEST(CutSkin, HasTwoSides) {
  for (const double spacing_mm : {2.0, 3.0, 5.0}) {
    const volume::Volume whole = volume::make_phantom({.spacing_mm = glm::dvec3(spacing_mm)}).volume;
    const std::vector<std::uint8_t> body = volume::body_mask(whole);
    for (const volume::Crop& crop : volume::crops({"head deep", "a slab of lung", "both ends"})) {
      const volume::Volume field = volume::cropped(whole, body, crop);
      const auto skin = skin_surface(field);
      ASSERT_TRUE(skin);
      EXPECT_EQ(wrong_sides(cases::MeshIndex(*skin), field), 0) << crop.name << ", " << spacing_mm << " mm";
    }
  }
}

TEST(CutSkin, OfSixtyWaysEachCropIsOneAndEverySpacingMeetsEveryPhase) {
  const std::vector<volume::Way> ways = volume::ways();
  EXPECT_EQ(ways.size(), 60U);
  std::set<std::string> names;
  std::set<std::pair<int, volume::TorsoPhase>> phases;
  std::set<std::pair<int, double>> noises;
  std::set<std::pair<volume::TorsoPhase, bool>> metals;
  for (const volume::Way& way : ways) {
    names.insert(way.crop.name);
    phases.emplace(way.spacing_mm, way.phase);
    noises.emplace(way.spacing_mm, way.noise_sd_hu);
    metals.emplace(way.phase, way.metal);
  }
  EXPECT_EQ(names.size(), 60U);
  EXPECT_EQ(phases.size(), 16U);
  EXPECT_EQ(noises.size(), 12U);
  EXPECT_EQ(metals.size(), 8U);
}

TEST(CutSkin, OfRealCtIsThatOfTheWhole) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read_source(fixtures::shared_data_dir() / "ct-abdomen-pelvis/abdomen_pelvis_2x.mha");
  ASSERT_TRUE(source);
  const WholePatient whole(source->volume);
  for (const volume::Crop& crop : volume::crops({"left deep", "sides and back", "circle narrow"}))
    expect_true_skin(whole, crop);
}

// A program that resamples or cuts a CT fills it with −1000 as often as with what scanners write.
TEST(CutSkin, IsThatOfTheWholeWhateverTheFieldIsFilledWith) {
  const WholePatient whole(quick_torso({{}, 3, volume::TorsoPhase::none, 12.0, false}));
  for (const std::int16_t fill : {std::int16_t{-1000}, std::int16_t{-1024}, std::int16_t{-990}})
    for (const volume::Crop& crop :
         volume::crops({"circle", "circle and left", "oblique left front", "oblique head"})) {
      SCOPED_TRACE(fill);
      expect_true_skin(whole, crop, 0.01, fill);
    }
}

TEST(CutSkin, WhereItEndsIsTold) {
  const volume::Volume coarse = volume::coarser(torso(), 4.0);
  const auto told = [&](const char* name) {
    const volume::Volume field = volume::cropped(coarse, volume::body_mask(coarse), volume::crops({name}).front());
    const auto skin = skin_surface(field);
    EXPECT_TRUE(skin);
    const auto warning = cut_body(*skin, field);
    return warning ? warning->text.substr(0, warning->text.find(':')) : std::string();
  };
  EXPECT_EQ(told("whole"), "");
  EXPECT_EQ(told("head"), "");
  EXPECT_EQ(told("left"), "the CT ends within the patient (left, feet, head)");
  EXPECT_EQ(told("front and right"), "the CT ends within the patient (right, front, feet, head)");
  EXPECT_EQ(told("circle"), "the CT ends within the patient (feet, head, edge of what was reconstructed)");
}

// A back that reaches both sides of the field, and lies on what is as dense as lung in coarse voxels.
TEST(CutSkin, OfABackOnAMattressIsKept) {
  for (const double slope : {0.0, 0.2}) {
    volume::Volume made = volume::make_volume({90, 90, 20}, {2, 2, 3}, glm::dmat3(1.0), glm::dvec3(0.0));
    const auto back_at = [&](int i) { return 60.0 + slope * i; };
    std::size_t body_voxels = 0;
    for (int k = 0; k < 20; ++k)
      for (int j = 0; j < 90; ++j)
        for (int i = 0; i < 90; ++i) {
          const bool body = j >= 20 && j < back_at(i);
          body_voxels += body ? 1 : 0;
          made.hu[made.index(i, j, k)] = body ? 40 : j < 20 ? -1000 : -880;
        }
    const std::vector<std::uint8_t> body = volume::body_mask(made);
    EXPECT_EQ(static_cast<std::size_t>(std::count(body.begin(), body.end(), 1)), body_voxels) << slope;
  }
}

// A belly cut at front and left: air beside it is no gas of a bowel, and gas that the front cuts is.
TEST(CutSkin, OfAPocketAtACornerIsKept) {
  volume::Volume made = volume::make_volume({90, 60, 20}, {2, 2, 3}, glm::dmat3(1.0), glm::dvec3(0.0));
  const auto air = [](int i, int j) { return i < 20 && j < 15; };
  const auto gas = [](int i, int j) { return std::hypot(i - 50.5, j + 4.5) < 16.0; };
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 90; ++i) made.hu[made.index(i, j, k)] = air(i, j) || gas(i, j) ? -1000 : 40;
  const std::vector<std::uint8_t> body = volume::body_mask(made);
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 90; ++i) ASSERT_EQ(body[made.index(i, j, k)], air(i, j) ? 0 : 1) << i << " " << j;
}

// Two thighs that a plane shuts in front: the air between them opens towards the feet, and is no gut's. Nor is it
// where a plane lies obliquely before them. A gut of gas within a thigh that it cuts is none of the room's.
TEST(CutSkin, OfANookBetweenThighsIsKept) {
  volume::Volume made = volume::make_volume({120, 50, 24}, {2, 2, 3}, glm::dmat3(1.0), glm::dvec3(0.0));
  // Joined from slice 20 on, farther apart below.
  const auto thigh = [](int i, int j, int k) {
    return std::hypot(std::abs(i - 59.5) - 30.0 - (20 - k) * 0.4, j - 24.0) <= 32.0;
  };
  const auto gas = [](int i, int j) { return std::hypot(i - 29.5, j + 3.5) < 12.0; };
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 50; ++j)
      for (int i = 0; i < 120; ++i) made.hu[made.index(i, j, k)] = thigh(i, j, k) && !gas(i, j) ? 40 : -1000;
  const std::vector<std::uint8_t> body = volume::body_mask(made);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 50; ++j)
      for (int i = 0; i < 120; ++i)
        ASSERT_EQ(body[made.index(i, j, k)], thigh(i, j, k) ? 1 : 0) << i << " " << j << " " << k;
}

// As between buttocks: a nook that opens to both ends of the CT, narrowest in between.
TEST(CutSkin, OfANookThatOpensToBothEndsIsKept) {
  volume::Volume made = volume::make_volume({120, 56, 24}, {2, 2, 3}, glm::dmat3(1.0), glm::dvec3(0.0));
  const auto side = [](int i, int j, int k) {
    return std::hypot(std::abs(i - 59.5) - 30.0 - 0.15 * std::abs(k - 10), j - 27.5) <= 32.0;
  };
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 56; ++j)
      for (int i = 0; i < 120; ++i) made.hu[made.index(i, j, k)] = side(i, j, k) ? 40 : -1000;
  const std::vector<std::uint8_t> body = volume::body_mask(made);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 56; ++j)
      for (int i = 0; i < 120; ++i)
        ASSERT_EQ(body[made.index(i, j, k)], side(i, j, k) ? 1 : 0) << i << " " << j << " " << k;
}

// Gas over a level of fluid, cut obliquely, is as much of a wedge; it reaches no end of the CT that it opens to.
TEST(CutSkin, OfGasOverFluidThereIsNone) {
  volume::Volume made = volume::make_volume({90, 60, 40}, {2, 2, 3}, glm::dmat3(1.0), glm::dvec3(0.0));
  const auto body_at = [](int i, int j) { return std::hypot((i - 44.5) / 40.0, (j - 35.0) / 40.0) < 1.0; };
  const auto gas = [](int i, int j, int k) {
    return j < 20 - (i - 44) * 0.4 && std::hypot((i - 44.5) / 20.0, (j - 16.0) / 22.0, (k - 20.0) / 14.0) < 1.0;
  };
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 90; ++i) made.hu[made.index(i, j, k)] = body_at(i, j) && !gas(i, j, k) ? 40 : -1000;
  const std::vector<std::uint8_t> body = volume::body_mask(made);
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 90; ++i)
        if (gas(i, j, k) && body_at(i, j)) {
          ASSERT_EQ(body[made.index(i, j, k)], 1) << i << " " << j << " " << k;
        }
}

TEST(CutSkin, WithinTheBodyThereIsNone) {
  volume::Crop crop;
  crop.name = "core";
  crop.faces = {.35, .35, .35, .35, .35, .35};
  const volume::Volume field = volume::cropped(torso(), volume::body_mask(torso()), crop);
  const auto skin = skin_surface(field);
  ASSERT_TRUE(skin);
  EXPECT_EQ(std::count(skin->cut.begin(), skin->cut.end(), 0), 0);
  const auto warning = cut_body(*skin, field);
  ASSERT_TRUE(warning);
  EXPECT_NE(warning->text.find(" 0 % of the surface is skin"), std::string::npos) << warning->text;
}

TEST(CutSkin, WhereAFaceWasTakenAwayThereIsNone) {
  HeadView view;
  view.noise_sd_hu = 10.0;
  const volume::Volume whole = head_volume(view);
  volume::Volume defaced = whole;
  ASSERT_EQ(settle_face(defaced, FaceChoice::deface).value(), FaceState::defaced);
  const auto before = skin_surface(whole), after = skin_surface(defaced);
  ASSERT_TRUE(before && after);
  const cases::MeshIndex skin(*before);
  double skin_mm2 = 0.0, false_mm2 = 0.0, cut_mm2 = 0.0;
  for (std::size_t i = 0; i < after->triangles.size(); ++i) {
    const glm::uvec3& t = after->triangles[i];
    const glm::dvec3 a(after->vertices_lps_mm[t.x]), b(after->vertices_lps_mm[t.y]), c(after->vertices_lps_mm[t.z]);
    const double area_mm2 = 0.5 * glm::length(glm::cross(b - a, c - a));
    (after->cut[i] != 0 ? cut_mm2 : skin_mm2) += area_mm2;
    const bool off = std::abs(skin.closest_skin((a + b + c) / 3.0).distance_mm) > 3.0;
    if (after->cut[i] == 0 && off) false_mm2 += area_mm2;
  }
  EXPECT_GT(cut_mm2, 5000.0);
  EXPECT_GT(skin_mm2, 50000.0);
  EXPECT_LT(false_mm2, 200.0);
}

TEST(Padding, IsACircleAndNoOutlineOfABody) {
  const auto body = volume::body_mask(torso());
  EXPECT_TRUE(volume::padding_of(torso()).empty());
  const volume::Volume circle = volume::cropped(torso(), body, volume::crops({"circle"}).front());
  const auto padding = volume::padding_of(circle);
  ASSERT_EQ(padding.size(), circle.hu.size());
  for (std::size_t at = 0; at < padding.size(); ++at)
    if (padding[at] != 0) {
      ASSERT_EQ(circle.hu[at], volume::kAirHu);
    }
  // A round body in air of one value, as scenes draw it, has skin.
  volume::Volume rod = volume::make_volume({90, 90, 20}, {1, 1, 2}, glm::dmat3(1.0), glm::dvec3(0.0));
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 90; ++j)
      for (int i = 0; i < 90; ++i) rod.hu[rod.index(i, j, k)] = std::hypot(i - 44.5, j - 44.5) < 35.0 ? 40 : -1000;
  EXPECT_TRUE(volume::padding_of(rod).empty());
}

}  // namespace
}  // namespace seldinger::casedb
