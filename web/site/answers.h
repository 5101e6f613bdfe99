// Answers that take seconds and much memory to make: one is made at a time, and kept as long as what it is made
// from stays the same.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <string>

#include "sim/base/result.h"

namespace seldinger::web {

class Answers {
 public:
  struct Made {
    std::string text;
    bool keep = true;  // false: what it is made from has changed meanwhile
  };
  using Make = std::function<base::Result<Made>()>;

  explicit Answers(std::size_t most_bytes = std::size_t{8} << 20) : most_bytes_(most_bytes) {}
  // What is kept under this key, else what `make` makes: it is called once, however many ask at the same time. Its
  // refusal is answered and not kept. The longest unused make room.
  base::Result<std::string> get(const std::string& key, const Make& make);

 private:
  struct Kept {
    std::string key, text;
    std::size_t bytes() const noexcept { return sizeof(Kept) + key.size() + text.size(); }
  };
  const std::string* find(const std::string& key);  // under mutex_

  const std::size_t most_bytes_;
  std::mutex making_, mutex_;
  std::list<Kept> kept_;  // last used first
  std::size_t bytes_ = 0;
};

}  // namespace seldinger::web
