// A plain value as bytes and back, and its hash, by lists of fields such as tick_state_fields.h: `visit(each,
// value)` beside the value's type or in this namespace. Versioned and checked; every bit comes back as it was.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/base/hash.h"
#include "sim/base/result.h"
#include "sim/engine/step.h"

namespace seldinger::engine::fields {

// Bytes are those of a little-endian machine, which every machine is that this is built for.
static_assert(std::endian::native == std::endian::little);

template <typename T>
concept Number = std::is_arithmetic_v<T> || std::is_enum_v<T>;

// Takes a value apart down to its numbers, each of which is handed to Leaf::number.
template <typename Leaf>
class Walk {
 public:
  explicit Walk(Leaf& leaf) : leaf_(leaf) {}
  template <typename... Fields>
  void operator()(Fields&... fields) {
    (value(fields), ...);
  }

 private:
  template <typename T>
  void value(T& field) {
    if constexpr (Number<T>)
      leaf_.number(field);
    else
      visit(*this, field);
  }
  template <glm::length_t N, typename T>
  void value(glm::vec<N, T>& v) {
    for (glm::length_t i = 0; i < N; ++i) value(v[i]);
  }
  template <glm::length_t N, typename T>
  void value(const glm::vec<N, T>& v) {
    for (glm::length_t i = 0; i < N; ++i) value(v[i]);
  }
  template <typename T, std::size_t N>
  void value(std::array<T, N>& all) {
    for (T& one : all) value(one);
  }
  template <typename T, std::size_t N>
  void value(const std::array<T, N>& all) {
    for (const T& one : all) value(one);
  }
  template <typename T, std::size_t N>
  void value(T (&all)[N]) {
    for (T& one : all) value(one);
  }
  template <typename T>
  void value(std::optional<T>& maybe) {
    bool there = maybe.has_value();
    value(there);
    if (there && !maybe) maybe.emplace();
    if (!there) maybe.reset();
    if (maybe) value(*maybe);
  }
  template <typename T>
  void value(const std::optional<T>& maybe) {
    const bool there = maybe.has_value();
    value(there);
    if (maybe) value(*maybe);
  }

  Leaf& leaf_;
};

struct Writer {
  std::vector<std::byte> bytes;
  template <Number T>
  void number(const T& value) {
    const auto* from = reinterpret_cast<const std::byte*>(&value);
    bytes.insert(bytes.end(), from, from + sizeof(T));
  }
};

// What is not there, or no truth value, is read as 0 and remembered as bad.
struct Reader {
  std::span<const std::byte> left;
  bool bad = false;
  template <Number T>
  void number(T& value) {
    std::array<std::byte, sizeof(T)> raw{};
    bad = bad || left.size() < raw.size();
    if (!bad) {
      std::copy_n(left.begin(), raw.size(), raw.begin());
      left = left.subspan(raw.size());
    }
    if constexpr (std::is_same_v<T, bool>) {
      bad = bad || raw[0] > std::byte{1};
      value = raw[0] == std::byte{1};
    } else {
      value = std::bit_cast<T>(raw);
    }
  }
};

// By bits: what differs in a NaN's, or in the sign of a zero, differs.
struct Hasher {
  std::uint64_t hash = 0;
  template <Number T>
  void number(const T& value) noexcept {
    std::uint64_t word = 0;
    std::memcpy(&word, &value, sizeof(T));
    hash = base::hash_combine(hash, word);
  }
};

// Eight letters that say what the bytes are, and the version of what is listed.
struct Mark {
  std::array<char, 8> letters;
  std::uint32_t format;
};

template <typename T>
std::uint64_t hash_of(const T& value) noexcept {
  Hasher hasher;
  Walk<Hasher>{hasher}(value);
  return hasher.hash;
}

template <typename T>
std::vector<std::byte> bytes_of(const Mark& mark, const T& value) {
  Writer writer;
  for (const char letter : mark.letters) writer.number(letter);
  writer.number(mark.format);
  writer.number(kStepVersion);
  Walk<Writer>{writer}(value);
  writer.number(base::hash_bytes(writer.bytes));
  return std::move(writer.bytes);
}

// Refused: `damaged` (cut short, foreign, altered), `state_version` (of another format or step version).
template <typename T>
base::Result<T> value_of(const Mark& mark, std::span<const std::byte> bytes) {
  constexpr std::size_t kHeadBytes = sizeof(mark.letters) + 2 * sizeof(std::uint32_t);
  constexpr std::size_t kChecksumBytes = sizeof(std::uint64_t);
  const base::Error damaged{"damaged", "these bytes are no saved state of an attempt, or not all of it"};
  if (bytes.size() < kHeadBytes + kChecksumBytes ||
      !std::equal(mark.letters.begin(), mark.letters.end(), bytes.begin(),
                  [](char letter, std::byte byte) { return static_cast<std::byte>(letter) == byte; }))
    return damaged;
  Reader checksum{bytes.last(kChecksumBytes)};
  std::uint64_t sum = 0;
  checksum.number(sum);
  const auto summed = bytes.first(bytes.size() - kChecksumBytes);
  if (sum != base::hash_bytes(summed)) return damaged;
  Reader reader{summed.subspan(mark.letters.size())};
  std::uint32_t format = 0, step_version = 0;
  reader.number(format);
  reader.number(step_version);
  if (format != mark.format || step_version != kStepVersion)
    return base::Error{"state_version", "the state was saved by another version of the simulation"};
  T value;
  Walk<Reader>{reader}(value);
  if (reader.bad || !reader.left.empty()) return damaged;
  return value;
}

}  // namespace seldinger::engine::fields
