#include "sim/imaging/ultrasound/speckle/cubes.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_cube.glsl.h"
#include "sim/base/clones.h"
#include "sim/imaging/ultrasound/speckle/phase.h"

namespace seldinger::imaging {
namespace {

[[gnu::always_inline]] inline void rest(const TileFrame& f, std::uint32_t bits, float& x, float& y, float& z) {
  const float u = shaders::us_cube_u(bits), v = shaders::us_cube_v(bits), w = shaders::us_cube_w(bits);
  x = x + u * f.a[0] + v * f.b[0] + w * f.c[0];
  y = y + u * f.a[1] + v * f.b[1] + w * f.c[1];
  z = z + u * f.a[2] + v * f.b[2] + w * f.c[2];
}
template <bool curved>
[[gnu::always_inline]] inline void see(const TileFrame& f, int n, float x, float y, float z, Chunk& chunk) {
  float depth = z, beam = 0.0F;
  if constexpr (curved) {
    const float from_center = z + f.radius;
    depth = std::sqrt(x * x + from_center * from_center) - f.radius;
    const float angle = shaders::us_narrow_angle(x / from_center);
    beam = f.beam_middle + angle * f.per_radian;
  } else {
    beam = f.beam_middle + x * f.per_radian;
  }
  chunk.depth[n] = depth;
  chunk.beam[n] = beam;
  chunk.inside[n] =
      static_cast<std::uint32_t>((depth >= f.from) & (depth < f.to) & (std::abs(y) < f.half_thickness) &
                                 (beam > f.first_beam) & (beam < f.end_beam));
}
template <bool curved>
[[gnu::always_inline]] inline void place_still(const TileFrame& f, Chunk& chunk) noexcept {
  for (int n = 0; n < chunk.count; ++n) {
    const std::uint32_t bits = shaders::us_lattice_bits(chunk.seed[n]);
    float x = chunk.x[n], y = chunk.y[n], z = chunk.z[n];
    rest(f, bits, x, y, z);
    chunk.x[n] = x;
    chunk.y[n] = y;
    chunk.z[n] = z;
    chunk.phase[n] = shaders::us_lattice_turned(bits) * (kPhases / 2);
    see<curved>(f, n, x, y, z, chunk);
  }
}
// Looks up columns, four scatterers at a time, and turns them from one scatterer's xyz to four's x, y and z: as
// loops over numbers compilers do neither well.
using Four = float __attribute__((vector_size(16)));
[[gnu::always_inline]] inline void look_up(const Columns& columns, Chunk& chunk) noexcept {
  static_assert(Chunk::kRoom % 4 == 0);
  for (int n = chunk.count; n % 4 != 0; ++n) chunk.column[n] = 0;
  for (int n = 0; n < chunk.count; n += 4) {
    Four moved[4];
    for (int i = 0; i < 4; ++i) {
      Four low, high;
      const float(*at)[4] = columns.mm + chunk.column[n + i];
      std::memcpy(&low, at[0], sizeof low);
      std::memcpy(&high, at[1], sizeof high);
      moved[i] = low + chunk.part[n + i] * (high - low);
    }
    const Four xy_first = __builtin_shufflevector(moved[0], moved[1], 0, 4, 1, 5),
               xy_last = __builtin_shufflevector(moved[2], moved[3], 0, 4, 1, 5),
               x = __builtin_shufflevector(xy_first, xy_last, 0, 1, 4, 5),
               y = __builtin_shufflevector(xy_first, xy_last, 2, 3, 6, 7),
               z_first = __builtin_shufflevector(moved[0], moved[1], 2, 6, 2, 6),
               z_last = __builtin_shufflevector(moved[2], moved[3], 2, 6, 2, 6),
               z = __builtin_shufflevector(z_first, z_last, 0, 1, 4, 5);
    std::memcpy(chunk.moved_x + n, &x, sizeof x);
    std::memcpy(chunk.moved_y + n, &y, sizeof y);
    std::memcpy(chunk.moved_z + n, &z, sizeof z);
  }
}
template <bool curved>
[[gnu::always_inline]] inline void place_moving(const TileFrame& f, const Columns& columns, Chunk& chunk) noexcept {
  const float low_mm = columns.low_mm, per_mm = columns.per_mm;
  const int last = columns.layers - 2;
  for (int n = 0; n < chunk.count; ++n) {
    const std::uint32_t bits = shaders::us_lattice_bits(chunk.seed[n]);
    float x = chunk.x[n], y = chunk.y[n], z = chunk.z[n];
    rest(f, bits, x, y, z);
    chunk.x[n] = x;
    chunk.at_y[n] = y;
    chunk.z[n] = z;
    chunk.phase[n] = shaders::us_lattice_turned(bits) * (kPhases / 2);
    const float layer = std::min(std::max((y - low_mm) * per_mm, 0.0F), static_cast<float>(last + 1));
    const int below = std::min(static_cast<int>(layer), last);
    chunk.part[n] = layer - static_cast<float>(below);
    chunk.column[n] += below;
  }
  look_up(columns, chunk);
  for (int n = 0; n < chunk.count; ++n) {
    const float y = chunk.at_y[n] + chunk.moved_y[n];
    chunk.y[n] = y;
    see<curved>(f, n, chunk.x[n] + chunk.moved_x[n], y, chunk.z[n] + chunk.moved_z[n], chunk);
  }
}
SELDINGER_FOR_AVX2_TOO void place_curved(const TileFrame& f, Chunk& chunk) noexcept {
  place_still<true>(f, chunk);
}
SELDINGER_FOR_AVX2_TOO void place_straight(const TileFrame& f, Chunk& chunk) noexcept {
  place_still<false>(f, chunk);
}
SELDINGER_FOR_AVX2_TOO void place_moving_curved(const TileFrame& f, const Columns& columns, Chunk& chunk) noexcept {
  place_moving<true>(f, columns, chunk);
}
SELDINGER_FOR_AVX2_TOO void place_moving_straight(const TileFrame& f, const Columns& columns,
                                                  Chunk& chunk) noexcept {
  place_moving<false>(f, columns, chunk);
}

}  // namespace

void place(const TileFrame& f, bool curved, const Columns* moving, Chunk& chunk) noexcept {
  if (moving != nullptr)
    curved ? place_moving_curved(f, *moving, chunk) : place_moving_straight(f, *moving, chunk);
  else
    curved ? place_curved(f, chunk) : place_straight(f, chunk);
}

}  // namespace seldinger::imaging
