// What is far from hands, floor and walls: light from all round and the key light, without shadows and shine. Most of
// a picture is that, and software GL pays for every look into a map.
#version 430 core
#extension GL_GOOGLE_include_directive : enable
#include "shared/room.glsl.h"

layout(std140, binding = 0) uniform View { RoomView view; };
layout(std140, binding = 1) uniform Thing { RoomThing thing; };

in vec3 place_mm;
in vec3 normal;
in vec4 paint;
layout(location = 0) out vec4 colour_out;

#include "room/room_light.glsl"

void main() {
  vec3 n = normalize(normal);
  vec3 base = thing.colour.rgb * paint.rgb;
  vec3 light = room_light_around(n, paint.a) + paint.a * kKeyLight * max(0.0, dot(n, view.key.xyz));
  colour_out = vec4(room_screen(base * light), thing.colour.a);
}
