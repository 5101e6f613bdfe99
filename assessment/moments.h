// The moments of an attempt that tell most about it: where a replay sheet stops.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "assessment/signals/signals.h"

namespace seldinger::assessment {

// In the order in which they are left out when there are too many: the last first.
enum class MomentKind {
  fire,
  end,              // of the recording, where the trigger did not fall
  puncture,         // the tip is 2 mm below the skin
  blind_run,        // the end of the longest advance that no picture showed
  withdrawal,       // before the needle is drawn back partly: where the tip was deepest
  full_withdrawal,  // before it leaves the skin
  target_seen,      // the first live picture of the target
  between,          // nothing but a picture on the way
};
const char* words_for(MomentKind kind, cases::Modality modality) noexcept;

struct Moment {
  double t_s = 0.0;
  MomentKind kind = MomentKind::between;
};

constexpr std::size_t kLeastMoments = 8, kMostMoments = 12;
constexpr double kMomentsApart_s = 0.3;  // nearer to a weightier one it shows the same

// By time. As withdrawals and blind advance are counted by the metrics. Fewer than kLeastMoments only where the
// attempt is too short for them.
std::vector<Moment> telling_moments(const Signals& signals);

}  // namespace seldinger::assessment
