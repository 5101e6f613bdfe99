// A double as two floats, for shaders: together they hold nearly all of its digits.
#pragma once

#include <bit>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace seldinger::imaging {

// The first 24 binary digits, by cutting off the others: what remains of a conversion to float and back, g++ 12 at
// -O2 takes for nothing.
inline double first_digits(double value) noexcept {
  constexpr std::uint64_t kKept = ~((std::uint64_t{1} << 29) - 1);
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(value) & kKept);
}

// The first digits, and the rest; w is 0.
inline void split(const glm::dvec3& value, glm::vec4& high, glm::vec4& rest) noexcept {
  const glm::dvec3 kept(first_digits(value.x), first_digits(value.y), first_digits(value.z));
  high = glm::vec4(glm::dvec4(kept, 0.0));
  rest = glm::vec4(glm::dvec4(value - kept, 0.0));
}

}  // namespace seldinger::imaging
