// Threads that answer requests, in lanes of their own, so that what takes long holds up nothing that does not. In a
// lane the addresses take turns: who sends many requests waits for themselves.
#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "web/site/http.h"
#include "web/site/lane.h"

namespace seldinger::web {

struct QueuedRequest {
  std::uint64_t connection = 0;
  Request request;
};

class Workers {
 public:
  // `work` may throw nothing.
  explicit Workers(std::function<void(QueuedRequest)> work);
  ~Workers();  // what is being answered is finished, what waits is dropped
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  void add(Lane lane, QueuedRequest job);  // how many can wait, connections bound

 private:
  struct Queue {
    std::mutex mutex;
    std::condition_variable arrived;
    std::map<std::string, std::deque<QueuedRequest>> of_address;
    std::deque<std::string> turns;  // each address with something once
    bool ended = false;
  };
  void run(Queue& queue);

  const std::function<void(QueuedRequest)> work_;
  std::array<Queue, kLanes> queues_;
  std::vector<std::thread> threads_;
};

}  // namespace seldinger::web
