// Formulas of X-ray projection: which part of a ray's piece lies in which of four voxels. Compiled as GLSL in float
// (xray_walk.glsl.h) and as C++ in double (tests).
//
// A ray walks along its main axis, on which it is steepest in voxels, one layer of voxels at a time. In a layer it
// moves by at most one voxel along each minor axis, so it meets at most 2×2 voxels: low and high of each minor axis.
// Coordinates are voxel faces: voxel j reaches from j to j + 1.
#ifndef SELDINGER_SHADERS_SHARED_XRAY_LAYER
#define SELDINGER_SHADERS_SHARED_XRAY_LAYER

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

SHARED_CONSTANT int kXrayBlock = 32;  // layers walked between two re-basings, and voxels along a cell's side

// Layers to the next face for a ray that keeps its y or z. Finite, so that nothing times it is not a number, and
// times the smallest distance from a face that float tells from none it is still beyond any piece.
SHARED_CONSTANT real kXrayFar = 1e30;

// The uniform block (std140). x is the main axis, y and z the minor axes, in voxel faces of the uploaded box. What
// decides positions comes as the sum of two floats: 48 bits.
struct XrayParameters {
  vec4 pixel_first, pixel_first_rest;      // xyz: pixel (0,0)
  vec4 pixel_per_column, per_column_rest;  // xyz
  vec4 pixel_per_row, per_row_rest;        // xyz
  vec4 source, source_rest;                // xyz: the source; parallel rays: first end minus last end
  vec4 clip_low, clip_high;                // xyz: rays count within
  vec4 metric;                             // mm² per voxel²: xx, yy, zz
  vec4 metric_mixed;                       // twice: xy, xz, yz
  int width_px;
  int height_px;
  int column_first;  // of this dispatch
  int row_first;
  int size_x;  // of the box
  int size_y;
  int size_z;
  int parallel;
  int wins_ties_y;  // 1: at equal steepness the ray is x's, not y's
  int wins_ties_z;
  int only_x;  // 1: every ray of this dispatch is x's
  int padding;
};

// Shares of a piece of `length` (in layers) that lie in the four voxels (low y low z, high y low z, low y high z,
// high y high z). `to_face_y`: from the piece's lowest y to the face between low and high, > 0; `layers_per_y`:
// 1/|slope|, at most kXrayFar; `together`: both minor axes rise, or both fall. None is negative, rounding included.
// Ties need no rule: two crossings at one place leave a piece of no length between them.
SHARED real4 xray_exact_shares(real length, real to_face_y, real to_face_z, real layers_per_y, real layers_per_z,
                               bool together) {
  real low_y = min(length, to_face_y * layers_per_y);
  real low_z = min(length, to_face_z * layers_per_z);
  real y = together ? low_y : length - low_y;  // of the side of y on which the ray is while z is low
  real both = min(y, low_z);
  real z_alone = low_z - both;
  real y_alone = y - both;
  real neither = length - max(y, low_z);
  return together ? real4(both, z_alone, y_alone, neither) : real4(z_alone, both, neither, y_alone);
}

// Joseph: the four centres around the piece's middle; at_y, at_z in [0,1] from the low centre to the high one.
SHARED real4 xray_slab_shares(real length, real at_y, real at_z) {
  real high = length * at_z;
  real low = length - high;
  real high_low = low * at_y;
  real high_high = high * at_y;
  return real4(low - high_low, high_low, high - high_high, high_high);
}

SHARED_END

#endif
