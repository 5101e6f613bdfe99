// Scatterers of a lattice in tissue coordinates laid into the beams that see them. One invocation goes along one
// row of cubes of a tile. Sums are whole numbers, so that the order of adding says nothing.
#include "shared/ultrasound.glsl.h"
#include "shared/ultrasound_cube.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usampler2DArray voxels;  // one layer a slice
layout(std140, binding = 0) uniform Parameters { UsScatterParameters parameters; };
layout(std140, binding = 1) uniform Tissue { UsTissue tissue; };
layout(std140, binding = 2) uniform Phases { vec4 phases[kUsPhases]; };
layout(std430, binding = 2) readonly buffer Tiles { UsTile tiles[]; };
layout(std430, binding = 3) buffer Sums { int sums[]; };
#ifdef ULTRASOUND_MOVED
layout(std140, binding = 3) uniform Motion { UsMotion motion; };
layout(std430, binding = 4) readonly buffer Slab { vec4 slab_mm[]; };  // a column's layers one after the other
#endif
#include "ultrasound/ultrasound_tissue.glsl"

float amplitude_at(UsTile tile, vec3 at_mm, uint seed) {
  uint bits = us_stray_bits(seed);
  vec3 stray = vec3(us_stray(bits), us_stray(bits >> 10u), us_stray(bits >> 20u));
  return speckle_amplitude(
      tile.index.xyz + at_mm.x * tile.index_x.xyz + at_mm.y * tile.index_y.xyz + at_mm.z * tile.index_z.xyz +
          (tissue.strays != 0 ? stray : vec3(0.0)),
      tile.origin_mm.xyz + at_mm.x * tile.axis_x.xyz + at_mm.y * tile.axis_y.xyz + at_mm.z * tile.axis_z.xyz);
}

// us_beam_weight of a sample's middle, in the table's steps. Worked out anew: on llvmpipe reading it costs more.
vec4 weight_at(UsTile tile, float depth_mm) {
  float lateral_mm = us_lateral_fwhm_mm(max(depth_mm, 0.01), parameters.wavelength_mm, parameters.f_number,
                                        parameters.aperture_mm, parameters.focus_mm);
  float elevation_mm = us_elevation_fwhm_mm(max(depth_mm, 0.01), parameters.wavelength_mm, parameters.height_mm,
                                            parameters.elevation_focus_mm);
  float spacing_mm = parameters.beam_step * (parameters.curved != 0 ? parameters.radius_mm + depth_mm : 1.0);
  vec4 weight = us_beam_weight(lateral_mm / kUsFwhmPerSigma, elevation_mm / kUsFwhmPerSigma, spacing_mm,
                               tile.outer_mm.w, kUsReachSigmas);
  return weight * vec4(kUsTablePerQ, 1.0, kUsTablePerQ, parameters.unit);
}

#ifdef ULTRASOUND_MOVED
// How far the tissue of a row has moved at a layer, along the tile's axes: of the slab's four columns around the row's
// middle.
vec3 moved_at(UsTile tile, vec2 column, int layer) {
  ivec2 cell = clamp(ivec2(column), ivec2(0), ivec2(motion.columns, motion.rows) - 2);
  vec2 part = clamp(column - vec2(cell), 0.0, 1.0);
  int low = (cell.y * motion.columns + cell.x) * motion.layers + layer;
  int high = low + motion.columns * motion.layers;
  vec3 u = mix(mix(slab_mm[low].xyz, slab_mm[low + motion.layers].xyz, part.x),
               mix(slab_mm[high].xyz, slab_mm[high + motion.layers].xyz, part.x), part.y);
  return vec3(dot(u, tile.axis_x.xyz), dot(u, tile.axis_y.xyz), dot(u, tile.axis_z.xyz));
}
#endif

void main() {
  UsTile tile = tiles[gl_WorkGroupID.y];
  int row = int(gl_GlobalInvocationID.x);
  int outer = row / tile.rows_middle;
  int middle = row - outer * tile.rows_middle;
  vec3 to_row = float(outer) * tile.outer_mm.xyz + float(middle) * tile.middle_mm.xyz;
  uint row_seed = tile.seed + uint(outer) * tile.step_outer + uint(middle) * tile.step_middle;

  // Rows are cut by the box: |centre of the cube| ≤ half, on each of its three axes.
  float low = -1e4;
  float high = outer < tile.rows_outer ? 1e4 : -2e4;
  vec3 fixed_mm = tile.from_box_mm.xyz + to_row;
  for (int a = 0; a < 3; ++a) {
    float slope = tile.inner_mm[a];
    slope = abs(slope) < 1e-6 ? 1e-6 : slope;
    float one = (-tile.half_box_mm[a] - fixed_mm[a]) / slope;
    float other = (tile.half_box_mm[a] - fixed_mm[a]) / slope;
    low = max(low, min(one, other));
    high = min(high, max(one, other));
  }
  int last = int(floor(high));
  vec3 row_mm = tile.corner_mm.xyz + to_row;
#ifdef ULTRASOUND_MOVED
  vec2 column = tile.column.xy + vec2(float(outer) * tile.column.z, float(middle) * tile.column.w);
  int held = -1;  // the layer below, of which:
  vec3 below_mm = vec3(0.0);
  vec3 above_mm = vec3(0.0);
#endif
  for (int cube = int(ceil(low)); cube <= last; ++cube) {
    uint seed = row_seed + uint(cube) * tile.step_inner;
    uint bits = us_lattice_bits(seed);
    vec3 at_mm = row_mm + float(cube) * tile.inner_mm.xyz + us_cube_u(bits) * tile.edge_x_mm.xyz +
                 us_cube_v(bits) * tile.edge_y_mm.xyz + us_cube_w(bits) * tile.edge_z_mm.xyz;
    vec3 rest_mm = at_mm;
#ifdef ULTRASOUND_MOVED
    float layer = clamp((at_mm.y - motion.low_mm) * motion.layers_per_mm, 0.0, float(motion.layers - 1));
    int below = min(int(layer), motion.layers - 2);
    if (below != held) {
      below_mm = moved_at(tile, column, below);
      above_mm = moved_at(tile, column, below + 1);
      held = below;
    }
    at_mm += below_mm + (layer - float(below)) * (above_mm - below_mm);
#endif
    float from_center = at_mm.z + parameters.radius_mm;
    bool curved = parameters.curved != 0;
    float depth_mm = curved ? sqrt(at_mm.x * at_mm.x + from_center * from_center) - parameters.radius_mm : at_mm.z;
    float beam = tile.edge_x_mm.w +
                 (curved ? us_narrow_angle(at_mm.x / from_center) : at_mm.x) / parameters.beam_step;
    int fine = clamp(int(depth_mm * parameters.fine_per_mm), tile.first_fine, tile.end_fine - 1);
    vec4 at = weight_at(tile, (float(fine / parameters.fine) + 0.5) * parameters.sample_mm);
    float q_y = at_mm.y * at_mm.y * at.z;
    bool inside = depth_mm >= tile.from_box_mm.w && depth_mm < tile.half_box_mm.w &&
                  abs(at_mm.y) < tile.corner_mm.w && beam >= tile.edge_y_mm.w && beam < tile.edge_z_mm.w &&
                  q_y < 512.0;
    float amplitude = inside ? amplitude_at(tile, rest_mm, seed) * at.w : 0.0;
    uint turned = us_lattice_turned(bits) * uint(kUsPhases / 2);
    uint phase = (uint(depth_mm * parameters.phases_per_mm) + turned) & uint(kUsPhases - 1);
    vec2 value = amplitude * phases[phase].xy;
    int from = max(0, int(ceil(beam - at.y)));
    int to = amplitude == 0.0 ? -1 : min(parameters.beams - 1, int(floor(beam + at.y)));
    for (int b = from; b <= to; ++b) {
      float off = float(b) - beam;
      // The table's entry, worked out: on llvmpipe quicker than looking it up.
      float weight = exp(-(floor(off * off * at.x + q_y) + 0.5) * (1.0 / kUsTablePerQ));
      int place = (b * parameters.fine_samples + fine) * 2;
      atomicAdd(sums[place], int(roundEven(value.x * weight)));
      atomicAdd(sums[place + 1], int(roundEven(value.y * weight)));
    }
  }
}
