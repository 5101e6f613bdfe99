#include "assessment/operators/probe_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <span>
#include <utility>
#include <variant>
#include <vector>

#include "assessment/operators/probe_over.h"
#include "sim/base/exact_math.h"
#include "sim/base/vectors.h"

namespace seldinger::assessment {
namespace {

constexpr double kPlaceRadPerDeg = std::numbers::pi / 180.0;
constexpr double kProbeMinMm = 20.0, kProbeMaxApartMm = 70.0;  // between probe's middle and entry: room for a hand
constexpr double kProbeMaxDepthMm = 120.0;
// Out of plane a needle enters beside the middle of the probe's long side, which is this far from its plane.
constexpr double kHalfCaseMm = 8.0, kAcrossMaxApartMm = 45.0;
// Across the way a probe leans no further from upright on the skin at the target: laid flat it would show the tip
// early, but half of its face would be in air and the picture no section that anybody is taught to read (design).
constexpr double kMostLeanDeg = 30.0;
// What a plan under ultrasound costs: so much for a mm of way before the tip shows, a mm of needle that is not seen
// at the target, a dB of shadow on the target, a mm from skin to target, and a degree by which a probe across a
// vessel is askew (design). Advance that nobody sees is the commonest error, and no more than 5 mm of it are let
// pass (docs/clinical.md): beyond what leaves room for a reaction it weighs most. Across a vessel the probe stands
// right over it: so near a linear one sees better.
constexpr double kBlindFreeMm = 2.5, kBlindPrice = 6.0;
constexpr double kUnseenPrice = 0.25, kShadowPrice = 2.0, kDepthPrice = 0.3;
constexpr double kOverPrice = 1.0, kAskewPrice = 0.2;
// A needle along the beams sends little back but from its tip: so much for each degree below this angle
// between them; across it, one along the picture's plane is long in coming.
constexpr double kSteepDeg = 40.0, kSteepPrice = 0.3;

// The direction of the vessel that the target lies in; none where no target structure is a tube.
std::optional<glm::dvec3> vessel_along(std::span<const cases::Structure> structures, const glm::dvec3& target) {
  std::optional<glm::dvec3> along;
  double nearest_mm = std::numeric_limits<double>::infinity();
  for (const cases::Structure& structure : structures) {
    const auto* tube = std::get_if<cases::Tube>(&structure.shape);
    if (tube == nullptr || structure.rule != cases::StructureRule::target) continue;
    for (std::size_t i = 1; i < tube->points_lps_mm.size(); ++i) {
      const glm::dvec3 a = tube->points_lps_mm[i - 1], way = tube->points_lps_mm[i] - a;
      if (!(glm::dot(way, way) > 0.0)) continue;
      const double share = std::clamp(glm::dot(target - a, way) / glm::dot(way, way), 0.0, 1.0);
      const double off_mm = glm::length(target - a - share * way);
      if (off_mm >= nearest_mm) continue;
      nearest_mm = off_mm;
      along = glm::normalize(way);
    }
  }
  return along;
}

struct Stand {
  glm::dvec3 origin{0.0}, outward{0.0}, upright{0.0};  // on the skin; from the target to it; into the body
  glm::dvec3 across{0.0};                              // normal of the plane that holds way and origin
  double distance_mm = 0.0;                            // from the target
  std::uint32_t triangle = 0;                          // of the skin, where it stands
};

// Where to look from: about the way, off the way, and how far the probe is rocked in its plane (heel and toe: one
// end of its face digs in) from standing upright on the skin, where all of its face touches: when the needle is at
// the target, and when it enters. A tip that goes deeper under the probe is met squarely by beams that lean towards
// it.
struct Place {
  double azimuth_deg = 0.0, tilt_deg = 0.0, rocked_deg = 0.0, rocked_first_deg = 0.0;
  double pressed_mm = 0.0;  // as PuncturePlan's
};
constexpr double kAzimuthStepDeg = 30.0, kMostRockedDeg = 40.0, kLeastTiltDeg = 15.0, kMostTiltDeg = 85.0;
// On a round flank the end of a rocked face lifts off, and a firm hand puts it down again (design).
constexpr double kMostPressedMm = 12.0, kPressPrice = 0.3;
constexpr std::size_t kClimbs = 3;  // from so many places of a coarse grid, to the best about each

std::optional<Stand> stand_at(const cases::MeshIndex& skin, const PathLimits& limits, const PuncturePlan& plan,
                              const Place& place) {
  const bool across = limits.approach == cases::Approach::out_of_plane;
  const glm::dvec3 back = -plan.direction;
  const auto [u, v] = base::perpendiculars(back);
  const double azimuth = place.azimuth_deg * kPlaceRadPerDeg, tilt = place.tilt_deg * kPlaceRadPerDeg;
  const glm::dvec3 aside = u * base::exact_cos(azimuth) + v * base::exact_sin(azimuth);
  Stand stand;
  stand.outward = back * base::exact_cos(tilt) + aside * base::exact_sin(tilt);
  if (towards_table(stand.outward, limits.position)) return std::nullopt;
  const auto hit = skin.first_hit(plan.target_lps_mm, stand.outward, kProbeMaxDepthMm);
  if (!hit || hit->cut || hit->distance_mm < 5.0) return std::nullopt;
  stand.distance_mm = hit->distance_mm;
  stand.origin = plan.target_lps_mm + stand.outward * hit->distance_mm;
  const double apart_mm = glm::distance(stand.origin, plan.entry_lps_mm);
  if (apart_mm < (across ? kHalfCaseMm : kProbeMinMm)) return std::nullopt;
  if (apart_mm > (across ? kAcrossMaxApartMm : kProbeMaxApartMm)) return std::nullopt;
  stand.across = glm::normalize(glm::cross(stand.outward, back));
  stand.triangle = hit->triangle;
  const glm::dvec3 inward = -skin.normal(hit->triangle);
  const glm::dvec3 upright = inward - stand.across * glm::dot(inward, stand.across);
  if (!(glm::length(upright) > 0.3)) return std::nullopt;  // the plane would lie on the skin
  stand.upright = glm::normalize(upright);
  return stand;
}

// In the plane of the way.
cases::ToolPose along_way(const Stand& stand, const glm::dvec3& axis, const PuncturePlan& plan) {
  return {stand.origin, axis, glm::normalize(plan.direction - axis * glm::dot(plan.direction, axis))};
}

glm::dvec3 rocked(const Stand& stand, double by_deg) {
  const double by = by_deg * kPlaceRadPerDeg;
  return glm::normalize(stand.upright * base::exact_cos(by) +
                        glm::cross(stand.across, stand.upright) * base::exact_sin(by));
}

// Across the way: the plane holds target and origin, and its first place is as near to the entry as the needle
// leaves room.
bool stand_across(const cases::MeshIndex& skin, const Stand& stand, PuncturePlan& plan) {
  plan.probe = {stand.origin, -stand.outward, stand.across};
  const glm::dvec3 inward = -skin.normal(stand.triangle);
  if (glm::dot(plan.probe.axis, inward) < base::exact_cos(kMostLeanDeg * kPlaceRadPerDeg)) return false;
  const glm::dvec3 entry_from = plan.entry_lps_mm - stand.origin;
  const double off_mm = std::abs(glm::dot(entry_from, plane_normal(plan.probe)));
  if (off_mm < kHalfCaseMm) return false;
  const auto first = skin.closest_skin(stand.origin + entry_from * (1.0 - kHalfCaseMm / off_mm));
  plan.probe_first = plan.probe;
  plan.probe_first.position_lps_mm = first.point_lps_mm;
  const glm::dvec3 first_inward = -skin.normal(first.triangle);
  const glm::dvec3 upright = first_inward - stand.across * glm::dot(first_inward, stand.across);
  if (!(glm::length(upright) > 0.5)) return false;
  plan.probe_first.axis = glm::normalize(upright);
  return true;
}

double price(const PathLimits& limits, const PuncturePlan& plan, const ProbeView& view, double probe_mm,
             const std::optional<glm::dvec3>& vessel) {
  const double unseen_mm = std::max(0.0, plan.depth_mm - view.needle_mm);
  const double angle_deg = base::exact_acos(std::abs(glm::dot(plan.direction, plan.probe.axis))) / kPlaceRadPerDeg;
  const double sum = kBlindPrice * std::max(0.0, view.tip_shows_from_mm - kBlindFreeMm) +
                     kShadowPrice * view.shadow_db + kDepthPrice * plan.depth_mm +
                     kSteepPrice * std::max(0.0, kSteepDeg - angle_deg) + kPressPrice * plan.pressed_mm;
  if (limits.approach == cases::Approach::in_plane) return sum + kUnseenPrice * unseen_mm + kDepthPrice * probe_mm;
  const double askew = vessel ? std::min(1.0, std::abs(glm::dot(*vessel, plan.probe.side))) : 0.0;
  const double askew_deg = vessel ? 90.0 - base::exact_acos(askew) / kPlaceRadPerDeg : 0.0;
  return sum + kOverPrice * probe_mm + kAskewPrice * askew_deg;
}

// A plan whose probe stands at such a place, and how good it is there.
struct Judged {
  Place place;
  PuncturePlan plan;
  double score = 0.0;
};

class PlaceJudge {
 public:
  PlaceJudge(const cases::MeshIndex& skin, const PathLimits& limits, const PuncturePlan& plan)
      : skin_(skin), limits_(limits), plan_(plan), across_(limits.approach == cases::Approach::out_of_plane) {
    plan_.approach = limits.approach;
    if (across_) vessel_ = vessel_along(limits.structures, plan.target_lps_mm);
  }
  // Nothing where there is no such place, or none better than one that is known.
  std::optional<Judged> judge(const Place& place, const std::optional<Judged>& known) const {
    const auto stand = stand_at(skin_, limits_, plan_, place);
    if (!stand) return std::nullopt;
    Judged judged{place, plan_};
    PuncturePlan& held = judged.plan;
    if (across_) {
      if (!stand_across(skin_, *stand, held)) return std::nullopt;
    } else if (limits_.looks_from) {
      held.probe = along_way(*stand, rocked(*stand, place.rocked_deg), held);
      held.probe_first = along_way(*stand, rocked(*stand, place.rocked_first_deg), held);
      held.pressed_mm = place.pressed_mm;
    } else {
      held.probe = held.probe_first = along_way(*stand, -stand->outward, held);
    }
    if (!limits_.looks_from) {
      const double apart_mm = glm::distance(stand->origin, plan_.entry_lps_mm);
      judged.score = 1.0 / (stand->distance_mm + std::abs(apart_mm - 45.0));
      return judged;
    }
    const auto score_of = [&](const ProbeView& view) {
      return -price(limits_, held, view, stand->distance_mm, vessel_);
    };
    const auto is_better = [&](const ProbeView& view) { return !known || score_of(view) > known->score; };
    ProbeView ideal;  // whatever is seen from there, it is no better
    ideal.needle_mm = held.depth_mm;
    if (!is_better(ideal)) return std::nullopt;
    const auto view = limits_.looks_from(held, is_better);
    if (!view) return std::nullopt;
    judged.score = score_of(*view);
    held.probe = view->probe;
    held.probe_first = view->probe_first;
    held.picture = view->picture;
    held.tip_shows_from_mm = view->tip_shows_from_mm;
    return judged;
  }
  // The best of each tilt off the way on a coarse grid, the best first.
  std::vector<Judged> coarse() const {
    std::vector<Judged> best;
    for (const double tilt_deg : tilts_deg()) {
      std::optional<Judged> best_here;
      for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += kAzimuthStepDeg)
        for (const Place& by : rocks())
          if (auto judged =
                  judge({azimuth_deg, tilt_deg, by.rocked_deg, by.rocked_first_deg, by.pressed_mm}, best_here);
              judged && (!best_here || judged->score > best_here->score))
            best_here = std::move(judged);
      if (best_here) best.push_back(std::move(*best_here));
    }
    std::stable_sort(best.begin(), best.end(), [](const Judged& a, const Judged& b) { return a.score > b.score; });
    return best;
  }
  // The best about it.
  Judged climbed(Judged from) const {
    std::optional<Judged> nearest = std::move(from);
    for (double step = limits_.looks_from ? 0.5 : 0.0; step > 0.03;) {
      bool better = false;
      for (const double sign : {-1.0, 1.0})
        for (int which = 0; which < (across_ ? 2 : 6); ++which) {
          auto judged = judge(moved(nearest->place, which, sign * step), nearest);
          if (!judged || judged->score <= nearest->score) continue;
          nearest = std::move(judged);
          better = true;
        }
      if (!better) step /= 2.0;
    }
    return *nearest;
  }

 private:
  std::span<const double> tilts_deg() const {
    static constexpr std::array kDeg{50.0, 40.0, 60.0, 30.0, 70.0, 20.0, 80.0};
    return std::span(kDeg).first(!limits_.looks_from ? 4 : across_ ? 6 : 7);
  }
  std::span<const Place> rocks() const {
    static constexpr double kPressed = 0.5 * kMostPressedMm;
    static constexpr std::array kRocks{Place{},
                                       Place{0, 0, -20, -20, 0},
                                       Place{0, 0, 20, 20, 0},
                                       Place{0, 0, -20, 0, 0},
                                       Place{0, 0, 20, 0, 0},
                                       Place{0, 0, -20, -20, kPressed},
                                       Place{0, 0, 20, 20, kPressed}};
    return std::span(kRocks).first(limits_.looks_from && !across_ ? kRocks.size() : 1);
  }
  static Place moved(Place place, int which, double by) {
    const auto rock = [by](double deg) { return std::clamp(deg + by * 20.0, -kMostRockedDeg, kMostRockedDeg); };
    if (which == 0) place.azimuth_deg += by * kAzimuthStepDeg;
    if (which == 1) place.tilt_deg = std::clamp(place.tilt_deg + by * 10.0, kLeastTiltDeg, kMostTiltDeg);
    if (which == 2 || which == 5) place.rocked_deg = rock(place.rocked_deg);
    if (which == 3 || which == 5) place.rocked_first_deg = rock(place.rocked_first_deg);
    if (which == 4) place.pressed_mm = std::clamp(place.pressed_mm + by * kMostPressedMm, 0.0, kMostPressedMm);
    return place;
  }

  const cases::MeshIndex& skin_;
  const PathLimits& limits_;
  PuncturePlan plan_;
  bool across_;
  std::optional<glm::dvec3> vessel_;
};

}  // namespace

std::optional<double> place_probe(const cases::MeshIndex& skin, const PathLimits& limits, PuncturePlan& plan) {
  const PlaceJudge judge(skin, limits, plan);
  std::optional<Judged> best;
  std::vector<Judged> coarse = judge.coarse();
  for (std::size_t i = 0; i < std::min(coarse.size(), kClimbs); ++i)
    if (Judged climbed = judge.climbed(std::move(coarse[i])); !best || climbed.score > best->score)
      best = std::move(climbed);
  if (!best) return std::nullopt;
  plan = best->plan;
  return best->score;
}

}  // namespace seldinger::assessment
