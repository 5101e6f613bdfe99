// The patient's skin where tissue moves: each vertex lies at rest, is displaced as every picture's tissue is, and its
// normal turns with two neighbours beside it.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/displacement_source.glsl.h"
#include "shared/room.glsl.h"

layout(location = 0) in vec3 place_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 paint_in;
layout(std140, binding = 0) uniform View { RoomView view; };
layout(std140, binding = 1) uniform Thing { RoomThing thing; };
layout(std140, binding = 2) uniform Sources { Displacement displacement; };

#include "shared/displacement.glsl.h"

out vec3 place_mm;
out vec3 normal;
out vec4 paint;
out float gl_ClipDistance[1];

const float kBesideMm = 0.5;

void main() {
  vec3 rest_mm = (thing.lps_from_mesh * vec4(place_in, 1.0)).xyz;
  place_mm = rest_mm + displacement_at(rest_mm);
  vec3 up = abs(normal_in.x) < 0.7 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0);
  vec3 u = kBesideMm * normalize(cross(up, normal_in));
  vec3 v = kBesideMm * normalize(cross(normal_in, u));
  normal = cross(rest_mm + u + displacement_at(rest_mm + u) - place_mm,
                 rest_mm + v + displacement_at(rest_mm + v) - place_mm);
  paint = paint_in;
  gl_ClipDistance[0] = thing.surface.w > 0.5 ? view.cut.w - dot(view.cut.xyz, place_mm) : 1.0;
  gl_Position = view.clip_from_lps * vec4(place_mm, 1.0);
}
