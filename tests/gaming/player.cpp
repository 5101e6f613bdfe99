#include "tests/gaming/player.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/operators/probe_over.h"
#include "assessment/operators/wander.h"
#include "session/guidance/guidance.h"
#include "sim/base/tick.h"
#include "sim/base/vectors.h"
#include "sim/case/c_arm.h"
#include "sim/engine/step.h"
#include "sim/engine/tick.h"

namespace seldinger::gaming {
namespace {

using From = Stage::From;
using cases::EventKind;

constexpr double kBesideMm = 15.0;      // a picture's plane so far off shows no needle
constexpr double kMostSeconds = 150.0;  // of any of these scripts
constexpr double kSaidEvery_s = 0.2;
constexpr double kViewsApartDeg = 40.0, kViewSeconds = 6.0;
constexpr double kParkSeconds = 25.0;  // longer than any of them advances

std::vector<EventKind> everything_sayable() {
  std::vector<EventKind> all;
  for (const cases::EventInfo& info : cases::event_kinds())
    if (info.source == cases::EventSource::trainee) all.push_back(info.kind);
  return all;
}

// How far short of the planned target's centre the tip is when the trigger falls.
double stop_short_mm(const cases::Instrument& needle) {
  return needle.kind == cases::InstrumentKind::core ? needle.throw_mm - needle.dead_tip_mm - needle.notch_mm / 2
                                                    : 0.0;
}

class Hands {
 public:
  Hands(const Player& player, const cases::Case& scene, const assessment::PuncturePlan& plan)
      : player_(player), scene_(scene), plan_(plan) {
    across_ = plan.approach == cases::Approach::out_of_plane;
    first_view_ = cases::angles_of_beam(-plan.direction, scene.position);
    begin();
  }
  bool done() const { return stage_ >= player_.stages.size(); }

  cases::Inputs act(const cases::State& state) {
    const Stage& stage = player_.stages[stage_];
    const double goal_mm = depth_of(stage), step_mm = stage.mm_s * base::kTickS;
    depth_mm_ += std::clamp(goal_mm - depth_mm_, -step_mm, step_mm);
    since_s_ += base::kTickS;
    const bool there = depth_mm_ == goal_mm;
    if (there) waited_s_ += base::kTickS;

    cases::Inputs hands;
    const auto [u, v] = base::perpendiculars(plan_.direction);
    hands.needle.position_lps_mm = plan_.entry_lps_mm + plan_.direction * depth_mm_ + u * stage.beside_mm;
    hands.needle.axis = plan_.direction;
    hands.needle.side = u;
    hands.probe = probe(stage);
    hands.freeze = stage.frozen;
    hands.fire = stage.fire && there;
    const auto said = static_cast<std::size_t>(since_s_ / kSaidEvery_s);
    if (said < stage.says.size() && said >= said_) {
      hands.event = stage.says[said];
      said_ = said + 1;
    }
    double wait_s = std::max(stage.wait_s, static_cast<double>(stage.says.size()) * kSaidEvery_s);
    if (stage.fire) wait_s = std::max(wait_s, assessment::kTriggerHoldSeconds);
    const bool looks = stage.two_views && scene_.picture.modality == cases::Modality::xray;
    if (looks) wait_s = std::max(wait_s, 2.0 * kViewSeconds);
    if (scene_.picture.modality == cases::Modality::xray) hands.fluoroscope = machine(state, looks && there);
    if (there && waited_s_ >= wait_s) {
      ++stage_;
      begin();
    }
    return hands;
  }

 private:
  void begin() { since_s_ = waited_s_ = 0.0, said_ = 0; }
  double depth_of(const Stage& stage) const {
    if (stage.from == From::entry) return stage.depth_mm;
    return plan_.depth_mm - stop_short_mm(scene_.instrument) + stage.depth_mm;
  }
  cases::ToolPose probe(const Stage& stage) const {
    if (stage.glance == Glance::tip) return assessment::probe_over(plan_, std::max(depth_mm_, 0.0));
    cases::ToolPose probe = plan_.probe;
    const glm::dvec3 normal = assessment::plane_normal(probe);
    // Out of plane, on the side to which the needle points.
    const double side = across_ && glm::dot(normal, plan_.direction) < 0.0 ? -1.0 : 1.0;
    probe.position_lps_mm += normal * (side * kBesideMm);
    return probe;
  }
  // Along the needle, then from the side, by pulses while the arm is at rest; the hand is away.
  cases::FluoroscopeInputs machine(const cases::State& state, bool looks) const {
    cases::FluoroscopeInputs asked;
    asked.pulse_rate = 0;
    asked.collimator = {0.5, 0.5};
    const cases::CArm& arm = state.fluoroscopy.arm;
    const bool second = looks && waited_s_ > kViewSeconds;
    const double side_deg = first_view_.lao_deg > 0.0 ? -kViewsApartDeg : kViewsApartDeg;
    const auto towards = [&](double now_deg, double wanted_deg) {
      const double gap_deg = wanted_deg - now_deg;
      return std::abs(gap_deg) < 0.3 ? 0.0
                                     : std::clamp(gap_deg / (scene_.fluoroscope.arm_speed_deg_s * 0.25), -1.0, 1.0);
    };
    asked.lao_speed = towards(arm.lao_deg, first_view_.lao_deg + (second ? side_deg : 0.0));
    asked.cranial_speed = towards(arm.cranial_deg, first_view_.cranial_deg);
    asked.hand_away = looks;
    const double in_view_s = second ? waited_s_ - kViewSeconds : waited_s_;
    asked.pedal = looks && in_view_s > kViewSeconds - 1.0 && !state.fluoroscopy.arm_moving;
    return asked;
  }

  const Player& player_;
  const cases::Case& scene_;
  const assessment::PuncturePlan& plan_;
  bool across_ = false;
  cases::BeamAngles first_view_;
  std::size_t stage_ = 0, said_ = 0;
  double depth_mm_ = -30.0, since_s_ = 0.0, waited_s_ = 0.0;
};

}  // namespace

const Player& honest_player() {
  static const Player player = [] {
    Player made = {"honest", "he leaves nothing out", {{.wait_s = 1.0, .two_views = true}}};
    // Under a fluoroscope with a look after each step.
    for (const double short_mm : {56.0, 42.0, 28.0, 14.0, 0.0})
      made.stages.push_back(
          {.from = From::target, .depth_mm = -short_mm, .mm_s = 8.0, .wait_s = 0.2, .two_views = true});
    made.stages.push_back({.from = From::target, .depth_mm = 0.0, .fire = true});
    return made;
  }();
  return player;
}

std::span<const Player> gaming_players() {
  static const std::vector<Player> players = {
      {"parks",
       "the needle went to the target unseen; then it is held in view until most of the time was in view",
       {{.wait_s = 1.0, .glance = Glance::beside},
        {.from = From::target, .depth_mm = 0.0, .glance = Glance::beside},
        {.from = From::target, .depth_mm = 0.0, .wait_s = kParkSeconds, .two_views = true},
        {.from = From::target, .depth_mm = 0.0, .fire = true}}},
      {"parks short",
       "the needle is held in view under the skin and never goes to the target",
       {{.wait_s = 1.0},
        {.depth_mm = 10.0, .wait_s = kParkSeconds, .two_views = true},
        {.depth_mm = 10.0, .fire = true}}},
      {"freezes",
       "the picture stands still while the needle goes on",
       {{.wait_s = 1.0},
        {.depth_mm = 8.0, .mm_s = 8.0, .wait_s = 0.5},
        {.from = From::target, .depth_mm = 0.0, .frozen = true},
        {.from = From::target, .depth_mm = 0.0, .wait_s = kParkSeconds, .two_views = true},
        {.from = From::target, .depth_mm = 0.0, .fire = true}}},
      {"creeps",
       "the needle went to the target unseen, more slowly than what counts as moving",
       {{.wait_s = 1.0, .glance = Glance::beside},
        {.depth_mm = 0.0, .glance = Glance::beside},
        {.from = From::target, .depth_mm = 0.0, .mm_s = 1.9, .glance = Glance::beside},
        {.from = From::target, .depth_mm = 0.0, .wait_s = 2.0 * kParkSeconds, .two_views = true},
        {.from = From::target, .depth_mm = 0.0, .fire = true}}},
      {"restarts",
       "out and in again until it fits",
       {{.wait_s = 1.0},
        {.from = From::target, .depth_mm = -8.0, .beside_mm = 6.0},
        {.depth_mm = -12.0, .mm_s = 30.0, .beside_mm = 6.0},
        {.depth_mm = -12.0, .wait_s = 0.5},
        {.from = From::target, .depth_mm = 0.0, .mm_s = 8.0, .wait_s = 0.5, .two_views = true},
        {.from = From::target, .depth_mm = 0.0, .fire = true}}},
      {"gives up",
       "all is done but the trigger does not fall, so that it may be begun again",
       {{.wait_s = 1.0},
        {.from = From::target, .depth_mm = 0.0, .mm_s = 8.0, .wait_s = kParkSeconds, .two_views = true}}},
      {"says all",
       "everything is said and nothing is done",
       {{.wait_s = 5.0, .two_views = true, .says = everything_sayable()}}},
      {"says all and fires",
       "everything is said and the trigger falls outside the patient",
       {{.wait_s = 5.0, .two_views = true, .says = everything_sayable()}, {.fire = true}}},
      {"fires outside",
       "the trigger falls before the skin",
       {{.wait_s = 1.0, .two_views = true},
        {.depth_mm = -2.0, .wait_s = kParkSeconds},
        {.depth_mm = -2.0, .fire = true}}},
      {"fires beside",
       "the trigger falls as deep as the target, 20 mm beside it",
       {{.beside_mm = 20.0, .wait_s = 1.0, .two_views = true},
        {.from = From::target, .depth_mm = 0.0, .mm_s = 8.0, .beside_mm = 20.0, .wait_s = 0.5, .two_views = true},
        {.from = From::target, .depth_mm = 0.0, .beside_mm = 20.0, .fire = true}}},
      {"sweeps",
       "through the target, and the trigger falls late",
       {{.wait_s = 1.0, .two_views = true},
        {.from = From::target, .depth_mm = 25.0, .mm_s = 8.0, .wait_s = 0.5, .two_views = true},
        {.from = From::target, .depth_mm = 25.0, .fire = true}}},
  };
  return players;
}

cases::Recording play(const Player& player, const cases::Case& scene, const assessment::PuncturePlan& plan) {
  const auto guidance = session::guidance_of(scene);
  const engine::Tick tick(scene);
  engine::TickState now;
  Hands hands(player, scene, plan);
  cases::Recording recording;
  recording.step_version = engine::kStepVersion;
  recording.dt_s = base::kTickS;
  recording.events.emplace();
  while (!hands.done() && now.state.t_s < kMostSeconds) {
    cases::Inputs inputs = hands.act(now.state);
    inputs.exposure = guidance->state().report;
    const cases::RecordedTick ticked = tick.advance_hands(inputs, {}, now);
    if (ticked.pose) recording.poses.push_back(*ticked.pose);
    if (ticked.force) recording.forces.push_back(*ticked.force);
    if (ticked.endpoint) recording.endpoint = ticked.endpoint;
    cases::add_events(now.state.t_s, ticked, *recording.events);
    if (const auto frame = guidance->follow(now.state, now.displacement)) recording.frames.push_back(*frame);
  }
  return recording;
}

}  // namespace seldinger::gaming
