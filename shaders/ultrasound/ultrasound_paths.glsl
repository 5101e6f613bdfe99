// Where the tissue along a beam was at rest (BeamPath, sim/imaging/ultrasound/motion.h). For shaders that have a list
// `paths` and a block `motion`.

struct PathPlace {
  int low;  // of the list: three vec4 of a node, then those of the next
  float part;
};
PathPlace path_place(int path, float depth_mm) {
  float nodes = depth_mm * motion.nodes_per_mm;
  int node = int(clamp(nodes, 0.0, float(motion.path_nodes - 2)));
  return PathPlace(motion.first_path + 3 * (path * motion.path_nodes + node), nodes - float(node));
}
vec3 path_value(PathPlace at, int which) {
  vec3 low = paths[at.low + which].xyz;
  return low + at.part * (paths[at.low + 3 + which].xyz - low);
}
// X − x.
vec3 back_at(int path, float depth_mm) {
  return path_value(path_place(path, depth_mm), 0);
}
// How X goes on with depth.
vec3 way_along(PathPlace at, vec3 direction) {
  return direction + motion.nodes_per_mm * (paths[at.low + 3].xyz - paths[at.low].xyz);
}
vec3 voxels_of(vec3 mm) {
  return mm.x * motion.index_x.xyz + mm.y * motion.index_y.xyz + mm.z * motion.index_z.xyz;
}
