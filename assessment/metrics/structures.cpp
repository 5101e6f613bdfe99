// Metrics of what lies beside the target: structures to stay out of, to cross, to enter once, and the target's far
// wall.
#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "assessment/metrics/structure_visits.h"
#include "assessment/metrics/tables.h"
#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

using cases::Structure;
using cases::StructureRule;

constexpr std::size_t kWayPart = 64;    // points of the way asked together
constexpr double kNeedleEndMm = 200.0;  // farther than any lumen's far wall

bool no_go(const Structure& structure) {
  return structure.rule == StructureRule::critical || structure.rule == StructureRule::major ||
         structure.rule == StructureRule::advisory;
}

template <typename Chosen>
std::vector<BoxedStructure> chosen(const Signals& signals, const Chosen& is) {
  std::vector<BoxedStructure> found;
  for (const Structure& structure : signals.setting.structures)
    if (is(structure)) found.emplace_back(structure);
  return found;
}
template <StructureRule rule>
bool of_rule(const Structure& structure) {
  return structure.rule == rule;
}

template <typename Chosen>
Measured count_visits(const Signals& signals, const Chosen& is, bool (*counts)(const Visit&)) {
  std::ptrdiff_t sum = 0;
  for (const BoxedStructure& structure : chosen(signals, is)) {
    const std::vector<Visit> visits = visits_of(structure, signals.trace);
    sum += std::count_if(visits.begin(), visits.end(), counts);
  }
  return Measured::of(static_cast<double>(sum));
}

// When those visits began, or ended.
template <typename Chosen>
std::vector<double> times_of_visits(const Signals& signals, const Chosen& is, bool (*counts)(const Visit&),
                                    double Visit::*when) {
  std::vector<double> times;
  for (const BoxedStructure& structure : chosen(signals, is))
    for (const Visit& visit : visits_of(structure, signals.trace))
      if (counts(visit)) times.push_back(visit.*when);
  std::sort(times.begin(), times.end());
  return times;
}

bool any_visit(const Visit&) {
  return true;
}
bool entered(const Visit& visit) {
  return !visit.began_inside;
}
bool went_through(const Visit& visit) {
  return visit.through;
}

template <typename Chosen>
Measured path_inside(const Signals& signals, const Chosen& is) {
  std::vector<std::vector<cases::Stretch>> inside(signals.trace.size());
  for (const BoxedStructure& structure : chosen(signals, is))
    for (const Visit& visit : visits_of(structure, signals.trace))
      for (const WayPart& part : visit.inside) inside[part.segment].push_back(part.stretch);
  double length_mm = 0.0;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const TraceSegment& segment = signals.trace[i];
    length_mm += covered_share(std::move(inside[i])) * glm::distance(segment.from_lps_mm, segment.to_lps_mm);
  }
  return Measured::of(length_mm);
}

Measured nogo_contacts(const Signals& signals) {
  return count_visits(signals, &no_go, &any_visit);
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

// Whether the tip of a pose is inside is asked only while a visit may have lasted: a graze is none.
Measured nogo_time(const Signals& signals) {
  const auto structures = chosen(signals, &no_go);
  std::vector<std::vector<Visit>> visits;
  for (const BoxedStructure& structure : structures) visits.push_back(visits_of(structure, signals.trace));
  const auto inside = [&](std::size_t structure, double t_s, const glm::dvec3& tip) {
    return std::any_of(visits[structure].begin(), visits[structure].end(),
                       [&](const Visit& visit) { return t_s >= visit.from_s && t_s <= visit.to_s; }) &&
           structures[structure].contains(tip);
  };
  double time_s = 0.0;
  for (std::size_t i = 0; i + 1 < signals.poses.size(); ++i) {
    if (signals.gap(i)) continue;
    bool any = false;
    for (std::size_t k = 0; k < structures.size() && !any; ++k)
      any = inside(k, signals.poses[i].t_s, signals.poses[i].tip_at_rest_lps_mm());
    if (any) time_s += signals.interval_s(i);
  }
  return Measured::of(time_s);
}

Measured nogo_uncertainty(const Signals& signals) {
  double half_mm = 0.0;
  for (const BoxedStructure& structure : chosen(signals, &no_go))
    half_mm = std::max(half_mm, structure.half_voxel_mm());
  return Measured::of(half_mm);
}

// A distance changes by no more than the way: of a part of it, what is not nearer than `nearest_mm` in the middle
// by the part's extent is nowhere nearer.
void come_nearer(const BoxedStructure& structure, std::span<const glm::dvec3> way, double known_mm,
                 double& nearest_mm) {
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
    const int pieces = std::max(1, static_cast<int>(length_mm / kVisitMm));  // a throw is one long segment
    for (int piece = 0; piece <= pieces; ++piece)
      way.push_back(glm::mix(segment.from_lps_mm, segment.to_lps_mm, static_cast<double>(piece) / pieces));
  }
  double nearest_mm = kMostClearanceMm;
  auto structures = chosen(signals, &no_go);
  std::stable_partition(structures.begin(), structures.end(),
                        [](const BoxedStructure& one) { return one.drawn(); });
  for (const BoxedStructure& structure : structures)
    for (std::size_t from = 0; from < way.size(); from += kWayPart)
      come_nearer(structure, std::span(way).subspan(from, std::min(kWayPart, way.size() - from)), -kMostClearanceMm,
                  nearest_mm);
  return Measured::of(nearest_mm);
}

Measured must_cross_length(const Signals& signals) {
  const cases::SkinPassage& skin = signals.passages.back();
  if (!skin.in_body) return Measured::none("not_in_tissue_at_the_end");
  const glm::dvec3 &from = skin.entry_lps_mm, &to = signals.endpoint->tip_at_rest_lps_mm();
  std::vector<cases::Stretch> inside;
  for (const BoxedStructure& structure : chosen(signals, &of_rule<StructureRule::must_cross>)) {
    const auto found = structure.stretches(from, to);
    inside.insert(inside.end(), found.begin(), found.end());
  }
  return Measured::of(covered_share(std::move(inside)) * glm::distance(from, to));
}

Measured capsule_punctures(const Signals& signals) {
  return count_visits(signals, &of_rule<StructureRule::organ>, &entered);
}

Measured posterior_wall(const Signals& signals) {
  return count_visits(signals, &of_rule<StructureRule::target>, &went_through);
}

Measured back_wall_dist(const Signals& signals) {
  const glm::dvec3& tip = signals.endpoint->tip_at_rest_lps_mm();
  const glm::dvec3 beyond = tip + signals.endpoint->direction * kNeedleEndMm;
  for (const BoxedStructure& lumen : chosen(signals, &of_rule<StructureRule::target>)) {
    if (!lumen.contains(tip)) continue;
    const auto stretches = lumen.stretches(tip, beyond);
    if (!stretches.empty()) return Measured::of(stretches.front().to * kNeedleEndMm);
  }
  return Measured::none("not_in_target_structure");
}

constexpr const char* kClinical =
    "never-event metrics of simulators (ImaGiNe-S: Johnson et al., BJR 85, 2012, 555)";
constexpr const char* kCapsule =
    "each pass through the capsule may bleed: SIR 2019 guidelines count liver and kidney as high risk";
constexpr const char* kWall =
    "posterior wall puncture, the error of vascular access: Blaivas and Adhikari, Crit. Care Med. 37 (2009) 2345";

constexpr MetricInfo kStructuresMetrics[] = {
    {"nogo_contacts", 1, "count", "No-go contacts", Group::safety, Direction::lower_is_better, kNoGo,
     "Times the tip's path, a core needle's throw included, went more than 0.5 mm inside a structure to stay out "
     "of; the next one counts once the tip has been 0.5 mm outside. Steps of under 0.25 mm are ignored. Where a "
     "structure comes from voxels, its surface is known to within nogo_uncertainty.",
     kClinical, &nogo_contacts, kMeanCount, kOfTheTrace},
    {"clearance_min", 1, "mm", "Least clearance", Group::safety, Direction::higher_is_better,
     kNoGo | kSkin | kMotion | kTissue,
     "Smallest distance of the tip in tissue, on its path and in a core needle's throw, from a structure to stay "
     "out of; negative inside, even where the path inside is too short to be a contact; at most 20. Where a "
     "structure comes from voxels, its surface is known to within nogo_uncertainty.",
     kClinical, &clearance_min, kMedianInterval, kOfTheTrace | kNothingIsNothing},
    {"capsule_punctures", 1, "count", "Capsule punctures", Group::safety, Direction::lower_is_better, kOrgan,
     "Times the tip, a core needle's throw included, went from outside more than 0.5 mm into the organ that "
     "carries the target; the next one counts once the tip has been 0.5 mm outside.",
     kCapsule, &capsule_punctures, kMeanCount, kOfTheTrace},
    {"posterior_wall", 1, "count", "Far wall punctures", Group::safety, Direction::lower_is_better, kLumen,
     "Times the tip, a core needle's throw included, left the lumen to be reached forwards, by more than 0.5 mm.",
     kWall, &posterior_wall, kMeanCount, kOfTheTrace},
    {"back_wall_dist", 1, "mm", "Before far wall", Group::safety, Direction::higher_is_better, kLumen | kEndpoint,
     "At the endpoint, along the needle from the tip in the lumen to be reached to its far wall. Null: "
     "not_in_target_structure.",
     kWall, &back_wall_dist, kMedianRatioOrFailure, kOfTheWay | kNothingIsNothing},
    {"must_cross_length", 1, "mm", "Path through must-cross structures", Group::safety, Direction::higher_is_better,
     kMustCross | kEndpoint | kSkin,
     "At the endpoint, length of the needle, from the skin to the tip, inside structures that the right path "
     "crosses (renal parenchyma before a calyx). Null: not_in_tissue_at_the_end.",
     "puncture through the parenchyma: Sampaio et al., J. Urol. 148 (1992) 1769", &must_cross_length,
     kMedianRatioOrFailure, kOfTheWay | kNothingIsNothing},
    {"nogo_length", 2, "mm", "Path through no-go structures", Group::safety, Direction::lower_is_better, kNoGo,
     "Length of the tip's path, to and fro and a core needle's throw included, inside structures to stay out of, "
     "from the start of each visit that nogo_contacts counts; shorter visits add 0. Where two structures overlap, "
     "it counts once. Where a structure comes from voxels, its surface is known to within nogo_uncertainty.",
     kClinical, &nogo_length, kMedianRatio, kOfTheTrace,
     "1: every length inside counted, a graze of under 0.5 mm, too."},
    {"nogo_length_critical", 2, "mm", "Path through critical structures", Group::safety, Direction::lower_is_better,
     kNoGoCritical, "As nogo_length, of structures that must never be touched.", kClinical, &nogo_length_critical,
     kMedianRatio, kOfTheTrace, "1: every length inside counted, a graze of under 0.5 mm, too."},
    {"nogo_length_major", 2, "mm", "Path through major structures", Group::safety, Direction::lower_is_better,
     kNoGoMajor, "As nogo_length, of structures whose injury is a complication.", kClinical, &nogo_length_major,
     kMedianRatio, kOfTheTrace, "1: every length inside counted, a graze of under 0.5 mm, too."},
    {"nogo_length_advisory", 2, "mm", "Path through advisory structures", Group::safety, Direction::lower_is_better,
     kNoGoAdvisory, "As nogo_length, of structures that are better avoided.", kClinical, &nogo_length_advisory,
     kMedianRatio, kOfTheTrace, "1: every length inside counted, a graze of under 0.5 mm, too."},
    {"nogo_time", 2, "s", "Time in no-go", Group::safety, Direction::lower_is_better, kNoGo | kMotion,
     "Time with the tip inside structures to stay out of, from the start of each visit that nogo_contacts counts; "
     "shorter visits add 0. Gaps over 0.25 s are left out.",
     kClinical, &nogo_time, kMedianRatio, kAnyPlace | kInAnyBreath | kIdleBefore | kOneDarkFrame | kLostSamples,
     "1: every time inside counted, a graze of under 0.5 mm, too."},
    {"nogo_uncertainty", 1, "mm", "No-go surfaces known to", Group::safety, Direction::none, kNoGo,
     "How far off the surface of a structure to stay out of may be: half the longest edge of a voxel where one "
     "comes from voxels (a label map, a tissue class), 0 where all are drawn. No-go lengths, contacts and "
     "clearance within it cannot be distinguished from a graze.",
     "half the width of a rectangular distribution: JCGM 100:2008 (GUM), 4.3.7", &nogo_uncertainty, kMedianRatio,
     kOfTheWay},
};

}  // namespace

std::vector<double> nogo_entries_s(const Signals& signals) {
  return times_of_visits(signals, &no_go, &any_visit, &Visit::from_s);
}
template <StructureRule rule>
std::vector<double> entries_s(const Signals& signals) {
  constexpr bool organ = rule == StructureRule::organ;  // a capsule is punctured from outside
  return times_of_visits(signals, &of_rule<rule>, organ ? &entered : &any_visit, &Visit::from_s);
}
template std::vector<double> entries_s<StructureRule::critical>(const Signals&);
template std::vector<double> entries_s<StructureRule::major>(const Signals&);
template std::vector<double> entries_s<StructureRule::advisory>(const Signals&);
template std::vector<double> entries_s<StructureRule::organ>(const Signals&);
std::vector<double> far_walls_s(const Signals& signals) {
  return times_of_visits(signals, &of_rule<StructureRule::target>, &went_through, &Visit::to_s);
}

std::span<const MetricInfo> structure_metrics() {
  return kStructuresMetrics;
}

}  // namespace seldinger::assessment
