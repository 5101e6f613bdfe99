// How the servo loop kept time: what an attempt stores beside its recording.
#pragma once

#include "sim/case/record/time_histogram.h"

namespace seldinger::cases {

enum class ServoScheduler { other, fifo };  // SCHED_OTHER, SCHED_FIFO

struct ServoRecord {
  double tick_s = 0.001;
  ServoScheduler scheduler = ServoScheduler::other;
  bool memory_locked = false;
  std::uint64_t ticks = 0;   // done
  std::uint64_t missed = 0;  // that never began: the next was due already
  TimeHistogram period;      // from one tick's begin to the next's
  TimeHistogram latency;     // from when a tick was due to its begin
  TimeHistogram compute;     // from its begin to its end

  // Of all ticks that were due; 0 of none.
  double missed_share() const noexcept {
    const auto due = static_cast<double>(ticks + missed);
    return due > 0.0 ? static_cast<double>(missed) / due : 0.0;
  }
};

}  // namespace seldinger::cases
