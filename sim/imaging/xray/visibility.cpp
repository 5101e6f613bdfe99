#include "sim/imaging/xray/visibility.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "sim/base/vectors.h"
#include "sim/case/lesion_form.h"
#include "sim/imaging/segment_clip.h"
#include "sim/imaging/xray/instruments.h"

namespace seldinger::imaging {
namespace {

constexpr double kPi = std::numbers::pi;

// The ray through a point, on to the panel.
struct RayThrough {
  RaySegment ray;
  glm::dvec3 hit_lps_mm;
  double magnification = 1.0;
  double focus_panel_mm = 1000.0;  // along the panel's normal
};

std::optional<RayThrough> ray_through(const volume::Volume& volume, const XrayGeometry& g,
                                      const glm::dvec3& p_lps_mm, double parallel_sid_mm) {
  if (!base::is_finite(p_lps_mm)) return std::nullopt;
  const glm::dvec3 normal = glm::cross(g.u, g.v);
  RayThrough through;
  if (g.source_lps_mm) {
    const double depth = glm::dot(p_lps_mm - *g.source_lps_mm, normal);
    const double distance = glm::dot(g.detector_center_lps_mm - *g.source_lps_mm, normal);
    if (!(depth * distance > 0.0) || !(std::abs(depth) <= std::abs(distance))) return std::nullopt;
    through.magnification = distance / depth;
    through.focus_panel_mm = std::abs(distance);
    through.hit_lps_mm = *g.source_lps_mm + through.magnification * (p_lps_mm - *g.source_lps_mm);
    through.ray = {*g.source_lps_mm, through.hit_lps_mm};
    return through;
  }
  const double ahead_mm = glm::dot(g.detector_center_lps_mm - p_lps_mm, normal) / glm::dot(g.direction, normal);
  if (!(ahead_mm >= 0.0)) return std::nullopt;
  through.focus_panel_mm = parallel_sid_mm;
  through.hit_lps_mm = p_lps_mm + ahead_mm * g.direction;
  const RaySegment first = ray_of(g, volume, 0, 0);  // long enough for every pixel
  through.ray = {through.hit_lps_mm - (glm::length(first.to_lps_mm - first.from_lps_mm)) * g.direction,
                 through.hit_lps_mm};
  return through;
}

// What lies on a ray once, and what of it is contrast medium.
struct Laid {
  Inserted inserted;
  std::optional<Inserted> in_iodine;  // the same in EnhancedTissue's volume; nothing: the CT is not enhanced
  double contrast_mm = 0.0;           // that was injected
};

// Of the volume alone.
struct OnRay {
  RayLengths lengths;
  double iodine_mm = 0.0;  // at 1000 HU more
};

double log_share(const BeamSignal& beam, const volume::Volume& volume, const RaySegment& ray, const OnRay& on_ray,
                 const Laid& laid, const EnhancedTissue* enhanced) {
  const OverlaidLengths overlaid = overlaid_lengths(volume, ray, laid.inserted, ProjectionMethod::exact);
  const double water_mm = on_ray.lengths.water_mm + overlaid.water_mm,
               mineral_mm = on_ray.lengths.mineral_mm + overlaid.mineral_mm;
  if (enhanced == nullptr) return beam.log_share(water_mm, mineral_mm, overlaid.iron_mm, laid.contrast_mm);
  const OverlaidLengths here = overlaid_lengths(*enhanced->volume, ray, *laid.in_iodine, ProjectionMethod::exact);
  const double iodine_mm = on_ray.iodine_mm + here.water_mm + here.mineral_mm;
  return beam.log_share(water_mm, mineral_mm - iodine_mm, overlaid.iron_mm,
                        laid.contrast_mm + enhanced->contrast_mm * iodine_mm);
}

std::optional<Inserted> in_iodine(const EnhancedTissue* enhanced, const Inserted& inserted) {
  return enhanced != nullptr ? std::optional(enhanced->inserted_here(inserted)) : std::nullopt;
}

double contrast_between_mm(const volume::Volume* contrast, const glm::dvec3& from_lps_mm,
                           const glm::dvec3& to_lps_mm) {
  return contrast != nullptr ? lengths_between(*contrast, from_lps_mm, to_lps_mm).water_mm : 0.0;
}

Contrast contrast_on(const volume::Volume& volume, const RayThrough& through, const BeamSignal& beam,
                     const Pulse& pulse, const Laid& with, const Laid& without, double patch_mm2,
                     const EnhancedTissue* enhanced) {
  const RaySegment& ray = through.ray;
  OnRay on_ray{lengths_between(volume, ray.from_lps_mm, ray.to_lps_mm)};
  if (enhanced != nullptr)
    on_ray.iodine_mm = lengths_between(*enhanced->volume, ray.from_lps_mm, ray.to_lps_mm).total_mm();
  const double log_with = log_share(beam, volume, ray, on_ray, with, enhanced);
  const double log_without = log_share(beam, volume, ray, on_ray, without, enhanced);
  const double primary = std::exp(log_without), all = primary + pulse.scatter.value_or(0.0);
  const double quanta = all * pulse.grid_passes() * beam.open_quanta_per_mas_mm2() * pulse.mas() * patch_mm2 * 1e6 /
                        (through.focus_panel_mm * through.focus_panel_mm);
  Contrast contrast{std::abs(std::expm1(log_with - log_without)),
                    quanta > 0.0 ? 1.0 / std::sqrt(quanta) : std::numeric_limits<double>::infinity()};
  if (pulse.scatter) {
    contrast.relative *= all > 0.0 ? primary / all : 0.0;
    contrast.least_sigmas = kVisibleSigmasInScatter;
  }
  return contrast;
}

// Half sides of the open field on the panel.
std::pair<double, double> open_half_mm(const XrayGeometry& g, const cases::Collimator& collimator) noexcept {
  return {0.5 * g.pixel_mm * g.width_px * collimator.open_u, 0.5 * g.pixel_mm * g.height_px * collimator.open_v};
}

bool in_field(const XrayGeometry& g, const cases::Collimator& collimator, const glm::dvec3& hit_lps_mm) noexcept {
  const auto [half_u_mm, half_v_mm] = open_half_mm(g, collimator);
  const glm::dvec3 from_center_mm = hit_lps_mm - g.detector_center_lps_mm;
  return std::abs(glm::dot(from_center_mm, g.u)) <= half_u_mm &&
         std::abs(glm::dot(from_center_mm, g.v)) <= half_v_mm;
}

// The part of the shaft whose shadow falls into the field, by s from the tip (0) to the hub (1). Where the shadow
// of a point lies is a ratio; multiplied by its depth, every border is a plane.
SegmentPart shaft_in_field(const XrayGeometry& g, const cases::Collimator& collimator,
                           const NeedlePose& needle) noexcept {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const glm::dvec3 shaft_mm = -needle.length_mm * needle.direction;
  const auto [half_u_mm, half_v_mm] = open_half_mm(g, collimator);
  glm::dvec3 normal = glm::cross(g.u, g.v);
  const glm::dvec3 from = g.source_lps_mm ? *g.source_lps_mm : g.detector_center_lps_mm;
  const glm::dvec3 start = needle.tip_lps_mm - from, center = g.detector_center_lps_mm - from;
  SegmentPart part;
  if (!g.source_lps_mm) {
    if (glm::dot(g.direction, normal) < 0.0) normal = -normal;
    part = clip(part, glm::dot(start, normal), glm::dot(shaft_mm, normal), -kFar, 0.0);
    const auto shift = [&](const glm::dvec3& p) {
      return p - g.direction * (glm::dot(p, normal) / glm::dot(g.direction, normal));
    };
    part = clip(part, glm::dot(shift(start), g.u), glm::dot(shift(shaft_mm), g.u), -half_u_mm, half_u_mm);
    return clip(part, glm::dot(shift(start), g.v), glm::dot(shift(shaft_mm), g.v), -half_v_mm, half_v_mm);
  }
  if (glm::dot(center, normal) < 0.0) normal = -normal;
  const double distance = glm::dot(center, normal);
  const double depth = glm::dot(start, normal), deeper = glm::dot(shaft_mm, normal);
  part = clip(part, depth, deeper, 1e-6 * distance, distance);
  for (const auto& [axis, half_mm] : {std::pair{g.u, half_u_mm}, std::pair{g.v, half_v_mm}}) {
    // |distance·(p·axis)/depth − center·axis| ≤ half
    const double at = distance * glm::dot(start, axis), along = distance * glm::dot(shaft_mm, axis);
    const double middle = glm::dot(center, axis);
    part = clip(part, at - (middle + half_mm) * depth, along - (middle + half_mm) * deeper, -kFar, 0.0);
    part = clip(part, at - (middle - half_mm) * depth, along - (middle - half_mm) * deeper, 0.0, kFar);
  }
  return part;
}

}  // namespace

std::optional<Contrast> needle_contrast(const volume::Volume& volume, const XrayGeometry& geometry,
                                        const BeamSignal& beam, const Pulse& pulse, const Inserted& inserted,
                                        double behind_tip_mm, const volume::Volume* contrast,
                                        const EnhancedTissue* enhanced) {
  if (!inserted.needle || !is_finite(*inserted.needle)) return std::nullopt;
  const NeedlePose& needle = *inserted.needle;
  const auto through =
      ray_through(volume, geometry, needle.tip_lps_mm - behind_tip_mm * needle.direction, pulse.sid_mm);
  if (!through) return std::nullopt;
  const glm::dvec3 along = glm::normalize(through->ray.to_lps_mm - through->ray.from_lps_mm);
  const double across = glm::length(glm::cross(along, needle.direction));
  const double width_mm = 2.0 * needle.radius_mm * through->magnification;
  const double length_mm =
      std::max(width_mm, std::min(kTipElementMm, needle.length_mm) * across * through->magnification);
  const Laid with{inserted, in_iodine(enhanced, inserted),
                  contrast_between_mm(contrast, through->ray.from_lps_mm, through->ray.to_lps_mm)};
  Laid without = with;
  without.inserted.needle.reset();
  if (without.in_iodine) without.in_iodine->needle.reset();
  return contrast_on(volume, *through, beam, pulse, with, without, width_mm * length_mm, enhanced);
}

std::optional<Contrast> target_contrast(const volume::Volume& volume, const XrayGeometry& geometry,
                                        const BeamSignal& beam, const Pulse& pulse, const Inserted& inserted,
                                        const volume::Volume* contrast, const EnhancedTissue* enhanced) {
  if (inserted.lesions.empty()) return std::nullopt;
  const cases::Lesion& target = inserted.lesions.front();
  const auto through = ray_through(volume, geometry, target.center_lps_mm, pulse.sid_mm);
  if (!through) return std::nullopt;
  Laid with{{std::nullopt, inserted.lesions}, in_iodine(enhanced, {std::nullopt, inserted.lesions})};
  if (target.in_volume()) {  // drawn as the ball of its volume: once as it is, once as what was there
    with.inserted.lesions.front().shape = nullptr;
    if (with.in_iodine) with.in_iodine->lesions.front().shape = nullptr;
  }
  Laid without = with;
  const auto about = target.in_volume() ? std::optional(target.around_hu) : cases::hu_about(volume, target);
  for (Inserted* laid : {&without.inserted, without.in_iodine ? &*without.in_iodine : nullptr}) {
    if (laid == nullptr) continue;
    if (about)
      laid->lesions.front().hu =
          laid == &without.inserted ? *about : cases::hu_about(*enhanced->volume, target).value_or(kNotEnhancedHu);
    else
      laid->lesions.erase(laid->lesions.begin());
  }
  const double shadow_mm2 =
      kPi * target.radius_mm * target.radius_mm * through->magnification * through->magnification;
  // What fills the target is its own; what lies before and behind it is there with and without it.
  const RaySegment& ray = through->ray;
  const Chord ball = sphere_chord(ray, target.center_lps_mm, target.radius_mm);
  const auto at = [&](double t) { return ray.from_lps_mm + t * (ray.to_lps_mm - ray.from_lps_mm); };
  with.contrast_mm = contrast_between_mm(contrast, ray.from_lps_mm, ray.to_lps_mm);
  without.contrast_mm = with.contrast_mm - contrast_between_mm(contrast, at(ball.enter), at(ball.leave));
  return contrast_on(volume, *through, beam, pulse, with, without, std::min(shadow_mm2, kLargestPatchMm2),
                     enhanced);
}

Visible xray_visible(const volume::Volume& volume, const XrayGeometry& geometry, const BeamSignal& beam,
                     const Pulse& pulse, const Inserted& inserted, const volume::Volume* contrast,
                     const EnhancedTissue* enhanced) {
  Visible visible;
  const auto hit_in_field = [&](const glm::dvec3& p_lps_mm) {
    const auto through = ray_through(volume, geometry, p_lps_mm, pulse.sid_mm);
    return through && in_field(geometry, pulse.collimator, through->hit_lps_mm);
  };
  if (inserted.needle && is_finite(*inserted.needle)) {
    const NeedlePose& needle = *inserted.needle;
    const auto seen_at = [&](double behind_tip_mm) {
      const auto found =
          needle_contrast(volume, geometry, beam, pulse, inserted, behind_tip_mm, contrast, enhanced);
      return found && found->visible();
    };
    visible.needle_tip =
        hit_in_field(needle.tip_lps_mm) && seen_at(0.5 * std::min(kTipElementMm, needle.length_mm));
    const SegmentPart part = shaft_in_field(geometry, pulse.collimator, needle);
    if (part.from <= part.to && seen_at(0.5 * (part.from + part.to) * needle.length_mm))
      visible.needle_length_mm = (part.to - part.from) * needle.length_mm;
  }
  if (!inserted.lesions.empty() && hit_in_field(inserted.lesions.front().center_lps_mm)) {
    const auto found = target_contrast(volume, geometry, beam, pulse, inserted, contrast, enhanced);
    visible.target = found && found->visible();
  }
  visible.joint = visible.needle_tip && visible.target;
  return visible;
}

}  // namespace seldinger::imaging
