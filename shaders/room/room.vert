// A thing of the room, as it lies.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/room.glsl.h"

layout(location = 0) in vec3 place_in;
layout(location = 1) in vec3 normal_in;
layout(location = 2) in vec4 paint_in;
layout(std140, binding = 0) uniform View { RoomView view; };
layout(std140, binding = 1) uniform Thing { RoomThing thing; };

out vec3 place_mm;
out vec3 normal;
out vec4 paint;
out float gl_ClipDistance[1];

void main() {
  place_mm = (thing.lps_from_mesh * vec4(place_in, 1.0)).xyz;
  // Cofactors turn normals rightly where axes are stretched unequally.
  mat3 axes = mat3(thing.lps_from_mesh);
  normal = mat3(cross(axes[1], axes[2]), cross(axes[2], axes[0]), cross(axes[0], axes[1])) * normal_in;
  paint = paint_in;
  gl_ClipDistance[0] = thing.surface.w > 0.5 ? view.cut.w - dot(view.cut.xyz, place_mm) : 1.0;
  gl_Position = view.clip_from_lps * vec4(place_mm, 1.0);
}
