// Breathing: how far along its way the diaphragm is, tick by tick, and where in the trunk tissue follows it. Pure:
// the state is one plain value, chance comes from a seed, and only + − × ÷ √ and sim/base/exact_math are used.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "sim/case/case.h"

namespace seldinger::tissue {

using BreathSettings = cases::Breathing;
using BreathState = cases::BreathState;

struct BreathAsks {
  bool hold = false;   // as long as it is true
  bool cough = false;  // begins one
};

// One tick. The answer: 0 breathed out, about 1 breathed in; below 0 in a cough. Steady in time.
double advance(const BreathSettings& settings, double dt_s, const BreathAsks& asks, BreathState& state) noexcept;

bool holds(const BreathState& state) noexcept;  // the patient holds still

// From where the CT saw it, mm: to the right, to the front, downwards.
glm::dvec3 breath_amount_mm(const BreathSettings& settings, double level) noexcept;

// Where the trunk is, LPS: what of it moves how much is in shaders/shared/displacement_source.glsl.h.
struct BreathRegion {
  double middle_x_mm = 0.0, half_width_mm = 170.0;
  double back_y_mm = 110.0, depth_mm = 220.0;  // to the front
  double dome_z_mm = 0.0;                      // of the diaphragm: where it moves most
  double above_mm = 200.0, below_mm = 350.0;   // from there to where it is still: apex, pelvis
};

// From the skin's extent and the lungs' classes. Where no lung is in the volume its top counts as the dome. Nothing
// when there is no skin.
std::optional<BreathRegion> breath_region(const cases::Case& scene);

}  // namespace seldinger::tissue
