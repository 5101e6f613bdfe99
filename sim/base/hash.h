// Our own 64-bit hash for state, recordings and checksums: the same bits on every machine. Not cryptographic
// (assets are named by SHA-256, casedb/database/credentials).
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace seldinger::base {

// Finaliser of SplitMix64 (Steele, Lea, Flood, OOPSLA 2014): every input bit reaches every output bit.
constexpr std::uint64_t mix64(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}

constexpr std::uint64_t hash_combine(std::uint64_t seed, std::uint64_t value) noexcept {
  return mix64(seed ^ mix64(value));
}

// Doubles enter by their bits, −0 as 0, so that equal values hash equally.
constexpr std::uint64_t hash_combine(std::uint64_t seed, double value) noexcept {
  return hash_combine(seed, std::bit_cast<std::uint64_t>(value == 0.0 ? 0.0 : value));
}

// Hash of bytes in order (little-endian words of eight; every machine we build for is little-endian).
std::uint64_t hash_bytes(std::span<const std::byte> bytes, std::uint64_t seed = 0) noexcept;

}  // namespace seldinger::base
