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

// How far the cavity's wall is from its axis, between nodes in straight lines, mm. turn: 0 to the left (x), 1 to
// the back (y), 2, 3, 4 to the left again; height: in steps, within the table.
SHARED real cavity_node_mm(OF_DISPLACEMENT int height, int way) {
  int at = height * kCavityWays + way;
  return real(displacement.wall_mm[at / 4][at % 4]);
}
SHARED real cavity_radius_mm(OF_DISPLACEMENT real turn, real height) {
  real ways = turn * real(kCavityWays / 4);
  int way = clamp(int(ways), 0, kCavityWays - 1);
  int next = way + 1 < kCavityWays ? way + 1 : 0;
  int low = clamp(int(height), 0, kCavityHeights - 2);
  real on = ways - real(way);
  real up = height - real(low);
  real below_mm = (real(1.0) - on) * cavity_node_mm(THE_DISPLACEMENT low, way) +
                  on * cavity_node_mm(THE_DISPLACEMENT low, next);
  real above_mm = (real(1.0) - on) * cavity_node_mm(THE_DISPLACEMENT low + 1, way) +
                  on * cavity_node_mm(THE_DISPLACEMENT low + 1, next);
  return (real(1.0) - up) * below_mm + up * above_mm;
}

// How near to the wall organs come to rest: pleura and peritoneum are thinner, but a picture's grid of 2 to 3 mm
// has to see it. In a breath of more than 16 mm within half of its way: steeper, no few steps would find the way
// back.
SHARED_CONSTANT real kSlipMm = 8.0;
SHARED_CONSTANT real kSlipOfWay = 0.5;

// Breathing by the law under which organs slide. As displacement_breath has it, but for what lies within the wall
// of chest and belly: that goes up and down along the wall, all of it but the last few mm, and the wall does not. A
// point keeps its direction from the axis and its share of the way to the wall. So nothing crosses the wall, and as
// height alone changes along such a way, nothing can fold however sharp the slip is. Beside the spine, behind the
// peritoneum, there is no such cavity below the dome: there organs move the less the farther back, as before.
SHARED real3 displacement_sliding(OF_DISPLACEMENT DisplacementSource source, real3 p_mm) {
  real side = (p_mm.x - real(source.place_mm.x)) / real(source.size_mm.x);
  real front = (real(source.place_mm.y) - p_mm.y) / real(source.size_mm.y);
  real up_mm = p_mm.z - real(source.place_mm.z);
  real level = breath_level(source, up_mm);
  real beside = real(0.35) * (real(1.0) - eased(up_mm / 120.0));
  real free = eased((abs(side) - beside) / 0.35);
  real loose = level * (free + (real(1.0) - free) * before_the_spine(side, front));

  real x_mm = p_mm.x - real(source.along.x);
  real y_mm = p_mm.y - real(source.along.y);
  real around_mm = max(abs(x_mm) + abs(y_mm), real(1e-6));
  real turn = y_mm < 0.0 ? real(3.0) + x_mm / around_mm : real(1.0) - x_mm / around_mm;
  real per_step = real(1.0) / real(source.along.w);
  real highest = real(kCavityHeights - 1);
  real height = (p_mm.z - real(source.along.z)) * per_step;
  real wall_mm = cavity_radius_mm(THE_DISPLACEMENT turn, clamp(height, real(0.0), highest));
  real from_axis_mm = sqrt(x_mm * x_mm + y_mm * y_mm);
  real slip_mm = max(kSlipMm, kSlipOfWay * abs(real(source.amount.z)));
  real down_mm = real(source.amount.z) * loose * eased((wall_mm - from_axis_mm) / slip_mm);
  real wider =
      cavity_radius_mm(THE_DISPLACEMENT turn, clamp(height - down_mm * per_step, real(0.0), highest)) / wall_mm -
      1.0;
  real inside = real(1.0) - eased((from_axis_mm / wall_mm - 0.65) / 0.35);
  return real3(wider * x_mm - real(source.amount.x) * loose * inside,
               wider * y_mm - real(source.amount.y) * level * eased(front), -down_mm);
}

// u at a place at rest, mm.
SHARED real3 displacement_at(OF_DISPLACEMENT real3 rest_mm) {
  real3 moved_mm = real3(0.0);
  int i = 0;
  for (; i < displacement.contact_end; ++i) moved_mm += displacement_contact(displacement.source[i], rest_mm);
  for (; i < displacement.tip_end; ++i) moved_mm += displacement_tip(displacement.source[i], rest_mm);
  for (; i < displacement.shaft_end; ++i) moved_mm += displacement_shaft(displacement.source[i], rest_mm);
  for (; i < displacement.organ_end; ++i) moved_mm += displacement_organ(displacement.source[i], rest_mm);
  for (; i < displacement.vein_end; ++i) moved_mm += displacement_vein(displacement.source[i], rest_mm);
  for (; i < displacement.breath_end; ++i) {
    if (displacement.source[i].along.w > 0.0)
      moved_mm += displacement_sliding(THE_DISPLACEMENT displacement.source[i], rest_mm);
    else
      moved_mm += displacement_breath(displacement.source[i], rest_mm);
  }
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
