// The built-in case: a torso from analytic shapes with typical HU, noise and labels. No patient's data.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <string>

#include "sim/volume/analytic.h"

namespace seldinger::volume {

// Of both kidneys. Dilated: the lower calyx 15 instead of 8 mm across; opacified: normal ones filled with contrast.
enum class Calyces { normal, dilated, opacified };

struct PhantomOptions {
  Calyces calyces = Calyces::normal;
  glm::dvec3 spacing_mm{1.5, 1.5, 3.0};
  double noise_sd_hu = 12.0;  // soft-tissue kernel, 5 mm slices: 10–15 HU
  std::uint64_t seed = 1;
};

constexpr const char* kPhantomVersion = "1";

struct Phantom {
  Volume volume;
  LabelMap labels;
};

// The shapes, without noise: the phantom's closed form.
AnalyticVolume phantom_shapes(const PhantomOptions& options = {});
Phantom make_phantom(const PhantomOptions& options = {});

// A scanner's noise, 1 σ in the body, half of it in air: the same for the same seed.
void add_ct_noise(double sd_hu, std::uint64_t seed, Phantom& phantom);

}  // namespace seldinger::volume
