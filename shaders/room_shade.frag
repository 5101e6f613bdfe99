// One key light with shadows, light from all round (more from above than from the floor), rough surfaces after
// Trowbridge and Reitz (J. Opt. Soc. Am. 65, 1975) with Schlick's approximations (1994).
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/room.glsl.h"

layout(std140, binding = 0) uniform View { RoomView view; };
layout(std140, binding = 1) uniform Thing { RoomThing thing; };
layout(binding = 0) uniform sampler2DShadow still_map;
layout(binding = 1) uniform sampler2DShadow tools_map;

in vec3 place_mm;
in vec3 normal;
in vec4 paint;
layout(location = 0) out vec4 colour_out;

const vec3 kKeyLight = vec3(1.75, 1.70, 1.62);
const vec3 kFromAbove = vec3(0.52, 0.55, 0.58);
const vec3 kFromBelow = vec3(0.24, 0.22, 0.20);

// Four looks, each between four texels.
float lit(sampler2DShadow map, vec3 at, float texel) {
  float sum = texture(map, at + vec3(-0.75, -0.25, 0.0) * texel);
  sum += texture(map, at + vec3(0.25, -0.75, 0.0) * texel);
  sum += texture(map, at + vec3(0.75, 0.25, 0.0) * texel);
  sum += texture(map, at + vec3(-0.25, 0.75, 0.0) * texel);
  return 0.25 * sum;
}

void main() {
  vec3 n = normalize(normal);
  if (!gl_FrontFacing) n = -n;
  vec3 to_eye = normalize(view.eye_mm.xyz - place_mm);
  vec3 base = thing.colour.rgb * paint.rgb;
  float by_key = dot(n, view.key.xyz);
  float shadow = 1.0;
  if (thing.surface.z > 0.5 && by_key > -0.4) {
    vec3 still = (view.still_from_lps * vec4(place_mm + n * view.shadow.x, 1.0)).xyz;
    shadow = lit(still_map, still, view.shadow.z);
    vec3 tools = (view.tools_from_lps * vec4(place_mm + n * view.shadow.y, 1.0)).xyz;
    if (all(greaterThan(tools.xy, vec2(0.0))) && all(lessThan(tools.xy, vec2(1.0))))
      shadow = min(shadow, lit(tools_map, tools, view.shadow.w));
  }
  vec3 round = thing.depth.rgb;
  vec3 diffuse = max(vec3(0.0), (vec3(by_key) + round) / (1.0 + round));
  float from_above = 0.5 + 0.5 * dot(n, view.up.xyz);
  vec3 ambient = paint.a * mix(kFromBelow, kFromAbove, from_above);
  float metal = thing.surface.y;
  vec3 colour = base * (1.0 - metal) * (ambient + shadow * kKeyLight * diffuse);
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
  // Bright parts are bent, not cut off; the square root stands for a screen's gamma.
  colour = colour * (1.0 + 0.15 * colour) / (1.0 + 0.55 * colour);
  colour_out = vec4(sqrt(clamp(colour, 0.0, 1.0)), thing.colour.a);
}
