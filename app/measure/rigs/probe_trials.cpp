#include "app/measure/rigs/probe_trials.h"

#include <limits>

#include "sim/haptics/probe/probe_law.h"

namespace seldinger::measure {
namespace {

constexpr double kNone = std::numeric_limits<double>::infinity();
constexpr double kPressedMm = 6.0;

constexpr ProbeSituation kSituations[] = {
    {"probe struck on soft skin at 50 mm/s", kNone, false},
    {"probe struck on skin 4 mm over bone at 50 mm/s", 4.0, false},
    {"probe pressed in, pushed sideways", kNone, true},
};

}  // namespace

std::span<const ProbeSituation> probe_situations() {
  return kSituations;
}

Settling settle_probe(const ProbeSituation& situation, const haptics::ArmModel& device, const haptics::Hand& hand,
                      double factor, double damping) {
  haptics::ProbeSettings settings;
  settings.stiffness_n_mm = factor * haptics::stiffness_n_mm(device);
  settings.damping_n_s_mm *= damping;
  const haptics::ProbeLaw law(settings);
  haptics::ProbeTrack track;
  Trial trial{device, hand};
  haptics::SkinTouch touch{{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, kPressedMm, situation.bone_mm};
  if (situation.sideways) {
    trial.to_mm = 10.0;
    trial.push_n = 0.1;  // below friction, so that it must hold
    return settle(trial, [&](double x_mm) {
      touch.at_lps_mm.x = x_mm;
      return -law.advance(touch, track).force_n.x;
    });
  }
  trial.to_mm = 3.0;
  trial.speed_mm_s = 50.0;
  return settle(trial, [&](double depth_mm) {
    touch.depth_mm = depth_mm;
    touch.at_lps_mm.z = -depth_mm;
    return law.advance(touch, track).force_n.z;
  });
}

}  // namespace seldinger::measure
