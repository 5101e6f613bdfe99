#include "assessment/signals/way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

constexpr double kSharpCosine = 0.5;  // of 60°: noise of 0.05 mm turns the line by some 13°
constexpr double kTurnMm = 0.08;      // more than that noise is seldom ahead of where the tip turned
constexpr double kAroundMovement_s = 0.25;

// Where the tip was, both ways.
struct Place {
  double t_s = 0.0;
  glm::dvec3 held_lps_mm{0.0}, rest_lps_mm{0.0};
  glm::dvec3 needle_direction{0.0};
  double depth_mm = 0.0;
};

Place end_of(const Step& step) {
  return {step.t_s + step.length_s, step.to_lps_mm, step.rest_to_lps_mm, step.needle_direction, step.depth_to_mm};
}

bool apart(const Place& a, const Place& b) {
  return std::min(glm::distance(a.held_lps_mm, b.held_lps_mm), glm::distance(a.rest_lps_mm, b.rest_lps_mm)) >=
         kTraceMm;
}

// One stretch without a gap.
class Tracer {
 public:
  Tracer(const Step& step, std::vector<WayPoint>& way) : way_(way) {
    last_ = {step.t_s, step.from_lps_mm, step.rest_from_lps_mm, step.needle_direction, step.depth_from_mm};
    ahead_ = far_ = now_ = last_;
    way_.push_back({last_.t_s, last_.rest_lps_mm, last_.needle_direction, last_.depth_mm, true, false});
  }
  void move_to(const Place& place) {
    now_ = place;
    const double rest_mm = glm::distance(last_.rest_lps_mm, now_.rest_lps_mm);
    if (rest_mm > glm::distance(last_.rest_lps_mm, far_.rest_lps_mm)) far_ = now_;
    if (apart(now_, far_)) add(far_, false);  // it has turned there
    if (onwards_mm(now_) > onwards_mm(ahead_)) ahead_ = now_;
    if (!apart(now_, last_)) return;
    if (onwards_mm(ahead_) > std::max(kTurnMm, onwards_mm(now_) + kTurnMm)) add(ahead_, false);  // or there
    add(now_, false);
  }
  void end() {
    if (now_.t_s > last_.t_s) add(now_, true);
  }

 private:
  void add(const Place& place, bool rest) {
    const glm::dvec3 held_mm = place.held_lps_mm - last_.held_lps_mm,
                     rest_mm = place.rest_lps_mm - last_.rest_lps_mm;
    const bool rested = rest || place.t_s - last_.t_s > kRestSeconds + kTimeTolerance_s;
    const glm::dvec3& gone_mm = rested && glm::length(held_mm) < glm::length(rest_mm) ? held_mm : rest_mm;
    way_.push_back({place.t_s, way_.back().lps_mm + gone_mm, place.needle_direction, place.depth_mm, false, rest});
    if (glm::length(gone_mm) > 0.0) onwards_ = glm::normalize(gone_mm);
    last_ = far_ = ahead_ = place;
  }
  // How much further than the last place it is, the way that led there.
  double onwards_mm(const Place& place) const {
    return std::min(glm::dot(place.held_lps_mm - last_.held_lps_mm, onwards_),
                    glm::dot(place.rest_lps_mm - last_.rest_lps_mm, onwards_));
  }

  std::vector<WayPoint>& way_;
  // Since the last one: the furthest from it, and the furthest onwards.
  Place last_, far_, ahead_, now_;
  glm::dvec3 onwards_{0.0};
};

// Of two points on either side of the skin, where it is passed.
glm::dvec3 at_skin(const WayPoint& a, const WayPoint& b) {
  const double share = a.depth_mm / (a.depth_mm - b.depth_mm);
  return glm::mix(a.lps_mm, b.lps_mm, share);
}

}  // namespace

std::vector<WayPoint> way_of(const Signals& signals) {
  std::vector<WayPoint> way;
  for (std::size_t i = 0; i < signals.steps.size();) {
    Tracer tracer(signals.steps[i], way);
    do tracer.move_to(end_of(signals.steps[i++]));
    while (i < signals.steps.size() && !signals.steps[i].first);
    tracer.end();
  }
  return way;
}

std::vector<Movement> movements_of(const Signals& signals) {
  const std::vector<WayPoint>& way = signals.way;
  std::vector<Movement> movements;
  double begins_s = 0.0;  // of the stretch
  for (std::size_t from = 0; from < way.size();) {
    if (way[from].first) begins_s = way[from].t_s;
    std::size_t to = from;
    const auto goes_on = [&](const WayPoint& a, const WayPoint& b) {
      return !b.first && !b.rest && b.t_s - a.t_s <= kRestSeconds + kTimeTolerance_s;
    };
    std::vector<glm::dvec3> points = {way[from].lps_mm};
    for (; to + 1 < way.size() && goes_on(way[to], way[to + 1]); ++to) points.push_back(way[to + 1].lps_mm);
    if (length_mm(points) >= kLeastMovementMm) {
      double ends_s = way[to].t_s;
      for (std::size_t i = to + 1; i < way.size() && !way[i].first; ++i) ends_s = way[i].t_s;
      movements.push_back({std::max(begins_s, way[from].t_s - kAroundMovement_s),
                           std::min(ends_s, way[to].t_s + kAroundMovement_s)});
    }
    from = to + 1;
  }
  return movements;
}

double length_mm(std::span<const glm::dvec3> points) {
  double sum_mm = 0.0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const auto kept = [&](std::size_t k) {
      if (k == 0 || k + 1 == points.size()) return true;
      const glm::dvec3 came = points[k] - points[k - 1], goes = points[k + 1] - points[k];
      return glm::dot(came, goes) < kSharpCosine * glm::length(came) * glm::length(goes);
    };
    // Half of each piece is one of the line through these points, half of one through every second.
    const double piece_mm = glm::distance(points[i], points[i + 1]);
    if (kept(i)) sum_mm += 0.5 * piece_mm;
    sum_mm += kept(i + 1) ? 0.5 * piece_mm : 0.5 * glm::distance(points[i], points[i + 2]);
  }
  return sum_mm;
}

std::vector<Stretch> stretches_of(std::span<const WayPoint> way) {
  std::vector<Stretch> stretches;
  for (std::size_t i = 0; i < way.size(); ++i) {
    const WayPoint& now = way[i];
    const bool in_tissue = now.depth_mm > 0.0;
    if (now.first || stretches.empty()) {
      stretches.push_back({{}, {}, in_tissue});
    } else if (in_tissue != stretches.back().in_tissue) {
      const glm::dvec3 skin = at_skin(way[i - 1], now);
      stretches.back().points_mm.push_back(skin);
      stretches.back().needle_directions.push_back(now.needle_direction);
      stretches.push_back({{skin}, {now.needle_direction}, in_tissue});
    }
    stretches.back().points_mm.push_back(now.lps_mm);
    stretches.back().needle_directions.push_back(now.needle_direction);
  }
  return stretches;
}

}  // namespace seldinger::assessment
