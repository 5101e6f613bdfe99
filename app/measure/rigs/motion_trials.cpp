#include "app/measure/rigs/motion_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/tick.h"
#include "sim/base/vectors.h"
#include "sim/engine/moving_tissue.h"
#include "sim/tissue/breathing.h"

namespace seldinger::measure {
namespace {

using base::kTickS;
constexpr double kInsertMmS = 20.0, kOutsideMm = 10.0, kRestS = 1.0;
constexpr double kHandKg = 0.1, kHandNSMm = 0.005;  // of an arm that holds loosely (design)
constexpr double kPressMm = 6.0, kLiftMm = 2.0, kSlideMm = 5.0, kPressPeriodS = 1.0;
constexpr int kSettlingCycles = 2;

constexpr std::size_t kProbe = 0, kNeedle = 1;

// Both hands at the scene, and the work that is done.
class Rig {
 public:
  Rig(const cases::Case& scene, const TrialPlace& place)
      : tissue_(scene),
        hands_(scene, {haptics::HandSettings{*haptics::find_arm_model("omni")},
                       haptics::HandSettings{*haptics::find_arm_model("omni")}}) {
    inputs_[kProbe].tool = haptics::Tool::probe;
    inputs_[kProbe].pose = {place.probe_lps_mm - 40.0 * place.probe_axis, place.probe_axis,
                            base::perpendiculars(place.probe_axis).u};
    inputs_[kNeedle].tool = haptics::Tool::needle;
    inputs_[kNeedle].pose = {place.entry_lps_mm - 40.0 * place.direction, place.direction,
                             base::perpendiculars(place.direction).u};
  }

  glm::dvec3& probe() { return inputs_[kProbe].pose.position_lps_mm; }
  glm::dvec3& needle() { return inputs_[kNeedle].pose.position_lps_mm; }
  const glm::dvec3& needle_n() const { return forces_[kNeedle].wanted_n; }
  const haptics::HeldNeedleState& held() const { return states_[kNeedle].needle; }
  const glm::dvec3& rest_tip() const { return rest_[kNeedle]; }
  void breathe(double level) { state_.breath.level = level; }

  // The hands went from `probe_before` and `needle_before` to where they are, against the last tick's forces.
  void tick(const glm::dvec3& probe_before, const glm::dvec3& needle_before) {
    const tissue::Displacement by_needle = tissue_.felt_by_needle(state_, states_),
                               by_probe = tissue_.felt_by_probe(state_);
    hands_mj_ += glm::dot(forces_[kProbe].wanted_n, probe() - probe_before) +
                 glm::dot(forces_[kNeedle].wanted_n, needle() - needle_before);
    if (begun_)
      tissue_mj_ += glm::dot(forces_[kNeedle].wanted_n, tissue::displaced(by_needle, rest_[kNeedle]) -
                                                            tissue::displaced(needle_tissue_, rest_[kNeedle])) +
                    glm::dot(forces_[kProbe].wanted_n, tissue::displaced(by_probe, rest_[kProbe]) -
                                                           tissue::displaced(probe_tissue_, rest_[kProbe]));
    needle_tissue_ = by_needle;
    probe_tissue_ = by_probe;
    haptics::HandInputs inputs = inputs_;
    inputs[kNeedle].pose = engine::at_rest(by_needle, inputs[kNeedle].pose, std::max(20.0, held().depth_mm));
    inputs[kProbe].pose.position_lps_mm = tissue::rest_of(by_probe, probe());
    rest_ = {inputs[kProbe].pose.position_lps_mm, inputs[kNeedle].pose.position_lps_mm};
    forces_ = hands_.advance(inputs, kTickS, states_);
    begun_ = true;
  }
  double hands_mj() const { return hands_mj_; }
  double tissue_mj() const { return tissue_mj_; }

 private:
  engine::MovingTissue tissue_;
  haptics::TwoHands hands_;
  haptics::HandInputs inputs_{};
  haptics::HandStates states_{};
  haptics::HandForces forces_{};
  cases::State state_;
  tissue::Displacement needle_tissue_{}, probe_tissue_{};
  std::array<glm::dvec3, 2> rest_{};
  double hands_mj_ = 0.0, tissue_mj_ = 0.0;
  bool begun_ = false;
};

void insert(Rig& rig, const TrialPlace& place) {
  double depth_mm = -kOutsideMm;
  for (double t_s = 0.0; depth_mm < place.depth_mm || t_s < kRestS;) {
    const glm::dvec3 before = rig.needle();
    if (depth_mm < place.depth_mm)
      depth_mm += kInsertMmS * kTickS;
    else
      t_s += kTickS;
    rig.needle() = place.entry_lps_mm + depth_mm * place.direction;
    rig.tick(rig.probe(), before);
  }
}

// A mass on a spring about where it was, pushed by what it feels.
struct SprungHand {
  glm::dvec3 about_lps_mm{0.0}, velocity_mm_s{0.0};
  double n_mm = 0.0;
  void move(glm::dvec3& at, const glm::dvec3& felt_n) {
    if (!(n_mm > 0.0)) return;
    const glm::dvec3 n = felt_n + n_mm * (about_lps_mm - at) - kHandNSMm * velocity_mm_s;
    velocity_mm_s += n / kHandKg * 1000.0 * kTickS;
    at += velocity_mm_s * kTickS;
  }
};

// `move` does tick i of a cycle to the rig.
template <typename Move>
EnergyTrial run(Rig& rig, int cycles, int ticks, bool breath_puts_in, const Move& move) {
  EnergyTrial trial;
  glm::dvec3 tip(0.0), force(0.0), entry(0.0), direction(0.0);
  for (int cycle = 0; cycle < cycles + kSettlingCycles; ++cycle) {
    const double hands_mj = rig.hands_mj(), tissue_mj = rig.tissue_mj();
    for (int i = 0; i < ticks; ++i) {
      move(i);
      if (cycle >= kSettlingCycles)
        trial.tissue_mj = std::max(trial.tissue_mj, std::abs(rig.tissue_mj() - tissue_mj));
    }
    if (cycle == kSettlingCycles) {
      tip = rig.rest_tip();
      force = rig.needle_n();
      entry = rig.held().entry_lps_mm;
      direction = rig.held().direction;
    }
    if (cycle < kSettlingCycles) continue;
    const double put_in = breath_puts_in ? rig.tissue_mj() - tissue_mj : 0.0;
    const double gain = rig.hands_mj() - hands_mj - put_in;
    if (cycle == kSettlingCycles || !(gain <= trial.most_gain_mj)) trial.most_gain_mj = gain;
  }
  trial.drift_mm = glm::distance(rig.rest_tip(), tip);
  trial.drift_n = glm::distance(rig.needle_n(), force);
  trial.line_mm =
      glm::distance(rig.held().entry_lps_mm, entry) + 100.0 * glm::distance(rig.held().direction, direction);
  return trial;
}

}  // namespace

EnergyTrial breathing_trial(const cases::Case& scene, const TrialPlace& place, double hand_n_mm, int cycles) {
  Rig rig(scene, place);
  insert(rig, place);
  cases::BreathState breath;
  SprungHand hand{rig.needle(), glm::dvec3(0.0), hand_n_mm};
  const int ticks = static_cast<int>(std::lround(scene.breathing->period_s / kTickS));
  return run(rig, cycles, ticks, true, [&](int) {
    rig.breathe(tissue::advance(*scene.breathing, kTickS, {}, breath));
    const glm::dvec3 before = rig.needle();
    hand.move(rig.needle(), rig.needle_n());
    rig.tick(rig.probe(), before);
  });
}

EnergyTrial coupled_trial(const cases::Case& scene, const TrialPlace& place, double hand_n_mm, int cycles) {
  Rig rig(scene, place);
  insert(rig, place);
  SprungHand hand{rig.needle(), glm::dvec3(0.0), hand_n_mm};
  const int ticks = static_cast<int>(std::lround(kPressPeriodS / kTickS));
  return run(rig, cycles, ticks, false, [&](int i) {
    const glm::dvec3 probe = rig.probe(), needle = rig.needle();
    const double down = 0.5 - 0.5 * base::exact_cos(2.0 * std::numbers::pi * i / ticks);
    rig.probe() = place.probe_lps_mm + (-kLiftMm + (kPressMm + kLiftMm) * down) * place.probe_axis;
    hand.move(rig.needle(), rig.needle_n());
    rig.tick(probe, needle);
  });
}

EnergyTrial indentation_trial(const cases::Case& scene, const TrialPlace& place, int cycles) {
  Rig rig(scene, place);
  const glm::dvec3 along = base::perpendiculars(place.probe_axis).u;
  const int ticks = static_cast<int>(std::lround(kPressPeriodS / kTickS));
  return run(rig, cycles, ticks, false, [&](int i) {
    const glm::dvec3 probe = rig.probe();
    const double angle = 2.0 * std::numbers::pi * i / ticks;
    rig.probe() = place.probe_lps_mm +
                  (-kLiftMm + (kPressMm + kLiftMm) * (0.5 - 0.5 * base::exact_cos(angle))) * place.probe_axis +
                  kSlideMm * base::exact_sin(angle) * along;
    rig.tick(probe, rig.needle());
  });
}

std::vector<ForceReading> motion_readings(cases::Case scene, const TrialPlace& place) {
  constexpr int kBreaths = 20;
  scene.yields = true;
  std::vector<ForceReading> readings;
  const EnergyTrial loop = indentation_trial(scene, place, kBreaths);
  const EnergyTrial coupled = coupled_trial(scene, place, 0.3, kBreaths);
  scene.breathing.emplace();
  scene.breathing->amplitude_mm = {0.0, 0.0, 16.0};
  scene.breathing->irregularity = 0.0;
  const EnergyTrial still = breathing_trial(scene, place, 0.0, kBreaths),
                    sprung = breathing_trial(scene, place, 0.3, kBreaths);
  readings.push_back({"given by a closed indentation loop", "probe", loop.most_gain_mj, "mJ", 0.0});
  readings.push_back({"given in a cycle, probe moves tissue", "both hands", coupled.most_gain_mj, "mJ", 1.0});
  for (const auto& [where, trial] : {std::pair{"hand still", still}, std::pair{"hand sprung", sprung}}) {
    readings.push_back({"given in a breath beyond tissue's", where, trial.most_gain_mj, "mJ", 1.0});
    readings.push_back({"anchor's drift in 20 breaths", where, trial.drift_mm + trial.line_mm, "mm", 0.1});
    readings.push_back({"force's drift in 20 breaths", where, trial.drift_n, "N", 0.05});
  }
  return readings;
}

}  // namespace seldinger::measure
