#include "sim/haptics/two_hands.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/vectors.h"

namespace seldinger::haptics {
namespace {

constexpr double kGravityMS2 = 9.80665;  // standard gravity (CGPM 1901)
// A hand that has moved further while it could not be followed holds its tool as if just taken up (design).
constexpr double kSamePlaceMm = 10.0;

// A fingertip, about as wide as one (design); skin on dry skin is held by more, and slides worse (S. Derler and
// L.-C. Gerhardt, Tribol. Lett. 45 (2012) 1: 0.2 to 1).
constexpr double kFingerMm = 8.0, kFingerFriction = 0.3;
// Cortical bone's edge against soft tissue, smooth as under a steel tip (design).
constexpr double kBoneHu = 250.0, kPointerFriction = 0.1;

struct Followed {
  cases::ToolPose pose;
  bool sound;
};

Followed followed(const HandInput& input) noexcept {
  Followed result{input.pose, input.healthy};
  const double square = glm::dot(input.pose.axis, input.pose.axis);
  result.sound = result.sound && base::is_finite(input.pose.position_lps_mm) && square > 0.25 && square < 4.0 &&
                 input.delay_ticks >= 0 && input.delay_ticks <= kMostDelayTicks;
  if (result.sound) result.pose.axis /= std::sqrt(square);
  return result;
}

void take_up(Tool tool, int delay_ticks, HandState& state) noexcept {
  state.tool = tool;
  state.needle = {};
  state.probe = {};
  state.finger = {};
  state.pointer = {};
  state.delay_ticks = delay_ticks;
  state.limiter.share = 0.0;
}

}  // namespace

std::array<HandSettings, 2> two_virtual_arms() {
  const HandSettings omni{*find_arm_model("omni")};
  return {omni, omni};
}

TwoHands::TwoHands(const cases::Case& scene, const std::array<HandSettings, 2>& settings)
    : skin_(&scene.skin_index),
      bone_(scene.volume, kBoneHu),
      needle_(scene),
      probe_(scene, ProbeSettings{}.radius_mm),
      up_(cases::upwards(scene.position)),
      stations_{station(settings[0], scene.touch.law), station(settings[1], scene.touch.law)} {}

TwoHands::Station TwoHands::station(const HandSettings& settings, cases::TouchLaw law) const {
  Station made{{},
               ForceLimiter({settings.device.peak_n, settings.device.continuous_n, kTickS}),
               settings.carried_kg * kGravityMS2 * up_};
  ArmModel device = settings.device;
  for (device.delay_ticks = 0; device.delay_ticks <= kMostDelayTicks; ++device.delay_ticks) {
    const NeedleSettings needle = of_law(needle_settings(device), law);
    ProbeSettings probe;
    probe.stiffness_n_mm = stiffness_n_mm(device);
    const DamperSettings spring{kTickS, kWallDampingNSMm, probe.stiffness_n_mm};
    made.laws.push_back({NeedleLaw(needle), NeedleSideLaw(needle, needle_.gauge()), ProbeLaw(probe),
                         SurfaceProxy({spring, kFingerMm, kFingerFriction, kFingerFriction}),
                         VolumeProxy({spring, kPointerFriction, kPointerFriction})});
  }
  return made;
}

HandForces TwoHands::advance(const HandInputs& inputs, double elapsed_s, HandStates& states) const noexcept {
  HandForces forces;
  for (std::size_t side = 0; side < forces.size(); ++side)
    forces[side] = advance(stations_[side], inputs[side], elapsed_s, states[side]);
  return forces;
}

HandForce TwoHands::advance(const Station& station, const HandInput& input, double elapsed_s,
                            HandState& state) const noexcept {
  HandForce force;
  const auto [pose, sound] = followed(input);
  if (input.tool != state.tool) take_up(input.tool, std::clamp(input.delay_ticks, 0, kMostDelayTicks), state);
  if (sound) {
    if (state.interrupted) {
      const glm::dvec3 moved_mm = pose.position_lps_mm - state.last_lps_mm;
      if (glm::dot(moved_mm, moved_mm) > kSamePlaceMm * kSamePlaceMm) take_up(state.tool, input.delay_ticks, state);
      interrupt(state.needle);
      interrupt(state.probe);
      state.interrupted = false;
    }
    state.last_lps_mm = pose.position_lps_mm;
    const bool touches =
        !state.needle.outside || state.probe.track.touching || state.finger.touching || state.pointer.touching;
    state.delay_ticks = touches ? std::max(state.delay_ticks, input.delay_ticks) : input.delay_ticks;
    const Laws& laws = station.laws[static_cast<std::size_t>(state.delay_ticks)];
    if (state.tool == Tool::needle) {
      needle_.exchange(input.introducer, state.needle);
      const HeldNeedleForce needle =
          needle_.advance(pose, laws.needle, laws.side, input.nicks_lps_mm, state.needle);
      force.wanted_n = needle.force_n;
      force.ruptured = needle.along.ruptured;
    } else if (state.tool == Tool::probe) {
      force.wanted_n = probe_.advance(pose, laws.probe, state.probe).force_n;
    } else if (state.tool == Tool::finger) {  // its position is the fingertip's foremost point
      force.wanted_n =
          laws.finger.advance(*skin_, pose.position_lps_mm - laws.finger.radius_mm() * pose.axis, state.finger);
    } else if (state.tool == Tool::pointer) {
      force.wanted_n = laws.pointer.advance(bone_, pose.position_lps_mm, state.pointer);
    }
    force.wanted_n += station.bear_n;
  }
  force.motor_n = station.limiter.advance(force.wanted_n, elapsed_s, sound, state.limiter);
  state.interrupted = state.limiter.fault_s > 0.0;
  return force;
}

}  // namespace seldinger::haptics
