#include "assessment/signals/pushed.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {
namespace {

// Along the needle from the same point: where the hand has the tip, and where it is in the tissue.
struct Along {
  double held_mm = 0.0, rest_mm = 0.0;
};

class Depth {
 public:
  void begin(const Along& now) {
    at_mm_ = now.rest_mm;
    from_ = now;
  }
  double move_to(const Along& now) {
    const double held_mm = now.held_mm - from_.held_mm, rest_mm = now.rest_mm - from_.rest_mm;
    const double least_mm = std::min(std::abs(held_mm), std::abs(rest_mm));
    const bool agree = held_mm * rest_mm > 0.0;
    const double sense = held_mm < 0.0 ? -1.0 : 1.0;
    // Both have gone on by more than noise: from here on anew.
    if (least_mm >= kTraceMm) {
      if (agree) {
        const double most_mm = std::max(std::abs(held_mm), std::abs(rest_mm));
        const double behind_mm =
            sense > 0.0 ? std::min(now.held_mm, now.rest_mm) - at_mm_ : at_mm_ - std::max(now.held_mm, now.rest_mm);
        at_mm_ += sense * std::clamp(behind_mm, least_mm, most_mm);
      }
      from_ = now;
      return at_mm_;
    }
    return agree ? at_mm_ + sense * least_mm : at_mm_;
  }

 private:
  double at_mm_ = 0.0;
  Along from_;
};

}  // namespace

std::vector<double> pushed_mm_of(const Signals& signals) {
  std::vector<double> pushed(signals.poses.size(), 0.0);
  const bool moves = std::any_of(signals.poses.begin(), signals.poses.end(),
                                 [](const cases::PoseSample& pose) { return pose.rest_tip_lps_mm.has_value(); });
  Depth depth;
  bool known = false;  // where it had been before
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    if (!moves) {
      pushed[i] = signals.inserted_mm(i);
      continue;
    }
    const cases::SkinPassage& skin = signals.passages[i];
    if (!skin.in_body || (i > 0 && signals.gap(i - 1))) known = false;
    if (!skin.in_body) continue;
    const cases::PoseSample& pose = signals.poses[i];
    const auto along_mm = [&](const glm::dvec3& p) {
      return glm::dot(p - skin.entry_lps_mm, pose.needle_direction);
    };
    const Along now = {along_mm(pose.tip_lps_mm), along_mm(pose.tip_at_rest_lps_mm())};
    if (!known) depth.begin(now);
    pushed[i] = std::max(0.0, known ? depth.move_to(now) : now.rest_mm);
    known = true;
  }
  return pushed;
}

std::vector<double> advances_of(const Signals& signals) {
  std::vector<double> advances(signals.poses.size(), 0.0);
  double reached_mm = 0.0;
  for (std::size_t i = 0; i < signals.poses.size(); ++i) {
    const double pushed_mm = signals.pushed_mm[i];
    // What happened before, or in a gap, is not known; the next puncture is a way of its own.
    if (i == 0 || signals.gap(i - 1) || signals.passages[i].depth_mm < -kJiggleMm) {
      reached_mm = pushed_mm;
    } else if (pushed_mm > reached_mm) {
      advances[i] = pushed_mm - reached_mm;
      reached_mm = pushed_mm;
    } else {
      reached_mm = std::min(reached_mm, pushed_mm + kJiggleMm);
    }
  }
  return advances;
}

}  // namespace seldinger::assessment
