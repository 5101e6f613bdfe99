// Complex noise of the lattice, times what the tissue gives back, on lines between and beside the beams. A work
// group is at one depth, so that what holds there is read once.
#include "shared/ultrasound_lattice.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usampler2DArray voxels;  // one layer a slice
layout(std140, binding = 0) uniform Parameters { UsLatticeParameters parameters; };
layout(std140, binding = 1) uniform Tissue { UsTissue tissue; };
layout(std430, binding = 2) readonly buffer Depths { UsLatticeDepth depths[]; };
layout(std430, binding = 3) writeonly buffer Noise { vec2 noise[]; };  // a row a sample
#include "ultrasound/ultrasound_tissue.glsl"
#ifdef ULTRASOUND_MOVED
layout(std140, binding = 3) uniform Motion { UsMotion motion; };
layout(std430, binding = 0) readonly buffer Paths { vec4 paths[]; };  // a line
#include "ultrasound/ultrasound_paths.glsl"
#endif

void main() {
  int line = int(gl_GlobalInvocationID.x);
  int k = int(gl_WorkGroupID.y);
  UsLatticeDepth depth = depths[k];
  float depth_mm = (float(k) + 0.5) * parameters.sample_mm;
  float beam = float(line - parameters.lines_before) * (1.0 / float(kUsLinesPerBeam));
  float off = parameters.first_beam + beam * parameters.beam_step;
  // Across and below the face's centre.
  vec2 at_mm = parameters.curved != 0 ? (parameters.radius_mm + depth_mm) * vec2(sin(off), cos(off)) -
                                            vec2(0.0, parameters.radius_mm)
                                      : vec2(off, depth_mm);
  vec3 from_origin_mm = at_mm.x * parameters.lateral.xyz + at_mm.y * parameters.axial.xyz;
  vec3 index = parameters.index.xyz + at_mm.x * parameters.index_lateral.xyz + at_mm.y * parameters.index_axial.xyz;
#ifdef ULTRASOUND_MOVED
  vec3 back_mm = back_at(min(line, parameters.lines - 1), depth_mm);
  from_origin_mm += back_mm;
  index += voxels_of(back_mm);
#endif
  vec3 cell = depth.part.xyz + from_origin_mm * depth.part.w;
  vec3 low = floor(cell);
  vec3 part = cell - low;
  ivec3 at = ivec3(depth.cell_x, depth.cell_y, depth.cell_z) + ivec3(low);
  vec4 value = us_lattice_noise(us_lattice_seed(depth.key, at.x, at.y, at.z), part.x, part.y, part.z);
  float level = speckle_amplitude(index, from_origin_mm) * depth.gain / value.z;
  if (line < parameters.lines) noise[k * parameters.lines + line] = level * value.xy;
}
