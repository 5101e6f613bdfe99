// The walk of one ray along its main axis; xray_exact.comp and xray_slab.comp differ in how they share out a layer's
// piece (XRAY_SLAB), and in whether water and mineral are summed apart (XRAY_TOTAL: not).
//
// Nothing is accumulated but the sums, and those block by block: a block's base comes from the ray's line in double, a
// place within the block from the layer's number by one fma in float, so positions keep 4e-6 voxel over any length,
// and 1e-7 of their distance from a face that they hardly cross.
//
// Measured on llvmpipe (Mesa 22.3, one thread, 512×512×62, milliseconds of processor time G1/G2 of tests/bench): this
// 114/297. Pairs of voxels fetched as one 32-bit texel, two texelFetch a layer, 190/400. Groups of 16×16 3 % more than
// 8×8. Blocks of 16 layers 5 % more than 32, of 8 layers 12 %. Vectors of 128, 256 or 512 bits make no difference.
#include "shared/xray_layer.glsl.h"

layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform usampler2DArray voxels;  // HU + 1000, at least 0; one layer a layer of the main axis
layout(binding = 1) uniform usampler2DArray cells;   // which of a cell and its higher neighbours hold anything
layout(std140, binding = 0) uniform Parameters { XrayParameters parameters; };
layout(std430, binding = 1) writeonly buffer Water { float water_mm[]; };
layout(std430, binding = 2) writeonly buffer Mineral { float mineral_mm[]; };

dvec3 both(vec4 high, vec4 rest) {
  return dvec3(high.xyz) + dvec3(rest.xyz);
}

// Where (from, to along x) the line is within [low, high) of a minor axis.
dvec2 within(double low, double high, double at_x, double at, double slope) {
  if (slope == 0.0lf) return at >= low && at < high ? dvec2(-1e9lf, 1e9lf) : dvec2(1e9lf, -1e9lf);
  double a = at_x + (low - at) / slope;
  double b = at_x + (high - at) / slope;
  return dvec2(min(a, b), max(a, b));
}

void main() {
  int column = int(gl_GlobalInvocationID.x) + parameters.column_first;
  int row = int(gl_GlobalInvocationID.y) + parameters.row_first;
  // The ray from source to pixel, in voxels, x the main axis of this pass. Rays steeper along another axis, or lost to
  // it in a tie, are another pass's.
  dvec3 pixel = both(parameters.pixel_first, parameters.pixel_first_rest) +
                double(column) * both(parameters.pixel_per_column, parameters.per_column_rest) +
                double(row) * both(parameters.pixel_per_row, parameters.per_row_rest);
  dvec3 source = both(parameters.source, parameters.source_rest);
  dvec3 along = parameters.parallel != 0 ? -source : pixel - source;
  dvec3 steep = abs(along);
  bool of_x = steep.x >= steep.y && steep.x >= steep.z && (parameters.wins_ties_y != 0 || steep.x > steep.y) &&
              (parameters.wins_ties_z != 0 || steep.x > steep.z);
  of_x = of_x || parameters.only_x != 0;

  // The part of x in which the ray lies between its ends and within the box.
  double per_x = steep.x > 0.0lf ? 1.0lf / along.x : 0.0lf;
  double slope_y = along.y * per_x;
  double slope_z = along.z * per_x;
  dvec2 in_y = within(double(parameters.clip_low.y), double(parameters.clip_high.y), pixel.x, pixel.y, slope_y);
  dvec2 in_z = within(double(parameters.clip_low.z), double(parameters.clip_high.z), pixel.x, pixel.z, slope_z);
  double x_in = max(max(min(pixel.x, pixel.x - along.x), double(parameters.clip_low.x)), max(in_y.x, in_z.x));
  double x_out = min(min(max(pixel.x, pixel.x - along.x), double(parameters.clip_high.x)), min(in_y.y, in_z.y));

  // What holds for the whole ray: its slopes, how many layers it takes to cross a voxel sideways, and whether both
  // slopes have the same sign.
  float dy = float(slope_y);
  float dz = float(slope_z);
  bool together = (dy >= 0.0) == (dz >= 0.0);
  float layers_per_y = dy == 0.0 ? kXrayFar : min(1.0 / abs(dy), kXrayFar);
  float layers_per_z = dz == 0.0 ? kXrayFar : min(1.0 / abs(dz), kXrayFar);
  vec2 per_size = 1.0 / vec2(parameters.size_y, parameters.size_z);

  bool runs = of_x && x_in < x_out;
  int block = runs ? int(x_in) / kXrayBlock : 0;
  int block_end = runs ? (int(ceil(x_out)) + kXrayBlock - 1) / kXrayBlock : 0;
  float water = 0.0;
  float mineral = 0.0;
  for (; block < block_end; ++block) {
    // Where the ray stands at the block's first layer.
    double base_x = double(block * kXrayBlock);
    double base_y = pixel.y + (base_x - pixel.x) * slope_y;
    double base_z = pixel.z + (base_x - pixel.x) * slope_z;
    // Relative to the nearest voxel face: a ray that hardly crosses it keeps all digits of its distance from it.
    double face_y = floor(base_y + 0.5lf);
    double face_z = floor(base_z + 0.5lf);
    int low_y = int(face_y);
    int low_z = int(face_z);
    float y = float(base_y - face_y);
    float z = float(base_z - face_z);
    float in_block = float(max(x_in - base_x, 0.0lf));
    float out_block = float(min(x_out - base_x, double(kXrayBlock)));

    // The cells that the ray meets in this block, at most two along each minor axis. Layers are walked only if one of
    // them holds anything.
    vec2 from = fma(vec2(in_block), vec2(dy, dz), vec2(y, z));
    vec2 to = fma(vec2(out_block), vec2(dy, dz), vec2(y, z));
    ivec2 first = ivec2(low_y, low_z) + ivec2(floor(min(from, to)));
    ivec2 last = ivec2(low_y, low_z) + ivec2(floor(max(from, to)));
    ivec2 cell = clamp(first / kXrayBlock, ivec2(0), (ivec2(parameters.size_y, parameters.size_z) - 1) / kXrayBlock);
    bvec2 next = greaterThanEqual(last, (cell + 1) * kXrayBlock);
    uint wanted = 1u | (next.x ? 2u : 0u) | (next.y ? 4u : 0u) | (next.x && next.y ? 8u : 0u);
    bool full = (texelFetch(cells, ivec3(cell, block), 0).x & wanted) != 0u;

    // Layer by layer: how the layer's piece of the ray is shared among four voxels, and their values.
    vec2 base_corner = vec2(low_y + 1, low_z + 1);
    float base_layer = float(block * kXrayBlock);
    float water_block = 0.0;
    float mineral_block = 0.0;
    int layer = int(in_block);
    int layer_end = full ? int(ceil(out_block)) : 0;
    for (; layer < layer_end; ++layer) {
      float x0 = max(float(layer), in_block);
      float x1 = min(float(layer + 1), out_block);
      float length_x = x1 - x0;
#ifdef XRAY_SLAB
      float x_mid = 0.5 * (x0 + x1);
      float lowest_y = fma(x_mid, dy, y) - 0.5;
      float lowest_z = fma(x_mid, dz, z) - 0.5;
#else
      float lowest_y = min(fma(x0, dy, y), fma(x1, dy, y));
      float lowest_z = min(fma(x0, dz, z), fma(x1, dz, z));
#endif
      float voxel_y = floor(lowest_y);
      float voxel_z = floor(lowest_z);
#ifdef XRAY_SLAB
      vec4 share = xray_slab_shares(length_x, lowest_y - voxel_y, lowest_z - voxel_z);
#else
      // As written: a compiler may make 1 - fract(lowest) of it (an NVIDIA driver does), which is 0 up to 6e-8 from the
      // face, and a ray that hardly crosses the face then crosses it layers too early.
      precise float to_face_y = (voxel_y + 1.0) - lowest_y;
      precise float to_face_z = (voxel_z + 1.0) - lowest_z;
      vec4 share = xray_exact_shares(length_x, to_face_y, to_face_z, layers_per_y, layers_per_z, together);
#endif
      // All four at once, at the corner that they share; beyond the box the sampler repeats the border, so rounding
      // never reads outside.
      vec2 corner = (base_corner + vec2(voxel_y, voxel_z)) * per_size;
      ivec4 value = ivec4(textureGather(voxels, vec3(corner, base_layer + float(layer))).wzxy);
#ifdef XRAY_TOTAL
      water_block += dot(vec4(value), share);
#else
      water_block += dot(vec4(min(value, 1000)), share);
      mineral_block += dot(vec4(max(value - 1000, 0)), share);
#endif
    }
    water += water_block;
#ifndef XRAY_TOTAL
    mineral += mineral_block;
#endif
  }

  if (of_x && column < parameters.width_px && row < parameters.height_px) {
    // From sums along x to millimetres: times the length of a step of one layer.
    vec3 step = vec3(1.0, dy, dz);
    float mm = 0.001 * sqrt(dot(parameters.metric.xyz, step * step) +
                            dot(parameters.metric_mixed.xyz, vec3(dy, dz, dy * dz)));
    int at = row * parameters.width_px + column;
    water_mm[at] = mm * water;
#ifndef XRAY_TOTAL
    mineral_mm[at] = mm * mineral;
#endif
  }
}
