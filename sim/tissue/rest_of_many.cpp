// The way back of many places, by the bits of one at a time: plain loops over places side by side, which compilers
// run several at a time (CMakeLists.txt).
#include <algorithm>
#include <array>
#include <cstddef>

#include "shaders/shared/displacement.glsl.h"
#include "sim/base/check.h"
#include "sim/base/clones.h"
#include "sim/tissue/displacement.h"

namespace seldinger::tissue {
namespace {

constexpr std::size_t kSideBySide = 8, kWorthIt = 4;  // fewer are found sooner one by one
struct Places {
  std::array<double, kSideBySide> x{}, y{}, z{};
};

template <typename Form>
[[gnu::always_inline]] inline void add_form(const Places& rest_mm, Places& moved_mm, const Form& form) {
  for (std::size_t i = 0; i < kSideBySide; ++i) {
    const glm::dvec3 moved = form(glm::dvec3(rest_mm.x[i], rest_mm.y[i], rest_mm.z[i]));
    moved_mm.x[i] += moved.x;
    moved_mm.y[i] += moved.y;
    moved_mm.z[i] += moved.z;
  }
}

// As shaders::displacement_at adds them up.
SELDINGER_FOR_AVX2_TOO
void displacement_at(const Displacement& displacement, const Places& rest_mm, Places& moved_mm) {
  using glm::dvec3;
  const auto& source = displacement.source;
  moved_mm = {};
  int i = 0;
  for (; i < displacement.contact_end; ++i)
    add_form(rest_mm, moved_mm, [&](const dvec3& p) { return shaders::displacement_contact(source[i], p); });
  for (; i < displacement.tip_end; ++i)
    add_form(rest_mm, moved_mm, [&](const dvec3& p) { return shaders::displacement_tip(source[i], p); });
  for (; i < displacement.shaft_end; ++i)
    add_form(rest_mm, moved_mm, [&](const dvec3& p) { return shaders::displacement_shaft(source[i], p); });
  for (; i < displacement.organ_end; ++i)
    add_form(rest_mm, moved_mm, [&](const dvec3& p) { return shaders::displacement_organ(source[i], p); });
  for (; i < displacement.vein_end; ++i)
    add_form(rest_mm, moved_mm, [&](const dvec3& p) { return shaders::displacement_vein(source[i], p); });
  for (; i < displacement.breath_end; ++i) {
    if (source[i].along.w > 0.0F)
      add_form(rest_mm, moved_mm,
               [&](const dvec3& p) { return shaders::displacement_sliding(displacement, source[i], p); });
    else
      add_form(rest_mm, moved_mm, [&](const dvec3& p) { return shaders::displacement_breath(source[i], p); });
  }
}

}  // namespace

void rest_of(const Displacement& displacement, std::span<const glm::dvec3> at_lps_mm, int fixed_point_steps,
             std::span<glm::dvec3> rest_lps_mm) noexcept {
  CHECK(at_lps_mm.size() == rest_lps_mm.size());
  for (std::size_t first = 0; first < at_lps_mm.size(); first += kSideBySide) {
    const std::size_t count = std::min(kSideBySide, at_lps_mm.size() - first);
    if (count < kWorthIt) {
      for (std::size_t i = first; i < first + count; ++i)
        rest_lps_mm[i] = shaders::rest_of(displacement, at_lps_mm[i], fixed_point_steps, 0);
      continue;
    }
    Places at, moved;
    for (std::size_t i = 0; i < kSideBySide; ++i) {  // the last one again where places run out
      const glm::dvec3& one = at_lps_mm[first + std::min(i, count - 1)];
      at.x[i] = one.x;
      at.y[i] = one.y;
      at.z[i] = one.z;
    }
    Places rest = at;
    for (int step = 0; step < fixed_point_steps; ++step) {
      displacement_at(displacement, rest, moved);
      for (std::size_t i = 0; i < kSideBySide; ++i) {
        rest.x[i] = at.x[i] - moved.x[i];
        rest.y[i] = at.y[i] - moved.y[i];
        rest.z[i] = at.z[i] - moved.z[i];
      }
    }
    for (std::size_t i = 0; i < count; ++i) rest_lps_mm[first + i] = {rest.x[i], rest.y[i], rest.z[i]};
  }
}

}  // namespace seldinger::tissue
