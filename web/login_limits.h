// How fast passwords may be tried, and how many at once.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>

#include "web/surroundings.h"

namespace seldinger::web {

// Five tries of one name are free; from then on each failure doubles the wait, 1 s up to 15 min. Names that do not
// exist count as well, so the answer does not tell. All names together: 60 tries at once, then one a second, which
// also bounds the number of names remembered (an hour's worth).
class LoginThrottle {
 public:
  explicit LoginThrottle(const Surroundings& surroundings) : surroundings_(surroundings) {}

  // Nothing: go on; the try counts as failed until succeeded() is called. Otherwise seconds to wait.
  std::optional<std::int64_t> begin(std::string_view name);
  void succeeded(std::string_view name);

 private:
  struct Tries {
    int failures = 0;
    std::int64_t last_us = 0;
  };
  const Surroundings& surroundings_;
  std::mutex mutex_;
  std::map<std::string, Tries> by_name_;  // names in lower case
  double tokens_ = 60.0;
  std::optional<std::int64_t> refilled_us_;
};

// A password's hash takes 64 MiB and 60 ms by design: two at once, eight wait, the rest come back later.
class LoginGate {
 public:
  class Pass {
   public:
    explicit Pass(LoginGate* gate) : gate_(gate) {}
    Pass(Pass&& other) noexcept : gate_(other.gate_) { other.gate_ = nullptr; }
    Pass(const Pass&) = delete;
    Pass& operator=(const Pass&) = delete;
    Pass& operator=(Pass&&) = delete;
    ~Pass();

   private:
    LoginGate* gate_;
  };
  std::optional<Pass> enter();

 private:
  std::mutex mutex_;
  std::condition_variable left_;
  int inside_ = 0, waiting_ = 0;
};

}  // namespace seldinger::web
