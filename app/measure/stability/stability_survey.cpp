#include "app/measure/stability/stability_survey.h"

#include <algorithm>

#include "app/measure/rigs/probe_trials.h"

namespace seldinger::measure {
namespace {

constexpr double kMostStepN = 0.15;
constexpr double kLeastWorkMj = -1.0;

// What the laws are put into, needle's first.
template <typename Look>
void each_situation(const haptics::ArmModel& device, const haptics::Hand& hand, double factor, Look look) {
  for (const NeedleSituation& situation : needle_situations())
    look(situation.name, settle_needle(situation, device, hand, factor));
  for (const ProbeSituation& situation : probe_situations())
    look(situation.name, settle_probe(situation, device, hand, factor));
}

void rest_of(const haptics::ArmModel& device, std::vector<RestRow>& rows) {
  for (const haptics::Hand& hand : haptics::hands())
    each_situation(device, hand, 1.0, [&](const char* name, const Settling& settling) {
      rows.push_back({device, hand, name, settling});
    });
}

MarginRow margin_of(const haptics::ArmModel& device) {
  MarginRow margin{device, 0.0, nullptr};
  for (const double factor : kMarginFactors) {
    each_situation(device, *haptics::find_hand("none"), factor, [&](const char* name, const Settling& settling) {
      if (margin.fails == nullptr && !settling.settled(device)) margin.fails = name;
    });
    if (margin.fails != nullptr) break;
    margin.rests_at = factor;
  }
  return margin;
}

}  // namespace

bool RestRow::holds() const noexcept {
  return settling.settled(device) && settling.least_work_mj >= kLeastWorkMj && settling.most_step_n <= kMostStepN;
}

bool breaks_the_rule(const WallCell& cell) noexcept {
  return cell.damping_n_s_mm == haptics::kWallDampingNSMm &&
         cell.stiffness_n_mm <= cell.bound_n_mm / haptics::kStiffnessMargin && !cell.settles;
}

bool StabilitySurvey::holds() const noexcept {
  return std::all_of(rest.begin(), rest.end(), [](const RestRow& row) { return row.holds(); }) &&
         std::all_of(maps.begin(), maps.end(), [](const WallMap& map) {
           return std::none_of(map.cells.begin(), map.cells.end(), &breaks_the_rule);
         });
}

StabilitySurvey survey_stability() {
  StabilitySurvey survey;
  for (haptics::ArmModel device : haptics::arm_models()) {
    rest_of(device, survey.rest);
    device.coulomb_n = kLeastCoulombN;
    for (device.delay_ticks = 0; device.delay_ticks <= haptics::kMostDelayTicks; ++device.delay_ticks) {
      rest_of(device, survey.rest);
      survey.margins.push_back(margin_of(device));
    }
  }
  haptics::ArmModel first = haptics::arm_models()[0];
  for (const haptics::Hand& hand : haptics::hands()) {
    if (hand.stiffness_n_mm == 0.0) continue;
    DrivenRow row{hand, drive_needle(first, hand).unrest_n, {}};
    for (std::size_t i = 0; i < std::size(kThesisMeans); ++i)
      row.thesis_n[i] = drive_thesis(first, hand, kThesisMeans[i]).unrest_n;
    survey.driven.push_back(row);
  }
  const haptics::Hand& none = *haptics::find_hand("none");
  survey.maps.push_back({first, none, wall_map(first, none)});
  first.coulomb_n = kLeastCoulombN;
  survey.maps.push_back({first, none, wall_map(first, none)});
  return survey;
}

}  // namespace seldinger::measure
