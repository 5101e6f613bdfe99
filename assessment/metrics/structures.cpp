// Metrics of what lies beside the target: structures to stay out of, to cross, to enter once, and the target's far
// wall.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <variant>
#include <vector>

#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

using cases::Structure;
using cases::StructureRule;

constexpr double kContactMm = 0.5;      // clinical.md: any path longer than this inside
constexpr double kClearanceMm = 20.0;   // nobody asks how far beyond
constexpr double kNearMm = 4.0;         // first asked within this
constexpr double kDeepMm = 64.0;        // deeper inside is this deep
constexpr std::size_t kWayPart = 64;    // points of the way asked together
constexpr double kNeedleEndMm = 200.0;  // farther than any lumen's far wall

bool no_go(const Structure& structure) {
  return structure.rule == StructureRule::critical || structure.rule == StructureRule::major ||
         structure.rule == StructureRule::advisory;
}

// The box around a structure, which most of the way is outside of.
class Boxed {
 public:
  explicit Boxed(const Structure& structure) : structure_(&structure), box_(cases::bounds_of(structure.shape)) {}
  // By a formula, which is asked at no cost.
  bool drawn() const { return !std::holds_alternative<cases::VoxelSet>(structure_->shape); }
  // A lower bound of the distance, mm.
  double beyond_mm(const glm::dvec3& p) const {
    return glm::length(glm::max(glm::dvec3(0.0), glm::max(box_.low_lps_mm - p, p - box_.high_lps_mm)));
  }
  std::vector<cases::Stretch> stretches(const glm::dvec3& a, const glm::dvec3& b) const {
    for (int axis = 0; axis < 3; ++axis)
      if (std::max(a[axis], b[axis]) < box_.low_lps_mm[axis] || std::min(a[axis], b[axis]) > box_.high_lps_mm[axis])
        return {};
    return cases::stretches_inside(structure_->shape, a, b);
  }
  // Exact below `enough_mm`, else some lower bound that is not below it. Far is asked in voxels at a high price, so
  // the search widens only as long as it must, from a lower bound that is known.
  double distance_mm(const glm::dvec3& p, double known_mm, double enough_mm) const {
    const double bound_mm = std::max(known_mm, beyond_mm(p));
    if (bound_mm > 0.0 && bound_mm >= enough_mm) return bound_mm;
    double most_mm = std::max(kNearMm, enough_mm);
    for (double limit_mm = std::max(kNearMm, bound_mm + kNearMm);; limit_mm *= 2.0) {
      const double asked_mm = std::min(limit_mm, most_mm);
      const double found_mm = cases::signed_distance_mm(structure_->shape, p, asked_mm);
      if (std::abs(found_mm) < asked_mm || found_mm >= enough_mm || limit_mm >= kDeepMm) return found_mm;
      if (found_mm < 0.0) most_mm = kDeepMm;
    }
  }
  bool contains(const glm::dvec3& p) const {
    return beyond_mm(p) == 0.0 && cases::signed_distance_mm(structure_->shape, p, 1e-3) < 0.0;
  }

 private:
  const Structure* structure_;
  cases::Bounds box_;
};

template <typename Chosen>
std::vector<Boxed> chosen(const Signals& signals, const Chosen& is) {
  std::vector<Boxed> found;
  for (const Structure& structure : signals.setting.structures)
    if (is(structure)) found.emplace_back(structure);
  return found;
}
template <StructureRule rule>
bool of_rule(const Structure& structure) {
  return structure.rule == rule;
}

// Length of a → b inside any of them, each part once.
double length_inside_mm(const std::vector<Boxed>& structures, const glm::dvec3& a, const glm::dvec3& b) {
  std::vector<cases::Stretch> all;
  for (const Boxed& one : structures) {
    const auto found = one.stretches(a, b);
    all.insert(all.end(), found.begin(), found.end());
  }
  std::sort(all.begin(), all.end(), [](const auto& x, const auto& y) { return x.from < y.from; });
  double share = 0.0, reached = 0.0;
  for (const cases::Stretch& stretch : all) {
    share += std::max(0.0, stretch.to - std::max(reached, stretch.from));
    reached = std::max(reached, stretch.to);
  }
  return share * glm::distance(a, b);
}

// The tip in and out of one structure: a visit is more than kContactMm of way inside, and ends with as much
// outside.
struct Visits {
  int entered = 0;       // from outside
  int began_inside = 0;  // 1 when the way began inside
  int through = 0;       // left forwards, along the needle: through the far wall
};
Visits visits_of(const Boxed& structure, const std::vector<TraceSegment>& trace) {
  Visits visits;
  bool visiting = false, left_forwards = false, any = false;
  double inside_mm = 0.0, outside_mm = 0.0;
  bool began_inside = false;
  const auto pass = [&](bool inside, double length_mm, bool forwards) {
    if (!any) began_inside = inside;
    any = true;
    if (inside) {
      inside_mm += length_mm;
      outside_mm = 0.0;
      if (inside_mm > kContactMm && !visiting) {
        visiting = true;
        (began_inside ? visits.began_inside : visits.entered) += 1;
        began_inside = false;
      }
      return;
    }
    if (outside_mm == 0.0) left_forwards = forwards;
    outside_mm += length_mm;
    if (outside_mm > kContactMm) {
      if (visiting && left_forwards) ++visits.through;
      visiting = began_inside = false;
      inside_mm = 0.0;
    }
  };
  for (const TraceSegment& segment : trace) {
    const glm::dvec3 way = segment.to_lps_mm - segment.from_lps_mm;
    const double length_mm = glm::length(way);
    const bool forwards = glm::dot(way, segment.needle_direction) > 0.0;
    double at = 0.0;
    for (const cases::Stretch& stretch : structure.stretches(segment.from_lps_mm, segment.to_lps_mm)) {
      if (stretch.from > at) pass(false, (stretch.from - at) * length_mm, forwards);
      pass(true, (stretch.to - stretch.from) * length_mm, forwards);
      at = stretch.to;
    }
    if (at < 1.0) pass(false, (1.0 - at) * length_mm, forwards);
  }
  return visits;
}

template <typename Chosen>
Measured sum_of_visits(const Signals& signals, const Chosen& is, int (*part)(const Visits&)) {
  int sum = 0;
  for (const Boxed& structure : chosen(signals, is)) sum += part(visits_of(structure, signals.trace));
  return Measured::of(sum);
}

template <typename Chosen>
Measured path_inside(const Signals& signals, const Chosen& is) {
  const auto structures = chosen(signals, is);
  double length_mm = 0.0;
  for (const TraceSegment& segment : signals.trace)
    length_mm += length_inside_mm(structures, segment.from_lps_mm, segment.to_lps_mm);
  return Measured::of(length_mm);
}

Measured nogo_contacts(const Signals& signals) {
  return sum_of_visits(signals, &no_go, [](const Visits& visits) { return visits.entered + visits.began_inside; });
}
Measured nogo_length(const Signals& signals) {
  return path_inside(signals, &no_go);
}
Measured nogo_length_critical(const Signals& signals) {
  return path_inside(signals, &of_rule<StructureRule::critical>);
}
Measured nogo_length_major(const Signals& signals) {
  return path_inside(signals, &of_rule<StructureRule::major>);
}
Measured nogo_length_advisory(const Signals& signals) {
  return path_inside(signals, &of_rule<StructureRule::advisory>);
}

Measured nogo_time(const Signals& signals) {
  const auto structures = chosen(signals, &no_go);
  double time_s = 0.0;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i) {
    if (signals.gap(i)) continue;
    const glm::dvec3& tip = signals.poses[i].tip_at_rest_lps_mm();
    if (std::any_of(structures.begin(), structures.end(), [&](const Boxed& one) { return one.contains(tip); }))
      time_s += signals.interval_s(i);
  }
  return Measured::of(time_s);
}

// A distance changes by no more than the way: of a part of it, what is not nearer than `nearest_mm` in the middle
// by the part's extent is nowhere nearer.
void come_nearer(const Boxed& structure, std::span<const glm::dvec3> way, double known_mm, double& nearest_mm) {
  if (way.empty()) return;
  const std::size_t middle = way.size() / 2;
  double extent_mm = 0.0;
  for (const glm::dvec3& p : way) extent_mm = std::max(extent_mm, glm::distance(p, way[middle]));
  const double distance_mm = structure.distance_mm(way[middle], known_mm, nearest_mm + extent_mm);
  if (distance_mm >= nearest_mm + extent_mm) return;
  nearest_mm = std::min(nearest_mm, distance_mm);
  come_nearer(structure, way.first(middle), distance_mm - extent_mm, nearest_mm);
  come_nearer(structure, way.subspan(middle + 1), distance_mm - extent_mm, nearest_mm);
}

Measured clearance_min(const Signals& signals) {
  std::vector<glm::dvec3> way;
  for (const TraceSegment& segment : signals.trace) {
    if (!segment.in_body) continue;
    const double length_mm = glm::distance(segment.from_lps_mm, segment.to_lps_mm);
    const int pieces = std::max(1, static_cast<int>(length_mm / kContactMm));  // a throw is one long segment
    for (int piece = 0; piece <= pieces; ++piece)
      way.push_back(glm::mix(segment.from_lps_mm, segment.to_lps_mm, static_cast<double>(piece) / pieces));
  }
  double nearest_mm = kClearanceMm;
  auto structures = chosen(signals, &no_go);
  std::stable_partition(structures.begin(), structures.end(), [](const Boxed& one) { return one.drawn(); });
  for (const Boxed& structure : structures)
    for (std::size_t from = 0; from < way.size(); from += kWayPart)
      come_nearer(structure, std::span(way).subspan(from, std::min(kWayPart, way.size() - from)), -kClearanceMm,
                  nearest_mm);
  return Measured::of(nearest_mm);
}

Measured must_cross_length(const Signals& signals) {
  const cases::SkinPassage& skin = signals.passages.back();
  if (!skin.in_body) return Measured::none("not_in_tissue_at_the_end");
  return Measured::of(length_inside_mm(chosen(signals, &of_rule<StructureRule::must_cross>), skin.entry_lps_mm,
                                       signals.endpoint->tip_at_rest_lps_mm()));
}

Measured capsule_punctures(const Signals& signals) {
  return sum_of_visits(signals, &of_rule<StructureRule::organ>,
                       [](const Visits& visits) { return visits.entered; });
}

Measured posterior_wall(const Signals& signals) {
  return sum_of_visits(signals, &of_rule<StructureRule::target>,
                       [](const Visits& visits) { return visits.through; });
}

Measured back_wall_dist(const Signals& signals) {
  const glm::dvec3& tip = signals.endpoint->tip_at_rest_lps_mm();
  const glm::dvec3 beyond = tip + signals.endpoint->direction * kNeedleEndMm;
  for (const Boxed& lumen : chosen(signals, &of_rule<StructureRule::target>)) {
    if (!lumen.contains(tip)) continue;
    const auto stretches = lumen.stretches(tip, beyond);
    if (!stretches.empty()) return Measured::of(stretches.front().to * kNeedleEndMm);
  }
  return Measured::none("not_in_target_structure");
}

constexpr const char* kClinical =
    "never-event metrics of simulators (ImaGiNe-S: Johnson et al., BJR 85, 2012, 555)";
constexpr const char* kCapsule =
    "each way through the capsule may bleed: SIR 2019 guidelines count liver and kidney as high risk";
constexpr const char* kWall =
    "posterior wall puncture, the error of vascular access: Blaivas and Adhikari, Crit. Care Med. 37 (2009) 2345";

constexpr MetricInfo kStructuresMetrics[] = {
    {"nogo_contacts", 1, "count", "No-go contacts", Group::safety, Direction::lower_is_better, kNoGo,
     "Times the tip's way, a core needle's throw included, went more than 0.5 mm inside a structure to stay out "
     "of; the "
     "next counts after 0.5 mm outside. Steps of under 0.25 mm are no way.",
     kClinical, &nogo_contacts},
    {"clearance_min", 1, "mm", "Least clearance", Group::safety, Direction::higher_is_better,
     kNoGo | kSkin | kMotion | kTissue,
     "Least distance of the tip in tissue, on its way and in a core needle's throw, from a structure to stay out "
     "of; "
     "negative inside, at most 20.",
     kClinical, &clearance_min},
    {"capsule_punctures", 1, "count", "Capsule punctures", Group::safety, Direction::lower_is_better, kOrgan,
     "Times the tip, a core needle's throw included, went from outside more than 0.5 mm into the organ that "
     "carries "
     "the target; the next counts after 0.5 mm outside.",
     kCapsule, &capsule_punctures},
    {"posterior_wall", 1, "count", "Far wall punctures", Group::safety, Direction::lower_is_better, kLumen,
     "Times the tip, a core needle's throw included, left the lumen to be reached forwards, by more than 0.5 mm.",
     kWall, &posterior_wall},
    {"back_wall_dist", 1, "mm", "Before far wall", Group::safety, Direction::higher_is_better, kLumen | kEndpoint,
     "At the endpoint, along the needle from the tip in the lumen to be reached to its far wall. Null: "
     "not_in_target_structure.",
     kWall, &back_wall_dist},
    {"must_cross_length", 1, "mm", "Way through must-cross", Group::safety, Direction::higher_is_better,
     kMustCross | kEndpoint | kSkin,
     "At the endpoint, length of the needle from the skin to the tip inside structures through which the right way "
     "leads (renal parenchyma before a calyx). Null: not_in_tissue_at_the_end.",
     "puncture through the parenchyma: Sampaio et al., J. Urol. 148 (1992) 1769", &must_cross_length},
    {"nogo_length", 1, "mm", "Way through no-go", Group::safety, Direction::lower_is_better, kNoGo,
     "Length of the tip's way, to and fro and a core needle's throw included, inside structures to stay out of; "
     "where "
     "two overlap it counts once.",
     kClinical, &nogo_length},
    {"nogo_length_critical", 1, "mm", "Way through critical", Group::safety, Direction::lower_is_better,
     kNoGoCritical, "As nogo_length, of structures that must never be touched.", kClinical, &nogo_length_critical},
    {"nogo_length_major", 1, "mm", "Way through major", Group::safety, Direction::lower_is_better, kNoGoMajor,
     "As nogo_length, of structures whose injury is a complication.", kClinical, &nogo_length_major},
    {"nogo_length_advisory", 1, "mm", "Way through advisory", Group::safety, Direction::lower_is_better,
     kNoGoAdvisory, "As nogo_length, of structures that are better avoided.", kClinical, &nogo_length_advisory},
    {"nogo_time", 1, "s", "Time in no-go", Group::safety, Direction::lower_is_better, kNoGo | kMotion,
     "Time with the tip inside structures to stay out of. Gaps over 0.25 s belong to no time.", kClinical,
     &nogo_time},
};

}  // namespace

std::span<const MetricInfo> structure_metrics() {
  return kStructuresMetrics;
}

}  // namespace seldinger::assessment
