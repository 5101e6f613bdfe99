#include "shared/ultrasound_lattice.glsl.h"

// The class of a voxel, or of the lesion that stands at its place; air outside the volume.
uint class_at(ivec3 voxel, vec3 from_origin_mm) {
  ivec3 size = ivec3(tissue.size_x, tissue.size_y, tissue.size_z);
  bool inside = all(greaterThanEqual(voxel, ivec3(0))) && all(lessThan(voxel, size));
  uint found = texelFetch(voxels, inside ? voxel : ivec3(0), 0).x & 255u;
  found = inside ? found : kUsAir;
  for (int i = tissue.lesion_count - 1; i >= 0; --i) {
    vec3 off = from_origin_mm - tissue.lesion_sphere_mm[i].xyz;
    float radius = tissue.lesion_sphere_mm[i].w;
    float inner = tissue.lesion_rim[i].z;
    float part = dot(off, off) <= inner * inner ? tissue.lesion_amplitude[i].y : tissue.lesion_rim[i].y;
    found = dot(off, off) <= radius * radius ? uint(part) : found;
  }
  return found;
}

// How much speckle comes from a place: lesions before the volume, nothing outside it. For shaders that have
// `voxels` (class + 256 · level of the echo) and a block `tissue`.
float speckle_amplitude(vec3 index, vec3 from_origin_mm) {
  bool inside = index.x >= 0.0 && index.y >= 0.0 && index.z >= 0.0 && index.x < float(tissue.size_x) &&
                index.y < float(tissue.size_y) && index.z < float(tissue.size_z);
  uint at = texelFetch(voxels, inside ? ivec3(index) : ivec3(0), 0).x;
  float offset = exp(float(int(at >> 8u) - tissue.no_offset) * tissue.log_of_a_step);
  float amplitude = inside ? tissue.amplitude[at & 255u].x * offset : 0.0;
  // Backwards, so that the first lesion that contains the point is the last to write.
  for (int i = tissue.lesion_count - 1; i >= 0; --i) {
    vec3 off = from_origin_mm - tissue.lesion_sphere_mm[i].xyz;
    float radius = tissue.lesion_sphere_mm[i].w;
    float inner = tissue.lesion_rim[i].z;
    bool is_inside = dot(off, off) <= inner * inner;
    float part = is_inside ? tissue.lesion_amplitude[i].x : tissue.lesion_rim[i].x;
    float log_sd = tissue.lesion_amplitude[i].z;
    if (is_inside && log_sd > 0.0)
      part *= exp(us_texture_log(uint(tissue.lesion_rim[i].w), tissue.lesion_amplitude[i].w, log_sd, off.x, off.y,
                                 off.z));
    float of_margin = (radius - length(off)) * tissue.lesion_margin[i].y;
    if (tissue.lesion_margin[i].y > 0.0 && of_margin < 1.0)
      part = us_margin_amplitude(part, tissue.lesion_margin[i].x, max(of_margin, 0.0));
    amplitude = dot(off, off) <= radius * radius ? part : amplitude;
  }
  return amplitude;
}
