#include "assessment/operators/probe_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <span>
#include <variant>

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
// end of its face digs in) from standing upright on the skin, where all of its face touches.
struct Place {
  double azimuth_deg = 0.0, tilt_deg = 0.0, rocked_deg = 0.0;
};
constexpr double kAzimuthStepDeg = 30.0, kMostRockedDeg = 40.0, kLeastTiltDeg = 15.0, kMostTiltDeg = 85.0;

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
void stand_along(const Stand& stand, const glm::dvec3& axis, PuncturePlan& plan) {
  plan.probe.position_lps_mm = stand.origin;
  plan.probe.axis = axis;
  plan.probe.side = glm::normalize(plan.direction - axis * glm::dot(plan.direction, axis));
  plan.probe_first = plan.probe;
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
                     kSteepPrice * std::max(0.0, kSteepDeg - angle_deg);
  if (limits.approach == cases::Approach::in_plane) return sum + kUnseenPrice * unseen_mm + kDepthPrice * probe_mm;
  const double askew = vessel ? std::min(1.0, std::abs(glm::dot(*vessel, plan.probe.side))) : 0.0;
  const double askew_deg = vessel ? 90.0 - base::exact_acos(askew) / kPlaceRadPerDeg : 0.0;
  return sum + kOverPrice * probe_mm + kAskewPrice * askew_deg;
}

}  // namespace

std::optional<double> place_probe(const cases::MeshIndex& skin, const PathLimits& limits, PuncturePlan& plan) {
  const bool across = limits.approach == cases::Approach::out_of_plane;
  plan.approach = limits.approach;
  const auto vessel = across ? vessel_along(limits.structures, plan.target_lps_mm) : std::nullopt;
  double best = -std::numeric_limits<double>::infinity();
  PuncturePlan chosen = plan;
  const auto consider = [&](const Place& place) {
    const auto stand = stand_at(skin, limits, plan, place);
    if (!stand) return false;
    PuncturePlan held = plan;
    double score = 0.0;
    if (across) {
      if (!stand_across(skin, *stand, held)) return false;
    } else if (limits.looks_from) {
      const double rocked = place.rocked_deg * kPlaceRadPerDeg;
      stand_along(*stand,
                  glm::normalize(stand->upright * base::exact_cos(rocked) +
                                 glm::cross(stand->across, stand->upright) * base::exact_sin(rocked)),
                  held);
    } else {
      stand_along(*stand, -stand->outward, held);
    }
    if (limits.looks_from) {
      const auto view = limits.looks_from(held);
      if (!view) return false;
      score = -price(limits, held, *view, stand->distance_mm, vessel);
      held.probe = view->probe;
      held.probe_first = view->probe_first;
      held.picture = view->picture;
      held.tip_shows_from_mm = view->tip_shows_from_mm;
    } else {
      score = 1.0 / (stand->distance_mm + std::abs(glm::distance(stand->origin, plan.entry_lps_mm) - 45.0));
    }
    if (score <= best) return false;
    best = score;
    chosen = held;
    return true;
  };

  Place nearest;
  const auto try_all = [&](std::initializer_list<double> tilts_deg, std::initializer_list<double> rocked_deg) {
    for (const double tilt_deg : tilts_deg)
      for (double azimuth_deg = 0.0; azimuth_deg < 360.0; azimuth_deg += kAzimuthStepDeg)
        for (const double rocked : rocked_deg)
          if (const Place place{azimuth_deg, tilt_deg, rocked}; consider(place)) nearest = place;
  };
  if (!limits.looks_from)
    try_all({50.0, 40.0, 60.0, 30.0}, {0.0});
  else if (across)
    try_all({50.0, 40.0, 60.0, 30.0, 70.0, 20.0}, {0.0});
  else
    try_all({50.0, 40.0, 60.0, 30.0, 70.0, 20.0, 80.0}, {0.0, -20.0, 20.0});
  if (std::isinf(best)) return std::nullopt;
  // From the best of a coarse grid to the best about it.
  for (double step = limits.looks_from ? 0.5 : 0.0; step > 0.03;) {
    bool better = false;
    for (const double sign : {-1.0, 1.0})
      for (int which = 0; which < (across ? 2 : 3); ++which) {
        Place place = nearest;
        if (which == 0) place.azimuth_deg += sign * step * kAzimuthStepDeg;
        if (which == 1)
          place.tilt_deg = std::clamp(place.tilt_deg + sign * step * 10.0, kLeastTiltDeg, kMostTiltDeg);
        if (which == 2)
          place.rocked_deg = std::clamp(place.rocked_deg + sign * step * 20.0, -kMostRockedDeg, kMostRockedDeg);
        if (!consider(place)) continue;
        nearest = place;
        better = true;
      }
    if (!better) step /= 2.0;
  }
  plan = chosen;
  return best;
}

}  // namespace seldinger::assessment
