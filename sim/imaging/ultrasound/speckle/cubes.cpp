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
// Three loops, so that only the middle one, which looks up columns, runs one scatterer at a time.
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
  for (int n = 0; n < chunk.count; ++n) {
    const float *low = columns.mm[chunk.column[n]], *high = low + 4;
    float moved[4];
    for (int c = 0; c < 4; ++c) moved[c] = low[c] + chunk.part[n] * (high[c] - low[c]);
    std::memcpy(chunk.moved[n], moved, sizeof moved);
  }
  for (int n = 0; n < chunk.count; ++n) {
    const float y = chunk.at_y[n] + chunk.moved[n][1];
    chunk.y[n] = y;
    see<curved>(f, n, chunk.x[n] + chunk.moved[n][0], y, chunk.z[n] + chunk.moved[n][2], chunk);
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

// Four numbers at a time, of which the last is nobody's.
void Sides::lay(float part, const glm::vec3 (&axes)[3], float (*mm)[4]) const noexcept {
  const float by_x[4] = {axes[0].x, axes[1].x, axes[2].x, 0.0F}, by_y[4] = {axes[0].y, axes[1].y, axes[2].y, 0.0F},
              by_z[4] = {axes[0].z, axes[1].z, axes[2].z, 0.0F};
  for (const Layer& layer : layers_) {
    float u[4], along[4];
    for (int c = 0; c < 4; ++c) u[c] = layer.xyz[0][c] + part * (layer.xyz[1][c] - layer.xyz[0][c]);
    for (int c = 0; c < 4; ++c) along[c] = u[0] * by_x[c] + u[1] * by_y[c] + u[2] * by_z[c];
    std::memcpy(*mm++, along, sizeof along);
  }
}

}  // namespace seldinger::imaging
