// A packet: as many rays of neighbouring pixels as a vector has lanes, walked together through the slabs of their
// main axis. The template is compiled once for each instruction set (packet_*.cpp); every operation is a plain
// IEEE one in the same order, so all of them give the same bits. Inside sim/imaging/xray only.
//
// The walk. In voxel units along the main axis a slab is one voxel thick, so a ray crosses at most one plane of
// each other axis in it: at most three voxels, of lengths that add up to the slab. The place of a crossing is
// ty0 + n·(1/|slope|), never accumulated, and relative to a block of kBlock slabs whose start is found in double:
// float then errs by about 1e-6 of a voxel, wherever the source stands. Axes along which a ray runs down are
// mirrored, so that every slope is positive. No division by a vanishing number can matter: a ray parallel to a
// plane has its next crossing beyond any block.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "sim/imaging/xray/projection/packet_volume.h"

namespace seldinger::imaging {

// Rays in the kept box's coordinates (faces at integers, box from 0 to size), affine in column and row.
struct PacketView {
  glm::dvec3 from, from_per_column, from_per_row;
  glm::dvec3 to, to_per_column, to_per_row;
  glm::dmat3 mm_from_voxel;
  int width_px, height_px;
};

// A packet's answers: the pixels (column + c, row + r) of a tile, in mm.
struct PacketJob {
  const PacketVolume* volume;
  const PacketView* view;
  float* water_mm;    // of the whole picture
  float* mineral_mm;  // null: water_mm is the total
  bool slab;          // Joseph's method, else exact
};

// Fills the tile of kTilePx × kTilePx pixels that begins at (column, row).
constexpr int kTilePx = 16;
using TileFunction = void (*)(const PacketJob&, int column, int row);
void project_tile_scalar(const PacketJob& job, int column, int row);
void project_tile_avx2(const PacketJob& job, int column, int row);
void project_tile_avx512(const PacketJob& job, int column, int row);

}  // namespace seldinger::imaging
