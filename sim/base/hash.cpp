#include "sim/base/hash.h"

#include <cstring>

namespace seldinger::base {

static_assert(std::endian::native == std::endian::little);

std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed) noexcept {
  std::uint64_t hash = hash_combine(seed, static_cast<std::uint64_t>(bytes.size()));
  std::size_t at = 0;
  for (; at + 8 <= bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, 8);
    hash = hash_combine(hash, word);
  }
  if (at < bytes.size()) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, bytes.size() - at);
    hash = hash_combine(hash, word);
  }
  return hash;
}

}  // namespace seldinger::base
