// Answers that take seconds and much memory to make: one is made at a time, and kept as long as what it is made
// from stays the same.
#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::web {

class Answers {
 public:
  struct Made {
    std::string text;
    bool keep = true;                                // false: what it is made from has changed meanwhile
    std::vector<std::vector<std::byte>> pictures{};  // that the text names
  };
  using Make = std::function<base::Result<Made>()>;

  explicit Answers(std::size_t most_bytes = std::size_t{24} << 20) : most_bytes_(most_bytes) {}
  // What is kept under this key, else what `make` makes: it is called once, however many ask at the same time. Its
  // refusal is answered and not kept. The longest unused make room.
  base::Result<std::shared_ptr<const Made>> get(const std::string& key, const Make& make);
  bool holds(const std::string& key);

 private:
  struct Kept {
    std::string key;
    std::shared_ptr<const Made> made;
    std::size_t bytes() const noexcept;
  };
  std::shared_ptr<const Made> find(const std::string& key);  // null: it is not kept; else it was used now

  const std::size_t most_bytes_;
  std::mutex making_, mutex_;
  std::list<Kept> kept_;  // last used first
  std::size_t bytes_ = 0;
};

}  // namespace seldinger::web
