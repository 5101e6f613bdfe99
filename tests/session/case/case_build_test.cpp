// A stored case becomes a scene: what was drawn lies in the volume and its classes once, every picture reads it,
// and nothing is built that is not needed.
#include "session/case/case_build.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "casedb/cases/authoring.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/tissue.h"
#include "sim/imaging/xray/exposure.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/imaging/xray/visibility.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::session {
namespace {

using volume::TissueClass;

class CaseBuild : public testing::Test {
 protected:
  std::filesystem::path folder_ = fixtures::fresh_test_folder("app") / "library";
  casedb::Library library_ = std::move(casedb::Library::open_or_create(folder_).value());
  std::string case_id_ = [this] { return casedb::add_case(library_, fixtures::new_ball()); }();

  casedb::CaseRow row() { return casedb::find_case(library_, case_id_).value(); }
  void add(const char* name, cases::Shape shape, TissueClass tissue, std::optional<double> hu) {
    casedb::StructureRow one;
    one.case_id = case_id_;
    one.name = name;
    one.tissue = tissue;
    one.drawn = std::move(shape);
    one.hu = hu;
    ASSERT_TRUE(casedb::add_structure(library_, one));
  }
  cases::Case build(const std::optional<cases::LesionForm>& target, Needs needs) {
    auto scene = build_case(library_, row(), target, {}, needs);
    EXPECT_TRUE(scene.has_value());
    return std::move(*scene);
  }
  static std::size_t at(const cases::Case& scene, const glm::dvec3& p) {
    const glm::ivec3 voxel(glm::floor(glm::dvec3(volume::voxel_from_lps(scene.volume) * glm::dvec4(p, 1.0)) + 0.5));
    return scene.volume.index(voxel.x, voxel.y, voxel.z);
  }
};

cases::LesionForm ellipsoid() {
  cases::LesionForm form;
  form.outline = cases::LesionOutline::ellipsoid;
  form.radii_mm = {16, 6, 6};
  form.hu = 200.0;
  return form;
}

TEST_F(CaseBuild, WhatIsDrawnOverridesHuAndClassInItsOrder) {
  add("duct", cases::Tube{{{-30, 20, 0}, {30, 20, 0}}, 5.0}, TissueClass::fluid, 8.0);
  add("vessel", cases::Sphere{{0, 20, 0}, 8.0}, TissueClass::vessel, 43.0);
  add("outline", cases::Sphere{{0, -25, 0}, 8.0}, TissueClass::kidney, std::nullopt);
  const cases::Case scene = build(ellipsoid(), Needs::ultrasound);
  const auto expect = [&](const glm::dvec3& p, int hu, TissueClass tissue) {
    EXPECT_EQ(scene.volume.hu[at(scene, p)], hu);
    EXPECT_EQ(scene.classes[at(scene, p)], tissue);
  };
  expect({-21, 21, 1}, 8, TissueClass::fluid);
  expect({1, 21, 1}, 43, TissueClass::vessel);   // painted later
  expect({1, -25, 1}, 50, TissueClass::kidney);  // the CT stays
  expect({11, 1, 1}, 200, TissueClass::soft_tissue);
  expect({1, 1, 31}, 50, TissueClass::soft_tissue);
  EXPECT_EQ(scene.echogenicity.size(), scene.volume.hu.size());
  ASSERT_EQ(scene.structures.size(), 3U);
  EXPECT_EQ(scene.structures[1].name, "vessel");
}

// Level over liver's speckle at a place, in dB.
double echo_db(const cases::Case& scene, std::size_t voxel) {
  return imaging::acoustic_table()[static_cast<std::size_t>(scene.classes[voxel])].scatter_db +
         imaging::echo_offset_db(scene.echogenicity[voxel]);
}

TEST_F(CaseBuild, ALesionOfAKindIsAsMuchBrighterAsItsRowSays) {
  cases::LesionForm form = ellipsoid();
  form.hu = 50.0;  // CT shows nothing
  form.kind = cases::LesionKind::haemangioma;
  const cases::Case scene = build(form, Needs::ultrasound);
  ASSERT_TRUE(scene.lesions[0].echo.has_value());
  EXPECT_EQ(scene.classes[at(scene, {1, 1, 1})], cases::about(form.kind).look.sound);
  EXPECT_NEAR(echo_db(scene, at(scene, {1, 1, 1})), scene.lesions[0].echo->inside_db, imaging::kEchoStepDb);
  EXPECT_NEAR(scene.lesions[0].echo->inside_db - echo_db(scene, at(scene, {1, 1, 11})),
              cases::about(form.kind).look.inside_db, 1.0);
}

// A case of before decision 0061 keeps every level it had, and one of after it has layers.
TEST_F(CaseBuild, OrgansAreShownByTheCasesLawOfSight) {
  const cases::Case newer = build({}, Needs::ultrasound);
  EXPECT_NE(newer.echogenicity, imaging::echogenicity(newer.volume, newer.classes));
  library_.database().run("UPDATE training_case SET sight_law = 'half_slice'");
  const cases::Case older = build({}, Needs::ultrasound);
  EXPECT_EQ(older.echogenicity, imaging::echogenicity(older.volume, older.classes));
}

// So do force and tip: a new case has the newest law, one of before keeps its own.
TEST_F(CaseBuild, TouchIsByTheCasesLawAndTip) {
  EXPECT_EQ(build({}, Needs::touch).touch.law, cases::kNewestTouchLaw);
  EXPECT_EQ(build({}, Needs::touch).touch.tip, cases::NeedleTip::bevel);
  library_.database().run("UPDATE training_case SET instrument_tip = 'trocar', touch_law = 'steady'");
  EXPECT_EQ(build({}, Needs::touch).touch.law, cases::TouchLaw::steady);
  EXPECT_EQ(build({}, Needs::touch).touch.tip, cases::NeedleTip::trocar);
}

// The scanner's voltage comes with the CT, where its file said it.
TEST_F(CaseBuild, TheScannersVoltageIsTheFiles) {
  EXPECT_FALSE(build({}, Needs::metrics).ct_tube_kv.has_value());
  casedb::NewCase made = fixtures::new_ball();
  made.attributes = {{"slice_thickness_mm", "5"}, {"tube_voltage_kv", "100"}};
  EXPECT_EQ(build_case(made, {}, Needs::metrics).ct_tube_kv, 100.0);
  case_id_ = casedb::add_case(library_, made);
  EXPECT_EQ(build({}, Needs::touch).ct_tube_kv, 100.0);
}

TEST_F(CaseBuild, OnlyWhatIsNeededIsBuilt) {
  add("vessel", cases::Sphere{{0, 20, 0}, 8.0}, TissueClass::vessel, 43.0);
  EXPECT_TRUE(build(ellipsoid(), Needs::metrics).classes.empty());
  EXPECT_EQ(build(ellipsoid(), Needs::metrics).volume.hu[at(build({}, Needs::metrics), {1, 21, 1})], 43);
  const cases::Case felt = build(ellipsoid(), Needs::touch);
  EXPECT_FALSE(felt.classes.empty());
  EXPECT_TRUE(felt.echogenicity.empty());
}

// What a lesion is sought in before anything is stored is what will be practised.
TEST_F(CaseBuild, ACaseThatIsNotStoredIsBuiltAsTheStoredOne) {
  const casedb::NewCase made = fixtures::new_ball();
  for (const Needs needs : {Needs::metrics, Needs::touch, Needs::ultrasound}) {
    const cases::Case before = build_case(made, {}, needs), stored = build({}, needs);
    EXPECT_EQ(before.volume.hu, stored.volume.hu);
    EXPECT_EQ(before.classes, stored.classes);
    EXPECT_EQ(before.echogenicity, stored.echogenicity);
    EXPECT_EQ(before.skin.triangles, stored.skin.triangles);
    EXPECT_EQ(before.planned_entry_lps_mm, stored.planned_entry_lps_mm);
    EXPECT_EQ(before.fluoroscope.start, stored.fluoroscope.start);
  }
}

TEST_F(CaseBuild, AClassIsAllItsVoxels) {
  casedb::StructureRow air;
  air.case_id = case_id_;
  air.name = "room";
  air.kind = casedb::StructureKind::tissue_class;
  air.tissue = TissueClass::air;
  ASSERT_TRUE(casedb::add_structure(library_, air));
  const cases::Case scene = build({}, Needs::metrics);
  ASSERT_EQ(scene.structures.size(), 1U);
  EXPECT_GT(cases::signed_distance_mm(scene.structures[0].shape, {0, 0, 0}, 60.0), 45.0);
  EXPECT_LT(cases::signed_distance_mm(scene.structures[0].shape, {55, 55, 55}, 5.0), 0.0);
}

// A painted lesion is in a slice by the volume alone: drawing it again as a ball would be wrong beyond its sides.
TEST_F(CaseBuild, ASliceShowsAPaintedLesionOnce) {
  const cases::Case scene = build(ellipsoid(), Needs::metrics);
  imaging::MprView view;
  view.u = {1, 0, 0};
  view.v = {0, 1, 0};
  view.pixel_mm = 2.0;
  view.width_px = view.height_px = 41;
  const auto with = imaging::mpr_cpu(scene.volume, view, {std::nullopt, scene.lesions});
  EXPECT_EQ(with, imaging::mpr_cpu(scene.volume, view, {}));
  const auto reference = imaging::mpr_reference(scene.volume, view, {std::nullopt, scene.lesions});
  for (std::size_t i = 0; i < with.size(); ++i) ASSERT_NEAR(with[i], reference[i], 0.01F);
  const auto hu = [&](int x_mm, int y_mm) {
    return with[static_cast<std::size_t>(20 + y_mm / 2) * 41U + static_cast<std::size_t>(20 + x_mm / 2)];
  };
  EXPECT_NEAR(hu(12, 0), 200.0, 1.0);  // beyond the ball of its volume, 8.3 mm
  EXPECT_NEAR(hu(0, 8), 50.0, 1.0);    // within that ball, outside the ellipsoid
}

// What X-ray lengths gain by a painted lesion is its chord in water.
TEST_F(CaseBuild, XRayLengthsTakeThePaintedChord) {
  const cases::Case plain = build({}, Needs::metrics), scene = build(ellipsoid(), Needs::metrics);
  const auto water = [](const cases::Case& one, const glm::dvec3& from, const glm::dvec3& to) {
    const imaging::RayLengths lengths = imaging::lengths_between(one.volume, from, to);
    return lengths.water_mm + lengths.mineral_mm;
  };
  const glm::dvec3 a(-58, 0.5, 0.5), b(58, 0.5, 0.5);
  const imaging::RayLengths of_lesion = imaging::lengths_between(scene.volume, {-4, 1, 1}, {4, 1, 1});
  const imaging::RayLengths of_tissue = imaging::lengths_between(plain.volume, {-4, 1, 1}, {4, 1, 1});
  const double per_mm =
      (of_lesion.water_mm + of_lesion.mineral_mm - of_tissue.water_mm - of_tissue.mineral_mm) / 8.0;
  EXPECT_NEAR(water(scene, a, b) - water(plain, a, b), 2.0 * 16.0 * per_mm, 2.0 * std::abs(per_mm));
}

// Told as the ball of its volume against what was there: as a plain sphere of the same HU is.
TEST_F(CaseBuild, APaintedSphereIsSeenLikeADrawnOne) {
  cases::LesionForm form;
  form.radii_mm = glm::dvec3(8.0);
  form.hu = 500.0;
  const cases::Case drawn = build(form, Needs::metrics);
  ASSERT_FALSE(drawn.lesions[0].in_volume());
  form.edge_mm = 0.01;
  const cases::Case painted = build(form, Needs::metrics);
  ASSERT_TRUE(painted.lesions[0].in_volume());
  EXPECT_NEAR(painted.lesions[0].around_hu, 50.0, 0.5);
  EXPECT_NEAR(painted.lesions[0].hu, 500.0, 60.0) << "its mean, voxels across the surface counted";
  EXPECT_NEAR(painted.lesions[0].radius_mm, 8.0, 1e-12);
}

}  // namespace
}  // namespace seldinger::session
