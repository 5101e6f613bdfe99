#include "sim/haptics/needle/needle_path.h"

#include <algorithm>
#include <cmath>
#include <glm/vector_relational.hpp>

#include "sim/base/check.h"

namespace seldinger::haptics {
namespace {

using volume::TissueClass;

constexpr double kStepMm = 0.5;
// CT tells no skin; it is this thick on trunk (design; 1.5-2.5 mm in textbooks).
constexpr double kSkinMm = 2.0;
// What is thinner is a voxel's fleck or partial volume, with no capsule of its own (design: about two voxels).
constexpr double kThinnestMm = 2.0;
constexpr double kInsideMm = 1e-6;  // of distances, of which the sign alone is asked

bool is_lesion(TissueClass tissue) {
  return static_cast<std::size_t>(tissue) >= volume::kTissueClasses;
}

}  // namespace

TissueAlongNeedle::TissueAlongNeedle(const volume::Volume& volume, std::span<const TissueClass> classes,
                                     const cases::Gauge& gauge, std::span<const cases::Lesion> lesions,
                                     const cases::Touch& touch)
    : volume_(&volume),
      classes_(classes),
      voxel_from_lps_(volume::voxel_from_lps(volume)),
      gauge_(gauge),
      touch_(touch) {
  CHECK(classes.size() == volume.hu.size());
  for (const NeedleTissueRow& row : needle_tissues())
    rows_[static_cast<std::size_t>(row.tissue)] = felt_by(row.needle, gauge, touch);
  for (std::size_t i = 0; i < lesions.size(); ++i) {
    const cases::Lesion& lesion = lesions[i];
    const bool by_hu = lesion.kind == cases::LesionKind::by_hu;
    if ((by_hu && lesion.in_volume()) || !(lesion.radius_mm > 0.0)) continue;
    const cases::Shape shape = cases::shape_of(lesion);
    lesions_.push_back({static_cast<TissueClass>(volume::kTissueClasses + i), shape, cases::bounds_of(shape),
                        felt_by(needle_tissue(lesion), gauge, touch), lesion.hu});
  }
}

const TissueAlongNeedle::Felt* TissueAlongNeedle::lesion_at(const glm::dvec3& p_lps_mm) const noexcept {
  for (const Felt& felt : lesions_)
    if (glm::all(glm::greaterThanEqual(p_lps_mm, felt.bounds.low_lps_mm)) &&
        glm::all(glm::lessThanEqual(p_lps_mm, felt.bounds.high_lps_mm)) &&
        cases::signed_distance_mm(felt.shape, p_lps_mm, kInsideMm) <= 0.0)
      return &felt;
  return nullptr;
}

const NeedleTissue& TissueAlongNeedle::row(TissueClass tissue) const noexcept {
  for (const Felt& felt : lesions_)
    if (felt.as == tissue) return felt.tissue;
  const auto at = static_cast<std::size_t>(tissue);
  return rows_[at < rows_.size() ? at : 0];
}

TissueAlongNeedle::Sample TissueAlongNeedle::at(const glm::dvec3& p_lps_mm) const noexcept {
  if (const Felt* felt = lesion_at(p_lps_mm)) return {felt->as, felt->hu};
  const glm::dvec3 index(voxel_from_lps_ * glm::dvec4(p_lps_mm, 1.0));
  if (!volume::inside(*volume_, index)) return {TissueClass::air, volume::kAirHu};
  const auto nearest = [](double value, int size) {
    return std::clamp(static_cast<int>(std::floor(value + 0.5)), 0, size - 1);
  };
  const glm::ivec3& size = volume_->size_voxels;
  const std::size_t voxel =
      volume_->index(nearest(index.x, size.x), nearest(index.y, size.y), nearest(index.z, size.z));
  return {classes_[voxel], static_cast<double>(volume_->hu[voxel])};
}

void TissueAlongNeedle::add(double start_mm, TissueClass tissue, NeedlePath& path) const noexcept {
  if (path.count == kMostNeedleLayers || (path.count > 0 && path.tissues[path.count - 1] == tissue)) return;
  NeedleTissue next = row(tissue);
  // What lies about a lesion has no capsule there: its edge is the lesion's on the way out as on the way in.
  if (path.count > 0 && is_lesion(path.tissues[path.count - 1]) && !next.impenetrable) {
    const NeedleTissue& lesion = path.layers[path.count - 1].tissue;
    next.rupture_n = lesion.rupture_n;
    next.dent_mm = lesion.dent_mm;
  }
  path.tissues[path.count] = tissue;
  path.layers[path.count++] = {start_mm, next};
}

void TissueAlongNeedle::look(const glm::dvec3& entry_lps_mm, const glm::dvec3& direction, double length_mm,
                             double depth_mm, const NeedleTrack& track, NeedlePath& path) const noexcept {
  const double reached_mm = std::max(depth_mm, track.cut_mm);
  std::size_t kept = std::min(track.opened, path.count);
  while (kept < path.count && path.layers[kept].start_mm <= reached_mm) ++kept;
  path.count = kept;
  if (path.count == 0) add(0.0, TissueClass::skin, path);

  // Runs of one class; a run becomes a layer once it is long enough, bone and metal at once.
  // Always at the same depths, so that a path looked up in pieces is the whole one.
  const double from_mm = std::max(kSkinMm, kStepMm * std::ceil(reached_mm / kStepMm));
  TissueClass run = path.tissues[path.count - 1];
  double run_mm = from_mm, sum_hu = 0.0, n = 0.0;
  const std::size_t fixed = path.count;
  for (int i = 0; from_mm + kStepMm * i <= length_mm; ++i) {
    const double along_mm = from_mm + kStepMm * i;
    const Sample sample = at(entry_lps_mm + along_mm * direction);
    if (sample.tissue != run) {
      run = sample.tissue;
      run_mm = along_mm;
      sum_hu = n = 0.0;
    }
    sum_hu += sample.hu;
    n += 1.0;
    const bool hard = row(run).impenetrable;
    if (hard || along_mm - run_mm >= kThinnestMm) add(run_mm, run, path);
    if (run == TissueClass::soft_tissue && path.count > fixed && path.tissues[path.count - 1] == run)
      path.layers[path.count - 1].tissue = felt_by(soft_tissue_of_hu(sum_hu / n), gauge_, touch_);
  }
}

}  // namespace seldinger::haptics
