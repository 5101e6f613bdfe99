// Cubes of the lattice that may hold scatterers of a tile, a few hundred at a time: where each one's scatterer
// lies, in loops that run several at a time (CMakeLists.txt).
#pragma once

#include <cstddef>
#include <cstdint>

namespace seldinger::imaging {

struct Chunk {
  static constexpr int kRoom = 512;
  int count = 0;
  std::uint32_t seed[kRoom];           // of the lattice
  float x[kRoom], y[kRoom], z[kRoom];  // the cube's corner, in the tile's frame
  float depth[kRoom], beam[kRoom];     // of the scatterer; y becomes its own
  std::uint32_t inside[kRoom];
  std::uint32_t phase[kRoom];  // steps of kPhases that the echo is turned by

  // Used only where tissue moves: then `y` is where the scatterer is now; x, at_y and z are where it is at rest.
  // The slab's column for its row gives the difference along the tile's axes, layer by layer.
  float at_y[kRoom];
  std::int32_t column[kRoom];  // where its row's column begins; later, the layer below it
  float part[kRoom];           // of the way from there to the layer above
  float moved_x[kRoom], moved_y[kRoom], moved_z[kRoom];
};

struct TileFrame {
  float radius, per_radian, beam_middle;  // straight: per_radian is per mm
  float a[3], b[3], c[3];                 // the cube's edges
  float from, to, half_thickness, first_beam, end_beam;
};

struct Columns {
  static constexpr int kRoom = 4096;
  int count = 0;
  float mm[kRoom][4];                  // xyz
  float low_mm = 0.0F, per_mm = 0.0F;  // height of the first layer; layers a mm
  int layers = 0;                      // ≥ 2
};

// Where the chunk's scatterers lie; `moving`: of tissue that moves, else null.
void place(const TileFrame& frame, bool curved, const Columns* moving, Chunk& chunk) noexcept;

}  // namespace seldinger::imaging
