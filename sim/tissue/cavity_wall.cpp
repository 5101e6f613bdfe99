#include "sim/tissue/cavity_wall.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <vector>

namespace seldinger::tissue {
namespace {

using volume::TissueClass;
constexpr int kWays = shaders::kCavityWays, kHeights = shaders::kCavityHeights;
using Radii = std::array<double, shaders::kCavityNodes>;

constexpr double kAlongRayMm = 1.0;
// Muscle of a wall that nothing tells apart from what is behind it: the straight muscle of the belly is some 10 mm
// thick, the three at its side some 20 (Rankin, Muscle Nerve 34, 2006, recalled).
constexpr double kMusclesMm = 12.0;
constexpr double kSkinMm = 6.0;  // a CT may show it as soft tissue; with its rim of mixed voxels (design)
// How deep a rib may lie under the muscles' outside (design). What is farther in is no wall: a heart that is
// labelled as muscle, and spine and psoas, which breath leaves where they are anyhow.
constexpr double kDeepestMm = 30.0;
// Fat that thick parts the wall from what lies within, thinner is between two muscles (design).
constexpr double kBetweenMusclesMm = 6.0;
// The axis lies before the spine: at this share of the way from the foremost to the hindmost bone (design).
constexpr double kAxisShare = 0.4, kOutlyingBone = 0.02;
constexpr double kLeastRadiusMm = 15.0;
// How much a wall may widen by height: with more, an organ that goes along it would be drawn out (design).
constexpr double kSteepest = 0.6;

bool is_cavity(TissueClass tissue) {
  return tissue == TissueClass::lung || tissue == TissueClass::gas || tissue == TissueClass::liver ||
         tissue == TissueClass::kidney || tissue == TissueClass::spleen;
}
bool is_hard(TissueClass tissue) {
  return tissue == TissueClass::bone || tissue == TissueClass::muscle || tissue == TissueClass::metal ||
         tissue == TissueClass::connective;
}

// Values of which `share` lie below, of counted ones 1 mm wide.
double quantile_mm(const std::vector<std::int64_t>& count, double low_mm, double share) {
  std::int64_t all = 0, below = 0;
  for (const std::int64_t one : count) all += one;
  std::size_t at = 0;
  while (at + 1 < count.size() && static_cast<double>(below + count[at]) <= share * static_cast<double>(all))
    below += count[at++];
  return low_mm + static_cast<double>(at) + 0.5;
}

// Classes from the axis outwards, one per kAlongRayMm.
double wall_of_ray(const std::vector<TissueClass>& ray) {
  const auto mm = [](std::size_t at) { return kAlongRayMm * static_cast<double>(at); };
  // An arm beside the trunk lies beyond the room's air.
  const auto room = std::find(ray.begin(), ray.end(), TissueClass::air);
  const auto surface = static_cast<std::size_t>(room - ray.begin());
  std::size_t outside = surface;  // one beyond what is muscle or bone or has no name
  const auto is_fat = [&](std::size_t at) { return ray[at] == TissueClass::fat || ray[at] == TissueClass::skin; };
  for (bool skin = true; skin;) {
    while (outside > 0 && is_fat(outside - 1)) --outside;
    std::size_t behind = outside;
    while (behind > 0 && !is_fat(behind - 1) && mm(outside - behind) <= kSkinMm) --behind;
    skin = behind > 0 && behind < outside && is_fat(behind - 1) && mm(surface - behind) <= 2.0 * kSkinMm;
    if (skin) outside = behind;
  }
  if (outside == 0) return 0.0;
  std::size_t wall = outside;  // one beyond what lies within
  double fat_mm = 0.0;
  for (std::size_t at = outside; at > 0 && mm(outside - at) < kDeepestMm; --at) {
    const TissueClass tissue = ray[at - 1];
    if (is_cavity(tissue)) break;
    fat_mm = tissue == TissueClass::fat ? fat_mm + kAlongRayMm : 0.0;
    // Soft tissue may be muscle or what is behind it.
    if (is_hard(tissue) || (tissue != TissueClass::fat && mm(outside - at) < kMusclesMm)) wall = at - 1;
    if (fat_mm >= kBetweenMusclesMm) break;
  }
  return mm(wall);
}

double median_of(std::array<double, 9> values) {
  std::nth_element(values.begin(), values.begin() + 4, values.end());
  return values[4];
}

// Of a node and its neighbours: from 0 to 2 by height, times 3, plus 0 to 2 by direction.
std::array<double, 9> about(const Radii& radii, int height, int way) {
  std::array<double, 9> values{};
  for (int i = 0; i < 9; ++i) {
    const int h = std::clamp(height + i / 3 - 1, 0, kHeights - 1), w = (way + i % 3 - 1 + kWays) % kWays;
    values[static_cast<std::size_t>(i)] = radii[static_cast<std::size_t>(h * kWays + w)];
  }
  return values;
}

// A height at which the axis runs outside the body, as above a scan that the skin closes, has the wall of the
// nearest.
void fill(Radii& radii) {
  for (int w = 0; w < kWays; ++w) {
    const auto at = [&](int h) -> double& { return radii[static_cast<std::size_t>(h * kWays + w)]; };
    for (int h = 1; h < kHeights; ++h)
      if (at(h) == 0.0) at(h) = at(h - 1);
    for (int h = kHeights - 2; h >= 0; --h)
      if (at(h) == 0.0) at(h) = at(h + 1);
  }
}

// One ray may pass between two ribs and meet a vessel: its neighbours outvote it.
void settle(double step_mm, Radii& radii) {
  Radii made = radii;
  for (int h = 0; h < kHeights; ++h)
    for (int w = 0; w < kWays; ++w) made[static_cast<std::size_t>(h * kWays + w)] = median_of(about(radii, h, w));
  radii = made;
  for (int h = 0; h < kHeights; ++h)
    for (int w = 0; w < kWays; ++w) {
      constexpr std::array<double, 9> kWeights{1, 2, 1, 2, 4, 2, 1, 2, 1};
      const std::array<double, 9> values = about(radii, h, w);
      double sum = 0.0;
      for (std::size_t i = 0; i < 9; ++i) sum += kWeights[i] * values[i] / 16.0;
      made[static_cast<std::size_t>(h * kWays + w)] = std::max(kLeastRadiusMm, sum);
    }
  radii = made;
  const auto lower = [&](int height, int from) {
    for (int w = 0; w < kWays; ++w) {
      double& radius_mm = radii[static_cast<std::size_t>(height * kWays + w)];
      radius_mm = std::min(radius_mm, radii[static_cast<std::size_t>(from * kWays + w)] + kSteepest * step_mm);
    }
  };
  for (int h = 1; h < kHeights; ++h) lower(h, h - 1);
  for (int h = kHeights - 2; h >= 0; --h) lower(h, h + 1);
}

// x and y: before the spine, in the middle of the bones. Nothing without any.
std::optional<glm::dvec2> axis_of(const cases::Case& scene, const glm::dvec3& low_mm, const glm::dvec3& high_mm) {
  const auto bins = [](double from, double to) {
    return std::vector<std::int64_t>(static_cast<std::size_t>(std::max(1.0, std::ceil(to - from))), 0);
  };
  std::vector<std::int64_t> by_x = bins(low_mm.x, high_mm.x), by_y = bins(low_mm.y, high_mm.y);
  const auto add = [](std::vector<std::int64_t>& count, double at_mm) {
    ++count[static_cast<std::size_t>(std::clamp(at_mm, 0.0, static_cast<double>(count.size() - 1)))];
  };
  bool any = false;
  std::size_t at = 0;
  const volume::Volume& volume = scene.volume;
  for (int k = 0; k < volume.size_voxels.z; ++k)
    for (int j = 0; j < volume.size_voxels.y; ++j)
      for (int i = 0; i < volume.size_voxels.x; ++i, ++at) {
        if (scene.classes[at] != TissueClass::bone) continue;
        const glm::dvec4 lps_mm = volume.lps_from_voxel * glm::dvec4(i, j, k, 1.0);
        add(by_x, lps_mm.x - low_mm.x);
        add(by_y, lps_mm.y - low_mm.y);
        any = true;
      }
  if (!any) return std::nullopt;
  const double front_mm = quantile_mm(by_y, low_mm.y, kOutlyingBone),
               back_mm = quantile_mm(by_y, low_mm.y, 1.0 - kOutlyingBone);
  return glm::dvec2(quantile_mm(by_x, low_mm.x, 0.5), front_mm + kAxisShare * (back_mm - front_mm));
}

// Whose direction number is `way`, as displacement_sliding counts: from left (x) to the back (y), right, front.
glm::dvec2 direction_of(int way) {
  const double turn = 4.0 * way / kWays;
  const glm::dvec2 on_square = turn <= 2.0 ? glm::dvec2(1.0 - turn, 1.0 - std::abs(1.0 - turn))
                                           : glm::dvec2(turn - 3.0, std::abs(turn - 3.0) - 1.0);
  return on_square / std::sqrt(glm::dot(on_square, on_square));
}

}  // namespace

std::optional<CavityWall> cavity_wall(const cases::Case& scene) {
  const volume::Volume& volume = scene.volume;
  if (scene.classes.size() != volume.hu.size() || scene.skin.vertices_lps_mm.empty()) return std::nullopt;
  glm::dvec3 low_mm(scene.skin.vertices_lps_mm[0]), high_mm = low_mm;
  for (const glm::vec3& vertex : scene.skin.vertices_lps_mm) {
    low_mm = glm::min(low_mm, glm::dvec3(vertex));
    high_mm = glm::max(high_mm, glm::dvec3(vertex));
  }
  const std::optional<glm::dvec2> axis_mm = axis_of(scene, low_mm, high_mm);
  if (!axis_mm || !(high_mm.z > low_mm.z)) return std::nullopt;
  CavityWall made;
  made.axis_lps_mm = {axis_mm->x, axis_mm->y, low_mm.z};
  made.step_mm = (high_mm.z - low_mm.z) / (kHeights - 1);

  const glm::dmat4 voxel_from_lps = glm::inverse(volume.lps_from_voxel);
  const auto class_at = [&](const glm::dvec3& lps_mm) {
    const glm::dvec3 at = glm::floor(glm::dvec3(voxel_from_lps * glm::dvec4(lps_mm, 1.0)) + 0.5);
    const glm::ivec3 ijk(at);
    for (int axis = 0; axis < 3; ++axis)
      if (!(at[axis] >= 0.0 && at[axis] < volume.size_voxels[axis])) return TissueClass::air;
    return scene.classes[volume.index(ijk.x, ijk.y, ijk.z)];
  };
  const glm::dvec3 size_mm = high_mm - low_mm;
  const auto longest = static_cast<std::size_t>(std::sqrt(glm::dot(size_mm, size_mm)) / kAlongRayMm);
  Radii radii{};
  std::vector<TissueClass> ray(longest);
  for (int h = 0; h < kHeights; ++h)
    for (int w = 0; w < kWays; ++w) {
      const glm::dvec2 way = direction_of(w);
      // The lowest and the highest are just within.
      const double inside_mm = std::clamp(h * made.step_mm, 1.0, std::max(1.0, size_mm.z - 1.0));
      for (std::size_t i = 0; i < longest; ++i) {
        const double off_mm = kAlongRayMm * static_cast<double>(i);
        ray[i] = class_at({axis_mm->x + off_mm * way.x, axis_mm->y + off_mm * way.y, low_mm.z + inside_mm});
      }
      radii[static_cast<std::size_t>(h * kWays + w)] = wall_of_ray(ray);
    }
  fill(radii);
  settle(made.step_mm, radii);
  for (std::size_t i = 0; i < radii.size(); ++i) made.radius_mm[i] = static_cast<float>(radii[i]);
  return made;
}

}  // namespace seldinger::tissue
