#include "assessment/signals/tracking.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

using Poses = std::span<const cases::PoseSample>;

constexpr std::ptrdiff_t kHampelReach = 3;  // poses to either side
constexpr double kHampelSigmas = 3.0, kSigmaOfMad = 1.4826;
// The program's own moves are noted when they begin; a device's filter carries them on.
constexpr double kBeforeMove_s = 0.02, kAfterMove_s = 0.1;

bool silent(Poses poses, std::size_t i) {
  return poses[i + 1].t_s - poses[i].t_s > kGapSeconds + kTimeTolerance_s;
}

// The poses from which and to which speed at pose i is told.
struct Base {
  std::optional<std::size_t> before, after;
};
Base base_of(Poses poses, std::size_t i) {
  constexpr double kLeast_s = kJumpBase_s - 0.05 * kJumpBase_s;  // clocks are not exact
  Base base;
  for (std::size_t j = i; j > 0 && !silent(poses, j - 1) && !base.before;) {
    --j;
    if (poses[i].t_s - poses[j].t_s >= kLeast_s) base.before = j;
  }
  for (std::size_t k = i; k + 1 < poses.size() && !silent(poses, k) && !base.after;) {
    ++k;
    if (poses[k].t_s - poses[i].t_s >= kLeast_s) base.after = k;
  }
  return base;
}

// Whether the tip came to pose i, or turned there, as no hand does; and between which poses.
struct Jump {
  std::size_t pose = 0, from = 0, to = 0;
};
std::optional<Jump> jump_at(Poses poses, std::size_t i) {
  const Base base = base_of(poses, i);
  if (!base.before) return std::nullopt;
  const cases::PoseSample &now = poses[i], &before = poses[*base.before];
  const double came_s = now.t_s - before.t_s;
  const glm::dvec3 came_mm_s = (now.tip_lps_mm - before.tip_lps_mm) / came_s;
  if (glm::length(came_mm_s) > kJumpMmS) return Jump{i, *base.before, i};
  if (!base.after) return std::nullopt;
  const cases::PoseSample& after = poses[*base.after];
  const double goes_s = after.t_s - now.t_s;
  const glm::dvec3 goes_mm_s = (after.tip_lps_mm - now.tip_lps_mm) / goes_s;
  if (!(glm::length(goes_mm_s - came_mm_s) > kJumpMmS2 * 0.5 * (came_s + goes_s))) return std::nullopt;
  return Jump{i, *base.before, *base.after};
}

bool within(std::span<const TimeSpan> spans, double t_s) {
  return std::any_of(spans.begin(), spans.end(), [&](const TimeSpan& span) {
    return t_s >= span.from_s - kBeforeMove_s && t_s <= span.to_s + kAfterMove_s;
  });
}

std::vector<Jump> jumps_of(Poses poses) {
  std::vector<Jump> jumps;
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (const auto jump = jump_at(poses, i)) jumps.push_back(*jump);
  return jumps;
}

// Of those that the program did not make.
int count(Poses poses, std::span<const Jump> jumps, std::span<const TimeSpan> by_program) {
  int sum = 0;
  double last_s = -1e300;
  for (const Jump& jump : jumps) {
    const double t_s = poses[jump.pose].t_s;
    if (within(by_program, t_s)) continue;
    if (t_s - last_s > kSameJump_s) ++sum;
    last_s = t_s;
  }
  return sum;
}

// Whether pose i lies far from where those around it are.
bool is_outlier(Poses poses, std::size_t i) {
  std::ptrdiff_t first = static_cast<std::ptrdiff_t>(i), last = first;
  const auto count = static_cast<std::ptrdiff_t>(poses.size()), middle = first;
  while (first > 0 && middle - first < kHampelReach && !silent(poses, static_cast<std::size_t>(first - 1))) --first;
  while (last + 1 < count && last - middle < kHampelReach && !silent(poses, static_cast<std::size_t>(last))) ++last;
  if (first == middle || last == middle) return false;  // nothing to put it between
  const Poses window = poses.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(last - first + 1));
  // The median of points: the one with the least sum of distances to the others, whichever way axes point.
  const glm::dvec3* median = nullptr;
  double least_mm = 1e300;
  for (const cases::PoseSample& one : window) {
    double sum_mm = 0.0;
    for (const cases::PoseSample& other : window) sum_mm += glm::distance(one.tip_lps_mm, other.tip_lps_mm);
    if (sum_mm < least_mm) least_mm = sum_mm, median = &one.tip_lps_mm;
  }
  std::array<double, 2 * kHampelReach + 1> deviations_mm{};
  for (std::size_t k = 0; k < window.size(); ++k) deviations_mm[k] = glm::distance(window[k].tip_lps_mm, *median);
  const auto half = deviations_mm.begin() + static_cast<std::ptrdiff_t>(window.size() / 2);
  std::nth_element(deviations_mm.begin(), half, deviations_mm.begin() + static_cast<std::ptrdiff_t>(window.size()));
  return glm::distance(poses[i].tip_lps_mm, *median) > kHampelSigmas * kSigmaOfMad * *half;
}

glm::dvec3 direction_between(const glm::dvec3& a, const glm::dvec3& b, double share) {
  const glm::dvec3 between = glm::mix(a, b, share);
  const double length = glm::length(between);
  return length > 0.5 ? between / length : a;  // those that point apart tell nothing of what is between
}

void put_between(const cases::PoseSample& before, const cases::PoseSample& after, cases::PoseSample& pose) {
  const double share = (pose.t_s - before.t_s) / (after.t_s - before.t_s);
  if (pose.rest_tip_lps_mm)
    pose.rest_tip_lps_mm = glm::mix(before.tip_at_rest_lps_mm(), after.tip_at_rest_lps_mm(), share);
  pose.tip_lps_mm = glm::mix(before.tip_lps_mm, after.tip_lps_mm, share);
  pose.needle_direction = direction_between(before.needle_direction, after.needle_direction, share);
}

// How many were repaired.
std::size_t repair(std::span<const Jump> jumps, std::span<const TimeSpan> by_program,
                   std::vector<cases::PoseSample>& poses) {
  std::vector<bool> outlier(poses.size(), false);
  for (const Jump& jump : jumps) {
    if (within(by_program, poses[jump.pose].t_s)) continue;
    for (std::size_t i = jump.from; i <= jump.to; ++i) outlier[i] = outlier[i] || is_outlier(poses, i);
  }
  std::size_t repaired = 0;
  for (std::size_t from = 1; from + 1 < poses.size(); ++from) {
    if (!outlier[from]) continue;
    std::size_t to = from;  // one beyond
    while (to < poses.size() && outlier[to] && !silent(poses, to - 1)) ++to;
    const bool between = to < poses.size() && !outlier[from - 1] && !silent(poses, from - 1) &&
                         !silent(poses, to - 1) && to - from <= static_cast<std::size_t>(kHampelReach);
    for (std::size_t i = from; between && i < to; ++i) put_between(poses[from - 1], poses[to], poses[i]);
    if (between) repaired += to - from;
    from = to;
  }
  return repaired;
}

}  // namespace

std::vector<TimeSpan> program_moves(std::span<const cases::PoseSample> poses,
                                    std::span<const cases::Event> events) {
  std::vector<TimeSpan> moves;
  if (!poses.empty()) moves.push_back({poses.front().t_s, poses.front().t_s});
  for (const cases::EventSpan& move : cases::program_moves(events)) moves.push_back({move.from_s, move.to_s});
  return moves;
}

Tracking mend(std::span<const TimeSpan> by_program, std::vector<cases::PoseSample>& poses, std::vector<Gap>& gaps) {
  Tracking tracking;
  const std::vector<Jump> before = jumps_of(poses);
  tracking.jumps = count(poses, before, by_program);
  tracking.repaired = repair(before, by_program, poses);
  const std::vector<Jump> after = tracking.repaired > 0 ? jumps_of(poses) : before;
  tracking.left = count(poses, after, by_program);
  gaps.assign(poses.size(), Gap::none);
  for (std::size_t i = 0; i + 1 < poses.size(); ++i)
    if (silent(poses, i)) gaps[i] = Gap::silence;
  for (const Jump& jump : after) {
    // The tip was lost where it went furthest.
    std::size_t widest = jump.from;
    const auto length_mm = [&](std::size_t i) {
      return glm::distance(poses[i].tip_lps_mm, poses[i + 1].tip_lps_mm);
    };
    for (std::size_t i = jump.from; i < jump.to; ++i)
      if (length_mm(i) > length_mm(widest)) widest = i;
    gaps[widest] = within(by_program, poses[jump.pose].t_s) ? Gap::snap : Gap::jump;
  }
  return tracking;
}

}  // namespace seldinger::assessment
