#include "app/measure/rigs/wall_map.h"

#include "app/measure/rigs/settling.h"
#include "app/measure/rigs/wall.h"
#include "sim/haptics/contact/elastic_damper.h"

namespace seldinger::measure {
namespace {

constexpr double kStillN = 0.1;  // beside one count of the encoder through the spring (docs/touch.md)

}  // namespace

std::vector<WallCell> wall_map(const haptics::ArmModel& device, const haptics::Hand& hand) {
  std::vector<WallCell> map;
  for (int delay = 0; delay <= haptics::kMostDelayTicks; ++delay)
    for (const double damping : kMapDampingNSMm)
      for (const double stiffness : kMapStiffnessNMm) {
        Trial trial{device, hand};
        trial.device.delay_ticks = delay;
        trial.speed_mm_s = 100.0;
        Wall wall(stiffness, damping, haptics::kDamperCutoffHz);
        const Settling settling = settle(trial, [&](double depth_mm) { return wall.advance(depth_mm); });
        map.push_back({stiffness, damping, delay,
                       haptics::stiffness_bound_n_mm(device.damping_n_s_mm + damping, haptics::kTickS,
                                                     delay * haptics::kTickS),
                       settling.position_mm <= device.encoder_mm * (1.0 + 1e-9) &&
                           settling.force_n <= kStillN + stiffness * device.encoder_mm});
      }
  return map;
}

}  // namespace seldinger::measure
