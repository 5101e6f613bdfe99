#include <cmath>
#include <nlohmann/json.hpp>

#include "app/measure/stability/stability_answer.h"

namespace seldinger::measure {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

}  // namespace

std::string json_of_stability(const StabilitySurvey& survey) {
  Json devices = Json::array(), rest = Json::array(), margins = Json::array(), driven = Json::array(),
       walls = Json::array();
  for (const haptics::ArmModel& device : haptics::arm_models())
    devices.push_back({{"device", device.name},
                       {"delay_ms", device.delay_ticks},
                       {"stiffness_n_mm", haptics::stiffness_n_mm(device)},
                       {"provenance", device.provenance}});
  for (const RestRow& row : survey.rest)
    rest.push_back({{"device", row.device.name},
                    {"dry_friction_n", row.device.coulomb_n},
                    {"delay_ms", row.device.delay_ticks},
                    {"hand", row.hand.name},
                    {"situation", row.situation},
                    {"rest_s", number(row.settling.rest_s)},
                    {"position_mm", number(row.settling.position_mm)},
                    {"force_n", number(row.settling.force_n)},
                    {"least_work_mj", number(row.settling.least_work_mj)},
                    {"most_step_n", number(row.settling.most_step_n)},
                    {"holds", row.holds()}});
  for (const MarginRow& row : survey.margins)
    margins.push_back({{"device", row.device.name},
                       {"dry_friction_n", row.device.coulomb_n},
                       {"delay_ms", row.device.delay_ticks},
                       {"rests_at", row.rests_at},
                       {"fails", row.fails == nullptr ? Json(nullptr) : Json(row.fails)}});
  for (const DrivenRow& row : survey.driven) {
    Json thesis = Json::array();
    for (std::size_t i = 0; i < std::size(kThesisMeans); ++i)
      thesis.push_back({{"m", kThesisMeans[i]}, {"unrest_n", number(row.thesis_n[i])}});
    driven.push_back({{"hand", row.hand.name}, {"unrest_n", number(row.ours_n)}, {"thesis", thesis}});
  }
  for (const WallMap& map : survey.maps)
    for (const WallCell& cell : map.cells)
      walls.push_back({{"device", map.device.name},
                       {"dry_friction_n", map.device.coulomb_n},
                       {"hand", map.hand.name},
                       {"delay_ms", cell.delay_ticks},
                       {"damping_n_s_mm", cell.damping_n_s_mm},
                       {"stiffness_n_mm", cell.stiffness_n_mm},
                       {"bound_n_mm", cell.bound_n_mm},
                       {"settles", cell.settles}});
  const Json document = {{"holds", survey.holds()},    {"devices", devices},      {"at_rest", rest},
                         {"stiffness_times", margins}, {"needle_driven", driven}, {"walls", walls}};
  return document.dump(2) + "\n";
}

}  // namespace seldinger::measure
