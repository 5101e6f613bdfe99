#include "sim/tissue/displacement.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>

#include "shaders/shared/displacement.glsl.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"

namespace seldinger::tissue {
namespace {

using shaders::DisplacementSource;
using shaders::vec4;

// Of the head's radius: up to there Hertz' small strains keep a picture (our judgement). Of the bone's depth: from
// 0.72 on the layer would be folded (docs/decisions/0023).
constexpr double kMostOfRadius = 0.6, kMostOfBone = 0.6;
// √(R δ) over the bone's depth: in a layer still thinner tissue is squeezed out sideways, and no disk of Hertz'
// pressure is what does that.
constexpr double kMostThinness = 2.0;

// A ball of tissue that is pushed by 1.7 times its radius folds what lies before it; a line's end does that when it
// is dragged by some ten times the radius within which tissue moves as one, or as far as it is long.
constexpr double kMostOfBall = 1.0, kMostOfShaft = 4.0, kMostOfLength = 0.8;
constexpr double kShortest = 5.0;  // needle radii of shaft, from where on it drags at all (design)

// Tissue's modulus around a needle: that of sim/haptics/needle/needle_law.h.
constexpr double kNeedleShearNMm2 = 0.0045;

// What holds an organ: loose fat and folds of peritoneum, as a wide medium would a ball of its volume (Stokes' and
// Kirchhoff's drag, read as elastic: 6 π G R and 8 π G R³). Nobody has published how far a needle pushes a kidney;
// this G lets one go by some 4 mm and 3° before its capsule opens, a liver by 1 mm (design; a prostate in a
// simulator went 6.5 mm: MSEC2017, abstract).
constexpr double kAboutOrganShearNMm2 = 0.001;
// Of the organ's radius, what goes and turns by no more folds nothing.
constexpr double kMostOfOrgan = 0.4;

// What moves nothing more than this is no source.
constexpr double kLeastMm = 1e-4;

// Bone farther away than this is none. A probe that has left bone forgets it by halves without an end, and the
// source is kept in float, where more than 3.4e38 is infinite and its image not a number.
constexpr double kFarthestBoneMm = 1e38;

// A vein never closes altogether: its wall has a thickness.
constexpr double kLeastVeinArea = 0.03;
// K of a thin wall, E (h/r)³ / (12 (1 − ν²)): 0.5 Pa, of 0.3 MPa and a wall of 0.025 radii (design).
constexpr double kVeinCollapseNMm2 = 5e-7;

vec4 vec4_from(const glm::dvec3& xyz, double w = 0.0) {
  return vec4(glm::dvec4(xyz, w));
}

bool press_source(const SkinPress& press, DisplacementSource& source) noexcept {
  const PressedDisk disk = pressed_disk(press);
  if (!(disk.depth_mm > kLeastMm)) return false;
  source = {vec4_from(press.at_lps_mm), vec4_from(press.inward), vec4_from({disk.radius_mm, disk.bone_mm, 0.0}),
            vec4_from({disk.amount_mm, 0.0, 0.0})};
  return true;
}

// Ball and line add up; the ball is pushed as much less as the line's end already takes the tissue at the tip
// along, so that this goes as far as touch says.
struct NeedleSources {
  DisplacementSource tip{}, shaft{};
  bool has_tip = false, has_shaft = false;
};
NeedleSources needle_sources(const NeedleDrag& drag) noexcept {
  NeedleSources made;
  // A needle that has just gone in has no shaft to drag with.
  const double most_shaft_mm = kMostOfLength * std::max(0.0, drag.cut_mm - kShortest * drag.radius_mm);
  const double shaft_mm = std::clamp(drag.shaft_mm, -most_shaft_mm, most_shaft_mm);
  const double within_mm = std::max(drag.radius_mm, std::abs(shaft_mm) / kMostOfShaft);
  double at_tip_mm = 0.0;
  if (std::abs(shaft_mm) > kLeastMm) {
    const auto line = [&](double along_mm) {
      return shaders::displacement_along_line(along_mm, 0.0, within_mm, drag.cut_mm).x;
    };
    const double amount_mm = shaft_mm / line(0.5 * drag.cut_mm);
    at_tip_mm = amount_mm * line(drag.cut_mm);
    made.has_shaft = true;
    made.shaft = {vec4_from(drag.entry_lps_mm), vec4_from(drag.direction), vec4_from({within_mm, drag.cut_mm, 0.0}),
                  vec4_from({amount_mm, 0.0, 0.0})};
  }
  if (std::abs(drag.tip_mm) > kLeastMm) {
    // As large as force and way make it, but never so small that it would fold what lies before it.
    const double by_force_mm = drag.tip_n / (6.0 * std::numbers::pi * kNeedleShearNMm2 * std::abs(drag.tip_mm));
    const double ball_mm =
        std::max({drag.radius_mm, by_force_mm, (std::abs(drag.tip_mm) + std::abs(shaft_mm)) / kMostOfBall});
    made.has_tip = true;
    made.tip = {vec4_from(drag.entry_lps_mm + drag.cut_mm * drag.direction), vec4_from(drag.direction),
                vec4_from({ball_mm, 0.0, 0.0}), vec4_from({drag.tip_mm - at_tip_mm, 0.0, 0.0})};
  }
  return made;
}

bool organ_source(const PushedOrgan& organ, DisplacementSource& source) noexcept {
  CHECK(organ.radius_mm > 0.0);
  const double hold = std::numbers::pi * kAboutOrganShearNMm2 * organ.radius_mm;
  glm::dvec3 moved_mm = organ.force_n / (6.0 * hold);
  glm::dvec3 turned = glm::cross(organ.at_lps_mm - organ.middle_lps_mm, organ.force_n) /
                      (8.0 * hold * organ.radius_mm * organ.radius_mm);
  const double way_mm = std::sqrt(glm::dot(moved_mm, moved_mm));
  const double most_mm = way_mm + organ.radius_mm * std::sqrt(glm::dot(turned, turned));
  if (!(most_mm > kLeastMm)) return false;
  const double share = std::min(1.0, kMostOfOrgan * organ.radius_mm / most_mm);
  source = {vec4_from(organ.middle_lps_mm), vec4_from(share * moved_mm), vec4_from({organ.radius_mm, 0.0, 0.0}),
            vec4_from(share * turned)};
  return true;
}

// What the organ goes along by, the ball at the tip need not: tissue at the tip stays there.
void take_organ_from_tip(const DisplacementSource& organ, DisplacementSource& tip) noexcept {
  const glm::dvec3 left_mm = glm::dvec3(tip.along) * static_cast<double>(tip.amount.x) -
                             shaders::displacement_organ(organ, glm::dvec3(tip.place_mm));
  const double length_mm = std::sqrt(glm::dot(left_mm, left_mm));
  if (length_mm > 0.0) tip.along = vec4_from(left_mm / length_mm);
  tip.amount = vec4_from({length_mm, 0.0, 0.0});
}

bool vein_source(const SqueezedVein& vein, DisplacementSource& source) noexcept {
  const glm::dvec3 axis_mm = vein.to_lps_mm - vein.from_lps_mm;
  const double length_mm = std::sqrt(glm::dot(axis_mm, axis_mm));
  const double share = std::max(kLeastVeinArea, vein.area_share);
  if (!(length_mm > 0.0) || !(vein.radius_mm * (1.0 - share) > kLeastMm)) return false;
  // Its ends close over two diameters, where there is room for them.
  const double end_mm = std::min(4.0 * vein.radius_mm, 0.5 * length_mm);
  source = {vec4_from(vein.from_lps_mm), vec4_from(axis_mm / length_mm),
            vec4_from({vein.radius_mm, length_mm, end_mm}), vec4_from({1.0 - share, 0.0, 0.0})};
  return true;
}

bool breath_source(const Breath& breath, Displacement& made, DisplacementSource& source) noexcept {
  if (!(glm::dot(breath.amount_mm, breath.amount_mm) > kLeastMm * kLeastMm)) return false;
  const BreathRegion& region = breath.region;
  source.place_mm = vec4_from({region.middle_x_mm, region.back_y_mm, region.dome_z_mm});
  source.size_mm = vec4_from({region.half_width_mm, region.depth_mm, region.above_mm}, region.below_mm);
  source.amount = vec4_from(breath.amount_mm);
  if (breath.wall != nullptr) {
    CHECK(breath.wall->step_mm > 0.0);
    source.along = vec4_from(breath.wall->axis_lps_mm, breath.wall->step_mm);
    static_assert(sizeof made.wall_mm == sizeof breath.wall->radius_mm);
    std::memcpy(static_cast<void*>(made.wall_mm), breath.wall->radius_mm.data(), sizeof made.wall_mm);
  }
  return true;
}

}  // namespace

PressedDisk pressed_disk(const SkinPress& press) noexcept {
  CHECK(press.radius_mm > 0.0 && press.per_bone_mm >= 0.0);
  PressedDisk disk;
  if (!(press.depth_mm > 0.0)) return disk;
  disk.bone_mm = press.per_bone_mm > 1.0 / kFarthestBoneMm ? 1.0 / press.per_bone_mm : 0.0;
  disk.depth_mm = std::min(press.depth_mm, kMostOfRadius * press.radius_mm);
  if (disk.bone_mm > 0.0)
    disk.depth_mm = std::min({disk.depth_mm, kMostOfBone * disk.bone_mm,
                              kMostThinness * kMostThinness * disk.bone_mm * disk.bone_mm / press.radius_mm});
  const double hertz_mm = std::sqrt(press.radius_mm * disk.depth_mm);
  const auto amount_mm = [&](double radius_mm) {
    return disk.depth_mm / shaders::displacement_under_disk(0.0, 0.0, disk.bone_mm / radius_mm).y;
  };
  // How far the skin at the contact's edge is below the ball.
  const auto below_mm = [&](double radius_mm) {
    const double skin_mm =
        amount_mm(radius_mm) * shaders::displacement_under_disk(1.0, 0.0, disk.bone_mm / radius_mm).y;
    return skin_mm - (disk.depth_mm - radius_mm * radius_mm / (2.0 * press.radius_mm));
  };
  disk.radius_mm = hertz_mm;
  if (disk.bone_mm > 0.0) {
    double low = hertz_mm, high = 2.0 * hertz_mm;  // incompressible and thin: at most √3 of it
    for (int i = 0; i < 24; ++i) {
      const double middle = 0.5 * (low + high);
      (below_mm(middle) < 0.0 ? low : high) = middle;
    }
    disk.radius_mm = low;
  }
  disk.amount_mm = amount_mm(disk.radius_mm);
  return disk;
}

// Hertz: F = 16/3 G a δ, and there δ = π/2 · amount.
double force_n(const PressedDisk& disk, double shear_n_mm2) noexcept {
  return 8.0 / 3.0 * std::numbers::pi * shear_n_mm2 * disk.radius_mm * disk.amount_mm;
}

double pressure_n_mm2(const SkinPress& press, const glm::dvec3& rest_lps_mm, double shear_n_mm2) noexcept {
  const PressedDisk disk = pressed_disk(press);
  if (!(disk.depth_mm > 0.0)) return 0.0;
  const glm::dvec3 from_mm = rest_lps_mm - press.at_lps_mm;
  const double inwards_mm = glm::dot(from_mm, press.inward);
  const glm::dvec3 across_mm = from_mm - inwards_mm * press.inward;
  const double r = std::sqrt(glm::dot(across_mm, across_mm)) / disk.radius_mm;
  const double z = std::max(inwards_mm / disk.radius_mm, 1e-5);
  double sum = -shaders::disk_potential(r, z).by_z;
  if (disk.bone_mm > 0.0) {
    // Blake 1971, as displacement_under_disk.
    const double h = disk.bone_mm / disk.radius_mm;
    if (z >= h) return 0.0;
    const shaders::DiskPotential image = shaders::disk_potential(r, 2.0 * h - z);
    sum += 2.0 * h * image.by_zz - image.by_z;
  }
  return 2.0 * shear_n_mm2 * disk.amount_mm / disk.radius_mm * sum;
}

double vein_area_share(double outside_n_mm2, double inside_n_mm2) noexcept {
  const double over = (outside_n_mm2 - inside_n_mm2) / kVeinCollapseNMm2;
  if (!(over > 0.0)) return 1.0;
  return std::max(kLeastVeinArea, base::exact_exp(-2.0 / 3.0 * base::exact_log(1.0 + over)));
}

Displacement displacement_of(const Causes& causes) noexcept {
  CHECK(causes.presses.size() <= static_cast<std::size_t>(kMostPresses));
  CHECK(causes.veins.size() <= static_cast<std::size_t>(kMostVeins));
  static_assert(kMostPresses + 2 + kMostVeins + 1 == shaders::kMostDisplacementSources);
  Displacement made{};
  int n = 0;
  for (const SkinPress& press : causes.presses) n += press_source(press, made.source[n]) ? 1 : 0;
  made.contact_end = n;
  CHECK(!causes.organ || causes.presses.size() < static_cast<std::size_t>(kMostPresses));
  DisplacementSource organ{};
  const bool has_organ = causes.organ && organ_source(*causes.organ, organ);
  NeedleSources needle = causes.needle ? needle_sources(*causes.needle) : NeedleSources{};
  if (needle.has_tip && has_organ) take_organ_from_tip(organ, needle.tip);
  if (needle.has_tip) made.source[n++] = needle.tip;
  made.tip_end = n;
  if (needle.has_shaft) made.source[n++] = needle.shaft;
  made.shaft_end = n;
  if (has_organ) made.source[n++] = organ;
  made.organ_end = n;
  for (const SqueezedVein& vein : causes.veins) n += vein_source(vein, made.source[n]) ? 1 : 0;
  made.vein_end = n;
  if (causes.breath) n += breath_source(*causes.breath, made, made.source[n]) ? 1 : 0;
  made.breath_end = n;
  return made;
}

Displacement without_presses(const Displacement& displacement) noexcept {
  Displacement left{};
  const int presses = displacement.contact_end;
  left.tip_end = displacement.tip_end - presses;
  left.shaft_end = displacement.shaft_end - presses;
  left.organ_end = displacement.organ_end - presses;
  left.vein_end = displacement.vein_end - presses;
  left.breath_end = displacement.breath_end - presses;
  for (int i = 0; i < left.breath_end; ++i) left.source[i] = displacement.source[i + presses];
  std::copy(std::begin(displacement.wall_mm), std::end(displacement.wall_mm), std::begin(left.wall_mm));
  return left;
}

int count_sources(const Displacement& displacement) noexcept {
  return displacement.breath_end;
}

glm::dvec3 displaced(const Displacement& displacement, const glm::dvec3& rest_lps_mm) noexcept {
  return rest_lps_mm + shaders::displacement_at(displacement, rest_lps_mm);
}

glm::dvec3 rest_of(const Displacement& displacement, const glm::dvec3& at_lps_mm, InverseSteps steps) noexcept {
  if (count_sources(displacement) == 0) return at_lps_mm;
  return shaders::rest_of(displacement, at_lps_mm, steps.fixed_point, steps.newton);
}

double volume_ratio(const Displacement& displacement, const glm::dvec3& rest_lps_mm) noexcept {
  return shaders::volume_ratio(
      shaders::stretching_at(displacement, rest_lps_mm, shaders::displacement_at(displacement, rest_lps_mm)));
}

}  // namespace seldinger::tissue
