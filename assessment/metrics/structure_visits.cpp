#include "assessment/metrics/structure_visits.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>
#include <variant>

namespace seldinger::assessment {
namespace {

constexpr double kNearMm = 4.0;   // first asked within this
constexpr double kDeepMm = 64.0;  // deeper inside is this deep

// Takes the way piece by piece, in order.
class Visiting {
 public:
  void pass(const WayPart& part, const TraceSegment& segment, bool inside) {
    const glm::dvec3 way = segment.to_lps_mm - segment.from_lps_mm;
    const double length_mm = (part.stretch.to - part.stretch.from) * glm::length(way);
    if (!any_) visit_.began_inside = inside;
    any_ = true;
    if (inside) {
      if (visit_.inside.empty()) visit_.from_s = segment.from_s;
      visit_.inside.push_back(part);
      inside_mm_ += length_mm;
      outside_mm_ = 0.0;
      return;
    }
    if (outside_mm_ == 0.0) left_forwards_ = glm::dot(way, segment.needle_direction) > 0.0;
    outside_mm_ += length_mm;
    if (outside_mm_ > kVisitMm) close(left_forwards_, segment.to_s);
  }
  std::vector<Visit> take() {
    close(false, std::numeric_limits<double>::infinity());
    return std::move(visits_);
  }

 private:
  void close(bool through, double to_s) {
    if (inside_mm_ > kVisitMm) {
      visit_.through = through;
      visit_.to_s = to_s;
      visits_.push_back(std::move(visit_));
    }
    visit_ = {};
    inside_mm_ = 0.0;
  }

  std::vector<Visit> visits_;
  Visit visit_;  // it goes on, or may become one
  bool any_ = false, left_forwards_ = false;
  double inside_mm_ = 0.0, outside_mm_ = 0.0;
};

}  // namespace

BoxedStructure::BoxedStructure(const cases::Structure& structure)
    : structure_(&structure), box_(cases::bounds_of(structure.shape)) {}

bool BoxedStructure::drawn() const {
  return !std::holds_alternative<cases::VoxelSet>(structure_->shape);
}

double BoxedStructure::half_voxel_mm() const {
  const auto* voxels = std::get_if<cases::VoxelSet>(&structure_->shape);
  if (voxels == nullptr) return 0.0;
  return 0.5 * std::max({voxels->spacing_mm.x, voxels->spacing_mm.y, voxels->spacing_mm.z});
}

double BoxedStructure::beyond_mm(const glm::dvec3& p) const {
  return glm::length(glm::max(glm::dvec3(0.0), glm::max(box_.low_lps_mm - p, p - box_.high_lps_mm)));
}

std::vector<cases::Stretch> BoxedStructure::stretches(const glm::dvec3& a, const glm::dvec3& b) const {
  for (int axis = 0; axis < 3; ++axis)
    if (std::max(a[axis], b[axis]) < box_.low_lps_mm[axis] || std::min(a[axis], b[axis]) > box_.high_lps_mm[axis])
      return {};
  return cases::stretches_inside(structure_->shape, a, b);
}

double BoxedStructure::distance_mm(const glm::dvec3& p, double known_mm, double enough_mm) const {
  const double bound_mm = std::max(known_mm, beyond_mm(p));
  if (bound_mm > 0.0 && bound_mm >= enough_mm) return bound_mm;
  double most_mm = std::max(kNearMm, enough_mm);
  for (double limit_mm = std::max(kNearMm, bound_mm + kNearMm);; limit_mm *= 2.0) {
    const double asked_mm = std::min(limit_mm, most_mm);
    const double found_mm = cases::signed_distance_mm(structure_->shape, p, asked_mm);
    const bool exact = std::abs(found_mm) < asked_mm;  // else it lies at least so deep inside, or so far outside
    if (exact || (found_mm > 0.0 && found_mm >= enough_mm) || limit_mm >= kDeepMm) return found_mm;
    if (found_mm < 0.0) most_mm = kDeepMm;
  }
}

bool BoxedStructure::contains(const glm::dvec3& p) const {
  return beyond_mm(p) == 0.0 && cases::signed_distance_mm(structure_->shape, p, 1e-3) < 0.0;
}

std::vector<Visit> visits_of(const BoxedStructure& structure, std::span<const TraceSegment> trace) {
  Visiting visiting;
  for (std::size_t i = 0; i < trace.size(); ++i) {
    const TraceSegment& segment = trace[i];
    double at = 0.0;
    for (const cases::Stretch& stretch : structure.stretches(segment.from_lps_mm, segment.to_lps_mm)) {
      if (stretch.from > at) visiting.pass({i, {at, stretch.from}}, segment, false);
      visiting.pass({i, stretch}, segment, true);
      at = stretch.to;
    }
    if (at < 1.0) visiting.pass({i, {at, 1.0}}, segment, false);
  }
  return visiting.take();
}

double covered_share(std::vector<cases::Stretch> stretches) {
  std::sort(stretches.begin(), stretches.end(), [](const auto& x, const auto& y) { return x.from < y.from; });
  double share = 0.0, reached = 0.0;
  for (const cases::Stretch& stretch : stretches) {
    share += std::max(0.0, stretch.to - std::max(reached, stretch.from));
    reached = std::max(reached, stretch.to);
  }
  return share;
}

}  // namespace seldinger::assessment
