// Skin of CTs whose field of view cuts the patient, against the skin of the whole patient.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "casedb/import/import.h"
#include "casedb/import/skin/surface.h"
#include "sim/volume/body_mask.h"
#include "sim/volume/field_of_view.h"
#include "sim/volume/phantom.h"
#include "tests/casedb/import/cuts/cropped.h"
#include "tests/casedb/import/cuts/cut_score.h"
#include "tests/fixtures/shared_data.h"

namespace seldinger::casedb {
namespace {

const volume::Volume& torso() {
  static const volume::Volume made = volume::make_phantom({.spacing_mm = {2, 2, 3}}).volume;
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
  const auto told = [](const char* name) {
    const volume::Volume field =
        volume::cropped(torso(), volume::body_mask(torso()), volume::crops({name}).front());
    const auto skin = skin_surface(field);
    EXPECT_TRUE(skin);
    const auto warning = cut_body(*skin, field);
    return warning ? warning->text : std::string();
  };
  EXPECT_EQ(told("whole"), "");
  EXPECT_EQ(told("head"), "");
  EXPECT_EQ(told("left").substr(0, told("left").find(')') + 1),
            "the CT ends within the patient (left, feet, head)");
  EXPECT_EQ(told("front and right").substr(0, told("front and right").find(')') + 1),
            "the CT ends within the patient (right, front, feet, head)");
  EXPECT_NE(told("circle").find("edge of what was reconstructed"), std::string::npos);
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
