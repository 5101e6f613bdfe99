#include "sim/case/state.h"

#include "sim/base/hash.h"

namespace seldinger::cases {

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
              (state.probe.frozen ? 4U : 0U) | (state.fire.fired ? 8U : 0U));
  return hash;
}

}  // namespace seldinger::cases
