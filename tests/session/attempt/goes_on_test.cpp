// An attempt that is saved in its middle and restored elsewhere goes on bit for bit: recording, what each picture
// showed, dose and the last picture, of each modality, of a patient who lies still and of one who breathes and
// yields.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <set>

#include "assessment/operators/fluoroscopy.h"
#include "assessment/operators/scripted.h"
#include "session/attempt/simulated_attempt.h"
#include "session/guidance/guidance.h"
#include "session/guidance/guidance_bytes.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/volume/tissue/find_tissue.h"
#include "tests/fixtures/ball_case.h"

namespace seldinger::session {
namespace {

enum class Tissue { still, moving };

cases::Case ball(cases::Modality modality, Tissue tissue) {
  cases::Case scene = fixtures::ball_case({.voxels = 88, .voxel_mm = 2.5, .radius_mm = 100.0, .skin_levels = 5});
  scene.classes = volume::tissue_classes(scene.volume);
  scene.echogenicity = imaging::echogenicity(scene.volume, scene.classes);
  scene.lesions.push_back({{0.0, -45.0, 0.0}, 6.0, 500.0});
  scene.picture.modality = modality;
  if (modality == cases::Modality::ultrasound) scene.picture.probe = "C5-2v";
  if (tissue == Tissue::moving) {
    scene.breathing.emplace();
    scene.yields = true;
  }
  return scene;
}

assessment::PuncturePlan plan_in(const cases::Case& scene) {
  assessment::PuncturePlan plan;
  plan.target_lps_mm = scene.lesions[0].center_lps_mm;
  plan.direction = glm::normalize(glm::dvec3(0.1, 1.0, 0.2));
  plan.depth_mm = scene.skin_index.first_hit(plan.target_lps_mm, -plan.direction, 300.0)->distance_mm;
  plan.entry_lps_mm = plan.target_lps_mm - plan.direction * plan.depth_mm;
  plan.probe = {plan.entry_lps_mm + glm::dvec3(30, 0, 0), {-0.5, 0.8, 0.0}, {0.8, 0.5, 0.0}};
  return plan;
}

// What an attempt came to, by the end.
struct Course {
  cases::Recording recording;
  engine::TickState now;
  GuidanceState seen;
  GreyPicture picture;
};

// At each of the ticks in `cuts` all that goes on does so in new objects, from bytes. Whoever acts stays.
Course run(const cases::Case& scene, std::uint64_t seed, std::uint64_t ticks, const std::set<std::uint64_t>& cuts,
           bool guidance_too = true) {
  const assessment::OperatorProfile profile = *assessment::named_profile("novice");
  const assessment::PuncturePlan plan = plan_in(scene);
  assessment::ScriptedOperator by_probe(profile, plan, scene.instrument, seed);
  assessment::FluoroscopyOperator by_beam(profile, plan, scene.instrument, scene.fluoroscope, scene.position, seed);
  const bool beam = scene.picture.modality == cases::Modality::xray;
  auto tick = std::make_unique<engine::Tick>(scene);
  auto guidance = guidance_of(scene);
  Course course;
  course.recording.events.emplace();
  while (course.now.state.tick < ticks) {
    if (cuts.contains(course.now.state.tick)) {
      const auto state = saved(guidance->state()), now = engine::saved(course.now);
      guidance = guidance_of(scene);
      tick = std::make_unique<engine::Tick>(scene);
      course.now = {};
      course.now = engine::restored(now).value();
      if (guidance_too) guidance->restore(restored_guidance(state).value());
    }
    const GuidanceState& seen = guidance->state();
    const cases::State& state = course.now.state;
    cases::Inputs hands =
        beam ? by_beam.act(state, seen.fresh ? &seen.fix : nullptr, base::kTickS)
             : by_probe.act(state, seen.fresh ? &seen.truth : nullptr, base::kTickS, seen.moved_mm);
    hands.exposure = seen.report;
    const cases::RecordedTick made = tick->advance_hands(hands, {}, course.now);
    beam ? by_beam.hear(hands.event) : by_probe.hear(hands.event);
    course.recording.inputs.push_back(made.inputs);
    course.recording.hashes.push_back(made.hash);
    if (made.pose) course.recording.poses.push_back(*made.pose);
    if (made.force) course.recording.forces.push_back(*made.force);
    if (made.endpoint) course.recording.endpoint = made.endpoint;
    cases::add_events(state.t_s, made, *course.recording.events);
    if (const auto frame = guidance->follow(state, course.now.displacement))
      course.recording.frames.push_back(*frame);
  }
  course.seen = guidance->state();
  course.picture = guidance->picture(course.now.state, course.now.displacement, {seed, 7});
  return course;
}

class GoesOn : public testing::TestWithParam<std::tuple<cases::Modality, Tissue>> {};

TEST_P(GoesOn, BitForBitFromBytes) {
  constexpr std::uint64_t kSeed = 11, kMostTicks = 14'000;
  const cases::Case scene = ball(std::get<0>(GetParam()), std::get<1>(GetParam()));
  // The product's own loop is what the two below are measured by.
  const cases::Recording product = run_attempt(scene, plan_in(scene), *assessment::named_profile("novice"), kSeed);
  const std::uint64_t ticks = std::min<std::uint64_t>(kMostTicks, product.inputs.size());
  ASSERT_GT(ticks, 4000U);
  const Course whole = run(scene, kSeed, ticks, {});
  ASSERT_TRUE(std::equal(whole.recording.hashes.begin(), whole.recording.hashes.end(), product.hashes.begin()));
  ASSERT_FALSE(whole.recording.frames.empty());
  // In the tick after a picture, too, and in one long after.
  const auto after_a_picture = static_cast<std::uint64_t>(
      whole.recording.frames[whole.recording.frames.size() / 2].t_s / base::kTickS + 0.5);
  const std::set<std::uint64_t> cuts = {1, 777, ticks / 2, after_a_picture, after_a_picture + 1, ticks - 5};
  const Course cut = run(scene, kSeed, ticks, cuts);
  EXPECT_EQ(cut.recording.hashes, whole.recording.hashes);
  EXPECT_EQ(cut.recording.poses, whole.recording.poses);
  EXPECT_EQ(cut.recording.forces, whole.recording.forces);
  EXPECT_EQ(cut.recording.frames, whole.recording.frames);
  EXPECT_EQ(cut.recording.events, whole.recording.events);
  EXPECT_EQ(cut.recording.endpoint, whole.recording.endpoint);
  EXPECT_EQ(cut.now.state.fluoroscopy.dap_mgy_cm2, whole.now.state.fluoroscopy.dap_mgy_cm2);
  EXPECT_EQ(cut.now.state.fluoroscopy.air_kerma_mgy, whole.now.state.fluoroscopy.air_kerma_mgy);
  EXPECT_EQ(engine::tick_state_hash(cut.now), engine::tick_state_hash(whole.now));
  EXPECT_EQ(cut.seen, whole.seen);
  EXPECT_EQ(cut.picture.grey, whole.picture.grey);
  EXPECT_FALSE(whole.picture.grey.empty());
  if (scene.picture.modality == cases::Modality::xray) {
    EXPECT_GT(whole.now.state.fluoroscopy.dap_mgy_cm2, 0.0);
  }
  // Guidance's state says something: without it the attempt is another.
  const Course forgetful = run(scene, kSeed, ticks, {after_a_picture}, false);
  EXPECT_FALSE(forgetful.recording.frames == whole.recording.frames && forgetful.seen == whole.seen);
}

INSTANTIATE_TEST_SUITE_P(AllModalities, GoesOn,
                         testing::Combine(testing::Values(cases::Modality::mpr, cases::Modality::ultrasound,
                                                          cases::Modality::xray),
                                          testing::Values(Tissue::still, Tissue::moving)));

TEST(GuidanceBytes, EveryFieldComesBackAndWhatIsNoneIsRefused) {
  GuidanceState state;
  for (double t_s = 0.0; t_s < 1.0; t_s += 0.001) state.clock.due(t_s, t_s < 0.4 ? 30.0 : 22.0);
  state.truth = {0.7,
                 false,
                 true,
                 true,
                 12.25,
                 cases::BeamTruth{1, 2, 3, 4, 5, 6, 7, 8, true, true},
                 cases::NearPlane{true, false, true, false}};
  state.fix = {true, true, true, {1.5, -2.5}, {3.5, -0.0}};
  state.report = {9, 0.25, 1.75, {71.0, 33.0, 7.0}, true};
  state.moved_mm = {0.1, -0.2, 0.3};
  state.fresh = state.live = true;
  const std::vector<std::byte> bytes = saved(state);
  const auto back = restored_guidance(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, state);
  GuidanceState going = state, gone = *back;
  for (double t_s = 1.0; t_s < 1.5; t_s += 0.001) EXPECT_EQ(going.clock.due(t_s, 25.0), gone.clock.due(t_s, 25.0));
  EXPECT_EQ(going.clock.count(), gone.clock.count());
  // Each field changes the bytes.
  const auto differs = [&](const std::function<void(GuidanceState&)>& change) {
    GuidanceState other = state;
    change(other);
    return saved(other) != bytes;
  };
  EXPECT_TRUE(differs([](GuidanceState& s) { s.clock.due(1.2, 22.0); }));
  EXPECT_TRUE(differs([](GuidanceState& s) { s.truth.beam.reset(); }));
  EXPECT_TRUE(differs([](GuidanceState& s) { s.truth.near_plane->target_5_mm = true; }));
  EXPECT_TRUE(differs([](GuidanceState& s) { s.fix.target_mm.y = 0.0; })) << "the sign of a zero";
  EXPECT_TRUE(differs([](GuidanceState& s) { s.report.next.pulse_ms = 8.0; }));
  EXPECT_TRUE(differs([](GuidanceState& s) { s.moved_mm.z = 0.4; }));
  EXPECT_TRUE(differs([](GuidanceState& s) { s.fresh = false; }));
  EXPECT_TRUE(differs([](GuidanceState& s) { s.live = false; }));
  for (std::size_t size = 0; size < bytes.size(); ++size)
    EXPECT_EQ(restored_guidance(std::span(bytes).first(size)).error().code, "damaged") << size;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    std::vector<std::byte> other = bytes;
    other[i] ^= std::byte{4};
    EXPECT_EQ(restored_guidance(other).error().code, "damaged") << i;
  }
  EXPECT_EQ(restored_guidance(engine::saved({})).error().code, "damaged") << "another's bytes";
}

}  // namespace
}  // namespace seldinger::session
