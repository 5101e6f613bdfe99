// How a thing near the hands is lit: one key light with shadows, light from all round (more from above than from the
// floor), rough surfaces after Trowbridge and Reitz (J. Opt. Soc. Am. 65, 1975) with Schlick's approximations (1994).
// GLSL alone; a shader defines ROOM_LOOKS, 1 or 4, each between four texels, before it includes this.
#ifndef SELDINGER_SHADERS_SHARED_ROOM_SHADE
#define SELDINGER_SHADERS_SHARED_ROOM_SHADE

layout(std140, binding = 0) uniform View { RoomView view; };
layout(std140, binding = 1) uniform Thing { RoomThing thing; };
layout(binding = 0) uniform sampler2DShadow still_map;
layout(binding = 1) uniform sampler2DShadow tools_map;

in vec3 place_mm;
in vec3 normal;
in vec4 paint;
layout(location = 0) out vec4 colour_out;

#include "room/room_light.glsl"

// How much of the key light gets by what casts into a map, 0 to 1. Looks are written out: software GL pays more for
// a loop than for the looks in it.
float lit(sampler2DShadow map, vec3 at, float texel) {
  at.z = min(at.z, 1.0);  // beyond the map's far end nothing has cast; GL does not hold float depths to 1
#if ROOM_LOOKS == 1
  return texture(map, at);
#else
  return 0.25 * (texture(map, at + vec3(-0.75, -0.25, 0.0) * texel) + texture(map, at + vec3(0.25, -0.75, 0.0) * texel) +
                 texture(map, at + vec3(0.75, 0.25, 0.0) * texel) + texture(map, at + vec3(-0.25, 0.75, 0.0) * texel));
#endif
}

void main() {
  vec3 n = normalize(normal);
  if (!gl_FrontFacing) n = -n;
  vec3 to_eye = normalize(view.eye_mm.xyz - place_mm);
  vec3 base = thing.colour.rgb * paint.rgb;
  float by_key = dot(n, view.key.xyz);
  vec3 still = (view.still_from_lps * vec4(place_mm + n * view.shadow.x, 1.0)).xyz;
  vec3 tools = (view.tools_from_lps * vec4(place_mm + n * view.shadow.y, 1.0)).xyz;
  // Where light only grazes, a coarse map's texels would show as combs; little light is lost or won there.
  float grazes = clamp(4.0 * by_key + 0.2, 0.0, 1.0);
  // Outside a map its border answers: lit.
  float shadow = min(mix(1.0, lit(still_map, still, view.shadow.z), grazes), lit(tools_map, tools, view.shadow.w));
  vec3 round = thing.depth.rgb;
  vec3 diffuse = max(vec3(0.0), (vec3(by_key) + round) / (1.0 + round));
  float metal = thing.surface.y;
  vec3 colour = base * (1.0 - metal) * (room_light_around(n, paint.a) + shadow * kKeyLight * diffuse);
  vec3 mirror = mix(vec3(0.04), base, metal);
  vec3 half_way = normalize(to_eye + view.key.xyz);
  float nh = max(dot(n, half_way), 0.0);
  float nv = max(dot(n, to_eye), 0.05);
  float nl = max(by_key, 0.0);
  float a = thing.surface.x * thing.surface.x;
  float a_2 = a * a;
  float d = nh * nh * (a_2 - 1.0) + 1.0;
  float k = 0.5 * a;
  float shine = a_2 / (4.0 * d * d * (nl * (1.0 - k) + k) * (nv * (1.0 - k) + k));
  float edge = 1.0 - nv;
  float edge_2 = edge * edge;
  vec3 fresnel = mirror + (1.0 - mirror) * (1.0 - thing.surface.x) * edge_2 * edge_2 * edge;
  // What a rough mirror sees of the room.
  float sees_above = 0.5 + 0.5 * dot(reflect(-to_eye, n), view.up.xyz);
  colour += shadow * kKeyLight * nl * mirror * min(shine, 24.0);
  colour += paint.a * fresnel * mix(kFromBelow, 1.5 * kFromAbove, sees_above * sees_above);
  colour_out = vec4(room_screen(colour), thing.colour.a);
}

#endif
