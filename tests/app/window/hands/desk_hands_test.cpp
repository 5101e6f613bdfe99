// Tests of app/window/hands/desk_hands: a simulated arm presses a probe on the built-in torso.
#include "app/window/hands/desk_hands.h"

#include <gtest/gtest.h>

#include <atomic>
#include <bitset>
#include <glm/geometric.hpp>

#include "app/device_simulation/haply_simulation.h"
#include "app/hands/servo_trial.h"
#include "sim/devices/arms/arm_mapping.h"
#include "tests/fixtures/ball_case.h"
#include "tests/fixtures/until.h"

namespace seldinger::app {
namespace {

constexpr double kTickS = 0.001;

TEST(DeskHands, AnArmFeelsWhatItsToolPressesOnAndALostOneLeavesItToTheMouse) {
  const auto torso = torso_under_hands(0.9);
  ASSERT_TRUE(torso);
  cases::Case scene = torso->scene;
  scene.planned_entry_lps_mm = torso->plan.entry_lps_mm;
  // The needle in the air; the probe 8 mm below the entry, looking down.
  std::array<SimulatedArm, 2> arms = circling_arms();
  const glm::dmat3 down({1, 0, 0}, {0, 0, -1}, {0, 1, 0});  // the stylus' z is the device's y: up
  arms[0].at_mm = [](double) { return glm::dvec3(0.0, devices::kEntryAboveMm - 8.0, 0.0); };
  arms[0].held = [&](double) { return down; };
  arms[1].at_mm = [](double) { return glm::dvec3(30.0, devices::kEntryAboveMm + 80.0, 0.0); };
  arms[1].held = [&](double) { return down; };
  Arms there;
  there.place.port = 0;
  const auto service = HaplySimulation::start(there.place, arms);
  ASSERT_TRUE(service);
  there.place.port = (*service)->port();

  const glm::dvec3 up = cases::upwards(scene.position);
  const glm::dvec3 above = torso->plan.entry_lps_mm + 60.0 * up;
  const devices::HandsStart start{{above, -up, {0, 0, 1}}, {above + 20.0 * up, -up, {0, 0, 1}}};
  DeskHands hands(scene, start, {}, haptics::Handedness::right, &there);
  const engine::Tick whole(scene);
  engine::TickState now;
  devices::HandIntent nothing;
  cases::Inputs inputs;
  double most_n = 0.0;
  bool late = false;
  const auto tick = [&](const devices::HandIntent& intent) {
    inputs = {};
    hands.advance(intent, now.state, {}, kTickS, inputs);
    whole.advance_hands(inputs, {}, now);
    hands.feel(whole, now, kTickS);
    most_n = std::max(most_n, (*service)->arm(0).asked_n.y);
    late = late || hands.arms().late[0];
    fixtures::let_pass(kTickS);  // the service's arms move in real time
  };
  for (int i = 0; i < 15000 && !(most_n > 0.5); ++i) tick(nothing);
  // A machine that is too busy for 1 kHz (or made slow by a sanitizer) gets no force, and the desk says so.
  EXPECT_TRUE(most_n > 0.5 || late) << most_n << " newtons, upwards";
  EXPECT_LT((*service)->arm(1).asked_n.y, 0.2) << "in the air there is nothing";
  EXPECT_FALSE(hands.arms().lost[0]);
  EXPECT_FALSE(hands.mouse_leads(haptics::Tool::needle));

  (*service)->set({.away = true});
  for (int i = 0; i < 5000 && !(hands.arms().lost[0] && hands.arms().lost[1]); ++i) tick(nothing);
  ASSERT_TRUE(hands.arms().lost[0] && hands.arms().lost[1]);
  const cases::Inputs stayed = inputs;
  for (int i = 0; i < 50; ++i) tick(nothing);
  EXPECT_EQ(inputs.needle.position_lps_mm, stayed.needle.position_lps_mm);
  EXPECT_EQ(inputs.probe.position_lps_mm, stayed.probe.position_lps_mm);
  devices::HandIntent slide;
  slide.slide_lps_mm = 0.05 * up;
  for (int i = 0; i < 100; ++i) tick(slide);
  EXPECT_NEAR(glm::dot(inputs.needle.position_lps_mm - stayed.needle.position_lps_mm, up), 5.0, 0.01);
  EXPECT_EQ(inputs.probe.position_lps_mm, stayed.probe.position_lps_mm) << "nobody moved it";
  // Back: from where it is now.
  const glm::dvec3 before = inputs.needle.position_lps_mm;
  (*service)->set({});
  glm::dvec3 last = before;
  for (int i = 0; i < 10000 && (hands.arms().lost[0] || hands.arms().lost[1]); ++i) {
    tick(nothing);
    ASSERT_LT(glm::length(inputs.needle.position_lps_mm - last), 1.0) << "no jump";
    last = inputs.needle.position_lps_mm;
  }
  EXPECT_FALSE(hands.arms().lost[0]);
}

// A fluoroscope's: what the tick freezes the hands freeze, too, also at a patient who breathes meanwhile.
TEST(DeskHands, WithTheHandAwayTheNeedleStaysAndIsTakenUpWhereItIs) {
  for (const bool breathes : {false, true}) {
    cases::Case scene = fixtures::ball_case();
    scene.classes.assign(scene.volume.hu.size(), volume::TissueClass::liver);
    scene.picture.modality = cases::Modality::xray;
    if (breathes) scene.breathing.emplace();
    const cases::ToolPose above{{0.0, -60.0, 0.0}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}};
    devices::HandsSettings settings;
    settings.has_probe = settings.has_guide = false;
    DeskHands hands(scene, {above, above}, settings, haptics::Handedness::right, nullptr);
    cases::State state;
    state.breath.moves = breathes;
    cases::Inputs inputs;
    const auto tick = [&](double advance_mm, bool away, bool fire = false) {
      devices::HandIntent intent;
      intent.advance_mm = advance_mm;
      intent.fire = fire;
      inputs = {};
      inputs.fluoroscope.hand_away = away;
      hands.advance(intent, state, {}, kTickS, inputs);
      ++state.tick;
    };
    for (int i = 0; i < 1000; ++i) tick(0.03, false);
    const cases::ToolPose left = inputs.needle;
    const double in_mm = hands.mouse().inserted_mm();
    ASSERT_GT(in_mm, 5.0);
    for (int i = 0; i < 1000; ++i) {
      state.breath.level = breathes ? i / 1000.0 : 0.0;
      tick(0.03, true, true);
      ASSERT_EQ(inputs.needle.position_lps_mm, left.position_lps_mm) << i;
      ASSERT_FALSE(inputs.fire);
    }
    EXPECT_NEAR(hands.mouse().inserted_mm(), in_mm, 1e-6) << "what the panel says";
    tick(0.0, false);
    EXPECT_LT(glm::length(inputs.needle.position_lps_mm - left.position_lps_mm), 0.2) << "no leap";
    const glm::dvec3 back = inputs.needle.position_lps_mm;
    for (int i = 0; i < 100; ++i) tick(0.03, false);
    EXPECT_NEAR(glm::length(inputs.needle.position_lps_mm - back), 3.0, 0.2) << "it is led again";
  }
}

// An arm's: it goes where it likes meanwhile and feels nothing; back, it holds the needle where that was left.
TEST(DeskHands, AnArmThatWasAwayTakesTheNeedleUpWhereItIs) {
  const auto torso = torso_under_hands(0.9);
  ASSERT_TRUE(torso);
  cases::Case scene = torso->scene;
  scene.planned_entry_lps_mm = torso->plan.entry_lps_mm;
  scene.picture.modality = cases::Modality::xray;
  const glm::dmat3 down({1, 0, 0}, {0, 0, -1}, {0, 1, 0});  // the stylus' z is the device's y: up
  std::atomic<double> above_mm = 60.0;
  std::atomic<bool> fires = false;
  std::array<SimulatedArm, 2> arms = circling_arms();
  arms[1].at_mm = [&](double) { return glm::dvec3(0.0, devices::kEntryAboveMm + above_mm.load(), 0.0); };
  arms[1].held = [&](double) { return down; };
  arms[1].buttons = [&](double) { return std::bitset<8>(fires.load() ? 1 : 0); };
  Arms there;
  there.place.port = 0;
  const auto service = HaplySimulation::start(there.place, arms);
  ASSERT_TRUE(service);
  there.place.port = (*service)->port();

  const glm::dvec3 up = cases::upwards(scene.position), above = torso->plan.entry_lps_mm + 60.0 * up;
  devices::HandsSettings settings;
  settings.has_probe = settings.has_guide = false;
  DeskHands hands(scene, {{above, -up, {0, 0, 1}}, {above, -up, {0, 0, 1}}}, settings, haptics::Handedness::right,
                  &there);
  const engine::Tick whole(scene);
  engine::TickState now;
  cases::Inputs inputs;
  const auto tick = [&](bool away) {
    inputs = {};
    inputs.fluoroscope.hand_away = away;
    hands.advance({}, now.state, {}, kTickS, inputs);
    whole.advance_hands(inputs, hands.read(), now);
    hands.feel(whole, now, kTickS);
    fixtures::let_pass(kTickS);  // the service's arms move in real time
  };
  const auto tip = [&] { return now.state.needle.tip_lps_mm; };
  const auto until = [&](bool away, const auto& holds) {
    for (int i = 0; i < 20000 && !holds(); ++i) tick(away);
    return holds();
  };
  // In by some 15 mm, the hand at rest.
  ASSERT_TRUE(until(false, [&] { return !hands.arms().lost[1] && !hands.mouse_leads(haptics::Tool::needle); }));
  above_mm = -15.0;
  ASSERT_TRUE(until(false, [&] { return now.state.needle.inserted_mm > 8.0; })) << now.state.needle.inserted_mm;
  for (int i = 0; i < 300; ++i) tick(false);

  tick(true);
  const glm::dvec3 left = tip(), told = inputs.needle.position_lps_mm;
  above_mm = 45.0;
  fires = true;
  for (int i = 0; i < 600; ++i) {
    tick(true);
    ASSERT_EQ(inputs.needle.position_lps_mm, told);
    ASSERT_EQ(tip(), left);
    ASSERT_FALSE(inputs.fire) << "nobody holds it";
  }
  ASSERT_TRUE(until(true, [&] { return (*service)->arm(1).at_mm.y > devices::kEntryAboveMm + 35.0; }));
  EXPECT_LT(glm::length((*service)->arm(1).asked_n), 0.05) << "what stands in the patient holds nobody's hand";
  ASSERT_FALSE(hands.arms().lost[1]);
  // Back from 60 mm away in a moment of silence, the trigger still pulled.
  (*service)->set({.silent = true});
  for (int i = 0; i < 40; ++i) tick(true);
  glm::dvec3 last = tip();
  for (int i = 0; i < 150; ++i) {
    if (i == 5) (*service)->set({});
    tick(false);
    ASSERT_LT(glm::distance(tip(), left), i < 20 ? 3.0 : 10.0) << "tick " << i;
    ASSERT_LT(glm::distance(tip(), last), 0.5) << "no leap, tick " << i;
    last = tip();
    ASSERT_FALSE(inputs.fire) << "pulled while away, tick " << i;
  }
  fires = false;
  for (int i = 0; i < 50; ++i) tick(false);
  fires = true;
  EXPECT_TRUE(until(false, [&] { return inputs.fire; })) << "pulled anew it fires";
  // And led again, from here.
  const glm::dvec3 back = tip();
  above_mm = 55.0;
  EXPECT_TRUE(until(false, [&] { return glm::dot(tip() - back, up) > 5.0; })) << glm::dot(tip() - back, up);
}

// An answer too late takes the force, a third of which is back .1 s later: ten of them a second are an arm without
// force, which is said; three, which halve it, are not.
TEST(DeskHands, AnArmThatIsLateNowAndThenIsSaidToBeLate) {
  const auto said = [](int every, int ticks, LateWatch& watch) {
    int so = 0;
    for (int i = 0; i < ticks; ++i) so += late_is_said(every > 0 && i % every == 0, kTickS, watch) ? 1 : 0;
    return so;
  };
  for (const int every : {1, 10, 50, 100}) {
    LateWatch watch;
    EXPECT_EQ(said(every, 990, watch), 0) << "not at once; every " << every;
    EXPECT_GT(said(every, 1000, watch), 980) << "every " << every;
    said(0, 1000, watch);
    EXPECT_EQ(said(0, 1000, watch), 0) << "in time again; every " << every;
  }
  LateWatch seldom;
  EXPECT_EQ(said(300, 60'000, seldom), 0) << "every .3 s";
}

// What comes and goes from tick to tick is one notice, and is over a second after the last of it.
TEST(DeskHands, ALimitIsSaidForASecondAndDoesNotFlicker) {
  double left_s = 0.0;
  EXPECT_FALSE(limit_is_said(0.0, kTickS, left_s));
  EXPECT_FALSE(limit_is_said(0.5 * kFeltLessN, kTickS, left_s)) << "nobody feels that";
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(limit_is_said(i % 20 == 0 ? 1.0 : 0.0, kTickS, left_s)) << i;
  int said = 0;
  while (limit_is_said(0.0, kTickS, left_s)) ++said;
  EXPECT_NEAR(said * kTickS, kSaidLimitS, 0.03);
}

}  // namespace
}  // namespace seldinger::app
