// Tests of session/guidance/guidance, of each modality: what a pulse and what a rate make, the last image that
// stays, and a state that is all that must be saved. In a ball of soft tissue whose middle breathes.
#include "session/guidance/guidance.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "assessment/operators/plan.h"
#include "session/guidance/ultrasound_sight.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::session {
namespace {

constexpr cases::Modality kAll[] = {cases::Modality::mpr, cases::Modality::xray, cases::Modality::ultrasound};

cases::Case make_ball() {
  cases::Case scene = fixtures::ball_case({.voxels = 88, .voxel_mm = 2.5, .radius_mm = 100.0, .skin_levels = 5});
  scene.classes = volume::tissue_classes(scene.volume);
  scene.echogenicity = imaging::echogenicity(scene.volume, scene.classes);
  scene.lesions.push_back({{0.0, -45.0, 0.0}, 6.0, 500.0});
  scene.breathing.emplace();
  return scene;
}

cases::Case ball_for(cases::Modality modality) {
  static const cases::Case kBall = make_ball();
  cases::Case scene = kBall;
  if (modality == cases::Modality::ultrasound) scene.picture = ultrasound_picture(50.0);
  scene.picture.modality = modality;
  return scene;
}

// Hands of tick i: a probe in its place and a needle on its way to the target; the foot comes and goes, and so does
// the frozen picture.
cases::Inputs hands_at(int i) {
  cases::Inputs hands;
  hands.probe = {{0.0, -98.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
  hands.needle = {{30.0, -110.0 + 0.08 * i, 0.0}, glm::normalize(glm::dvec3(-0.4, 1.0, 0.0)), {1.0, 0.0, 0.0}};
  hands.fluoroscope.pedal = i % 400 < 250;
  hands.fluoroscope.pulse_rate = 2;
  hands.freeze = i % 300 > 200;
  if (i > 350) hands.console.depth_mm = 90.0;
  return hands;
}

// An attempt that can be copied in its middle, but for what guidance keeps to itself.
struct Course {
  engine::TickState now;
  std::vector<cases::FrameTruth> frames;
};

void run(const cases::Case& scene, Guidance& guidance, int from, int to, Course& course) {
  const engine::Tick tick(scene);
  for (int i = from; i < to; ++i) {
    cases::Inputs inputs = hands_at(i);
    inputs.exposure = guidance.state().report;
    tick.advance(inputs, base::kTickS, course.now);
    if (const auto frame = guidance.follow(course.now.state, course.now.displacement))
      course.frames.push_back(*frame);
  }
}

TEST(Guidance, GoesOnFromItsStateAsIfItHadNotStopped) {
  constexpr int kMiddle = 401, kEnd = 900;  // a pulse has just been made, and its report is not yet taken in
  for (const cases::Modality modality : kAll) {
    SCOPED_TRACE(static_cast<int>(modality));
    const cases::Case scene = ball_for(modality);
    const auto guidance = guidance_of(scene);
    Course course;
    run(scene, *guidance, 0, kMiddle, course);
    const GuidanceState saved = guidance->state();
    Course restored{course.now, {}}, forgotten = restored;
    course.frames.clear();
    run(scene, *guidance, kMiddle, kEnd, course);
    ASSERT_GT(course.frames.size(), 3U);

    const auto other = guidance_of(scene);
    other->restore(saved);
    run(scene, *other, kMiddle, kEnd, restored);
    EXPECT_EQ(restored.frames, course.frames);
    EXPECT_EQ(restored.now.hash, course.now.hash);
    EXPECT_EQ(other->state(), guidance->state());
    EXPECT_EQ(other->picture(restored.now.state, restored.now.displacement, {3, 8}).grey,
              guidance->picture(course.now.state, course.now.displacement, {3, 8}).grey);

    const auto anew = guidance_of(scene);
    run(scene, *anew, kMiddle, kEnd, forgotten);
    EXPECT_FALSE(forgotten.frames == course.frames && forgotten.now.hash == course.now.hash &&
                 anew->state() == guidance->state())
        << "what is forgotten is missed";
  }
}

TEST(Guidance, APulsedMachinesLastImageStaysAndIsToldOnce) {
  const cases::Case scene = ball_for(cases::Modality::xray);
  const auto guidance = guidance_of(scene);
  ASSERT_TRUE(guidance->pulsed());
  Course course;
  run(scene, *guidance, 0, 400, course);  // the foot is off from 250 on
  ASSERT_GE(course.frames.size(), 3U);
  const cases::FrameTruth held = course.frames.back(), before = course.frames[course.frames.size() - 2];
  for (std::size_t i = 0; i + 1 < course.frames.size(); ++i)
    EXPECT_TRUE(course.frames[i].live && course.frames[i].beam) << i;
  EXPECT_FALSE(held.live || held.beam);
  EXPECT_NEAR(held.t_s, before.t_s + before.beam->beam_s, 0.0015) << "when its time is over";
  EXPECT_EQ(held.needle_tip, before.needle_tip);
  EXPECT_EQ(held.target, before.target);
  EXPECT_EQ(held.needle_length_mm, before.needle_length_mm);
  EXPECT_FALSE(guidance->state().fresh || guidance->state().live);
  EXPECT_GT(guidance->state().report.air_kerma_mgy, 0.0);
}

TEST(Guidance, UnderAProbeFrozenPicturesGoOn) {
  for (const cases::Modality modality : {cases::Modality::mpr, cases::Modality::ultrasound}) {
    SCOPED_TRACE(static_cast<int>(modality));
    const cases::Case scene = ball_for(modality);
    const auto guidance = guidance_of(scene);
    ASSERT_FALSE(guidance->pulsed());
    Course course;
    run(scene, *guidance, 0, 300, course);
    EXPECT_NEAR(static_cast<double>(course.frames.size()), 0.3 * scene.picture.rate_hz, 1.5);
    for (const cases::FrameTruth& frame : course.frames) {
      EXPECT_EQ(frame.live, frame.t_s < 0.2015) << frame.t_s;
      EXPECT_FALSE(frame.beam);
    }
    EXPECT_FALSE(course.frames.back().live);
    EXPECT_GT(glm::length(guidance->state().moved_mm), 0.0) << "the target breathes";
  }
}

TEST(Guidance, OfEachModalityTellsWhatItNeeds) {
  EXPECT_EQ(needs_of(cases::Modality::mpr), Needs::touch);
  EXPECT_EQ(needs_of(cases::Modality::xray), Needs::touch);
  EXPECT_EQ(needs_of(cases::Modality::ultrasound), Needs::ultrasound);
  for (const cases::Modality modality : kAll) {
    const GuidanceKind& kind = guidance_kind(modality);
    EXPECT_GT(kind.loading_share, 0.0);
    EXPECT_LT(kind.loading_share, 1.0);
    const cases::Case scene = ball_for(modality);
    EXPECT_EQ(guidance_of(scene)->pulsed(), !kind.probe_guides) << "no pulse without a hand free of the probe";
    EXPECT_EQ(kind.looks_from != nullptr, modality == cases::Modality::ultrasound);
  }
}

}  // namespace
}  // namespace seldinger::session
