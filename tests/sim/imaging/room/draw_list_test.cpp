// What is in a picture's list, without GL.
#include "sim/imaging/room/draw_list.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

#include "sim/imaging/probe.h"
#include "sim/imaging/room/scan_border.h"
#include "tests/fixtures/allocations.h"
#include "tests/sim/imaging/room/room_fixture.h"

namespace seldinger::imaging {
namespace {

const RoomItem* find(const DrawList& list, RoomPart part) {
  const auto at =
      std::find_if(list.items.begin(), list.items.end(), [&](const auto& item) { return item.part == part; });
  return at == list.items.end() ? nullptr : &*at;
}

DrawList list_of(const cases::Case& scene, const cases::State& state, const RoomOptions& options = {},
                 const RoomWish& wish = {}) {
  DrawList list;
  make_draw_list(make_room_model(scene, wish), scene, state, options, list);
  return list;
}

glm::dvec3 placed(const RoomItem& item, const glm::dvec3& p) {
  return glm::dvec3(item.lps_from_mesh * glm::dvec4(p, 1.0));
}

TEST(DrawList, ShowsNothingThatTheRoomDoesNotShowUnlessAsked) {
  const DrawList list = list_of(ball_case(), ball_state());
  for (const RoomPart part : {RoomPart::skin, RoomPart::table, RoomPart::floor, RoomPart::walls,
                              RoomPart::needle_shaft, RoomPart::needle_hub, RoomPart::probe})
    EXPECT_NE(find(list, part), nullptr) << static_cast<int>(part);
  for (const RoomPart part : {RoomPart::target, RoomPart::structure, RoomPart::bone, RoomPart::planned_path,
                              RoomPart::planned_entry, RoomPart::scan_plane, RoomPart::guide_line, RoomPart::tube,
                              RoomPart::detector, RoomPart::cut_end, RoomPart::drape})
    EXPECT_EQ(find(list, part), nullptr) << static_cast<int>(part);
  EXPECT_FALSE(list.cut);
}

TEST(DrawList, AWhealLiesOnTheSkinWhereItIsNumb) {
  const cases::Case scene = ball_case();
  const glm::dvec3 place = scene.skin_index.closest_skin(*scene.planned_entry_lps_mm).point_lps_mm;
  EXPECT_EQ(find(list_of(scene, ball_state()), RoomPart::wheal), nullptr);
  RoomOptions options;
  options.numb_lps_mm = {&place, 1};
  const DrawList list = list_of(scene, ball_state(), options);
  const RoomItem* wheal = find(list, RoomPart::wheal);
  ASSERT_NE(wheal, nullptr);
  EXPECT_LT(glm::distance(placed(*wheal, {0.0, 0.0, 0.0}), place), 1e-9);
  const double high_mm = glm::distance(placed(*wheal, {0.0, 0.0, 1.0}), place),
               wide_mm = glm::distance(placed(*wheal, {1.0, 0.0, 0.0}), place);
  EXPECT_GT(wide_mm, 2.0 * high_mm) << "flat";
  EXPECT_FALSE(wheal->over_all) << "a thing in the room, not a mark over it";
}

TEST(DrawList, ANickIsASlitInTheSkinAcrossTheBody) {
  const cases::Case scene = ball_case();
  const glm::dvec3 skin = scene.skin_index.closest_skin(*scene.planned_entry_lps_mm).point_lps_mm;
  EXPECT_EQ(find(list_of(scene, ball_state()), RoomPart::nick), nullptr);
  // Where the needle pointed: as far above the skin as it was held.
  const glm::dvec3 places[] = {skin + 0.5 * glm::normalize(skin), skin};
  RoomOptions options;
  options.nicks_lps_mm = places;
  const DrawList list = list_of(scene, ball_state(), options);
  const auto count = std::count_if(list.items.begin(), list.items.end(),
                                   [](const RoomItem& item) { return item.part == RoomPart::nick; });
  EXPECT_EQ(count, 2);
  const RoomItem* nick = find(list, RoomPart::nick);
  ASSERT_NE(nick, nullptr);
  EXPECT_LT(glm::distance(placed(*nick, {0.0, 0.0, 0.0}), skin), 0.1);
  const auto half_mm = [&](const glm::dvec3& axis) { return glm::distance(placed(*nick, axis), skin); };
  EXPECT_NEAR(2.0 * half_mm({1.0, 0.0, 0.0}), 4.0, 0.2) << "a blade's prick: 3 to 5 mm";
  EXPECT_LT(half_mm({0.0, 1.0, 0.0}), 1.0);
  EXPECT_LT(half_mm({0.0, 0.0, 1.0}), 0.5);
  EXPECT_FALSE(nick->over_all) << "a thing in the room, not a mark over it";
}

TEST(DrawList, AnIntroducerStandsWhereItIsWhereverTheNeedleIs) {
  const cases::Case scene = ball_case();
  cases::State state = ball_state();
  EXPECT_EQ(find(list_of(scene, state), RoomPart::introducer), nullptr);
  const glm::dvec3 end(3.0, -30.0, 7.0), axis = glm::normalize(glm::dvec3(0.2, 1.0, 0.1));
  RoomOptions options;
  options.introducer = RoomIntroducer{end, axis};
  state.needle.tip_lps_mm = {0.0, -200.0, 0.0};  // drawn out of it
  const DrawList list = list_of(scene, state, options);
  std::vector<RoomItem> its;
  for (const RoomItem& item : list.items)
    if (item.part == RoomPart::introducer) its.push_back(item);
  ASSERT_EQ(its.size(), 2U) << "tube and hub";
  const glm::dvec3 outer = placed(its[0], {0.0, 0.0, 0.0});
  EXPECT_LT(glm::distance(placed(its[0], {0.0, 0.0, 1.0}), end), 1e-9);
  EXPECT_LT(glm::length(glm::cross(end - outer, axis)), 1e-9);
  EXPECT_NEAR(glm::distance(end, outer), scene.instrument.length_mm - 30.0, 1e-9);
  EXPECT_NEAR(glm::distance(placed(its[0], {1.0, 0.0, 0.0}), outer), scene.instrument.radius_mm + 0.1, 1e-9)
      << "the needle goes through it";
  EXPECT_LT(glm::distance(placed(its[1], {0.0, 0.0, 0.0}), outer), 1e-9);
  EXPECT_FALSE(its[0].over_all) << "a thing in the room, not a mark over it";
}

TEST(DrawList, HelpGrowsByLevels) {
  const std::vector<std::vector<RoomPart>> more = {{},
                                                   {RoomPart::scan_plane},
                                                   {RoomPart::planned_entry, RoomPart::guide_line},
                                                   {RoomPart::target, RoomPart::planned_path}};
  const std::size_t bare = list_of(ball_case(), ball_state()).items.size();
  std::size_t expected = bare;
  for (int help = 0; help <= 3; ++help) {
    RoomOptions options;
    options.help = help;
    const DrawList list = list_of(ball_case(), ball_state(), options);
    expected += more[static_cast<std::size_t>(help)].size();
    EXPECT_EQ(list.items.size(), expected) << help;
    for (int level = 0; level <= help; ++level)
      for (const RoomPart part : more[static_cast<std::size_t>(level)]) {
        ASSERT_NE(find(list, part), nullptr) << help;
        EXPECT_EQ(find(list, part)->casts, Casts::nothing);
        EXPECT_LT(find(list, part)->colour.a, 1.0F);
      }
  }
}

// The outline in the room is that of the picture as its console stands.
TEST(DrawList, TheScanPlaneFollowsTheConsole) {
  for (const char* probe : {"L11-5v", "C5-2v"}) {
    cases::Case scene = ball_case();
    scene.picture.modality = cases::Modality::ultrasound;
    scene.picture.probe = probe;
    scene.picture.depth_mm = 50.0;
    RoomOptions options;
    options.help = 1;
    cases::State state = ball_state();
    const auto deepest_mm = [&] {
      double deepest = 0.0;
      for (const RoomItem& item : list_of(scene, state, options).items)
        if (item.part == RoomPart::scan_plane)
          for (const glm::dvec3& end : {placed(item, {0, 0, 0}), placed(item, {0, 0, 1})})
            deepest = std::max(deepest, glm::dot(end - state.probe.origin_lps_mm, state.probe.axial));
      return deepest;
    };
    state.probe.console.depth_mm = 90.0;
    EXPECT_NEAR(deepest_mm(), 90.0, 0.01) << probe;
    state.probe.console.depth_mm = 1e6;
    EXPECT_NEAR(deepest_mm(), probe_named(probe)->most_depth_mm, 0.01) << probe;
  }
  // A slice beside the probe's plane lies there.
  cases::Picture slices;
  for (const glm::dvec3& corner : scan_border(slices, {0.0, 0.0, 0.0, -12.0}, 1)) EXPECT_EQ(corner.y, -12.0);
  for (const glm::dvec3& corner : scan_border(slices, {}, 1)) EXPECT_EQ(corner.y, 0.0);
}

TEST(DrawList, LooksInsideForAMentorOnly) {
  cases::Case scene = ball_case();
  scene.structures.push_back(
      {"vessel", {}, cases::StructureRule::critical, cases::Tube{{{0, 0, 0}, {0, 0, 30}}, 4.0}});
  RoomOptions options;
  options.mentor = true;
  const DrawList list = list_of(scene, ball_state(), options, {20'000, true});
  ASSERT_TRUE(list.cut);
  EXPECT_NEAR(glm::dot(list.cut->normal, scene.lesions[0].center_lps_mm), list.cut->distance_mm, 1e-9);
  EXPECT_TRUE(find(list, RoomPart::skin)->cut);
  ASSERT_NE(find(list, RoomPart::structure), nullptr);
  EXPECT_FALSE(find(list, RoomPart::structure)->cut);
  ASSERT_NE(find(list, RoomPart::target), nullptr);
  EXPECT_FALSE(find(list, RoomPart::target)->over_all);
  // Not even made for anybody else.
  EXPECT_TRUE(make_room_model(scene).structures.empty());
  EXPECT_EQ(make_room_model(scene).bone, kNoMesh);
}

TEST(DrawList, HoldsOnlyTheModalitysMachines) {
  const DrawList sound = list_of(ball_case(), ball_state());
  EXPECT_EQ(find(sound, RoomPart::tube), nullptr);
  const cases::Case scene = ball_case(cases::Modality::xray);
  const RoomModel room = make_room_model(scene);
  EXPECT_EQ(room.probe, kNoMesh);
  EXPECT_EQ(room.scan_plane, kNoMesh);
  RoomOptions options;
  options.help = 3;
  cases::State state = ball_state();
  state.fluoroscopy.in_use = true;
  state.fluoroscopy.arm.sid_mm = 1000.0;
  DrawList list;
  make_draw_list(room, scene, state, options, list);
  EXPECT_EQ(find(list, RoomPart::probe), nullptr);
  EXPECT_EQ(find(list, RoomPart::scan_plane), nullptr);
  ASSERT_NE(find(list, RoomPart::tube), nullptr);
  // Tube under the table, detector above the patient: sid apart.
  const glm::dvec3 source = placed(*find(list, RoomPart::tube), {0.0, 0.0, -scene.fluoroscope.source_isocentre_mm});
  const glm::dvec3 face = placed(*find(list, RoomPart::detector), {0.0, 0.0, 0.0});
  EXPECT_NEAR(source.y, 785.0, 1e-9);
  EXPECT_NEAR(face.y, 785.0 - 1000.0, 1e-9);
}

TEST(DrawList, PutsToolsWhereHandsHoldThem) {
  cases::Case scene = ball_case();
  scene.instrument.kind = cases::InstrumentKind::core;
  cases::State state = ball_state();
  const DrawList held = list_of(scene, state);
  const glm::dvec3 tip = state.needle.tip_lps_mm, way = state.needle.direction;
  EXPECT_NEAR(glm::distance(placed(*find(held, RoomPart::needle_shaft), {0, 0, 0}), tip), 0.0, 1e-9);
  EXPECT_NEAR(glm::distance(placed(*find(held, RoomPart::needle_shaft), {0, 0, -50.0}), tip - 50.0 * way), 0.0,
              1e-9);
  const RoomItem& probe = *find(held, RoomPart::probe);
  EXPECT_NEAR(glm::distance(placed(probe, {10.0, 0.0, 20.0}),
                            state.probe.origin_lps_mm + 10.0 * state.probe.lateral + 20.0 * state.probe.axial),
              0.0, 1e-9);
  // Thrown: the tip is on, the handle where it was.
  const glm::dvec3 handle = placed(*find(held, RoomPart::needle_hub), {0, 0, -200.0});
  state.fire.fired = true;
  state.needle.tip_lps_mm += way * scene.instrument.throw_mm;
  const DrawList thrown = list_of(scene, state);
  EXPECT_NEAR(glm::distance(placed(*find(thrown, RoomPart::needle_hub), {0, 0, -200.0}), handle), 0.0, 1e-9);
  // The shaft still reaches into it.
  const RoomModel room = make_room_model(scene);
  const RoomMesh& shaft = room.meshes[room.shaft];
  const auto low = std::min_element(shaft.vertices.begin(), shaft.vertices.end(),
                                    [](const auto& a, const auto& b) { return a.place_mm.z < b.place_mm.z; });
  EXPECT_LE(static_cast<double>(low->place_mm.z), -(scene.instrument.length_mm + scene.instrument.throw_mm));
}

TEST(DrawList, MovesTheSkinOnlyWhereTissueMoves) {
  cases::Case scene = ball_case();
  EXPECT_FALSE(list_of(scene, ball_state()).needs_displacement);
  scene.yields = true;
  EXPECT_TRUE(list_of(scene, ball_state()).needs_displacement);
}

TEST(DrawList, AllocatesNothingOnceItHasGrown) {
  const cases::Case scene = ball_case();
  const RoomModel room = make_room_model(scene);
  const cases::State state = ball_state();
  RoomOptions options;
  options.help = 3;
  DrawList list;
  make_draw_list(room, scene, state, options, list);
  const auto before = fixtures::allocations();
  make_draw_list(room, scene, state, options, list);
  EXPECT_EQ(fixtures::allocations(), before);
}

TEST(RoomModel, PutsTheTableUnderThePatientHoweverHeLies) {
  for (const auto position : {cases::PatientPosition::supine, cases::PatientPosition::prone,
                              cases::PatientPosition::lateral_left, cases::PatientPosition::lateral_right}) {
    cases::Case scene = ball_case();
    scene.position = position;
    const RoomModel room = make_room_model(scene);
    const glm::dvec3 up = cases::upwards(position);
    EXPECT_NEAR(room.frame.table_mm, -kBallMm, 0.5);
    EXPECT_NEAR(glm::dot(glm::cross(room.frame.across, room.frame.head), room.frame.up), 1.0, 1e-12);
    double highest = -1e9;
    for (const auto& vertex : room.meshes[room.table].vertices)
      highest = std::max(highest, glm::dot(glm::dvec3(vertex.place_mm), up));
    EXPECT_NEAR(highest, room.frame.table_mm, 1e-3);
  }
}

TEST(RoomModel, LampAndOperatorAreOnTheSideOfTheWayIn) {
  cases::Case scene = ball_case();
  const RoomFrame frame = room_frame_of(scene);
  EXPECT_EQ(operator_side(frame, scene), -1.0);
  scene.lesions[0].center_lps_mm.x = 50.0;
  EXPECT_EQ(operator_side(frame, scene), -1.0);  // the plan says otherwise
  scene.planned_entry_lps_mm.reset();
  EXPECT_EQ(operator_side(frame, scene), 1.0);
  const glm::dvec3 light = make_room_model(scene).key_light;
  EXPECT_GT(glm::dot(light, frame.across), 0.1);
  EXPECT_GT(glm::dot(light, frame.up), 0.8);
  EXPECT_NEAR(glm::length(light), 1.0, 1e-12);
}

TEST(RoomModel, ShowsFewerTrianglesNearTheSkinTheyStandFor) {
  cases::Case scene = ball_case();
  const RoomModel room = make_room_model(scene, {2'000, false});
  const RoomMesh& skin = room.meshes[room.skin];
  EXPECT_LE(skin.triangles.size(), 2'000U);
  EXPECT_GT(skin.triangles.size(), 500U);
  for (const auto& vertex : skin.vertices) {
    EXPECT_NEAR(scene.skin_index.closest(glm::dvec3(vertex.place_mm)).distance_mm, 0.0, 1.0);
    // Out of the ball.
    EXPECT_GT(glm::dot(glm::normalize(vertex.place_mm), vertex.normal), 0.98F);
  }
}

// Cut off flat towards the head.
cases::Case cut_ball() {
  cases::Case scene = ball_case();
  for (glm::vec3& vertex : scene.skin.vertices_lps_mm) vertex.z = std::min(vertex.z, 60.0F);
  for (std::size_t t = 0; t < scene.skin.triangles.size(); ++t) {
    const glm::uvec3& corners = scene.skin.triangles[t];
    scene.skin.cut[t] = std::min({scene.skin.vertices_lps_mm[corners.x].z, scene.skin.vertices_lps_mm[corners.y].z,
                                  scene.skin.vertices_lps_mm[corners.z].z}) >= 60.0F;
  }
  return scene;
}

TEST(RoomModel, NobodyCoversAPhantom) {
  cases::Case scene = cut_ball();
  const DrawList patient = list_of(scene, ball_state());
  ASSERT_NE(find(patient, RoomPart::drape), nullptr);
  scene.subject = cases::Subject::phantom;
  const DrawList phantom = list_of(scene, ball_state());
  EXPECT_EQ(find(phantom, RoomPart::drape), nullptr);
  EXPECT_NE(find(phantom, RoomPart::skin)->colour, find(patient, RoomPart::skin)->colour);
  EXPECT_NE(find(phantom, RoomPart::cut_end)->colour, find(patient, RoomPart::cut_end)->colour);
}

TEST(RoomModel, CoversWhereTheCtEndsAndOnlyThere) {
  EXPECT_EQ(make_room_model(ball_case()).drapes, kNoMesh);
  const RoomModel room = make_room_model(cut_ball());
  ASSERT_NE(room.drapes, kNoMesh);
  for (const auto& vertex : room.meshes[room.drapes].vertices) {
    EXPECT_GT(vertex.place_mm.z, 45.0F);
    EXPECT_GT(glm::dot(glm::dvec3(vertex.place_mm), room.frame.up), room.frame.table_mm);
  }
}

}  // namespace
}  // namespace seldinger::imaging
