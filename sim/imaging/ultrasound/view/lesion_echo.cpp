#include "sim/imaging/ultrasound/view/lesion_echo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "shaders/shared/ultrasound_lattice.glsl.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/case/paint.h"
#include "sim/imaging/ultrasound/view/echogenicity.h"
#include "sim/imaging/ultrasound/view/fan.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

// What speckles and lets sound through.
bool is_tissue(TissueClass tissue) {
  return acoustic_table()[static_cast<std::size_t>(tissue)].soft;
}

void put_in_volume(const cases::Lesion& lesion, const volume::Volume& volume, std::span<TissueClass> classes,
                   std::span<std::uint8_t> echogenicity) {
  const cases::LesionEcho& echo = *lesion.echo;
  const Texture texture(lesion, echo);
  const auto nx = static_cast<std::size_t>(volume.size_voxels.x),
             ny = static_cast<std::size_t>(volume.size_voxels.y);
  const double deepest_mm = std::max(echo.rim_mm, echo.margin_mm);
  cases::over_voxels_in(*lesion.shape, volume, deepest_mm, [&](std::size_t at, double depth_mm) {
    const bool rim = depth_mm < echo.rim_mm;
    classes[at] = rim ? echo.rim : echo.inside;
    double level_db = rim ? echo.rim_db : echo.inside_db;
    if (!rim && texture.log_sd > 0.0F) {
      const glm::dvec4 voxel(static_cast<double>(at % nx), static_cast<double>(at / nx % ny),
                             static_cast<double>(at / nx / ny), 1.0);
      const glm::dvec3 off_mm = glm::dvec3(volume.lps_from_voxel * voxel) - lesion.center_lps_mm;
      level_db += echo.texture_db + 20.0 / std::numbers::ln10 * static_cast<double>(texture.log_at(off_mm));
    }
    if (depth_mm < echo.margin_mm) {
      const auto share = static_cast<float>(depth_mm / echo.margin_mm);
      level_db = 20.0 * std::log10(static_cast<double>(shaders::us_margin_amplitude(
                            speckle_amplitude(level_db), speckle_amplitude(echo.about_db), share)));
    }
    echogenicity[at] = echo_level(level_db, classes[at]);
  });
}

}  // namespace

cases::LesionEcho lesion_echo(const TissueVolume& tissue, const cases::Lesion& lesion) {
  CHECK(lesion.kind != cases::LesionKind::by_hu);
  const cases::LesionLook& look = cases::about(lesion.kind).look;
  const TissueAt tissue_at(tissue, {});
  const cases::Shape shape = cases::shape_of(lesion);
  const cases::Bounds bounds = cases::bounds_of(shape);
  double power = 0.0;
  int count = 0;
  std::array<int, volume::kTissueClasses> of_class{};
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::dvec3 direction = glm::normalize(glm::dvec3(x, y, z));
        const glm::dvec3 half = 0.5 * (bounds.high_lps_mm - bounds.low_lps_mm);
        // The ellipsoid in the shape's box is its surface, or lies beyond it.
        const double surface_mm = 1.0 / glm::length(direction / glm::max(half, glm::dvec3(1e-6)));
        const glm::dvec3 p =
            0.5 * (bounds.low_lps_mm + bounds.high_lps_mm) + (surface_mm + kAboutLesionMm) * direction;
        const TissueClass here = tissue_at(p);
        if (!is_tissue(here)) continue;
        const double amplitude = static_cast<double>(tissue_at.speckle(p));
        power += amplitude * amplitude;
        ++count;
        ++of_class[static_cast<std::size_t>(here)];
      }
  const double about_db = count > 0 ? 10.0 * std::log10(std::max(power / count, 1e-20)) : 0.0;
  const auto most = std::max_element(of_class.begin(), of_class.end());
  const TissueClass about = count > 0 ? static_cast<TissueClass>(most - of_class.begin()) : TissueClass::liver;

  cases::LesionEcho echo;
  echo.rim = about;
  echo.inside = look.sound == TissueClass::soft_tissue ? about : look.sound;
  echo.inside_db = look.speckled ? about_db + look.inside_db
                                 : acoustic_table()[static_cast<std::size_t>(echo.inside)].scatter_db;
  echo.rim_db = about_db + look.rim_db;
  echo.rim_mm = look.rim_mm;
  echo.margin_mm = look.margin_mm;
  echo.about_db = about_db;
  echo.texture = look.texture;
  echo.texture_db = texture_db(lesion, echo);
  return echo;
}

cases::LesionEcho echo_of(const cases::Lesion& lesion) noexcept {
  if (lesion.echo) return *lesion.echo;
  cases::LesionEcho echo;
  echo.inside = echo.rim = cases::tissue_of_lesion(lesion.hu);
  echo.inside_db = echo.rim_db = acoustic_table()[static_cast<std::size_t>(echo.inside)].scatter_db;
  return echo;
}

Texture::Texture(const cases::Lesion& lesion, const cases::LesionEcho& echo) noexcept
    : key(0),
      grains_per_mm(echo.texture.grain_mm > 0.0 ? static_cast<float>(1.0 / echo.texture.grain_mm) : 0.0F),
      log_sd(static_cast<float>(echo.texture.sd_db * std::numbers::ln10 / 20.0)) {
  // Two lesions a hundredth of a millimetre apart differ.
  for (const double mm : {lesion.center_lps_mm.x, lesion.center_lps_mm.y, lesion.center_lps_mm.z})
    key = shaders::mix_32(key ^ static_cast<std::uint32_t>(std::llround(100.0 * mm)));
  key >>= 8U;
}

float Texture::log_at(const glm::dvec3& from_center_mm) const noexcept {
  const glm::vec3 off(from_center_mm);
  return shaders::us_texture_log(key, grains_per_mm, log_sd, off.x, off.y, off.z);
}

float Texture::at(const glm::dvec3& from_center_mm) const noexcept {
  return static_cast<float>(base::exact_exp(static_cast<double>(log_at(from_center_mm))));
}

double texture_db(const cases::Lesion& lesion, const cases::LesionEcho& echo) {
  const Texture texture(lesion, echo);
  if (!(texture.log_sd > 0.0F)) return 0.0;
  constexpr int kSteps = 12;  // across its radius: a grain of a tenth of it is still seen
  const double inner_mm = std::max(inner_radius_mm(lesion, echo), 1e-3);
  double power = 0.0;
  int count = 0;
  for (int i = -kSteps; i <= kSteps; ++i)
    for (int j = -kSteps; j <= kSteps; ++j)
      for (int k = -kSteps; k <= kSteps; ++k) {
        if (i * i + j * j + k * k > kSteps * kSteps) continue;
        power +=
            base::exact_exp(2.0 * static_cast<double>(texture.log_at(inner_mm / kSteps * glm::dvec3(i, j, k))));
        ++count;
      }
  return -10.0 / std::numbers::ln10 * base::exact_log(power / count);
}

double inner_radius_mm(const cases::Lesion& lesion, const cases::LesionEcho& echo) noexcept {
  return std::max(0.0, lesion.radius_mm - echo.rim_mm);
}

double seen_radius_mm(const cases::Lesion& lesion, const cases::LesionEcho& echo) noexcept {
  // The integral of the share along a radius.
  const double r_mm = lesion.radius_mm, margin_mm = echo.margin_mm;
  return r_mm > margin_mm ? r_mm - 0.5 * margin_mm : 0.5 * r_mm * r_mm / margin_mm;
}

void settle_lesions(const volume::Volume& volume, std::span<TissueClass> classes,
                    std::span<std::uint8_t> echogenicity, std::span<cases::Lesion> lesions, cases::SightLaw law) {
  for (cases::Lesion& lesion : lesions) {
    if (lesion.kind == cases::LesionKind::by_hu) continue;
    lesion.echo = lesion_echo({&volume, classes, echogenicity}, lesion);
    if (law < cases::SightLaw::material) lesion.echo->texture = {}, lesion.echo->texture_db = 0.0;
    if (law < cases::SightLaw::tilt) lesion.echo->margin_mm = 0.0;
    if (lesion.in_volume() && !echogenicity.empty()) put_in_volume(lesion, volume, classes, echogenicity);
  }
}

}  // namespace seldinger::imaging
