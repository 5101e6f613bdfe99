#include "sim/engine/moving_tissue.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace seldinger::engine {

MovingTissue::MovingTissue(const cases::Case& scene) : scene_(scene) {
  if (scene.breathing) region_ = tissue::breath_region(scene);
  if (region_ && scene.breathing->slides) wall_ = tissue::cavity_wall(scene);
  if (scene.yields) veins_ = tissue::compressible_veins(scene);
  if (scene.yields && scene.touch.law == cases::TouchLaw::organs_move) organs_ = tissue::loose_organs(scene);
}

tissue::Displacement MovingTissue::of(const cases::State& state, const haptics::HandStates* presses,
                                      const haptics::HandStates* drags) const noexcept {
  if (!moves()) return {};
  tissue::Causes causes;
  std::array<tissue::SkinPress, tissue::kMostPresses> pressed;
  std::size_t count = 0;
  if (scene_.yields && presses != nullptr)
    for (const haptics::HandState& hand : *presses)
      if (hand.tool == haptics::Tool::probe && hand.probe.press.depth_mm > 0.0 && count < pressed.size())
        pressed[count++] = hand.probe.press;
  causes.presses = {pressed.data(), count};
  std::array<tissue::SqueezedVein, tissue::kMostVeins> closing;
  std::size_t closed = 0;
  for (const tissue::CompressibleVein& vein : veins_) {
    std::optional<tissue::SqueezedVein> most;  // by what presses it most
    for (const tissue::SkinPress& press : causes.presses)
      if (const auto by = tissue::squeezed(vein, press, haptics::SoftContact{}.shear_n_mm2);
          by && (!most || by->area_share < most->area_share))
        most = by;
    if (most) closing[closed++] = *most;
  }
  causes.veins = {closing.data(), closed};
  if (scene_.yields && drags != nullptr)
    for (const haptics::HandState& hand : *drags)
      if (hand.tool == haptics::Tool::needle) causes.needle = hand.needle.drag;
  if (causes.needle) causes.organ = tissue::pushed(organs_, *causes.needle);
  if (region_)
    causes.breath = tissue::Breath{*region_, tissue::breath_amount_mm(*scene_.breathing, state.breath.level),
                                   wall_ ? &*wall_ : nullptr};
  return tissue::displacement_of(causes);
}

tissue::Displacement MovingTissue::felt_by_needle(const cases::State& state,
                                                  const haptics::HandStates& hands) const noexcept {
  return of(state, &hands, nullptr);
}
tissue::Displacement MovingTissue::felt_by_probe(const cases::State& state) const noexcept {
  return of(state, nullptr, nullptr);
}
tissue::Displacement MovingTissue::seen(const cases::State& state,
                                        const haptics::HandStates& hands) const noexcept {
  return of(state, &hands, &hands);
}

cases::ToolPose at_rest(const tissue::Displacement& displacement, const cases::ToolPose& pose,
                        double behind_mm) noexcept {
  if (tissue::count_sources(displacement) == 0) return pose;
  cases::ToolPose rest = pose;
  rest.position_lps_mm = tissue::rest_of(displacement, pose.position_lps_mm);
  const glm::dvec3 along =
      rest.position_lps_mm - tissue::rest_of(displacement, pose.position_lps_mm - behind_mm * pose.axis);
  const double length2 = glm::dot(along, along);
  if (length2 > 0.0) rest.axis = along / std::sqrt(length2);
  return rest;
}

}  // namespace seldinger::engine
