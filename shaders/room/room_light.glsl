// The room's light, and how it comes to a screen. GLSL alone: a shader declares `view` before it includes this.
#ifndef SELDINGER_SHADERS_SHARED_ROOM_LIGHT
#define SELDINGER_SHADERS_SHARED_ROOM_LIGHT

const vec3 kKeyLight = vec3(1.75, 1.70, 1.62);
const vec3 kFromAbove = vec3(0.52, 0.55, 0.58);
const vec3 kFromBelow = vec3(0.24, 0.22, 0.20);

vec3 room_light_around(vec3 n, float share) {
  return share * mix(kFromBelow, kFromAbove, 0.5 + 0.5 * dot(n, view.up.xyz));
}

// Bright parts are bent, not cut off; the square root stands for a screen's gamma.
vec3 room_screen(vec3 light) {
  return sqrt(clamp(light * (1.0 + 0.15 * light) / (1.0 + 0.55 * light), 0.0, 1.0));
}

#endif
