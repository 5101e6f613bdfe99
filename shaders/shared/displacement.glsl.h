// Where tissue is: x = X + u(X), with X at rest. One u for pictures, touch and visibility. A shader declares
// `uniform … { Displacement displacement; };` with displacement_source.glsl.h before it includes this, so that no
// function copies 16 sources; in C++ they are handed on.
#ifndef SELDINGER_SHADERS_SHARED_DISPLACEMENT
#define SELDINGER_SHADERS_SHARED_DISPLACEMENT

#include "displacement_source.glsl.h"  // beside this file: the one path that glslang and g++ both resolve

#ifdef __cplusplus
#include <glm/geometric.hpp>
#define OF_DISPLACEMENT const Displacement &displacement,
#define THE_DISPLACEMENT displacement,
namespace seldinger::shaders {
using glm::cross;
}
#else
#define OF_DISPLACEMENT
#define THE_DISPLACEMENT
#endif

SHARED_BEGIN

// u at a place at rest, mm.
SHARED real3 displacement_at(OF_DISPLACEMENT real3 rest_mm) {
  real3 moved_mm = real3(0.0);
  int i = 0;
  for (; i < displacement.contact_end; ++i) moved_mm += displacement_contact(displacement.source[i], rest_mm);
  for (; i < displacement.tip_end; ++i) moved_mm += displacement_tip(displacement.source[i], rest_mm);
  for (; i < displacement.shaft_end; ++i) moved_mm += displacement_shaft(displacement.source[i], rest_mm);
  for (; i < displacement.organ_end; ++i) moved_mm += displacement_organ(displacement.source[i], rest_mm);
  for (; i < displacement.vein_end; ++i) moved_mm += displacement_vein(displacement.source[i], rest_mm);
  for (; i < displacement.breath_end; ++i) moved_mm += displacement_breath(displacement.source[i], rest_mm);
  return moved_mm;
}

// ∂x/∂X, by columns, from differences: half of this apart to each side.
SHARED_CONSTANT real kDisplacementStepMm = 0.05;

struct Stretching {
  real3 by_x, by_y, by_z;
};
// One-sided where `here_mm` = u(rest_mm) is known already: three sums instead of six.
SHARED Stretching stretching_at(OF_DISPLACEMENT real3 rest_mm, real3 here_mm) {
  real per_step = real(1.0) / kDisplacementStepMm;
  Stretching s;
  s.by_x = (displacement_at(THE_DISPLACEMENT rest_mm + real3(kDisplacementStepMm, 0.0, 0.0)) - here_mm) * per_step;
  s.by_y = (displacement_at(THE_DISPLACEMENT rest_mm + real3(0.0, kDisplacementStepMm, 0.0)) - here_mm) * per_step;
  s.by_z = (displacement_at(THE_DISPLACEMENT rest_mm + real3(0.0, 0.0, kDisplacementStepMm)) - here_mm) * per_step;
  s.by_x.x += 1.0;
  s.by_y.y += 1.0;
  s.by_z.z += 1.0;
  return s;
}

SHARED real volume_ratio(Stretching s) {
  return dot(s.by_x, cross(s.by_y, s.by_z));
}

// X of the tissue that is at x: first X ← x − u(X), then Newton's steps (Cramer's rule), no longer than the miss
// asks for twice over: near a rim, where u bends sharply, a full step would overshoot.
SHARED real3 rest_of(OF_DISPLACEMENT real3 at_mm, int fixed_point_steps, int newton_steps) {
  real3 rest_mm = at_mm;
  for (int i = 0; i < fixed_point_steps; ++i) rest_mm = at_mm - displacement_at(THE_DISPLACEMENT rest_mm);
  for (int i = 0; i < newton_steps; ++i) {
    real3 here_mm = displacement_at(THE_DISPLACEMENT rest_mm);
    real3 miss_mm = at_mm - here_mm - rest_mm;
    Stretching s = stretching_at(THE_DISPLACEMENT rest_mm, here_mm);
    // Where tissue is all but folded the step is bounded below anyhow.
    real per_volume = real(1.0) / max(volume_ratio(s), real(0.05));
    real3 step_mm = per_volume * real3(dot(miss_mm, cross(s.by_y, s.by_z)), dot(miss_mm, cross(s.by_z, s.by_x)),
                                       dot(miss_mm, cross(s.by_x, s.by_y)));
    real most_2 = real(4.0) * dot(miss_mm, miss_mm);
    real length_2 = dot(step_mm, step_mm);
    if (length_2 > most_2) step_mm *= sqrt(most_2 / length_2);
    rest_mm += step_mm;
  }
  return rest_mm;
}

SHARED_END

#endif
