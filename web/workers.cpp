#include "web/workers.h"

#include <utility>

namespace seldinger::web {
namespace {

// Pages read one library, which answers one question at a time: more threads would only hold more memory.
constexpr std::array<std::size_t, kLanes> kThreads = {4, 2, 1, 1};

}  // namespace

Workers::Workers(std::function<void(QueuedRequest)> work) : work_(std::move(work)) {
  for (std::size_t lane = 0; lane < queues_.size(); ++lane)
    for (std::size_t i = 0; i < kThreads[lane]; ++i)
      threads_.emplace_back([this, &queue = queues_[lane]] { run(queue); });
}

Workers::~Workers() {
  for (Queue& queue : queues_) {
    const std::lock_guard lock(queue.mutex);
    queue.ended = true;
    queue.arrived.notify_all();
  }
  for (std::thread& thread : threads_) thread.join();
}

void Workers::add(Lane lane, QueuedRequest job) {
  Queue& queue = queues_[static_cast<std::size_t>(lane)];
  {
    const std::lock_guard lock(queue.mutex);
    std::deque<QueuedRequest>& own = queue.of_address[job.request.from];
    if (own.empty()) queue.turns.push_back(job.request.from);
    own.push_back(std::move(job));
  }
  queue.arrived.notify_one();
}

void Workers::run(Queue& queue) {
  for (;;) {
    QueuedRequest job;
    {
      std::unique_lock lock(queue.mutex);
      queue.arrived.wait(lock, [&] { return queue.ended || !queue.turns.empty(); });
      if (queue.ended) return;
      const auto next = queue.of_address.find(queue.turns.front());
      queue.turns.pop_front();
      job = std::move(next->second.front());
      next->second.pop_front();
      if (next->second.empty()) {
        queue.of_address.erase(next);
      } else {
        queue.turns.push_back(next->first);
      }
    }
    work_(std::move(job));
  }
}

}  // namespace seldinger::web
