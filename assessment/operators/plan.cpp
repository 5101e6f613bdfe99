#include "assessment/operators/plan.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <numbers>
#include <vector>

#include "assessment/operators/probe_place.h"
#include "sim/base/exact_math.h"
#include "sim/base/vectors.h"
#include "sim/case/c_arm.h"

namespace seldinger::assessment {
namespace {

constexpr int kDirections = 1500;
// Room for a needle before it enters, this long and so far off the skin (design).
constexpr double kNeedleOutsideMm = 75.0, kSkinStepMm = 3.0, kOffSkinMm = 3.0;
constexpr double kOffCutMm = 10.0;     // a hand sways by millimetres, in the air most (design)
constexpr double kMaxTableward = 0.3;  // the table is behind a supine patient (LPS +y), before a prone one
// So many free ways are compared, evenly from the shortest to those longer by this (design): a longer way may be
// seen better.
constexpr std::size_t kWaysJudged = 32;
constexpr double kLongerWay = 1.4;

struct Way {
  glm::dvec3 outward;
  double depth_mm;
};

// Directions spread evenly over the sphere (Fibonacci lattice).
glm::dvec3 spread_direction(int i) {
  constexpr double kGoldenAngle = 2.399963229728653;  // π (3 − √5)
  const double z = 1.0 - 2.0 * (i + 0.5) / kDirections, r = std::sqrt(1.0 - z * z);
  return {r * base::exact_cos(kGoldenAngle * i), r * base::exact_sin(kGoldenAngle * i), z};
}

// No bone and no gas at seven points around each millimetre, from skin_free_mm below the entry to the target.
bool free_path(const volume::Volume& volume, const glm::dmat4& voxel_from_lps, const glm::dvec3& target,
               const Way& way, const PathLimits& limits) {
  const auto [u, v] = base::perpendiculars(way.outward);
  for (double s_mm = 0.0; s_mm < way.depth_mm - limits.skin_free_mm; s_mm += 1.0)
    for (int k = 0; k < 7; ++k) {
      const double angle = k * std::numbers::pi / 3.0, radius = k < 6 ? limits.clearance_mm : 0.0;
      const glm::dvec3 p =
          target + way.outward * s_mm + (u * base::exact_cos(angle) + v * base::exact_sin(angle)) * radius;
      const bool open = std::any_of(limits.open.begin(), limits.open.end(), [&](const cases::Shape& shape) {
        return cases::signed_distance_mm(shape, p, limits.clearance_mm) < limits.clearance_mm;
      });
      if (open) continue;
      const glm::dvec3 voxel(voxel_from_lps * glm::dvec4(p, 1.0));
      const auto hu = volume::sample_trilinear(volume, voxel);
      if (!hu || is_bone(limits, volume, voxel, *hu) || *hu < limits.gas_hu) return false;
    }
  return true;
}

// Whether a place outside lies where the patient goes on beyond a cut side of the CT.
bool beyond_a_cut(const cases::MeshIndex& skin, const cases::Closest& near, const glm::dvec3& p) {
  constexpr double kStraightAhead = 0.98;  // cosine: not beside the cut
  return skin.cut(near.triangle) &&
         glm::dot(p - near.point_lps_mm, skin.normal(near.triangle)) > kStraightAhead * near.distance_mm;
}

// Whether an entry keeps off the rim of a cut.
bool off_every_cut(const cases::MeshIndex& skin, const glm::dvec3& entry, const glm::dvec3& outward) {
  const auto [u, v] = base::perpendiculars(outward);
  for (int k = 0; k < 8; ++k) {
    const double angle = k * std::numbers::pi / 4.0;
    const glm::dvec3 p = entry + (u * base::exact_cos(angle) + v * base::exact_sin(angle)) * kOffCutMm;
    if (skin.cut(skin.closest(p).triangle)) return false;
  }
  return true;
}

// Whether a needle gets to its entry from outside without going through a fold of skin or along it, nor through
// what of the patient the CT does not show.
bool free_outside(const cases::MeshIndex& skin, const glm::dvec3& target, const Way& way) {
  if (!off_every_cut(skin, target + way.outward * way.depth_mm, way.outward)) return false;
  for (double out_mm = kSkinStepMm; out_mm <= kNeedleOutsideMm; out_mm += kSkinStepMm) {
    const glm::dvec3 p = target + way.outward * (way.depth_mm + out_mm);
    const cases::Closest near = skin.closest(p);
    const double off_mm = skin.cut(near.triangle) ? kOffCutMm : std::min(kOffSkinMm, 0.25 * out_mm);
    if (near.distance_mm < off_mm || beyond_a_cut(skin, near, p)) return false;
  }
  return true;
}

// Whether the way keeps off what must not be met and leads through what must be crossed.
bool spares_structures(const glm::dvec3& target, const Way& way, const PathLimits& limits) {
  const glm::dvec3 entry = target + way.outward * way.depth_mm;
  const glm::dvec3 end = target - way.outward * limits.behind_target_mm;
  for (const cases::Structure& structure : limits.structures) {
    if (structure.rule == cases::StructureRule::must_cross) {
      double crossed_mm = 0.0;
      for (const cases::Stretch& part : cases::stretches_inside(structure.shape, entry, target))
        crossed_mm += (part.to - part.from) * way.depth_mm;
      if (crossed_mm < limits.must_cross_mm) return false;
      continue;
    }
    if (structure.rule != cases::StructureRule::critical && structure.rule != cases::StructureRule::major) continue;
    if (!cases::stretches_inside(structure.shape, entry, end).empty()) return false;
    // A step of the clearance: what lies nearer between two steps is missed by no more than an eighth of it.
    const double length_mm = glm::distance(entry, end), clear_mm = limits.structure_clearance_mm;
    const int steps = std::max(1, static_cast<int>(std::ceil(length_mm / std::max(clear_mm, 0.5))));
    for (int i = 0; i <= steps && clear_mm > 0.0; ++i)
      if (cases::signed_distance_mm(structure.shape, entry + (end - entry) * (static_cast<double>(i) / steps),
                                    clear_mm) < clear_mm)
        return false;
  }
  return true;
}

// From where on the way is inside the organ that carries the target, without leaving it again before.
double organ_from_mm(const glm::dvec3& entry, const glm::dvec3& target,
                     std::span<const cases::Structure> structures) {
  double from = 0.0;
  for (const cases::Structure& structure : structures)
    if (structure.rule == cases::StructureRule::organ)
      for (const cases::Stretch& part : cases::stretches_inside(structure.shape, entry, target))
        from = std::max(from, part.from);
  return from * glm::distance(entry, target);
}

}  // namespace

bool towards_table(const glm::dvec3& outward, cases::PatientPosition position) noexcept {
  return -glm::dot(outward, cases::upwards(position)) > kMaxTableward;
}

bool is_bone(const PathLimits& limits, const volume::Volume& volume, const glm::dvec3& voxel, double hu) noexcept {
  if (limits.classes.empty()) return hu > limits.bone_hu;
  const glm::ivec3 at(glm::clamp(glm::round(voxel), glm::dvec3(0.0), glm::dvec3(volume.size_voxels - 1)));
  const volume::TissueClass tissue = limits.classes[static_cast<std::size_t>(volume.index(at.x, at.y, at.z))];
  return tissue == volume::TissueClass::bone || tissue == volume::TissueClass::metal;
}

PathLimits path_limits(cases::Modality modality, cases::PatientPosition position) {
  PathLimits limits;
  limits.position = position;
  if (modality == cases::Modality::xray) {
    limits.needs_probe = false;
    limits.max_lao_deg = kBullsEyeLaoDeg;
    limits.max_cranial_deg = kBullsEyeCranialDeg;
  }
  return limits;
}

PathLimits path_limits(const cases::Case& scene) {
  PathLimits limits = path_limits(scene.picture.modality, scene.position);
  limits.max_depth_mm = std::min(limits.max_depth_mm, scene.instrument.length_mm);
  limits.structures = scene.structures;
  limits.classes = scene.classes;
  limits.approach = scene.approach;
  for (const cases::Structure& structure : scene.structures)
    if (structure.rule == cases::StructureRule::target) limits.open.push_back(structure.shape);
  if (!scene.lesions.empty() && scene.lesions.front().in_volume())
    limits.open.push_back(*scene.lesions.front().shape);
  const cases::Instrument& needle = scene.instrument;
  if (needle.kind == cases::InstrumentKind::core)  // the middle of the notch comes to the target's
    limits.behind_target_mm = needle.dead_tip_mm + needle.notch_mm / 2.0;
  return limits;
}

base::Result<PuncturePlan> plan_puncture(const volume::Volume& volume, const cases::MeshIndex& skin,
                                         const glm::dvec3& target, const PathLimits& limits) {
  const base::Error none{"no_path",
                         limits.structures.empty()
                             ? "no straight path from the skin to the target is free of bone and gas"
                             : "no straight path from the skin to the target is free of bone, gas and structures"};
  if (skin.empty()) return none;
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  std::vector<Way> ways;
  for (int i = 0; i < kDirections; ++i) {
    const glm::dvec3 outward = spread_direction(i);
    if (towards_table(outward, limits.position)) continue;
    const cases::BeamAngles along = cases::angles_of_beam(outward, limits.position);
    if (std::abs(along.lao_deg) > limits.max_lao_deg || std::abs(along.cranial_deg) > limits.max_cranial_deg)
      continue;
    const auto hit = skin.first_hit(target, outward, limits.max_depth_mm);
    if (!hit || hit->cut || hit->distance_mm < limits.min_depth_mm) continue;
    ways.push_back({outward, hit->distance_mm});
  }
  std::stable_sort(ways.begin(), ways.end(), [](const Way& a, const Way& b) { return a.depth_mm < b.depth_mm; });
  std::erase_if(ways, [&](const Way& way) {
    return !free_outside(skin, target, way) || !free_path(volume, voxel_from_lps, target, way, limits) ||
           !spares_structures(target, way, limits);
  });
  if (limits.looks_from && !ways.empty()) {
    std::erase_if(ways, [longest_mm = kLongerWay * ways.front().depth_mm](const Way& way) {
      return way.depth_mm > longest_mm;
    });
    if (ways.size() > kWaysJudged) {
      for (std::size_t i = 0; i < kWaysJudged; ++i) ways[i] = ways[i * ways.size() / kWaysJudged];
      ways.resize(kWaysJudged);
    }
  }
  std::optional<PuncturePlan> best;
  double best_score = 0.0;
  for (std::size_t i = 0; i < ways.size(); ++i) {
    const Way& way = ways[i];
    if (limits.told) limits.told(static_cast<double>(i) / static_cast<double>(ways.size()));
    PuncturePlan plan;
    plan.target_lps_mm = target;
    plan.entry_lps_mm = target + way.outward * way.depth_mm;
    plan.direction = -way.outward;
    plan.depth_mm = way.depth_mm;
    constexpr double kAsideMm = 150.0;
    plan.probe = {plan.entry_lps_mm + way.outward * kAsideMm, plan.direction, base::perpendiculars(way.outward).u};
    plan.probe_first = plan.probe;
    plan.organ_from_mm = organ_from_mm(plan.entry_lps_mm, target, limits.structures);
    if (!limits.needs_probe) return plan;
    const auto score = place_probe(skin, limits, plan);
    if (score && !limits.looks_from) return plan;
    if (!score || (best && *score <= best_score)) continue;
    best = plan;
    best_score = *score;
  }
  if (best) return *best;
  return none;
}

}  // namespace seldinger::assessment
