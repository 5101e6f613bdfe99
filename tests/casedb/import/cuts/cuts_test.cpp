// Skin of CTs whose field of view cuts the patient, against the skin of the whole patient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "casedb/import/import.h"
#include "casedb/import/privacy/face.h"
#include "casedb/import/skin/surface.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/body/field_of_view.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/casedb/import/cuts/cut_score.h"
#include "tests/casedb/import/head_phantom.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

const volume::Volume& torso() {
  static const volume::Volume made = volume::make_phantom({.spacing_mm = glm::dvec3(2, 2, 3)}).volume;
  return made;
}

TEST(CutSkin, OfTheTorsoIsThatOfTheWhole) {
  const WholePatient whole(torso());
  for (const volume::Crop& crop :
       volume::crops({"whole", "left deep", "right", "front deep", "back", "both sides deep", "sides and front",
                      "left half", "five faces", "circle", "circle and left", "oblique left front"}))
    expect_true_skin(whole, crop);
}

TEST(CutSkin, OfRealCtIsThatOfTheWhole) {
  SELDINGER_NEEDS_SHARED_DATA();
  const auto source = read_source(fixtures::shared_data_dir() / "ct-abdomen-pelvis/abdomen_pelvis_2x.mha");
  ASSERT_TRUE(source);
  const WholePatient whole(source->volume);
  for (const volume::Crop& crop : volume::crops({"left deep", "sides and back", "circle narrow"}))
    expect_true_skin(whole, crop);
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
