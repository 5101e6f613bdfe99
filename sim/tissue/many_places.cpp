// Where many places are, and their way back, by the bits of one at a time: plain loops over places side by side,
// which compilers run several at a time (CMakeLists.txt).
#include <algorithm>
#include <array>
#include <cstddef>

#include "shaders/shared/displacement.glsl.h"
#include "sim/base/check.h"
#include "sim/base/clones.h"
#include "sim/tissue/displacement.h"

namespace seldinger::tissue {
namespace {

constexpr std::size_t kMost = 8, kHalf = 4, kWorthIt = 2;  // one alone is found sooner as it is
template <std::size_t count>
struct Places {
  std::array<double, count> x{}, y{}, z{};
};

template <std::size_t count, typename Form>
[[gnu::always_inline]] inline void add_form(const Places<count>& rest_mm, Places<count>& moved_mm,
                                            const Form& form) {
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 moved = form(glm::dvec3(rest_mm.x[i], rest_mm.y[i], rest_mm.z[i]));
    moved_mm.x[i] += moved.x;
    moved_mm.y[i] += moved.y;
    moved_mm.z[i] += moved.z;
  }
}

// As shaders::displacement_at adds them up.
template <std::size_t count>
[[gnu::always_inline]] inline void add_up(const Displacement& displacement, const Places<count>& rest_mm,
                                          Places<count>& moved_mm) {
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

SELDINGER_FOR_AVX2_TOO
void displacement_at(const Displacement& displacement, const Places<kMost>& rest_mm, Places<kMost>& moved_mm) {
  add_up(displacement, rest_mm, moved_mm);
}
SELDINGER_FOR_AVX2_TOO
void displacement_at(const Displacement& displacement, const Places<kHalf>& rest_mm, Places<kHalf>& moved_mm) {
  add_up(displacement, rest_mm, moved_mm);
}

// As many as there are, no more than `count`; the last one again where places run out.
template <std::size_t count>
Places<count> side_by_side(std::span<const glm::dvec3> some) {
  Places<count> places;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3& one = some[std::min(i, some.size() - 1)];
    places.x[i] = one.x;
    places.y[i] = one.y;
    places.z[i] = one.z;
  }
  return places;
}

template <std::size_t count>
void find_rest(const Displacement& displacement, std::span<const glm::dvec3> at_lps_mm, int fixed_point_steps,
               glm::dvec3* rest_lps_mm) {
  const Places<count> at = side_by_side<count>(at_lps_mm);
  Places<count> rest = at, moved;
  for (int step = 0; step < fixed_point_steps; ++step) {
    displacement_at(displacement, rest, moved);
    for (std::size_t i = 0; i < count; ++i) {
      rest.x[i] = at.x[i] - moved.x[i];
      rest.y[i] = at.y[i] - moved.y[i];
      rest.z[i] = at.z[i] - moved.z[i];
    }
  }
  for (std::size_t i = 0; i < at_lps_mm.size(); ++i) rest_lps_mm[i] = {rest.x[i], rest.y[i], rest.z[i]};
}

}  // namespace

void displaced(const Displacement& displacement, std::span<const glm::dvec3> rest_lps_mm,
               std::span<glm::dvec3> now_lps_mm) noexcept {
  CHECK(rest_lps_mm.size() == now_lps_mm.size());
  Places<kMost> moved;
  for (std::size_t first = 0; first < rest_lps_mm.size(); first += kMost) {
    const auto some = rest_lps_mm.subspan(first, std::min(kMost, rest_lps_mm.size() - first));
    displacement_at(displacement, side_by_side<kMost>(some), moved);
    for (std::size_t i = 0; i < some.size(); ++i)
      now_lps_mm[first + i] = some[i] + glm::dvec3(moved.x[i], moved.y[i], moved.z[i]);
  }
}

void rest_of(const Displacement& displacement, std::span<const glm::dvec3> at_lps_mm, int fixed_point_steps,
             std::span<glm::dvec3> rest_lps_mm) noexcept {
  CHECK(at_lps_mm.size() == rest_lps_mm.size());
  for (std::size_t first = 0; first < at_lps_mm.size(); first += kMost) {
    const auto some = at_lps_mm.subspan(first, std::min(kMost, at_lps_mm.size() - first));
    glm::dvec3* rest = rest_lps_mm.data() + first;
    if (some.size() < kWorthIt)
      *rest = shaders::rest_of(displacement, some.front(), fixed_point_steps, 0);
    else if (some.size() <= kHalf)
      find_rest<kHalf>(displacement, some, fixed_point_steps, rest);
    else
      find_rest<kMost>(displacement, some, fixed_point_steps, rest);
  }
}

}  // namespace seldinger::tissue
