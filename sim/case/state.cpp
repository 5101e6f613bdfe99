#include "sim/case/state.h"

#include "sim/base/hash.h"

namespace seldinger::cases {
namespace {

std::uint64_t hash_of(const FluoroscopyState& state, std::uint64_t previous) noexcept {
  std::uint64_t hash = previous;
  const auto add = [&hash](auto... values) { ((hash = base::hash_combine(hash, values)), ...); };
  const auto add_technique = [&add](const Technique& technique) {
    add(technique.kv, technique.ma, technique.pulse_ms);
  };
  add(state.arm.lao_deg, state.arm.cranial_deg, state.arm.sid_mm);
  add(state.arm.isocentre_lps_mm.x, state.arm.isocentre_lps_mm.y, state.arm.isocentre_lps_mm.z);
  add(state.wait_s, state.collimator.open_u, state.collimator.open_v, state.frame_s);
  add_technique(state.technique);
  add_technique(state.last_technique);
  add(state.fluoroscopy_time_s, state.beam_while_moving_s, state.hand_in_beam_s);
  add(state.air_kerma_mgy, state.dap_mgy_cm2, state.collimated_s, state.views.widest_deg);
  for (int i = 0; i < state.views.count; ++i)
    add(state.views.lao_deg[static_cast<std::size_t>(i)], state.views.cranial_deg[static_cast<std::size_t>(i)]);
  add(std::uint64_t{state.frames} << 32U | state.reported);
  add(static_cast<std::uint64_t>(state.pulse_rate) << 32U | static_cast<std::uint64_t>(state.magnification) << 16U |
      static_cast<std::uint64_t>(state.views.count));
  add(std::uint64_t{(state.arm_moving ? 1U : 0U) | (state.beam_on ? 2U : 0U) | (state.frame_due ? 4U : 0U) |
                    (state.live ? 8U : 0U) | (state.hand_away ? 16U : 0U)});
  return hash;
}

std::uint64_t hash_of(const NeedleFlow& flow, std::uint64_t previous) noexcept {
  std::uint64_t hash = previous;
  const auto add = [&hash](auto... values) { ((hash = base::hash_combine(hash, values)), ...); };
  add(std::uint64_t{flow.stylet_out ? 1U : 0U} | std::uint64_t{static_cast<std::uint8_t>(flow.column)} << 8U |
      std::uint64_t{static_cast<std::uint8_t>(flow.at_hub)} << 16U |
      std::uint64_t{static_cast<std::uint8_t>(flow.aspirated)} << 24U);
  add(flow.column_ml, flow.syringe_ml, flow.injected_ml, flow.carried_away_ml);
  for (const ContrastPool& pool : flow.pools) {
    add(static_cast<std::uint64_t>(static_cast<std::int64_t>(pool.lumen)));
    add(pool.at_rest_lps_mm.x, pool.at_rest_lps_mm.y, pool.at_rest_lps_mm.z, pool.spread_ml, pool.contrast_ml);
  }
  return hash;
}

}  // namespace

std::uint64_t state_hash(const State& state, std::uint64_t previous) noexcept {
  std::uint64_t hash = previous;
  const auto add = [&hash](double value) { hash = base::hash_combine(hash, value); };
  const auto add_point = [&add](const glm::dvec3& p) {
    add(p.x);
    add(p.y);
    add(p.z);
  };
  const auto add_integer = [&hash](std::uint64_t value) { hash = base::hash_combine(hash, value); };
  add_integer(state.tick);
  add(state.t_s);
  add_point(state.needle.tip_lps_mm);
  add_point(state.needle.direction);
  add_point(state.needle.skin.tip_lps_mm);
  add(state.needle.skin.depth_mm);
  add_point(state.needle.skin.asked_lps_mm);
  add_integer(state.needle.skin.triangle);
  add_point(state.needle.skin.entry_lps_mm);
  add(state.needle.inserted_mm);
  add_point(state.probe.origin_lps_mm);
  add_point(state.probe.axial);
  add_point(state.probe.lateral);
  add(state.fire.t_s);
  add_point(state.fire.tip_lps_mm);
  add_point(state.fire.direction);
  add_integer((state.needle.skin.geometric_inside ? 1U : 0U) | (state.needle.skin.in_body ? 2U : 0U) |
              (state.probe.frozen ? 4U : 0U) | (state.fire.fired ? 8U : 0U) |
              (state.fluoroscopy.in_use ? 16U : 0U));
  if (state.breath.moves) {
    const BreathState& breath = state.breath.state;
    for (const double value : {breath.phase, breath.asked_s, breath.held, breath.cough_s, state.breath.level})
      add(value);
    add_integer(breath.breath << 2U | (breath.failed ? 1U : 0U) | (state.breath.hold_asked ? 2U : 0U));
    if (breath.hold_off != 0.0) {  // who holds alike and still has the hash of before there was another way
      add(breath.hold_off);
      add_integer(breath.holds);
    }
  }
  if (const ConsoleSetting& console = state.probe.console; !(console == ConsoleSetting{})) {
    for (const double value : {console.depth_mm, console.focus_mm, console.frequency_mhz, console.slice_mm})
      add(value);
    // Whoever leaves these off has the hash of before there were any.
    if (console.colour_mm_s != 0.0) add(console.colour_mm_s);
    if (console.compound_deg != 0.0 || console.lean_deg != 0.0 || console.box_across != 0.0 ||
        console.box_down != 0.0)
      for (const double value : {console.compound_deg, console.lean_deg, console.box_across, console.box_down})
        add(value);
  }
  if (state.flow.in_use) hash = hash_of(state.flow, hash);
  return state.fluoroscopy.in_use ? hash_of(state.fluoroscopy, hash) : hash;
}

}  // namespace seldinger::cases
