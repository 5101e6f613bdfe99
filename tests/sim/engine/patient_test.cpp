// Tests of sim/engine/patient: what hurts, and how a breath is held.
#include "sim/engine/patient.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <tuple>
#include <vector>

#include "sim/engine/step.h"
#include "tests/fixtures/allocations.h"
#include "tests/fixtures/meshes.h"

namespace seldinger::engine {
namespace {

using cases::EventKind;

// A body of soft tissue, 200 mm across, with a plate of bone from y = -60 to -50 mm.
cases::Case body_with_a_plate() {
  cases::Case scene;
  scene.skin = fixtures::sphere_mesh({0, 0, 0}, 100.0, 5);
  scene.skin_index = cases::MeshIndex(scene.skin);
  scene.volume.size_voxels = {21, 121, 21};
  scene.volume.spacing_mm = {10.0, 2.0, 10.0};
  scene.volume.lps_from_voxel = glm::dmat4{10, 0, 0, 0, 0, 2, 0, 0, 0, 0, 10, 0, -100, -120, -100, 1};
  scene.volume.hu.assign(21 * 121 * 21, 40);
  scene.classes.assign(scene.volume.hu.size(), volume::TissueClass::soft_tissue);
  for (int k = 0; k < 21; ++k)
    for (int j = 30; j <= 35; ++j)
      for (int i = 0; i < 21; ++i) scene.classes[scene.volume.index(i, j, k)] = volume::TissueClass::bone;
  return scene;
}

// Drives the needle along y through x = z = 0.3 mm, and tells what the patient did and when.
class Trial {
 public:
  explicit Trial(const cases::Case& scene) : scene_(scene), patient_(scene) {}
  void tick(double y_mm, EventKind event = EventKind::none, double length_mm = 0.0) {
    cases::Inputs inputs;
    inputs.needle = {{x_mm, y_mm, 0.3}, {0, 1, 0}, {1, 0, 0}};
    inputs.event = event;
    inputs.event_tenths_mm = cases::tenths_of(length_mm);
    step(scene_, inputs, 0.001, state_);
    const EventKind reaction = patient_.advance(inputs, state_, memory_);
    if (reaction != EventKind::none) told.push_back({state_.t_s, reaction});
  }
  void move(double from_mm, double to_mm, double mm_s = 100.0) {
    const double step_mm = mm_s * 0.001 * (to_mm > from_mm ? 1.0 : -1.0);
    for (double y = from_mm; (to_mm - y) * step_mm > 0.0; y += step_mm) tick(y);
  }
  void wait(double seconds, double y_mm) {
    for (int i = 0; i < static_cast<int>(seconds * 1000.0 + 0.5); ++i) tick(y_mm);
  }
  std::vector<EventKind> kinds() const {
    std::vector<EventKind> all;
    for (const cases::Event& event : told) all.push_back(event.kind);
    return all;
  }
  std::span<const glm::dvec3> nicks() const { return nicks_of(memory_); }
  double x_mm = 0.3;
  std::vector<cases::Event> told;

 private:
  const cases::Case& scene_;
  Patient patient_;
  PatientState memory_;
  cases::State state_;
};

using Kinds = std::vector<EventKind>;

// A nick is where the needle points at the skin; by the law of touch of before, nobody felt one.
TEST(Patient, IsNickedWhereTheNeedlePoints) {
  cases::Case scene = body_with_a_plate();
  for (const cases::TouchLaw law : {cases::TouchLaw::steady, cases::TouchLaw::by_speed, cases::kNewestTouchLaw}) {
    scene.touch.law = law;
    Trial trial(scene);
    trial.tick(-140.0);
    trial.tick(-140.0, EventKind::nick);
    if (law == cases::TouchLaw::steady) {
      EXPECT_TRUE(trial.nicks().empty());
      continue;
    }
    ASSERT_EQ(trial.nicks().size(), 1U);
    EXPECT_NEAR(glm::distance(trial.nicks()[0], glm::dvec3(0.3, -100.0, 0.3)), 0.0, 0.5);
    for (int i = 0; i < 5; ++i) trial.tick(-140.0, EventKind::nick);
    EXPECT_EQ(trial.nicks().size(), kNickPlaces) << "the latest are remembered";
    EXPECT_TRUE(trial.kinds().empty()) << "and none of them hurts";
  }
}

TEST(Patient, SkinThatIsNotNumbHurtsAtEachPuncture) {
  const cases::Case scene = body_with_a_plate();
  Trial trial(scene);
  trial.move(-120, -90);
  trial.move(-90, -120);
  trial.move(-120, -90);
  EXPECT_EQ(trial.kinds(), (Kinds{EventKind::pain_skin, EventKind::pain_skin}));
}

TEST(Patient, APhantomFeelsNothing) {
  cases::Case scene = body_with_a_plate();
  scene.subject = cases::Subject::phantom;
  Trial trial(scene);
  trial.move(-120, -57);
  trial.wait(1.0, -57);
  EXPECT_TRUE(trial.told.empty());
}

TEST(Patient, NumbSkinDoesNotHurtFifteenMillimetresAround) {
  const cases::Case scene = body_with_a_plate();
  for (const double beside_mm : {0.0, 10.0, 14.0, 17.0, 40.0}) {
    Trial trial(scene);
    trial.tick(-120, EventKind::anaesthetic);  // where the needle points
    trial.x_mm += beside_mm;
    trial.move(-120, -80);
    EXPECT_EQ(trial.told.empty(), beside_mm < 15.0) << beside_mm;
  }
}

TEST(Patient, BoneHurtsOnceUntilItIsLeftForAWhile) {
  const cases::Case scene = body_with_a_plate();
  Trial trial(scene);
  trial.tick(-120, EventKind::anaesthetic);
  trial.move(-120, -57);
  trial.wait(2.0, -57);
  EXPECT_EQ(trial.kinds(), Kinds{EventKind::pain_bone});
  EXPECT_NEAR(trial.told[0].t_s, (120.0 - 61.0) / 100.0, 0.004)
      << "half a voxel before the middle of the plate's first";
  trial.move(-57, -70);
  trial.wait(0.1, -70);
  trial.move(-70, -57);
  EXPECT_EQ(trial.told.size(), 1U) << "0.36 s after";
  trial.move(-57, -70);
  trial.wait(0.5, -70);
  trial.move(-70, -57);
  EXPECT_EQ(trial.told.size(), 2U);
}

// At the depth and place that it is given: bone 14 mm beyond the tip is numb, at 17 mm it is not, nor what was only
// given at the skin, nor a place beside it.
TEST(Patient, WhatIsGivenThroughTheNeedleWorksAboutItsTip) {
  const cases::Case scene = body_with_a_plate();
  for (const auto& [from_bone_mm, told, beside_mm, hurts] : {std::tuple{13.0, true, 0.0, false},
                                                             {17.0, true, 0.0, true},
                                                             {13.0, false, 0.0, true},
                                                             {13.0, true, 17.0, true},
                                                             {13.0, true, 5.0, false}}) {
    Trial trial(scene);
    trial.tick(-120, EventKind::anaesthetic);
    const double tip_mm = -61.0 - from_bone_mm;
    trial.move(-120, tip_mm);
    trial.tick(tip_mm, EventKind::anaesthetic, told ? tip_mm + 100.0 : 0.0);
    trial.move(tip_mm, -120);
    trial.x_mm += beside_mm;
    trial.tick(-120, EventKind::anaesthetic);
    trial.move(-120, -60);
    EXPECT_EQ(trial.kinds(), hurts ? Kinds{EventKind::pain_bone} : Kinds{})
        << from_bone_mm << " mm before bone, " << beside_mm << " mm beside, told " << told;
  }
}

// A length without a needle in tissue is none: what was given lies at the skin.
TEST(Patient, NothingIsGivenDeepOfANeedleThatIsOutside) {
  const cases::Case scene = body_with_a_plate();
  Trial trial(scene);
  trial.tick(-120, EventKind::anaesthetic, 40.0);
  trial.move(-120, -57);
  EXPECT_EQ(trial.kinds(), Kinds{EventKind::pain_bone});
}

TEST(Patient, TheSkinStaysNumbHoweverDeepMoreIsGiven) {
  const cases::Case scene = body_with_a_plate();
  Trial trial(scene);
  trial.tick(-120, EventKind::anaesthetic);
  trial.move(-120, -80);
  for (std::size_t i = 0; i + 1 < kNumbPlaces; ++i) trial.tick(-80, EventKind::anaesthetic, 20.0);
  trial.move(-80, -120);
  trial.move(-120, -80);
  EXPECT_TRUE(trial.told.empty());
}

TEST(Patient, WithoutClassesNothingIsBone) {
  cases::Case scene = body_with_a_plate();
  scene.classes.clear();
  Trial trial(scene);
  trial.tick(-120, EventKind::anaesthetic);
  trial.move(-120, -40);
  EXPECT_TRUE(trial.told.empty());
}

TEST(Patient, ABreathIsHeldAfterADelayAndNotForEver) {
  const cases::Case scene = body_with_a_plate();
  Trial trial(scene);
  trial.tick(-120, EventKind::breath_hold_request);
  trial.wait(30.0, -120);
  ASSERT_EQ(trial.kinds(), (Kinds{EventKind::breath_held, EventKind::breath_lost}));
  // Half a second to stop.
  const cases::Breathing quiet;
  EXPECT_NEAR(trial.told[0].t_s, quiet.hold_delay_s + 0.5, 0.005);
  EXPECT_NEAR(trial.told[1].t_s, quiet.hold_delay_s + quiet.hold_most_s, 0.005);
  trial.tick(-120, EventKind::breath_hold_request);
  trial.wait(3.0, -120);
  trial.tick(-120, EventKind::breathe_again);
  trial.wait(30.0, -120);
  EXPECT_EQ(trial.told.size(), 3U) << "let go in time, it is not lost";
}

TEST(Patient, ACoughEndsIt) {
  const cases::Case scene = body_with_a_plate();
  Trial trial(scene);
  trial.tick(-120, EventKind::breath_hold_request);
  trial.wait(3.0, -120);
  trial.tick(-120, EventKind::cough);
  trial.wait(1.0, -120);
  EXPECT_EQ(trial.kinds(), (Kinds{EventKind::breath_held, EventKind::breath_lost}));
}

TEST(Patient, WhatHappensAtOnceIsToldOneAfterTheOther) {
  cases::Case scene = body_with_a_plate();
  std::fill(scene.classes.begin(), scene.classes.end(), volume::TissueClass::bone);
  Trial trial(scene);
  trial.move(-120, -90);
  ASSERT_EQ(trial.kinds(), (Kinds{EventKind::pain_skin, EventKind::pain_bone}));
  EXPECT_NEAR(trial.told[1].t_s - trial.told[0].t_s, 0.001, 1e-9);
}

TEST(Patient, MakesNoAllocation) {
  const cases::Case scene = body_with_a_plate();
  const Patient patient(scene);
  PatientState memory;
  cases::State state;
  cases::Inputs inputs;
  const long before = fixtures::allocations();
  for (int i = 0; i < 1000; ++i) {
    inputs.needle = {{0.3, -120.0 + 0.1 * i, 0.3}, {0, 1, 0}, {1, 0, 0}};
    inputs.event = i % 50 == 0 ? EventKind::anaesthetic : EventKind::none;
    step(scene, inputs, 0.001, state);
    patient.advance(inputs, state, memory);
  }
  EXPECT_EQ(fixtures::allocations(), before);
}

}  // namespace
}  // namespace seldinger::engine
