// The servo's thread: calls one function 1000 times a second. It is scheduled SCHED_FIFO with memory locked where
// the system allows that; else it runs as any thread does, with the finest timer slack, and its record says so.
// Between two calls it only looks at clocks and counts.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

#include "sim/case/record/servo_record.h"

namespace seldinger::engine {

struct ServoSettings {
  std::int64_t tick_ns = 1'000'000;
  int priority = 80;      // SCHED_FIFO, above interrupt threads' 50
  bool real_time = true;  // false: SCHED_OTHER, and no memory is locked
};

// What is said of time in `record` for a tick that was due `due_ns` after the loop's begin and begins `begin_ns`
// after it, the one before having begun at last_begin_ns (< 0: there is none). Returns when the tick to be done now
// was due: due_ns, or the last one before begin_ns; those between are missed.
std::int64_t account_for_begin(std::int64_t due_ns, std::int64_t begin_ns, std::int64_t last_begin_ns,
                               std::int64_t tick_ns, cases::ServoRecord& record) noexcept;

class ServoLoop {
 public:
  // Starts at once. `tick` is given the time since the last call in s (the first: one tick); it must not allocate,
  // lock, log or throw.
  ServoLoop(const ServoSettings& settings, std::function<void(double elapsed_s)> tick);
  ServoLoop(const ServoLoop&) = delete;
  ServoLoop& operator=(const ServoLoop&) = delete;
  ~ServoLoop();

  // After the tick that is running, if one is. Then, and not before, record() may be read.
  void stop();
  const cases::ServoRecord& record() const;  // CHECKs that the loop was stopped

 private:
  void run();

  ServoSettings settings_;
  std::function<void(double)> tick_;
  cases::ServoRecord record_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;  // last: it uses the rest
};

}  // namespace seldinger::engine
