// The newest value of something, from one thread to another, without either ever waiting: three slots, of which
// each side owns one and the third changes hands. Values that are not read in time are passed over.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

namespace seldinger::base {

template <typename T>
class Snapshot {
 public:
  // By the writer only.
  void put(const T& value) noexcept {
    slots_[mine_] = value;
    mine_ = shared_.exchange(mine_ | kNew, std::memory_order_acq_rel) & kSlot;
  }

  // By the reader only: the newest value, if there was one since the last call.
  std::optional<T> take() noexcept {
    if ((shared_.load(std::memory_order_relaxed) & kNew) == 0) return std::nullopt;
    theirs_ = shared_.exchange(theirs_, std::memory_order_acq_rel) & kSlot;
    return slots_[theirs_];
  }

 private:
  static constexpr std::uint32_t kSlot = 3, kNew = 4;
  std::array<T, 3> slots_{};
  std::uint32_t mine_ = 0, theirs_ = 1;
  alignas(64) std::atomic<std::uint32_t> shared_{2};
};

}  // namespace seldinger::base
