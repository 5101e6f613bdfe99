// The case editor without its window: what is placed is stored and checked, what is refused changes nothing, and
// every change can be taken back.
#include "app/window/editor/case_editor.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "casedb/cases/cases.h"
#include "casedb/people/people.h"
#include "sim/imaging/room/room_camera.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

constexpr double kBallMm = 50.0;

class CaseEditorTest : public testing::Test {
 protected:
  // A ball of soft tissue with a rod of bone along z at x = −25, and no lesion yet.
  void SetUp() override {
    library_.emplace(std::move(casedb::Library::open_or_create(folder_).value()));
    fixtures::Ball ball;
    ball.radius_mm = kBallMm;
    ball.inside = {{volume::Sphere{{-25, 0, 0}, 8.0}, 900.0, ""}};
    casedb::NewCase made = fixtures::new_ball(ball);
    made.origin = "phantom:test";
    made.no_burned_in_text = false;
    made.difficulty = casedb::Difficulty::moderate;
    made.planned_entry_lps_mm.reset();
    case_id_ = casedb::add_case(*library_, made);
    ASSERT_TRUE(casedb::add_user(*library_, "mona", casedb::Role::mentor, "a long password"));
    editor_.emplace(*library_, case_id_, "mona");
    ASSERT_TRUE(checked());
  }
  bool checked() {
    return fixtures::until([&] {
      editor_->look();
      return !editor_->checking() && editor_->scene();
    });
  }
  const casedb::Check* check(const std::string& name) const {
    for (const casedb::Check& one : editor_->scene()->check.checks)
      if (one.name == name) return &one;
    return nullptr;
  }
  std::string findings() const {
    std::string text;
    for (const casedb::Check& one : editor_->scene()->check.checks)
      if (!one.holds) text += one.name + ": " + one.text + "\n";
    return text;
  }
  bool holds(const std::string& name) const { return check(name) != nullptr && check(name)->holds; }
  std::size_t stored_lesions() { return casedb::list_lesions(*library_, case_id_).size(); }

  std::filesystem::path folder_ = fixtures::fresh_test_folder("app") / "library";
  std::optional<casedb::Library> library_;
  std::string case_id_;
  std::optional<CaseEditor> editor_;
};

TEST_F(CaseEditorTest, AClickPlacesALesionAndTheChecksSeeIt) {
  EXPECT_FALSE(holds("lesion_present"));
  editor_->tool = EditorTool::lesion;
  editor_->new_lesion.radii_mm = glm::dvec3(6.0);
  editor_->click({-25.0, 0.0, 0.0});
  ASSERT_EQ(stored_lesions(), 1U);
  ASSERT_TRUE(checked());
  EXPECT_TRUE(holds("lesion_present"));
  EXPECT_FALSE(holds("lesion_not_in_bone"));
  ASSERT_TRUE(check("lesion_not_in_bone")->place_lps_mm);
  EXPECT_EQ(*check("lesion_not_in_bone")->place_lps_mm, glm::dvec3(-25.0, 0.0, 0.0));
  editor_->click({15.0, 0.0, 0.0});
  EXPECT_EQ(stored_lesions(), 1U) << "the chosen one is moved";
  ASSERT_TRUE(checked());
  EXPECT_TRUE(editor_->scene()->check.holds()) << findings();
  const auto spot = editor_->spot({16.0, 0.0, 0.0});
  ASSERT_TRUE(spot && spot->hu);
  EXPECT_EQ(*spot->hu, editor_->new_lesion.hu);
  EXPECT_EQ(spot->in, std::vector<std::string>{"lesion 1"});
  EXPECT_NEAR(spot->depth_mm, kBallMm - 16.0, 1.0);
  // The command line's own check says the same.
  const auto row = casedb::find_case(*library_, case_id_).value();
  const auto asked = session::check_case(*library_, row.case_id).value();
  ASSERT_EQ(asked.checks.size(), editor_->scene()->check.checks.size());
  for (std::size_t i = 0; i < asked.checks.size(); ++i) {
    EXPECT_EQ(asked.checks[i].name, editor_->scene()->check.checks[i].name);
    EXPECT_EQ(asked.checks[i].text, editor_->scene()->check.checks[i].text);
  }
}

TEST_F(CaseEditorTest, WhatIsRefusedSaysWhyAndChangesNothing) {
  editor_->tool = EditorTool::lesion;
  editor_->click({500.0, 0.0, 0.0});
  EXPECT_FALSE(editor_->refusal().empty());
  EXPECT_EQ(stored_lesions(), 0U);
  EXPECT_FALSE(editor_->can_undo());
  editor_->click({0.0, 0.0, 0.0});
  EXPECT_TRUE(editor_->refusal().empty()) << editor_->refusal();
  cases::LesionForm form = editor_->lesions().at(0).form;
  form.radii_mm = glm::dvec3(-1.0);
  EXPECT_FALSE(editor_->put_lesion(0, form));
  EXPECT_EQ(casedb::list_lesions(*library_, case_id_).at(0).form.radii_mm.x, editor_->new_lesion.radii_mm.x);
  EXPECT_FALSE(editor_->set_title(""));
  EXPECT_EQ(editor_->row().title, "Ball");
}

TEST_F(CaseEditorTest, ARimIsDraggedAndStoredWhenItIsLetGo) {
  editor_->tool = EditorTool::lesion;
  editor_->click({0.0, 0.0, 4.0});
  const std::string lesion_id = editor_->lesions().at(0).lesion_id;
  editor_->view.set_cursor(editor_->scene()->scene.volume, {0.0, 0.0, 4.0});
  ASSERT_TRUE(editor_->grab(0, {8.0, 0.0, 4.0}, 1.0)) << "its rim";
  editor_->drag(0, {12.0, 0.0, 4.0});
  EXPECT_EQ(editor_->shown_lesions().at(0).radii_mm.x, 12.0);
  EXPECT_EQ(editor_->lesions().at(0).form.radii_mm.x, 8.0) << "not stored yet";
  editor_->let_go();
  EXPECT_EQ(casedb::list_lesions(*library_, case_id_).at(0).form.radii_mm.x, 12.0);
  ASSERT_TRUE(editor_->grab(0, {1.0, 0.0, 4.0}, 2.0)) << "its middle";
  editor_->drag(0, {5.0, 6.0, 4.0});
  editor_->let_go();
  EXPECT_EQ(editor_->lesions().at(0).form.center_lps_mm, glm::dvec3(5.0, 6.0, 4.0));
  EXPECT_EQ(editor_->lesions().at(0).lesion_id, lesion_id) << "it is the same lesion";
  EXPECT_FALSE(editor_->grab(0, {40.0, 0.0, 4.0}, 2.0)) << "nothing is there";
  for (int i = 0; i < 3; ++i) editor_->undo();
  EXPECT_EQ(stored_lesions(), 0U);
  EXPECT_FALSE(editor_->can_undo());
}

TEST_F(CaseEditorTest, StructuresAreDrawnMovedAndTakenBackInTheirOrder) {
  editor_->tool = EditorTool::structure;
  editor_->new_structure.name = "vein";
  editor_->new_structure.drawn = cases::Tube{{}, 3.0};
  editor_->click({10.0, 0.0, -10.0});
  editor_->click({10.0, 0.0, 10.0});
  EXPECT_TRUE(editor_->drawing());
  EXPECT_TRUE(editor_->structures().empty()) << "not finished";
  editor_->finish_drawing();
  ASSERT_EQ(editor_->structures().size(), 1U) << editor_->refusal();
  EXPECT_EQ(std::get<cases::Tube>(editor_->structures()[0].drawn).points_lps_mm.size(), 2U);
  editor_->structure = 1;
  editor_->new_structure.drawn = cases::Sphere{{}, 5.0};
  editor_->click({0.0, 20.0, 0.0});
  ASSERT_EQ(editor_->structures().size(), 2U) << editor_->refusal();
  casedb::StructureRow twice = editor_->structures()[1];
  twice.name = "vein";
  EXPECT_FALSE(editor_->put_structure(1, twice)) << "a name is taken once";
  ASSERT_TRUE(editor_->grab(0, {10.0, 0.0, -10.0}, 2.0));
  EXPECT_EQ(editor_->structure, 0U);
  editor_->drag(0, {14.0, 2.0, -10.0});
  editor_->let_go();
  EXPECT_EQ(std::get<cases::Tube>(editor_->structures()[0].drawn).points_lps_mm[0], glm::dvec3(14.0, 2.0, -10.0));
  ASSERT_TRUE(editor_->remove_structure(0));
  editor_->undo();
  ASSERT_EQ(editor_->structures().size(), 2U);
  EXPECT_EQ(editor_->structures()[0].name, "vein") << "painted in the order in which it was";
  ASSERT_TRUE(checked());
  const auto in = editor_->spot({0.0, 20.0, 0.0})->in;
  ASSERT_EQ(in.size(), 1U);
  EXPECT_EQ(in[0], editor_->structures()[1].name);
}

TEST_F(CaseEditorTest, AnEntryGoesOntoTheSkinAndTheWayToTheTargetIsTold) {
  editor_->tool = EditorTool::lesion;
  editor_->click({0.0, 0.0, 0.0});
  ASSERT_TRUE(checked());
  EXPECT_FALSE(editor_->scene()->way);
  editor_->tool = EditorTool::entry;
  editor_->click({0.0, -40.0, 0.0});
  ASSERT_TRUE(editor_->row().planned_entry_lps_mm);
  EXPECT_NEAR(glm::length(*editor_->row().planned_entry_lps_mm), kBallMm, 0.3);
  ASSERT_TRUE(checked());
  EXPECT_TRUE(holds("entry_on_skin"));
  ASSERT_TRUE(editor_->scene()->way);
  EXPECT_NEAR(editor_->scene()->way->length_mm, kBallMm, 0.3);
  EXPECT_LT(editor_->scene()->way->skin_angle_deg, 5.0);
  EXPECT_TRUE(editor_->scene()->way->free());
  // Through the bone.
  editor_->click({-60.0, 0.0, 0.0});
  ASSERT_TRUE(checked());
  ASSERT_EQ(editor_->scene()->way->parts.size(), 1U);
  const session::WayPart& bone = editor_->scene()->way->parts[0];
  EXPECT_EQ(bone.what, "bone");
  EXPECT_NEAR(bone.from_mm, kBallMm - 25.0 - 8.0, 1.5);
  EXPECT_NEAR(bone.length_mm, 16.0, 2.0);
  EXPECT_FALSE(editor_->scene()->way->free());
  editor_->undo();
  editor_->undo();
  EXPECT_FALSE(editor_->row().planned_entry_lps_mm);
}

TEST_F(CaseEditorTest, OnlyWhatHoldsIsPublishedAndThenNothingIsChanged) {
  editor_->publish(true, "");
  ASSERT_TRUE(checked());
  EXPECT_EQ(editor_->row().state, casedb::CaseState::draft) << "there is no lesion";
  EXPECT_FALSE(editor_->refusal().empty());
  editor_->tool = EditorTool::lesion;
  editor_->click({0.0, 0.0, 0.0});
  editor_->publish(false, "");
  ASSERT_TRUE(checked());
  EXPECT_EQ(editor_->row().state, casedb::CaseState::draft) << "nobody has reviewed it";
  editor_->publish(true, "");
  ASSERT_TRUE(checked());
  // Before: published, and nobody was offered it.
  EXPECT_EQ(editor_->refusal(), "you lead no cohort that the case could reach");
  EXPECT_EQ(editor_->row().state, casedb::CaseState::draft);
  fixtures::make_cohort(*library_, "mona", {});
  editor_->publish(true, "");
  ASSERT_TRUE(checked());
  EXPECT_EQ(editor_->row().state, casedb::CaseState::published) << editor_->refusal();
  EXPECT_FALSE(editor_->locked().empty());
  EXPECT_FALSE(editor_->can_undo());
  editor_->click({10.0, 0.0, 0.0});
  EXPECT_EQ(casedb::list_lesions(*library_, case_id_).at(0).form.center_lps_mm, glm::dvec3(0.0));
}

TEST_F(CaseEditorTest, PlanesLookThroughOneCursor) {
  const volume::Volume& volume = editor_->scene()->scene.volume;
  EditorView view;
  const glm::dvec2 px(400.0, 300.0);
  view.fit(volume, px);
  view.set_cursor(volume, {10.0, -6.0, 8.0});
  for (std::size_t plane = 0; plane < 3; ++plane) {
    const glm::dvec2 at = view.pixel(plane, px, {10.0, -6.0, 8.0});
    EXPECT_LT(glm::distance(view.place(plane, px, at), glm::dvec3(10.0, -6.0, 8.0)), 1e-9) << plane;
    const glm::dvec3 held = view.place(plane, px, {30.0, 40.0});
    view.zoom(plane, px, {30.0, 40.0}, 0.5);
    EXPECT_LT(glm::distance(view.place(plane, px, {30.0, 40.0}), held), 1e-9) << plane;
    view.zoom(plane, px, {30.0, 40.0}, 2.0);
  }
  view.scroll(volume, 0, 2);
  EXPECT_NEAR(std::abs(view.cursor_lps_mm().z - 8.0), 4.0, 1e-9) << "two slices of 2 mm";
  view.set_cursor(volume, {1000.0, 0.0, 0.0});
  EXPECT_NEAR(view.cursor_lps_mm().x, 59.0, 1e-9) << "never outside the CT";
  view.go_to(volume, {20.0, 20.0, 20.0});
  for (std::size_t plane = 0; plane < 3; ++plane)
    EXPECT_LT(glm::distance(view.pixel(plane, px, {20.0, 20.0, 20.0}), 0.5 * px), 1e-9);
}

// Before: at the origin of the scanner's coordinates, wherever the patient lay.
TEST_F(CaseEditorTest, ANewDraftsRoomLooksAtThePatient) {
  const glm::dvec3 up{0.0, -1.0, 0.0};
  const auto looks_at = [&] { return first_look(editor_->scene()->scene, editor_->lesions(), up); };
  EXPECT_LT(glm::distance(looks_at(), glm::dvec3(0.0, -kBallMm, 0.0)), 2.0) << "nothing is drawn: on top of it";
  editor_->tool = EditorTool::lesion;
  editor_->new_lesion.radii_mm = glm::dvec3(6.0);
  editor_->click({30.0, 0.0, 0.0});
  ASSERT_TRUE(checked());
  EXPECT_LT(glm::distance(looks_at(), glm::dvec3(kBallMm, 0.0, 0.0)), 2.0) << "where the lesion is nearest";
  ASSERT_TRUE(editor_->set_entry(glm::dvec3(0.0, 60.0, 0.0)));
  ASSERT_TRUE(checked());
  EXPECT_LT(glm::distance(looks_at(), glm::dvec3(0.0, kBallMm, 0.0)), 2.0) << "at the planned entry";
}

TEST_F(CaseEditorTest, AClickInTheRoomFindsTheSkinThatIsSeen) {
  const cases::Case& scene = editor_->scene()->scene;
  imaging::RoomCamera camera;
  camera.eye_lps_mm = {0.0, -400.0, 0.0};
  const auto projection = imaging::projection_of(camera, 0, 1.0);
  const glm::dvec3 mark(20.0, -std::sqrt(kBallMm * kBallMm - 500.0), 10.0);
  const auto pixel = imaging::pixel_of(projection, mark, 300, 300);
  ASSERT_TRUE(pixel);
  const glm::dvec3 ray = imaging::ray_of(projection, *pixel, 300, 300);
  const auto found = skin_under(scene, projection.eye_lps_mm, ray, std::nullopt);
  ASSERT_TRUE(found);
  EXPECT_LT(glm::distance(*found, mark), 0.6);
  const imaging::CutPlane cut{{1.0, 0.0, 0.0}, 0.0};
  EXPECT_FALSE(skin_under(scene, projection.eye_lps_mm, ray, cut)) << "what is cut away is not clicked";
  EXPECT_FALSE(skin_under(scene, projection.eye_lps_mm, {0.0, -1.0, 0.0}, std::nullopt));
}

}  // namespace
}  // namespace seldinger::app
