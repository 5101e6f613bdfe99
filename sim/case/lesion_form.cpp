#include "sim/case/lesion_form.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "sim/base/exact_math.h"
#include "sim/base/rng.h"

namespace seldinger::cases {
namespace {

constexpr int kWaves = 12;
constexpr double kSlowest = 2.0, kFastest = 6.0;  // radians of a wave from the middle of its side to its rim
constexpr double kLeastShare = 0.2;
constexpr double kFinestMm = 0.25;
constexpr double kVoxelsARadius = 24.0;
constexpr double kAboutMm = 2.0;

struct Wave {
  glm::dvec3 along;
  double phase;
};

std::array<Wave, kWaves> waves_of(std::uint64_t seed) {
  base::Rng rng(seed);
  std::array<Wave, kWaves> waves;
  for (Wave& wave : waves) {
    const double z = 2.0 * rng.uniform() - 1.0, turn = 2.0 * std::numbers::pi * rng.uniform();
    const double r = std::sqrt(std::max(0.0, 1.0 - z * z)), rate = kSlowest + (kFastest - kSlowest) * rng.uniform();
    wave.along = rate * glm::dvec3(r * base::exact_cos(turn), r * base::exact_sin(turn), z);
    wave.phase = 2.0 * std::numbers::pi * rng.uniform();
  }
  return waves;
}

double radius_of(const LesionForm& form, const std::array<Wave, kWaves>& waves, const glm::dvec3& direction) {
  double sum = 0.0;  // variance: kWaves / 2
  for (const Wave& wave : waves) sum += base::exact_cos(glm::dot(wave.along, direction) + wave.phase);
  const double share = 1.0 + form.roughness * std::sqrt(2.0 / kWaves) * sum;
  return form.radii_mm.x * std::max(kLeastShare, share);
}

VoxelSet voxels_of(const LesionForm& form) {
  const auto waves = waves_of(form.seed);
  const double step_mm = std::max(kFinestMm, form.radii_mm.x / kVoxelsARadius);
  // No wave is higher than all crests at once.
  const double reach_mm = form.radii_mm.x * (1.0 + form.roughness * std::sqrt(2.0 * kWaves));
  const int half = static_cast<int>(std::ceil(reach_mm / step_mm));
  VoxelSet set;
  set.low = glm::ivec3(-half);
  set.size = glm::ivec3(2 * half + 1);
  set.spacing_mm = glm::dvec3(step_mm);
  glm::dmat4 lps_from_voxel(step_mm);
  lps_from_voxel[3] = glm::dvec4(form.center_lps_mm, 1.0);
  set.voxel_from_lps = glm::inverse(lps_from_voxel);
  set.member.reserve(static_cast<std::size_t>(set.size.x) * static_cast<std::size_t>(set.size.y) *
                     static_cast<std::size_t>(set.size.z));
  for (int k = -half; k <= half; ++k)
    for (int j = -half; j <= half; ++j)
      for (int i = -half; i <= half; ++i) {
        const glm::dvec3 off = step_mm * glm::dvec3(i, j, k);
        const double away = glm::length(off);
        set.member.push_back(away == 0.0 || away <= radius_of(form, waves, off / away) ? 1 : 0);
      }
  return set;
}

double volume_mm3(const Shape& shape) {
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&shape))
    return 4.0 / 3.0 * std::numbers::pi * ellipsoid->radii_mm.x * ellipsoid->radii_mm.y * ellipsoid->radii_mm.z;
  const auto* set = std::get_if<VoxelSet>(&shape);
  const auto* sphere = std::get_if<Sphere>(&shape);
  if (sphere != nullptr) return 4.0 / 3.0 * std::numbers::pi * std::pow(sphere->radius_mm, 3.0);
  const auto voxels = std::count(set->member.begin(), set->member.end(), std::uint8_t{1});
  return static_cast<double>(voxels) * set->spacing_mm.x * set->spacing_mm.y * set->spacing_mm.z;
}

}  // namespace

double irregular_radius_mm(const LesionForm& form, const glm::dvec3& direction) {
  return radius_of(form, waves_of(form.seed), direction);
}

Shape shape_of(const LesionForm& form) {
  switch (form.outline) {
    case LesionOutline::ellipsoid:
      return Ellipsoid{form.center_lps_mm, form.radii_mm};
    case LesionOutline::irregular:
      return voxels_of(form);
    case LesionOutline::sphere:
      break;
  }
  return Sphere{form.center_lps_mm, form.radii_mm.x};
}

Lesion lesion_of(const LesionForm& form) {
  Lesion lesion;
  lesion.center_lps_mm = form.center_lps_mm;
  lesion.radius_mm = form.radii_mm.x;
  lesion.hu = form.hu;
  lesion.kind = form.kind;
  if (is_plain(form)) return lesion;
  lesion.shape = std::make_shared<const Shape>(shape_of(form));
  if (form.outline != LesionOutline::sphere)
    lesion.radius_mm = std::cbrt(volume_mm3(*lesion.shape) * 3.0 / (4.0 * std::numbers::pi));
  return lesion;
}

std::optional<double> hu_about(const volume::Volume& volume, const Lesion& drawn) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  double sum = 0.0;
  int count = 0;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const glm::dvec3 p =
            drawn.center_lps_mm + (drawn.radius_mm + kAboutMm) * glm::normalize(glm::dvec3(x, y, z));
        const auto hu = volume::sample_trilinear(volume, glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)));
        if (!hu) continue;
        sum += *hu;
        ++count;
      }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace seldinger::cases
