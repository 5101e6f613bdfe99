// Work on several threads whose results are taken one by one, in order, as if one thread had done it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace seldinger::session {

// make(i) for i < count on `jobs` threads; take(i, result) for each in order, on the caller's, until it says false.
// Never more than a few results per thread wait. What make throws is thrown here.
template <typename Made>
void in_order(std::size_t count, std::size_t jobs, const std::function<Made(std::size_t)>& make,
              const std::function<bool(std::size_t, Made)>& take) {
  constexpr std::size_t kAhead = 3;
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::optional<Made>> made(count);
  std::size_t next = 0, taken = 0;
  bool stop = false;
  std::exception_ptr thrown;
  const auto work = [&] {
    for (std::unique_lock lock(mutex); !stop && next < count;) {
      if (next >= taken + kAhead * jobs) {
        changed.wait(lock);
        continue;
      }
      const std::size_t mine = next++;
      lock.unlock();
      try {
        Made one = make(mine);
        lock.lock();
        made[mine].emplace(std::move(one));
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        thrown = std::current_exception();
        stop = true;
      }
      changed.notify_all();
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < jobs && i < count; ++i) threads.emplace_back(work);
  std::unique_lock lock(mutex);
  while (taken < count && !stop) {
    changed.wait(lock, [&] { return stop || made[taken].has_value(); });
    if (stop) break;
    Made one = std::move(*made[taken]);
    made[taken].reset();
    lock.unlock();
    bool go_on = false;
    try {
      go_on = take(taken, std::move(one));
    } catch (...) {
      lock.lock();
      thrown = std::current_exception();
      stop = true;
      break;
    }
    lock.lock();
    ++taken;
    stop = stop || !go_on;
    changed.notify_all();
  }
  stop = true;
  lock.unlock();
  changed.notify_all();
  for (std::thread& thread : threads) thread.join();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace seldinger::session
