#include "sim/engine/fluoroscopy.h"

#include <algorithm>
#include <cmath>

namespace seldinger::engine {
namespace {

// Ticks of 1 ms do not add up to a third of a second exactly: what is left of it is no wait.
constexpr double kNoWait_s = 1e-9;
// More than any machine gives in one pulse: a report beyond is a mistake, and is not added up.
constexpr double kMaxFrameKermaMgy = 100.0, kMaxFrameDapMgyCm2 = 1e5;
constexpr double kMinPulseMs = 0.5;

double share(double asked) noexcept {
  return std::isfinite(asked) ? std::clamp(asked, -1.0, 1.0) : 0.0;
}

// Whether it moved.
bool move(double& value, double way, double low, double high) noexcept {
  const double from = value;
  value = std::clamp(value + way, low, high);
  return value != from;
}

bool move_machine(const cases::Fluoroscope& machine, const cases::FluoroscopeInputs& asked, double dt_s,
                  cases::CArm& arm) noexcept {
  const double turn_deg = machine.arm_speed_deg_s * dt_s;
  bool moved = move(arm.lao_deg, share(asked.lao_speed) * turn_deg, -machine.angle_max_deg, machine.angle_max_deg);
  moved |= move(arm.cranial_deg, share(asked.cranial_speed) * turn_deg, -machine.cranial_max_deg,
                machine.cranial_max_deg);
  moved |= move(arm.sid_mm, share(asked.sid_speed) * machine.sid_speed_mm_s * dt_s, machine.sid_min_mm,
                machine.sid_max_mm);
  for (int axis = 0; axis < 3; ++axis) {
    const double start_mm = machine.start.isocentre_lps_mm[axis];
    moved |= move(arm.isocentre_lps_mm[axis], share(asked.table_speed[axis]) * machine.table_speed_mm_s * dt_s,
                  start_mm - machine.table_travel_mm, start_mm + machine.table_travel_mm);
  }
  return moved;
}

double clamped_or(double asked, double low, double high, double last) noexcept {
  return std::isfinite(asked) ? std::clamp(asked, low, high) : last;
}

cases::Technique within(const cases::Fluoroscope& machine, const cases::Technique& asked,
                        const cases::Technique& last) noexcept {
  return {clamped_or(asked.kv, machine.kv_min, machine.kv_max, last.kv),
          clamped_or(asked.ma, machine.ma_min, machine.ma_max, last.ma),
          clamped_or(asked.pulse_ms, kMinPulseMs, machine.pulse_ms, last.pulse_ms)};
}

void take_in(const cases::ExposureReport& report, cases::FluoroscopyState& state) noexcept {
  const auto sound = [](double value, double most) { return value >= 0.0 && value <= most; };
  state.reported = report.frame;
  if (!sound(report.air_kerma_mgy, kMaxFrameKermaMgy) || !sound(report.dap_mgy_cm2, kMaxFrameDapMgyCm2)) return;
  state.air_kerma_mgy += report.air_kerma_mgy;
  state.dap_mgy_cm2 += report.dap_mgy_cm2;
  if (report.hand_in_beam) state.hand_in_beam_s += state.frame_s;
}

void fire_pulse(cases::FluoroscopyState& state) noexcept {
  ++state.frames;
  state.frame_s = 1.0 / cases::kPulseRateHz[static_cast<std::size_t>(state.pulse_rate)];
  state.wait_s = std::max(0.0, state.wait_s + state.frame_s);
  state.last_technique = state.technique;
  state.fluoroscopy_time_s += state.frame_s;
  state.collimated_s += state.collimator.shut_share() * state.frame_s;
  if (state.arm_moving)
    state.beam_while_moving_s += state.frame_s;
  else
    cases::add_view(state.arm.lao_deg, state.arm.cranial_deg, state.views);
}

}  // namespace

void advance_fluoroscope(const cases::Case& scene, const cases::Inputs& inputs, double dt_s,
                         cases::FluoroscopyState& state) noexcept {
  const cases::Fluoroscope& machine = scene.fluoroscope;
  const cases::FluoroscopeInputs& asked = inputs.fluoroscope;
  if (!state.in_use) {
    state.in_use = true;
    state.arm = machine.start;
    state.technique = within(machine, {}, {});
  }
  state.arm_moving = move_machine(machine, asked, dt_s, state.arm);
  state.hand_away = asked.hand_away;
  state.magnification = std::clamp(asked.magnification, 0, 2);
  state.pulse_rate = std::clamp(asked.pulse_rate, 0, 2);
  state.collimator.open_u =
      clamped_or(asked.collimator.open_u, cases::kCollimatorMin, 1.0, state.collimator.open_u);
  state.collimator.open_v =
      clamped_or(asked.collimator.open_v, cases::kCollimatorMin, 1.0, state.collimator.open_v);

  const cases::ExposureReport& report = inputs.exposure;
  const bool new_report = report.frame > state.reported && report.frame <= state.frames;
  if (new_report) take_in(report, state);
  if (!asked.automatic_exposure)
    state.technique = within(machine, {asked.kv, asked.ma, machine.pulse_ms}, state.technique);
  else if (new_report)
    state.technique = within(machine, report.next, state.technique);

  // A held pedal keeps the rate; one pressed anew waits until the last pulse's time is over.
  state.wait_s = asked.pedal && state.beam_on ? state.wait_s - dt_s : std::max(0.0, state.wait_s - dt_s);
  state.beam_on = asked.pedal;
  state.frame_due = state.beam_on && state.wait_s <= kNoWait_s;
  if (state.frame_due)
    fire_pulse(state);
  else if (state.wait_s <= kNoWait_s)
    state.wait_s = 0.0;
  state.live = state.wait_s > 0.0;
}

}  // namespace seldinger::engine
