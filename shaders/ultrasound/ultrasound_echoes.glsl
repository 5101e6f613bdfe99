// Echoes of the interfaces that ultrasound_lines.comp listed, of the needle, and of the lens of a face in air. An
// invocation is a place in a beam's list; neighbours in a work group are neighbouring beams, which have lists
// alike.
#include "shared/ultrasound_line.glsl.h"
#include "shared/ultrasound_passes.glsl.h"

layout(local_size_x = 64) in;

layout(binding = 0) uniform usampler2DArray voxels;  // one layer a slice
layout(std140, binding = 0) uniform Parameters { UsLineParameters parameters; };
layout(std140, binding = 1) uniform Tissue { UsTissue tissue; };
layout(std430, binding = 0) readonly buffer Neighbours { vec4 neighbours[]; };  // xyz: voxels off; w: weight
layout(std430, binding = 1) readonly buffer EchoCountsBefore { ivec2 counts[]; };
layout(std430, binding = 2) readonly buffer Beams { UsBeam beams[]; };
layout(std430, binding = 3) readonly buffer Loss { float loss_db[]; };
layout(std430, binding = 4) readonly buffer Shift { float shift_mm[]; };
layout(std430, binding = 5) readonly buffer Interfaces { ivec4 interfaces[]; };
layout(std430, binding = 6) writeonly buffer EchoCounts { int echo_counts[]; };
layout(std430, binding = 7) writeonly buffer Echoes { vec4 echoes[]; };
#include "ultrasound/ultrasound_tissue.glsl"
#ifdef ULTRASOUND_MOVED
layout(std140, binding = 3) uniform Motion { UsMotion motion; };
#define paths neighbours  // the paths come after them
#include "ultrasound/ultrasound_paths.glsl"
#endif

int sample_at(float depth_mm) {
  return int(clamp(depth_mm / parameters.sample_mm - 0.5, 0.0, float(parameters.samples - 1)));
}

void put(int beam, int place, float depth_mm, float amplitude, float parting_per_mm) {
  float turns = depth_mm * parameters.turns_per_mm;
  if (parameters.shifts != 0) {
    depth_mm += shift_mm[beam * parameters.samples + sample_at(depth_mm)];
    turns = depth_mm * parameters.turns_per_mm;
  }
  float angle = -6.283185307 * (turns - floor(turns));
  echoes[beam * kUsMostEchoes + place] = vec4(depth_mm, amplitude * cos(angle), amplitude * sin(angle), parting_per_mm);
}

// What lies so many samples down a beam, as it was at rest.
struct Meeting {
  dvec3 index;
  vec3 from_origin_mm;
  vec3 way;  // of the beam, through tissue at rest
#ifdef ULTRASOUND_MOVED
  PathPlace path;
#endif
};
Meeting meeting_at(int beam, UsBeam at, double k) {
  Meeting here;
  float depth_mm = float(k) * parameters.sample_mm;
  here.index = dvec3(at.index.xyz) + dvec3(at.index_rest.xyz) +
               k * (dvec3(at.index_along.xyz) + dvec3(at.index_along_rest.xyz));
  here.from_origin_mm = at.start_mm.xyz + depth_mm * at.direction.xyz;
  here.way = at.direction.xyz;
#ifdef ULTRASOUND_MOVED
  here.path = path_place(beam, depth_mm);
  vec3 back_mm = path_value(here.path, 0);
  here.index += dvec3(voxels_of(back_mm));
  here.from_origin_mm += back_mm;
  here.way = way_along(here.path, at.direction.xyz);
#endif
  return here;
}

vec3 offset_mm_of(vec4 neighbour) {
  return neighbour.x * parameters.mm_per_voxel[0].xyz + neighbour.y * parameters.mm_per_voxel[1].xyz +
         neighbour.z * parameters.mm_per_voxel[2].xyz;
}
// Weight of a neighbour, negative where it is more like what is before.
float side_of(Meeting here, vec4 neighbour, float before, float after) {
  uint there = class_at(ivec3(floor(here.index)) + ivec3(neighbour.xyz), here.from_origin_mm + offset_mm_of(neighbour));
  return (parameters.of_class[there].x > sqrt(before * after)) == (after > before) ? neighbour.w : -neighbour.w;
}
// Of the plane between the two, from which side each neighbour resembles more (line.cpp, plane_at); 0: not told.
vec3 normal_at(Meeting here, float before, float after) {
  vec3 normal = vec3(0.0);
  for (int i = 0; i < parameters.around; ++i)
    normal += side_of(here, neighbours[i], before, after) * offset_mm_of(neighbours[i]);
  float side_mm = length(normal);
  return side_mm > parameters.least_side_mm ? normal / side_mm : vec3(0.0);
}
float before_mrayl(ivec4 listed) {
  int before_class = listed.y & 255;
  return before_class == kUsGel ? kUsMatchedMrayl : parameters.of_class[before_class].x;
}

// From a place in a body to its end.
float reach_mm(Meeting from, vec3 way, vec3 way_voxels, uint inside) {
  float within = 0.0;
  float beyond = kUsMostReachMm;
  float at = kUsReachStepMm;
  while (at < kUsMostReachMm) {
    bool is_inside =
        class_at(ivec3(floor(from.index + dvec3(at * way_voxels))), from.from_origin_mm + at * way) == inside;
    within = is_inside ? at : within;
    beyond = is_inside ? beyond : at;
    at = is_inside ? at + max(kUsReachStepMm, kUsReachStepShare * at) : kUsMostReachMm;
  }
  for (int i = 0; i < kUsReachHalvings; ++i) {
    float middle = 0.5 * (within + beyond);
    bool is_inside =
        class_at(ivec3(floor(from.index + dvec3(middle * way_voxels))), from.from_origin_mm + middle * way) == inside;
    within = is_inside ? middle : within;
    beyond = is_inside ? beyond : middle;
  }
  return 0.5 * (within + beyond);
}

// The parting of rays behind a round body that the beam leaves here: the interface before is where it came in.
float parting_behind(int beam, int place, UsBeam at, ivec4 here, float cosine, float depth_mm) {
  uint inside = uint(here.y & 255);
  bool leaves = parameters.edges != 0 && place > 0 && (inside == kUsFluid || inside == kUsVessel) &&
                us_is_matched(parameters.of_class[here.y >> 8].x);
  ivec4 last = interfaces[beam * kUsMostInterfaces + max(place - 1, 0)];
  if (!leaves || uint(last.y >> 8) != inside) return 0.0;
  vec4 within = parameters.of_class[inside];
  vec4 beyond = parameters.of_class[here.y >> 8];
  float shift_inside = (within.z + within.w) / parameters.sample_mm;
  float shift_beyond = (beyond.z + beyond.w) / parameters.sample_mm;
  float width_mm = us_lateral_fwhm_mm(max(depth_mm, 1.0), parameters.wavelength_mm, parameters.f_number,
                                      parameters.aperture_mm, parameters.focus_mm);
  if (parameters.edges == kUsEdgesByOneSide)
    return us_parting_per_mm(shift_inside, shift_beyond, float(here.x - last.x) * parameters.sample_mm, cosine,
                             width_mm);
  if (last.x == 0) return 0.0;
  Meeting middle = meeting_at(beam, at, 0.5lf * double(last.x + here.x));
  vec3 elevation = vec3(parameters.elevation_x, parameters.elevation_y, parameters.elevation_z);
  vec3 across = normalize(cross(elevation, middle.way));
  mat3 voxels_per_mm = inverse(mat3(parameters.mm_per_voxel[0].xyz, parameters.mm_per_voxel[1].xyz,
                                    parameters.mm_per_voxel[2].xyz));
  float parting[2];
  for (int axis = 0; axis < 2; ++axis) {
    vec3 way = axis == 0 ? across : elevation;
    vec3 way_voxels = voxels_per_mm * way;
    float one_mm = reach_mm(middle, way, way_voxels, inside);
    float other_mm = reach_mm(middle, -way, -way_voxels, inside);
    parting[axis] = us_parting_by_width(shift_inside, shift_beyond, one_mm, other_mm, width_mm);
  }
  return us_stronger(parting[0], parting[1]);
}

void put_interface(int beam, int place, UsBeam at) {
  ivec4 here = interfaces[beam * kUsMostInterfaces + place];
  // What is before and after the interface, and what was lost on the way to it.
  int k = here.x;
  float before = before_mrayl(here);
  float after = parameters.of_class[here.y >> 8].x;
  float loss_to_db = intBitsToFloat(here.w);
  float reflection = us_reflection(before, after);
  float depth_mm = float(k) * parameters.sample_mm;
  float cosine = 1.0;
  Meeting meeting = meeting_at(beam, at, double(k));
  vec3 normal = vec3(0.0);
  if (k > 0) {
    normal = normal_at(meeting, before, after);
    bool told = normal != vec3(0.0);
    float along = dot(normal, meeting.way);
#ifdef ULTRASOUND_MOVED
    // As the beam meets it now.
    float facing = us_facing(along, dot(normal, path_value(meeting.path, 1)), dot(normal, path_value(meeting.path, 2)));
#else
    float facing = abs(along);
#endif
    cosine = told ? clamp(facing, 0.0, 1.0) : 1.0;
    // The plane's place is told by how many of the close ones resemble each.
    float sum = 0.0;
    float square = 0.0;
    for (int i = parameters.around; i < parameters.around + parameters.close; ++i) {
      vec4 one = neighbours[i];
      float way = dot(offset_mm_of(one), normal);
      sum += side_of(meeting, one, before, after);
      square += one.w * way * way;
    }
    // Placed between voxels, so that a slanted wall is a line, not a staircase; except where it is seen edge-on.
    if (told && square > 1e-9 && cosine > kUsLeastPlaceCosine) {
      vec3 to_center = vec3(floor(meeting.index) + 0.5lf - meeting.index);
      float off_mm = dot(offset_mm_of(vec4(to_center, 0.0)), normal) -
                     us_plane_off(sum, parameters.close_weight, square);
      depth_mm = max(0.0, depth_mm + clamp(off_mm / along, -parameters.most_shift_mm, parameters.most_shift_mm));
    }
  }
  // Its echo, and the repeats of a strong one.
  float face = reflection * us_interface_law(cosine) * us_amplitude(kUsInterfaceDb - loss_to_db);
  put(beam, here.z, depth_mm, face, parting_behind(beam, place, at, here, cosine, depth_mm));
  if (abs(reflection) < kUsRepeatsFrom) return;
  int room = float(k) * parameters.sample_mm > parameters.most_shift_mm ? kUsMostAgain : 1 + kUsLensLines;
  for (int i = 1; i < room; ++i) {
    // Gas repeats; right at the probe's face it rings in the lens. Places left over stay silent.
    bool rings = depth_mm <= 0.0;
    float again_mm = rings ? float(i) * kUsLensMm : float(i + 1) * depth_mm;
    float amplitude = rings ? us_lens_line(i) : i < kUsMostAgain ? face * us_repeat(i + 1, loss_to_db) : 0.0;
    put(beam, here.z + i, again_mm, again_mm < parameters.depth_mm ? amplitude : 0.0, 0.0);
  }
}

void main() {
  int beam = int(gl_GlobalInvocationID.x);
  int place = int(gl_WorkGroupID.y);
  if (beam >= parameters.beams) return;
  UsBeam at = beams[beam];
  ivec2 count = counts[beam];
  if (place < count.x) put_interface(beam, place, at);
  if (place < at.needle_echoes && at.contact != 0) {
    vec4 echo = at.needle_echo[place];
    float down_db = loss_db[beam * parameters.samples + sample_at(echo.z)];
    put(beam, count.y + place, echo.x, echo.y * us_amplitude(-down_db), 0.0);
  }
  if (at.contact == 0 && place < kUsLensLines) {
    float depth_mm = float(place + 1) * kUsLensMm;
    put(beam, place, depth_mm, depth_mm < parameters.depth_mm ? us_lens_line(place + 1) : 0.0, 0.0);
  }
  if (place == 0) echo_counts[beam] = at.contact != 0 ? count.y + at.needle_echoes : kUsLensLines;
}
