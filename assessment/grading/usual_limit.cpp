#include "assessment/grading/usual_limit.h"

#include <algorithm>
#include <iterator>
#include <string_view>

#include "assessment/registry.h"

namespace seldinger::assessment {
namespace {

// Where the unit alone says too little; many as the cases have them that the program brings along.
struct Usual {
  std::string_view metric;
  double value;
};
constexpr Usual kUsual[] = {{"core_in_target", 8.0},
                            {"tip_target_dist", 5.0},
                            {"tip_target_surface", 0.0},
                            {"tip_target_axial", 3.0},
                            {"tip_target_lateral", 3.0},
                            {"clearance_min", 3.0},
                            {"back_wall_dist", 2.0},
                            {"blind_advance_max", 5.0},
                            {"longest_advance_between_sights", 8.0},
                            {"longest_advance_between_exposures", 10.0},
                            {"withdrawals_full", 0.0},
                            {"nogo_contacts", 0.0},
                            {"nogo_length", 0.0},
                            {"nogo_length_critical", 0.0},
                            {"nogo_length_major", 0.0},
                            {"nogo_time", 0.0},
                            {"posterior_wall", 0.0},
                            {"steps_violated", 0.0},
                            {"pain_reactions", 0.0},
                            {"breath_holds_failed", 0.0},
                            {"hand_in_beam", 0.0},
                            {"beam_while_moving", 0.0},
                            {"pulses", 300.0},
                            {"views", 2.0},
                            {"view_angle_max", 30.0},
                            {"pulse_rate_max", 7.5},
                            {"path_tip", 500.0},
                            {"path_in_tissue", 200.0},
                            {"path_inefficiency", 50.0},
                            {"swept_area", 500.0},
                            {"ldlj", -10.0},
                            {"sparc", -5.0},
                            {"sample_rate_p5", 60.0},
                            {"tracking_jumps", 0.0},
                            {"jumps_unrepaired", 0.0}};

double usual_value(const MetricInfo& info, bool at_most) {
  const auto own =
      std::find_if(std::begin(kUsual), std::end(kUsual), [&](const Usual& one) { return one.metric == info.id; });
  if (own != std::end(kUsual)) return own->value;
  switch (info.estimand.scale) {
    case Scale::yes_no:
      return at_most ? 0.0 : 1.0;
    case Scale::share:
      return at_most ? 0.2 : 0.8;
    case Scale::count:
      return 1.0;
    case Scale::ratio:
    case Scale::interval:
      break;
  }
  if (std::string_view(info.unit) == "s") return info.group == Group::time ? 300.0 : 60.0;
  return 10.0;  // mm, deg, N
}

}  // namespace

Criterion usual_criterion(const MetricInfo& info, cases::SightLaw law) {
  Criterion usual;
  usual.metric = info.id;
  usual.version = version_of(info, law);
  const bool at_most = info.direction == Direction::lower_is_better ||
                       (info.direction == Direction::none && info.estimand.scale != Scale::yes_no);
  usual.comparison = at_most ? Comparison::at_most : Comparison::at_least;
  usual.value = usual_value(info, at_most);
  return usual;
}

}  // namespace seldinger::assessment
