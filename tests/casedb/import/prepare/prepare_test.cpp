// A CT is prepared as asked and no other way: as it is it keeps its bits, and each setting does what it says.
#include "casedb/import/prepare.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "casedb/import/skin/closed_mesh.h"
#include "casedb/import/skin/surface.h"
#include "sim/volume/phantom.h"

namespace seldinger::casedb {
namespace {

constexpr double kRadiusMm = 30.0, kHuPerMm = 200.0;

// A ball of tissue at 40 HU in air whose HU fall by kHuPerMm across its edge, −300 at kRadiusMm; a metal bead of
// 3000 HU in its middle.
volume::Volume ball(glm::ivec3 size = {75, 76, 41}, glm::dvec3 spacing_mm = {1.0, 1.0, 2.0}) {
  volume::Volume made = volume::make_volume(size, spacing_mm, glm::dmat3(1.0), {-37.0, -37.0, -40.0});
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i) {
        const double away_mm = glm::length(glm::dvec3(made.lps_from_voxel * glm::dvec4(i, j, k, 1.0)));
        const double hu = std::clamp(-300.0 - kHuPerMm * (away_mm - kRadiusMm), -1000.0, 40.0);
        made.hu[made.index(i, j, k)] = static_cast<std::int16_t>(away_mm < 3.0 ? 3000.0 : std::round(hu));
      }
  return made;
}

Preparation with(double Preparation::*setting, double value) {
  Preparation preparation;
  preparation.*setting = value;
  return preparation;
}

std::string code(const volume::Volume& volume, const Preparation& preparation) {
  const auto prepared = prepare(volume, preparation);
  return prepared ? "" : prepared.error().code;
}

double mean_radius_mm(const cases::Mesh& skin) {
  double sum = 0.0;
  for (const glm::vec3& p : skin.vertices_lps_mm) sum += glm::length(glm::dvec3(p));
  return sum / static_cast<double>(skin.vertices_lps_mm.size());
}

TEST(Prepare, AsItIsEveryBitStays) {
  const volume::Volume original = ball();
  const Prepared prepared = prepare(original, {}).value();
  EXPECT_EQ(prepared.volume.hu, original.hu);
  EXPECT_EQ(prepared.volume.lps_from_voxel, original.lps_from_voxel);
  EXPECT_EQ(cases::bytes_from_mesh(prepared.skin), cases::bytes_from_mesh(skin_surface(original).value()));
  EXPECT_TRUE(prepared.warnings.empty());
  EXPECT_EQ(text_of(Preparation{}), "");
  EXPECT_FALSE(Preparation{}.changes_volume());
}

// What is linear in space is so after blocks are averaged, at the same places; a rest is left out.
TEST(Prepare, ShrinkingKeepsPlacesAndLeavesTheRestOut) {
  const glm::dmat3 turned(glm::dvec3(0.8, 0.6, 0.0), glm::dvec3(-0.6, 0.8, 0.0), glm::dvec3(0.0, 0.0, -1.0));
  volume::Volume original = volume::make_volume({13, 9, 8}, {0.5, 1.5, 2.0}, turned, {10.0, -20.0, 30.0});
  const glm::dvec3 slope(8.0, -5.0, 3.0);
  for (int k = 0; k < 8; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 13; ++i)
        original.hu[original.index(i, j, k)] = static_cast<std::int16_t>(
            std::lround(glm::dot(slope, glm::dvec3(original.lps_from_voxel * glm::dvec4(i, j, k, 1.0)))));
  const volume::Volume small = shrunk(original, {4, 1, 2});
  ASSERT_EQ(small.size_voxels, glm::ivec3(3, 9, 4));
  EXPECT_EQ(small.spacing_mm, glm::dvec3(2.0, 1.5, 4.0));
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 9; ++j)
      for (int i = 0; i < 3; ++i) {
        const glm::dvec3 place(small.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        EXPECT_NEAR(small.at(i, j, k), glm::dot(slope, place), 1.0);
      }
  // The near faces of both volumes are one.
  const glm::dvec3 before(original.lps_from_voxel * glm::dvec4(-0.5, -0.5, -0.5, 1.0)),
      after(small.lps_from_voxel * glm::dvec4(-0.5, -0.5, -0.5, 1.0));
  EXPECT_NEAR(glm::length(after - before), 0.0, 1e-9);
}

TEST(Prepare, ClampingKeepsWhatWasNotMeasured) {
  volume::Volume original = ball();
  std::fill_n(original.hu.begin(), 76, volume::kAirHu);
  Preparation preparation = with(&Preparation::clamp_low_hu, -900.0);
  preparation.clamp_high_hu = 1000.0;
  const Prepared prepared = prepare(original, preparation).value();
  for (std::size_t at = 0; at < original.hu.size(); ++at) {
    const int hu = original.hu[at];
    EXPECT_EQ(prepared.volume.hu[at], hu == volume::kAirHu ? hu : std::clamp(hu, -900, 1000));
  }
}

// The edge falls by a known HU per millimetre: the iso-value tells where the surface is.
TEST(Prepare, TheSkinLiesWhereItsValueIs) {
  Preparation preparation;
  preparation.skin_grid_mm = 1.0;
  const double usual_mm = mean_radius_mm(prepare(ball(), preparation).value().skin);
  EXPECT_NEAR(usual_mm, kRadiusMm, 0.3);
  preparation.skin_hu = -700.0;
  EXPECT_NEAR(mean_radius_mm(prepare(ball(), preparation).value().skin) - usual_mm, 400.0 / kHuPerMm, 0.2);
}

TEST(Prepare, SurfaceSettingsCostWhatTheyTell) {
  const volume::Volume original = ball();
  const FullSurface full = full_surface(original, -300.0).value();
  const auto fidelity = [&](const Preparation& preparation) {
    return fidelity_of(original, full, prepare(original, preparation).value());
  };
  Preparation none;
  none.skin_grid_mm = 0.5;
  none.skin_smooth = none.skin_decimate = 0.0;
  const Fidelity same = fidelity(none);
  EXPECT_TRUE(same.compares_skin);
  EXPECT_LT(same.most_mm, 1e-6) << "the full surface itself";
  EXPECT_EQ(same.triangles, same.full_triangles);
  EXPECT_EQ(same.mean_hu, 0.0);
  std::size_t before = same.triangles;
  for (const double share : {0.3, 0.6, 0.9, 0.97}) {
    Preparation fewer = none;
    fewer.skin_decimate = share;
    const Fidelity found = fidelity(fewer);
    EXPECT_LT(found.triangles, before);
    EXPECT_NEAR(static_cast<double>(found.triangles) / static_cast<double>(same.triangles), 1.0 - share, 0.05);
    EXPECT_GT(found.most_mm, 0.0);
    EXPECT_GE(found.most_mm, found.most_95_mm);
    EXPECT_GE(found.most_95_mm, found.mean_mm);
    EXPECT_LT(found.most_mm, 2.0);
    EXPECT_NEAR(found.decimated, share, 0.05);
    EXPECT_EQ(less_decimated(fewer, found), "");
    before = found.triangles;
  }
  Preparation coarse = none;
  coarse.skin_grid_mm = 4.0;
  EXPECT_LT(fidelity(coarse).triangles, same.triangles / 2);
  Preparation smooth = none;
  smooth.skin_smooth = 30.0;
  EXPECT_GT(fidelity(smooth).mean_mm, 0.0);
  EXPECT_EQ(fidelity(smooth).triangles, same.triangles);
  // A shrunk volume: the bead is blurred, and that is told.
  const Fidelity half = fidelity(with(&Preparation::shrink_i, 2.0));
  EXPECT_GT(half.mean_hu, 1.0);
  EXPECT_LT(half.most_mm, 3.0);
}

// Where taking away as much would open the skin, it stays closed, and both import and window say that less was
// taken.
TEST(Prepare, SaysWhereLessOfTheSkinWasTakenAwayThanWasAsked) {
  Preparation most;
  most.skin_decimate = 0.98;
  const Prepared prepared = prepare(ball(), most).value();
  EXPECT_TRUE(is_closed(prepared.skin));
  Fidelity found;
  found.decimated = 0.97;
  EXPECT_EQ(less_decimated(most, found), "");
  found.decimated = 0.61;
  EXPECT_EQ(less_decimated(most, found),
            "61 % of the skin's triangles were taken away, not 98: more would have opened it");
  EXPECT_NE(told_of(most, prepared, found).text.find(less_decimated(most, found)), std::string::npos);
}

TEST(Prepare, DenoisingIsTold) {
  const Prepared prepared = prepare(ball(), with(&Preparation::denoise, 3.0)).value();
  ASSERT_EQ(prepared.warnings.size(), 1U);
  EXPECT_EQ(prepared.warnings.front().code, "denoised");
  EXPECT_NE(prepared.volume.hu, ball().hu);
}

TEST(Prepare, WhatCannotBeIsRefusedWithItsBounds) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  for (const PreparationRow& row : kPreparationRows) {
    for (const double wrong : {row.least - 1.0, row.most + 1.0, kNan}) {
      const auto refused = check_preparation(with(row.value, wrong));
      ASSERT_FALSE(refused) << row.name << " " << wrong;
      ASSERT_EQ(refused.error().findings.size(), 1U);
      EXPECT_NE(refused.error().findings.front().text.find(row.option), std::string::npos);
    }
    EXPECT_EQ(check_preparation(with(row.value, row.least + 0.25)).has_value(), row.digits > 0) << row.name;
    EXPECT_TRUE(check_preparation(with(row.value, row.least))) << row.name;
    EXPECT_TRUE(check_preparation(with(row.value, row.most))) << row.name;
  }
  EXPECT_EQ(code(ball(), with(&Preparation::shrink_k, 6.0)), "bad_preparation") << "12 mm";
  EXPECT_EQ(code(ball({75, 76, 5}, {1.0, 1.0, 2.0}), with(&Preparation::shrink_k, 2.0)), "bad_preparation");
  EXPECT_EQ(code(ball(), with(&Preparation::shrink_k, 5.0)), "");
}

TEST(Prepare, WhereThereIsNoSkinNoDistanceIsTold) {
  EXPECT_EQ(text_of(Fidelity{}).find("mm"), std::string::npos);
  Fidelity found;
  found.compares_skin = true;
  EXPECT_NE(text_of(found).find("0.00 mm from the full surface on average"), std::string::npos);
}

// Else the body would be the scan's box.
TEST(Prepare, TheSkinLiesAboveTheLowerClamp) {
  Preparation pair = with(&Preparation::clamp_low_hu, -700.0);
  for (const auto& [skin_hu, refused] : {std::pair{-850.0, true}, {-700.0, true}, {-699.0, false}}) {
    pair.skin_hu = skin_hu;
    EXPECT_EQ(check_preparation(pair).has_value(), !refused) << skin_hu;
  }
  pair.skin_hu = -850.0;
  EXPECT_EQ(code(ball(), pair), "bad_preparation");
}

}  // namespace
}  // namespace seldinger::casedb
