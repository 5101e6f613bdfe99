// What a lesion is to sound in the tissue it lies in: its kind's row (sim/case/lesion_kind.h) is relative to that.
#pragma once

#include <span>

#include "sim/case/case.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

// Of a lesion of any kind but by_hu, from the mean square echo of the tissue kAboutLesionMm off its surface
// (outside the volume and in gas or bone there is none; nothing all around: liver). `tissue`: without the lesion,
// or with it painted.
constexpr double kAboutLesionMm = 3.0;
cases::LesionEcho lesion_echo(const TissueVolume& tissue, const cases::Lesion& lesion);

// What a lesion's parts are to sound; by_hu, or not settled yet: the tissue of its HU, without a rim.
cases::LesionEcho echo_of(const cases::Lesion& lesion) noexcept;
// Where the rim of a sphere begins; ≥ 0.
double inner_radius_mm(const cases::Lesion& lesion, const cases::LesionEcho& echo) noexcept;
// Of the sharp sphere that has as much of its own along a radius: to the middle of the margin, where that is less.
double seen_radius_mm(const cases::Lesion& lesion, const cases::LesionEcho& echo) noexcept;

// Of a lesion's inside, fixed to it (shaders/shared/ultrasound_lattice.glsl.h).
struct Texture {
  Texture(const cases::Lesion& lesion, const cases::LesionEcho& echo) noexcept;
  float log_at(const glm::dvec3& from_center_mm) const noexcept;  // of the factor on the speckle's amplitude
  float at(const glm::dvec3& from_center_mm) const noexcept;      // that factor
  std::uint32_t key;  // of its centre; below 2²⁴, so that float holds it
  float grains_per_mm, log_sd;
};

// An echo's texture_db. Of the few grains that a small lesion has the mean square is by chance another than of
// many.
double texture_db(const cases::Lesion& lesion, const cases::LesionEcho& echo);

// Settles every lesion whose kind has a look of its own, and puts those that lie in the volume into it: their
// voxels take class and level, which replace what HU told. With texture by the law `material` and later, with a
// margin by `tilt`.
void settle_lesions(const volume::Volume& volume, std::span<volume::TissueClass> classes,
                    std::span<std::uint8_t> echogenicity, std::span<cases::Lesion> lesions,
                    cases::SightLaw law = cases::kNewestSightLaw);

}  // namespace seldinger::imaging
