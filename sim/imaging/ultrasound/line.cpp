#include "sim/imaging/ultrasound/line.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "shaders/shared/ultrasound.glsl.h"
#include "sim/base/vectors.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;
constexpr double kMatchedMrayl = 1.65;  // gel and lens
constexpr double kDeadDb = 400.0;       // nothing comes back; keeps sums finite

double amplitude(double db) {
  return std::pow(10.0, db / 20.0);
}

double decibels_of(double amplitude) {
  return 20.0 * std::log10(std::max(amplitude, 1e-12));
}

bool is_gas(TissueClass tissue) {
  return tissue == TissueClass::air || tissue == TissueClass::gas;
}

bool is_usable(const NeedlePose& needle) {
  return base::is_finite(needle.tip_lps_mm) && base::is_finite(needle.direction) &&
         std::isfinite(needle.length_mm) && needle.length_mm > 0.0 && needle.radius_mm > 0.0;
}

// Five voxels, within reason: fewer and the steps of voxels show in the normal.
constexpr double kNormalVoxels = 5.0, kLeastNormalMm = 3.0, kMostNormalMm = 6.0;
// Interfaces whose echo is this far below liver's speckle are not worth their normal.
constexpr double kLeastEchoDb = -10.0;

}  // namespace

struct LineWalker::NeedleCrossing {
  double depth_mm = -1.0;  // of the shaft's near side; < 0: none
  double weight = 0.0;     // how much of the beam meets it
  double tilt_rad = 0.0;   // of the beam off the needle's normal
  double covered = 0.0;    // share of the beam it stands before
  double tip_depth_mm = -1.0, tip_weight = 0.0;
};

LineWalker::LineWalker(const UltrasoundView& view, const TissueAt& tissue_at, const volume::Volume& volume,
                       const Inserted& inserted)
    : view_(view),
      fan_(fan_of(view)),
      tissue_at_(tissue_at),
      neighbours_(neighbours(volume)),
      table_(acoustic_table(view.attenuation_db_cm_mhz)),
      needle_(inserted.needle && is_usable(*inserted.needle) ? &*inserted.needle : nullptr),
      frequency_mhz_(view.frequency_mhz > 0.0 ? view.frequency_mhz : view.probe.frequency_mhz) {
  for (std::size_t i = 0; i < table_.size(); ++i)
    loss_db_mm_[i] =
        shaders::us_loss_db_per_mm(table_[i].attenuation_db_cm_mhz, table_[i].exponent, frequency_mhz_);
}

// Voxels around an interface; whatever lies between the voxels is the same for all of them.
std::vector<LineWalker::Neighbour> LineWalker::neighbours(const volume::Volume& volume) {
  const glm::dmat3 step(volume.lps_from_voxel);
  const glm::dvec3 spacing = volume.spacing_mm;
  const double radius_mm =
      std::clamp(kNormalVoxels * std::cbrt(spacing.x * spacing.y * spacing.z), kLeastNormalMm, kMostNormalMm);
  const glm::ivec3 reach = glm::max(glm::ivec3(radius_mm / spacing), glm::ivec3(1));
  std::vector<Neighbour> all;
  for (int k = -reach.z; k <= reach.z; ++k)
    for (int j = -reach.y; j <= reach.y; ++j)
      for (int i = -reach.x; i <= reach.x; ++i) {
        const glm::dvec3 offset = step * glm::dvec3(i, j, k);
        const glm::dvec3 part = glm::dvec3(i, j, k) * spacing / glm::max(glm::dvec3(radius_mm), spacing);
        const double weight = 1.0 - glm::dot(part, part) / 1.44;
        if (glm::dot(part, part) <= 1.0 && weight > 0.0) all.push_back({offset, weight * offset});
      }
  return all;
}

// From the side that each neighbour is more like.
glm::dvec3 LineWalker::normal_at(const glm::dvec3& p_lps_mm, double before_mrayl, double after_mrayl) const {
  const double middle_mrayl = std::sqrt(before_mrayl * after_mrayl);
  std::array<bool, volume::kTissueClasses> after;
  for (std::size_t i = 0; i < after.size(); ++i)
    after[i] = (table_[i].impedance_mrayl > middle_mrayl) == (after_mrayl > before_mrayl);
  glm::dvec3 sum(0.0);
  for (const Neighbour& n : neighbours_)
    sum += after[static_cast<std::size_t>(tissue_at_(p_lps_mm + n.offset_mm))] ? n.weighted_mm : -n.weighted_mm;
  const double length = glm::length(sum);
  return length > 0.0 ? sum / length : glm::dvec3(0.0);
}

void LineWalker::walk(int beam, bool contact, Line& line) const {
  const auto count = static_cast<std::size_t>(view_.samples);
  line.tissue.resize(count);
  line.loss_db.assign(count, static_cast<float>(kDeadDb));
  line.echoes.clear();
  line.contact = contact;
  if (!contact) {
    std::fill(line.tissue.begin(), line.tissue.end(), TissueClass::air);
    for (int k = 1; k * kLensMm < view_.depth_mm && k <= 20; ++k)
      line.echoes.push_back({k * kLensMm, amplitude(kLensDb - (k - 1) * kLensDbPerLine)});
    return;
  }
  const glm::dvec3 start = fan_.start_lps_mm(beam), direction = fan_.direction(beam);
  const double dz = fan_.sample_mm;
  for (std::size_t k = 0; k < count; ++k)
    line.tissue[k] = tissue_at_(start + ((static_cast<double>(k) + 0.5) * dz) * direction);
  // Gel, unless there is gas beyond what a blurred skin can be.
  std::size_t first = 0;
  while (first < count && is_gas(line.tissue[first])) ++first;
  if (first == count || static_cast<double>(first) * dz > kGelMm) first = 0;

  const NeedleCrossing needle = needle_ != nullptr ? crossing(beam, start, direction) : NeedleCrossing{};
  const double steel_db = shaders::us_step_loss_db(
      shaders::us_reflection(kMatchedMrayl, table_[std::size_t(TissueClass::metal)].impedance_mrayl));
  const double shadow_db =
      needle.covered > 0.0 ? -20.0 * std::log10(1.0 - needle.covered * (1.0 - amplitude(-steel_db))) : 0.0;
  double sum_db = 0.0, before_mrayl = kMatchedMrayl;
  bool needle_above = false;
  for (std::size_t k = first; k < count; ++k) {
    const auto tissue = static_cast<std::size_t>(line.tissue[k]);
    const double mrayl = table_[tissue].impedance_mrayl;
    // The skin of gel and lens is matched: only what reflects much shows at the face.
    if (k == first && mrayl > 0.5 && mrayl < 3.0) before_mrayl = mrayl;
    if (mrayl != before_mrayl && sum_db < kDeadDb) {
      add_interface(start, direction, static_cast<int>(k), before_mrayl, mrayl, sum_db, line);
      sum_db += shaders::us_step_loss_db(shaders::us_reflection(before_mrayl, mrayl));
      before_mrayl = mrayl;
    }
    if (!needle_above && needle.depth_mm >= 0.0 && (static_cast<double>(k) + 0.5) * dz >= needle.depth_mm) {
      needle_above = true;
      sum_db += shadow_db;
    }
    const double step_db = loss_db_mm_[tissue] * dz;
    line.loss_db[k] = static_cast<float>(std::min(kDeadDb, sum_db + 0.5 * step_db));
    sum_db = std::min(kDeadDb, sum_db + step_db);
  }
  for (std::size_t k = 0; k < first; ++k) line.loss_db[k] = 0.0F;
  if (needle_ != nullptr) add_needle(needle, line);
}

void LineWalker::add_interface(const glm::dvec3& start, const glm::dvec3& direction, int sample,
                               double before_mrayl, double after_mrayl, double loss_db, Line& line) const {
  const double reflection = shaders::us_reflection(before_mrayl, after_mrayl);
  const double depth_mm = sample * fan_.sample_mm;
  double cosine = 1.0;
  if (sample > 0) {
    if (decibels_of(std::abs(reflection)) + kInterfaceDb < kLeastEchoDb) return;
    const glm::dvec3 normal = normal_at(start + depth_mm * direction, before_mrayl, after_mrayl);
    cosine = std::clamp(std::abs(glm::dot(normal, direction)), 0.0, 1.0);
  }
  const double tilt_rad = std::acos(cosine);
  const double law = shaders::us_needle_mirror(tilt_rad, kInterfaceConeRad) + amplitude(kInterfaceRoughDb) * cosine;
  const double face = reflection * law * amplitude(kInterfaceDb - loss_db);
  line.echoes.push_back({depth_mm, face});
  if (std::abs(reflection) < kRepeatsFrom || depth_mm <= 0.0) {
    // Gas at the face itself rings in the lens.
    if (std::abs(reflection) >= kRepeatsFrom)
      for (int k = 1; k * kLensMm < view_.depth_mm && k <= 20; ++k)
        line.echoes.push_back({k * kLensMm, amplitude(kLensDb - (k - 1) * kLensDbPerLine)});
    return;
  }
  for (int again = 2; again * depth_mm < view_.depth_mm && again <= 4; ++again)
    line.echoes.push_back({again * depth_mm, face * amplitude(-(again - 1) * (kRepeatDb + loss_db))});
}

LineWalker::NeedleCrossing LineWalker::crossing(int beam, const glm::dvec3& start,
                                                const glm::dvec3& direction) const {
  (void)beam;
  NeedleCrossing at;
  const glm::dvec3 along = glm::normalize(needle_->direction);
  const glm::dvec3 across = glm::cross(fan_.elevation, direction);  // in the plane, square to the beam
  const glm::dvec3 tip = needle_->tip_lps_mm - start;
  const double tip_x = glm::dot(tip, across), tip_y = glm::dot(tip, fan_.elevation),
               tip_z = glm::dot(tip, direction);
  const double x1 = -glm::dot(along, across), y1 = -glm::dot(along, fan_.elevation),
               z1 = -glm::dot(along, direction);
  const auto width_at = [&](double depth_mm) {
    return beam_width(view_.probe, frequency_mhz_, view_.focus_mm, std::clamp(depth_mm, 0.5, view_.depth_mm));
  };
  // The point of the shaft that the beam sees most of; its widths change slowly with depth, twice is enough.
  double t = 0.0;
  for (int round = 0; round < 3; ++round) {
    const BeamWidth width = width_at(tip_z + t * z1);
    const double wx = 1.0 / (width.lateral_sigma_mm * width.lateral_sigma_mm),
                 wy = 1.0 / (width.elevation_sigma_mm * width.elevation_sigma_mm);
    const double curvature = x1 * x1 * wx + y1 * y1 * wy;
    t = curvature > 1e-9 ? std::clamp(-(tip_x * x1 * wx + tip_y * y1 * wy) / curvature, 0.0, needle_->length_mm)
                         : 0.0;
  }
  const auto weight_at = [&](double x, double y, double z) {
    const BeamWidth width = width_at(z);
    const double u = x / width.lateral_sigma_mm, v = y / width.elevation_sigma_mm;
    return std::exp(-0.5 * (u * u + v * v));
  };
  const double z = tip_z + t * z1;
  const double sine = std::min(1.0, std::abs(z1));
  at.tilt_rad = std::asin(sine);
  const double near_mm = z - needle_->radius_mm / std::max(0.25, std::sqrt(1.0 - sine * sine));
  constexpr double kLeastWeight = 0.01;
  const double weight = weight_at(tip_x + t * x1, tip_y + t * y1, z);
  if (near_mm >= 0.0 && near_mm < view_.depth_mm && weight > kLeastWeight) {
    at.depth_mm = near_mm;
    at.weight = weight;
    // A strip as wide as the needle, in a Gaussian beam whose width across the strip is:
    const BeamWidth width = width_at(z);
    const double flat = std::sqrt(x1 * x1 + y1 * y1);  // 0: along the beam, a dot
    const double sigma = flat > 1e-6 ? std::hypot(width.elevation_sigma_mm * x1, width.lateral_sigma_mm * y1) / flat
                                     : width.elevation_sigma_mm;
    at.covered = std::min(0.99, weight * 2.0 * needle_->radius_mm / (2.506628 * sigma));
  }
  if (tip_z >= 0.0 && tip_z < view_.depth_mm) {
    at.tip_weight = weight_at(tip_x, tip_y, tip_z);
    if (at.tip_weight > kLeastWeight) at.tip_depth_mm = tip_z;
  }
  return at;
}

void LineWalker::add_needle(const NeedleCrossing& at, Line& line) const {
  const auto loss_at = [&](double depth_mm) {
    const auto k = static_cast<std::size_t>(std::clamp(depth_mm / fan_.sample_mm - 0.5, 0.0, view_.samples - 1.0));
    return static_cast<double>(line.loss_db[k]);
  };
  if (at.depth_mm >= 0.0) {
    // ½·atan(a/z) of an aperture of half width a.
    const double open_mm = std::min(view_.probe.aperture_mm, std::max(1.0, at.depth_mm) / view_.probe.f_number);
    const double cone_rad = 0.5 * std::atan(0.5 * open_mm / std::max(1.0, at.depth_mm));
    const double mirror = shaders::us_needle_mirror(at.tilt_rad, cone_rad) * amplitude(kNeedleMirrorDb);
    const double fade = view_.echogenic_needle ? kEchogenicFadeDbPerDeg : kPlainFadeDbPerDeg;
    const double tilt_deg = at.tilt_rad * 57.29577951308232;
    const double rough = at.tilt_rad < 1.55 ? amplitude(kNeedleRoughDb - fade * tilt_deg) : 0.0;
    const double through = at.weight * amplitude(-loss_at(at.depth_mm));
    line.echoes.push_back({at.depth_mm, std::max(mirror, rough) * through});
    // Lines from inside: the lumen of a hollow one, as deep as saline shows it; the steel of a solid one.
    const double spacing_mm = needle_->inner_radius_mm > 0.0 ? 2.0 * needle_->inner_radius_mm * 1540.0 / 1480.0
                                                             : 2.0 * needle_->radius_mm * 1540.0 / 5790.0;
    for (int n = 1; n <= 8 && mirror > rough; ++n)
      line.echoes.push_back({at.depth_mm + n * spacing_mm, mirror * through * amplitude(-n * kTailDbPerLine)});
  }
  if (at.tip_depth_mm >= 0.0)
    line.echoes.push_back({at.tip_depth_mm, at.tip_weight * amplitude(kNeedleTipDb - loss_at(at.tip_depth_mm))});
}

}  // namespace seldinger::imaging
