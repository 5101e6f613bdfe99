#include "sim/imaging/xray/instruments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/shared/xray.glsl.h"
#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

constexpr Chord kEmpty{1.0, 0.0};

Chord limited(double enter, double leave) {
  return {std::max(0.0, enter), std::min(1.0, leave)};
}

bool holds(const Chord& chord, double t) {
  return t > chord.enter && t < chord.leave;
}

// The chords of one ray: what lies where, by priority.
struct Pierced {
  Chord needle = kEmpty, lumen = kEmpty;
  std::array<Chord, kMaxLesions> lesions;

  Pierced(const RaySegment& ray, const Inserted& inserted) {
    lesions.fill(kEmpty);
    if (inserted.needle && is_finite(*inserted.needle)) {
      const NeedlePose& n = *inserted.needle;
      needle = cylinder_chord(ray, n.tip_lps_mm, n.direction, n.length_mm, n.radius_mm);
      if (n.inner_radius_mm > 0.0)
        lumen = cylinder_chord(ray, n.tip_lps_mm, n.direction, n.length_mm, n.inner_radius_mm);
    }
    for (std::size_t i = 0; i < inserted.lesions.size(); ++i)
      if (!inserted.lesions[i].in_volume())
        lesions[i] = sphere_chord(ray, inserted.lesions[i].center_lps_mm, inserted.lesions[i].radius_mm);
  }

  // Where something begins or ends, in order.
  std::vector<double> ends(std::size_t lesion_count) const {
    std::vector<double> t;
    const auto add = [&](const Chord& chord) {
      if (chord.enter < chord.leave) t.insert(t.end(), {chord.enter, chord.leave});
    };
    add(needle);
    add(lumen);
    for (std::size_t i = 0; i < lesion_count; ++i) add(lesions[i]);
    std::sort(t.begin(), t.end());
    return t;
  }
};

// A thick line on the picture that covers what the spheres around two points (and all between them) cast: pixels
// within `half_width` of the line from `from` to `to`. Nothing: it may be anywhere.
struct Shadow {
  glm::dvec2 from, to;
  double half_width = 0.0;
};

std::optional<Shadow> shadow_of(const XrayGeometry& geometry, const glm::dvec3& one_lps_mm,
                                const glm::dvec3& other_lps_mm, double radius_mm) {
  Shadow shadow;
  const auto from = pixel_of(geometry, one_lps_mm), to = pixel_of(geometry, other_lps_mm);
  if (!from || !to) return std::nullopt;
  shadow.from = *from;
  shadow.to = *to;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 side = radius_mm * (2.0 * glm::dvec3(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1) - 1.0);
    const auto a = pixel_of(geometry, one_lps_mm + side), b = pixel_of(geometry, other_lps_mm + side);
    if (!a || !b) return std::nullopt;
    shadow.half_width = std::max({shadow.half_width, glm::length(*a - *from), glm::length(*b - *to)});
  }
  shadow.half_width += 1.0;
  return shadow;
}

// Marks the pixels of a shadow.
void mark(const XrayGeometry& geometry, const std::optional<Shadow>& shadow, std::vector<bool>& marked) {
  if (!shadow) {
    marked.assign(marked.size(), true);
    return;
  }
  const double width = geometry.width_px, h = shadow->half_width;
  const glm::dvec2 a = shadow->from, along = shadow->to - shadow->from;
  const auto row_of = [&](double y) { return static_cast<int>(std::clamp(y, 0.0, geometry.height_px + 0.0)); };
  const int first = row_of(std::floor(std::min(a.y, shadow->to.y) - h));
  const int end = row_of(std::ceil(std::max(a.y, shadow->to.y) + h) + 1.0);
  for (int row = first; row < end; ++row) {
    double s0 = 0.0, s1 = 1.0;  // the part of the line that comes within h of the row
    if (std::abs(along.y) > 1e-9) {
      const double one = (row - h - a.y) / along.y, other = (row + h - a.y) / along.y;
      s0 = std::max(s0, std::min(one, other));
      s1 = std::min(s1, std::max(one, other));
    }
    if (s0 > s1) continue;
    const double x0 = a.x + s0 * along.x, x1 = a.x + s1 * along.x;
    const auto left = static_cast<std::size_t>(std::clamp(std::floor(std::min(x0, x1) - h), 0.0, width));
    const auto right = static_cast<std::size_t>(std::clamp(std::ceil(std::max(x0, x1) + h) + 1.0, 0.0, width));
    const std::size_t begin = static_cast<std::size_t>(row) * static_cast<std::size_t>(geometry.width_px);
    for (std::size_t column = left; column < right; ++column) marked[begin + column] = true;
  }
}

}  // namespace

Chord cylinder_chord(const RaySegment& ray, const glm::dvec3& tip_lps_mm, const glm::dvec3& direction,
                     double length_mm, double radius_mm) noexcept {
  const glm::dvec3 along = ray.to_lps_mm - ray.from_lps_mm, from_tip = ray.from_lps_mm - tip_lps_mm;
  // Between the flat ends: 0 ≤ −(from_tip + t·along)·direction ≤ length.
  const double back = -glm::dot(from_tip, direction), slope = -glm::dot(along, direction);
  Chord chord{0.0, 1.0};
  if (slope != 0.0) {
    const double tip = -back / slope, hub = (length_mm - back) / slope;
    chord = limited(std::min(tip, hub), std::max(tip, hub));
  } else if (!(back >= 0.0 && back <= length_mm)) {
    return kEmpty;
  }
  // Within the radius. The nearest point first, so that nothing cancels for a thin needle far from the source.
  const glm::dvec3 across = along + slope * direction, offset = from_tip + back * direction;
  const double across_2 = glm::dot(across, across);
  if (!(across_2 > 1e-24 * glm::dot(along, along)))
    return glm::dot(offset, offset) <= radius_mm * radius_mm ? chord : kEmpty;
  const double nearest = -glm::dot(offset, across) / across_2;
  const glm::dvec3 miss = offset + nearest * across;
  const double half_2 = radius_mm * radius_mm - glm::dot(miss, miss);
  if (!(half_2 > 0.0)) return kEmpty;
  const double half = std::sqrt(half_2 / across_2);
  return {std::max(chord.enter, nearest - half), std::min(chord.leave, nearest + half)};
}

Chord sphere_chord(const RaySegment& ray, const glm::dvec3& center_lps_mm, double radius_mm) noexcept {
  const glm::dvec3 along = ray.to_lps_mm - ray.from_lps_mm, from_center = ray.from_lps_mm - center_lps_mm;
  const double along_2 = glm::dot(along, along);
  if (!(along_2 > 0.0)) return kEmpty;
  const double nearest = -glm::dot(from_center, along) / along_2;
  const glm::dvec3 miss = from_center + nearest * along;
  const double half_2 = radius_mm * radius_mm - glm::dot(miss, miss);
  if (!(half_2 > 0.0)) return kEmpty;
  const double half = std::sqrt(half_2 / along_2);
  return limited(nearest - half, nearest + half);
}

OverlaidLengths overlaid_lengths(const volume::Volume& volume, const RaySegment& ray, const Inserted& inserted,
                                 ProjectionMethod method) {
  const Pierced pierced(ray, inserted);
  const std::vector<double> t = pierced.ends(inserted.lesions.size());
  OverlaidLengths lengths;
  const glm::dvec3 along = ray.to_lps_mm - ray.from_lps_mm;
  const double length_mm = glm::length(along);
  double displaced_from = 0.0;
  bool displacing = false;
  const auto displace = [&](double to) {
    const RayLengths tissue =
        lengths_between(volume, ray.from_lps_mm + displaced_from * along, ray.from_lps_mm + to * along, method);
    lengths.water_mm -= tissue.water_mm;
    lengths.mineral_mm -= tissue.mineral_mm;
    displacing = false;
  };
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    const double middle = 0.5 * (t[i] + t[i + 1]), piece_mm = (t[i + 1] - t[i]) * length_mm;
    if (!(piece_mm > 0.0)) continue;
    bool owned = true;
    if (holds(pierced.needle, middle)) {
      if (!holds(pierced.lumen, middle)) lengths.iron_mm += piece_mm;
    } else {
      const auto lesion = std::find_if(pierced.lesions.begin(), pierced.lesions.end(),
                                       [&](const Chord& chord) { return holds(chord, middle); });
      owned = lesion != pierced.lesions.end();
      if (owned) {
        const double hu = inserted.lesions[static_cast<std::size_t>(lesion - pierced.lesions.begin())].hu;
        lengths.water_mm += piece_mm * shaders::xray_water(hu);
        lengths.mineral_mm += piece_mm * shaders::xray_mineral(hu);
      }
    }
    if (displacing && !owned) displace(t[i]);
    if (!displacing && owned) {
      displaced_from = t[i];
      displacing = true;
    }
  }
  if (displacing) displace(t.back());
  return lengths;
}

void overlay_instruments(const volume::Volume& volume, const XrayGeometry& geometry, const Inserted& inserted,
                         ProjectionMethod method, PathLengths& lengths) {
  CHECK(inserted.lesions.size() <= static_cast<std::size_t>(kMaxLesions));
  CHECK(lengths.width_px == geometry.width_px && lengths.height_px == geometry.height_px);
  std::vector<bool> marked(lengths.water_mm.size(), false);
  const bool needle = inserted.needle && is_finite(*inserted.needle);
  if (needle) {
    const NeedlePose& n = *inserted.needle;
    mark(geometry, shadow_of(geometry, n.tip_lps_mm, n.tip_lps_mm - n.length_mm * n.direction, n.radius_mm),
         marked);
    lengths.iron_mm.assign(lengths.water_mm.size(), 0.0F);
  }
  for (const cases::Lesion& lesion : inserted.lesions)
    if (!lesion.in_volume())
      mark(geometry, shadow_of(geometry, lesion.center_lps_mm, lesion.center_lps_mm, lesion.radius_mm), marked);
  for (std::size_t i = 0; i < marked.size(); ++i) {
    if (!marked[i]) continue;
    const auto width = static_cast<std::size_t>(geometry.width_px);
    const RaySegment ray = ray_of(geometry, volume, static_cast<int>(i % width), static_cast<int>(i / width));
    const OverlaidLengths one = overlaid_lengths(volume, ray, inserted, method);
    const bool split = !lengths.mineral_mm.empty();
    // Rounding of the volume's own lengths must not leave less than nothing.
    lengths.water_mm[i] =
        std::max(0.0F, static_cast<float>(lengths.water_mm[i] + one.water_mm + (split ? 0.0 : one.mineral_mm)));
    if (split) lengths.mineral_mm[i] = std::max(0.0F, static_cast<float>(lengths.mineral_mm[i] + one.mineral_mm));
    if (needle) lengths.iron_mm[i] = static_cast<float>(one.iron_mm);
  }
}

}  // namespace seldinger::imaging
