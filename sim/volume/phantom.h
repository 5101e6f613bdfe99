// The built-in patients: a family of torsos, groins and necks from analytic shapes with typical HU, noise and
// labels, each of several bodies, supine or prone (docs/decisions/0066). No patient's data.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "sim/base/names.h"
#include "sim/volume/analytic.h"

namespace seldinger::volume {

// Of both kidneys. Dilated: the lower calyx 15 instead of 8 mm across; opacified: normal ones filled with contrast.
enum class Calyces { normal, dilated, opacified };
inline constexpr auto kCalycesNames = base::names<Calyces>(
    {{Calyces::normal, "normal"}, {Calyces::dilated, "dilated"}, {Calyces::opacified, "opacified"}});

// What the CT covers. All have one frame, that of the torso: x = 0 in the middle, z = 0 at the first lumbar
// vertebra.
enum class Region { torso, groin, neck };
inline constexpr auto kRegionNames =
    base::names<Region>({{Region::torso, "torso"}, {Region::groin, "groin"}, {Region::neck, "neck"}});

// Lean and obese differ from the adult by fat, a child of about seven years by size as well.
enum class Body { adult, lean, obese, child };
inline constexpr auto kBodyNames = base::names<Body>(
    {{Body::adult, "adult"}, {Body::lean, "lean"}, {Body::obese, "obese"}, {Body::child, "child"}});

// How the patient lay in the scanner: gas rises, and the side that is lain on is flat.
enum class Posture { supine, prone };
inline constexpr auto kPostureNames =
    base::names<Posture>({{Posture::supine, "supine"}, {Posture::prone, "prone"}});

struct PhantomOptions {
  Calyces calyces = Calyces::normal;       // of a torso
  std::optional<glm::dvec3> spacing_mm{};  // nothing: as the region is scanned
  double noise_sd_hu = 12.0;               // soft-tissue kernel, 5 mm slices: 10–15 HU
  std::uint64_t seed = 1;
  Region region = Region::torso;
  Body body = Body::adult;
  Posture posture = Posture::supine;
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
