// Formulas of MPR: where a pixel lies, what of needle and lesion it shows, and the volume's HU there. Compiled as
// GLSL in float (mpr_slice.comp, mpr_displaced.comp) and as C++ in double (sim/imaging/mpr/mpr_cpu.cpp).
#ifndef SELDINGER_SHADERS_SHARED_MPR
#define SELDINGER_SHADERS_SHARED_MPR

#include "real.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

SHARED_BEGIN

SHARED_CONSTANT real kMprOutsideHu = -1024.0;  // padding, as kAirHu of sim/volume/volume.h
SHARED_CONSTANT real kMprLumenHu = -1000.0;    // the lumen of a hollow needle is empty: air
SHARED_CONSTANT int kMprMaxLesions = 16;

// A needle this near to parallel with the plane (sine of the angle) keeps one axial position across the slab: over
// a slab of 100 mm the axial range moves by 0.1 µm, and nothing is divided by a vanishing number.
SHARED_CONSTANT real kMprParallel = 1e-6;

// The uniform block (std140). Positions are relative to the view's centre, so that float keeps its digits.
struct MprParameters {
  vec4 index_first;             // xyz: continuous voxel index of pixel (0,0)
  vec4 index_per_column;        // xyz
  vec4 index_per_row;           // xyz
  vec4 position_first_mm;       // xyz, from the view's centre
  vec4 position_per_column_mm;  // xyz
  vec4 position_per_row_mm;     // xyz
  vec4 needle_tip_mm;           // xyz, from the view's centre; w: length
  vec4 needle_direction;        // xyz: unit, hub → tip; w: radius in mm
  vec4 needle_normal_across;    // xyz: part of the plane's normal across the needle; w: part along it
  float needle_inner_radius_mm;
  float needle_slab_half_mm;
  float needle_hu;
  int needle_present;
  int lesion_count;
  int width_px;
  int height_px;
  int size_x;  // of the volume, voxels
  int size_y;
  int size_z;
  int nearest;  // 1: the nearest voxel, 0: trilinear
  int padding;
  vec4 lesion_sphere_mm[kMprMaxLesions];  // xyz: centre from the view's centre; w: radius
  vec4 lesion_hu[kMprMaxLesions];         // x
};

// Beside it, of a patient who moves.
struct MprDisplaced {
  mat4 voxel_from_center;  // continuous voxel index of a place at rest, mm from the view's centre
  vec4 center_lps_mm;      // xyz
  int fixed_point_steps;   // of each pixel's way back
  int newton_steps;
  int columns;  // of a grid's cells
  int rows;
  float nodes_per_pixel;
  int padding_0;
  int padding_1;
  int padding_2;
};

// The start of a row is computed first, then the column added to it: never accumulated, and every caller that
// hoists the row's start gets the same bits.
SHARED real3 mpr_row_start(real3 first, real3 per_row, int row) {
  return first + real(row) * per_row;
}

SHARED real3 mpr_in_row(real3 row_start, real3 per_column, int column) {
  return row_start + real(column) * per_column;
}

// The volume reaches half a voxel beyond the outermost centres. NaN is outside.
SHARED bool mpr_inside(real3 index, int3 size) {
  return index.x >= -0.5 && index.y >= -0.5 && index.z >= -0.5 && index.x <= real(size.x) - 0.5 &&
         index.y <= real(size.y) - 0.5 && index.z <= real(size.z) - 0.5;
}

// For an index inside: index + 0.5 is not negative, so truncation is floor. The clamp is for the far face itself.
SHARED int3 mpr_nearest(real3 index, int3 size) {
  return clamp(int3(index + 0.5), int3(0), size - 1);
}

// The last half voxel repeats the outermost centres (clamp to them).
SHARED real3 mpr_clamped(real3 index, int3 size) {
  return clamp(index, real3(0.0), real3(size - 1));
}

// From the eight corners; x runs fastest: front = (000, 100, 010, 110), back = the same at z + 1.
SHARED real mpr_trilinear(real4 front, real4 back, real3 fraction) {
  real4 plane = front + fraction.z * (back - front);
  real near_y = plane.x + fraction.x * (plane.y - plane.x);
  real far_y = plane.z + fraction.x * (plane.w - plane.z);
  return near_y + fraction.y * (far_y - near_y);
}

SHARED bool mpr_in_sphere(real3 from_center_mm, real radius_mm) {
  return dot(from_center_mm, from_center_mm) <= radius_mm * radius_mm;
}

// What of the needle a pixel shows: 0 nothing, 1 metal, 2 lumen. The needle is the finite cylinder tip −
// t·direction, t in [0, length]. With a slab the pixel stands for the segment p + y·normal, |y| ≤ slab_half_mm, and
// shows metal when any point of it lies in the solid cylinder: y is first limited to where the segment is between
// the two flat ends, then the distance to the axis, a convex quadratic of y, is minimised there. slab_half_mm = 0
// is the point test. normal_across = normal − along·direction, along = normal·direction.
SHARED int mpr_needle_part(real3 from_tip_mm, real3 direction, real3 normal_across, real normal_along,
                           real length_mm, real radius_mm, real inner_radius_mm, real slab_half_mm) {
  real back_mm = -dot(from_tip_mm, direction);  // from the tip towards the hub; at y: back_mm − y·normal_along
  real3 across_mm = from_tip_mm + back_mm * direction;
  real low_mm = -slab_half_mm;
  real high_mm = slab_half_mm;
  bool parallel = abs(normal_along) <= kMprParallel;
  real slope = parallel ? real(1.0) : normal_along;
  real y_tip_mm = back_mm / slope;
  real y_hub_mm = (back_mm - length_mm) / slope;
  low_mm = parallel ? low_mm : max(low_mm, min(y_tip_mm, y_hub_mm));
  high_mm = parallel ? high_mm : min(high_mm, max(y_tip_mm, y_hub_mm));
  bool axial = parallel ? (back_mm >= 0.0 && back_mm <= length_mm) : low_mm <= high_mm;
  // Seen end-on the distance does not depend on y.
  real curvature = dot(normal_across, normal_across);
  real y_mm = curvature > 1e-12 ? clamp(-dot(across_mm, normal_across) / curvature, low_mm, high_mm) : low_mm;
  real3 nearest_mm = across_mm + y_mm * normal_across;
  real distance_2 = dot(nearest_mm, nearest_mm);
  bool solid = axial && distance_2 <= radius_mm * radius_mm;
  bool lumen = !(slab_half_mm > 0.0) && distance_2 < inner_radius_mm * inner_radius_mm;
  return solid ? (lumen ? 2 : 1) : 0;
}

SHARED_END

#endif
