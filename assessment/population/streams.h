// Where what is drawn of a simulated person comes from: each thing has a stream of its own, named by a hash of
// whose it is and what it is. Nothing is drawn in turn, so no two people, groups or attempts share a stream,
// whatever is drawn beside it or in which order.
#pragma once

#include <cstdint>
#include <string_view>

#include "sim/base/hash.h"
#include "sim/base/rng.h"

namespace seldinger::assessment::population {

enum class Drawn : std::uint64_t {
  ability = 1,
  strategy,
  learning,
  specific,  // a person's own part of a skill
  with_case,
  occasion,
  lapse,
  device,
  patience,
  drop_out,
  attempt,  // what hands and eyes do in it
  fact,
  rater,
  rating,
  answer,
  surrogate,
  identity,
};

// Of whom: a run's seed, the group's name and the person's number in it, from 1.
constexpr std::uint64_t person_key(std::uint64_t seed, std::string_view group, std::uint64_t person) noexcept {
  std::uint64_t key = base::hash_combine(base::mix64(0x70656f706c65ULL), seed);
  for (const char letter : group) key = base::hash_combine(key, std::uint64_t{static_cast<unsigned char>(letter)});
  return base::hash_combine(base::hash_combine(key, std::uint64_t{group.size()}), person);
}

// What: of two things with the same name `first` and `second` tell which, for instance the case and the skill.
constexpr std::uint64_t stream_of(std::uint64_t person, Drawn what, std::uint64_t first = 0,
                                  std::uint64_t second = 0) noexcept {
  return base::hash_combine(base::hash_combine(base::hash_combine(person, static_cast<std::uint64_t>(what)), first),
                            second);
}

inline double normal_of(std::uint64_t stream) noexcept {
  return base::normal_at(stream, 0);
}
constexpr double uniform_of(std::uint64_t stream) noexcept {
  return base::uniform_at(stream, 0);
}

}  // namespace seldinger::assessment::population
