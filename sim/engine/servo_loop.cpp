#include "sim/engine/servo_loop.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "sim/base/check.h"

namespace seldinger::engine {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::int64_t now_ns() noexcept {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

void sleep_until(std::int64_t at_ns) noexcept {
  timespec at{};
  at.tv_sec = at_ns / kNsPerS;
  at.tv_nsec = at_ns % kNsPerS;
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr) == EINTR) {
  }
}

cases::ServoScheduler take_priority(int priority) noexcept {
  sched_param wanted{};
  wanted.sched_priority = priority;
  if (::pthread_setschedparam(::pthread_self(), SCHED_FIFO, &wanted) == 0) return cases::ServoScheduler::fifo;
  ::prctl(PR_SET_TIMERSLACK, 1UL);  // ns; 50 µs by default
  return cases::ServoScheduler::other;
}

}  // namespace

std::int64_t account_for_begin(std::int64_t due_ns, std::int64_t begin_ns, std::int64_t last_begin_ns,
                               std::int64_t tick_ns, cases::ServoRecord& record) noexcept {
  const std::int64_t late_ns = std::max<std::int64_t>(0, begin_ns - due_ns);
  const std::int64_t missed = late_ns / tick_ns;
  ++record.ticks;
  record.missed += static_cast<std::uint64_t>(missed);
  record.latency.add(static_cast<std::uint64_t>(late_ns));
  if (last_begin_ns >= 0) record.period.add(static_cast<std::uint64_t>(begin_ns - last_begin_ns));
  return due_ns + missed * tick_ns;
}

ServoLoop::ServoLoop(const ServoSettings& settings, std::function<void(double)> tick)
    : settings_(settings), tick_(std::move(tick)) {
  CHECK(settings.tick_ns > 0 && tick_ != nullptr);
  record_.tick_s = static_cast<double>(settings.tick_ns) / static_cast<double>(kNsPerS);
  thread_ = std::thread([this] { run(); });
}

ServoLoop::~ServoLoop() {
  stop();
}

void ServoLoop::stop() {
  stopping_ = true;
  if (!thread_.joinable()) return;
  thread_.join();
  if (record_.memory_locked) ::munlockall();
}

const cases::ServoRecord& ServoLoop::record() const {
  CHECK(!thread_.joinable());
  return record_;
}

void ServoLoop::run() {
  if (settings_.real_time) {
    record_.scheduler = take_priority(settings_.priority);
    // What there is now, this thread's stack with it; what others map later may need more than they are allowed.
    record_.memory_locked = ::mlockall(MCL_CURRENT) == 0;
  }
  const std::int64_t start_ns = now_ns();
  std::int64_t due_ns = 0, last_begin_ns = -1;
  while (!stopping_.load(std::memory_order_relaxed)) {
    due_ns += settings_.tick_ns;
    sleep_until(start_ns + due_ns);
    const std::int64_t begin_ns = now_ns() - start_ns;
    due_ns = account_for_begin(due_ns, begin_ns, last_begin_ns, settings_.tick_ns, record_);
    tick_(last_begin_ns < 0 ? record_.tick_s
                            : static_cast<double>(begin_ns - last_begin_ns) / static_cast<double>(kNsPerS));
    record_.compute.add(static_cast<std::uint64_t>(now_ns() - start_ns - begin_ns));
    last_begin_ns = begin_ns;
  }
}

}  // namespace seldinger::engine
