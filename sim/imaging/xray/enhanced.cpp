#include "sim/imaging/xray/enhanced.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "sim/base/check.h"
#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/instruments.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

// A mean of so much more over a voxel and its six neighbours of the same class is enhancement; less is noise and
// what people differ by.
constexpr double kLeastEnhancementHu = 30.0;

// By class, in whole HU; nothing is enhanced where the highest is 0.
struct Levels {
  int plain_hu = 0, highest_hu = 0;
  bool hold(double hu) const noexcept { return hu > plain_hu && hu <= highest_hu; }
};

Levels levels_of(TissueClass tissue, double ct_kev) {
  const auto most_hu = most_enhanced_hu(tissue, ct_kev);
  return most_hu ? Levels{static_cast<int>(volume::typical_hu(tissue)), static_cast<int>(*most_hu)} : Levels{};
}

using AllLevels = std::array<Levels, volume::kTissueClasses>;

AllLevels all_levels(double ct_kev) {
  AllLevels levels;
  for (std::size_t at = 0; at < levels.size(); ++at) levels[at] = levels_of(static_cast<TissueClass>(at), ct_kev);
  return levels;
}

// What iodine adds to a voxel; 0: it is not enhanced.
int more_hu(const cases::Case& scene, const AllLevels& levels, const glm::ivec3& at, std::size_t voxel) {
  const TissueClass tissue = scene.classes[voxel];
  const Levels& level = levels[static_cast<std::size_t>(tissue)];
  const volume::Volume& patient = scene.volume;
  if (!level.hold(patient.hu[voxel])) return 0;
  double sum = patient.hu[voxel];
  int count = 1;
  std::size_t stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto add = [&](bool there, std::size_t other) {
      if (!there || scene.classes[other] != tissue || patient.hu[other] > level.highest_hu) return;
      sum += patient.hu[other];
      ++count;
    };
    add(at[axis] > 0, voxel - stride);
    add(at[axis] + 1 < patient.size_voxels[axis], voxel + stride);
    stride *= static_cast<std::size_t>(patient.size_voxels[axis]);
  }
  return sum < count * (level.plain_hu + kLeastEnhancementHu) ? 0 : patient.hu[voxel] - level.plain_hu;
}

}  // namespace

// Blood: a well filled aorta has 300 to 400 HU at 120 kV, by some 25 HU for a mg of iodine in a ml (Bae, Radiology
// 256 (2010) 32; recalled), which is 12 to 16 mg/ml; twice that, since fast injections and small patients have
// more. Organs: a kidney has 220 HU at the most (sim/volume/tissue/contrast.cpp), 8 mg/ml; twice that. Urine:
// kidneys concentrate it much further; at 60 mg/ml many stones are still below, so that in a lumen full of contrast
// they are not told from it. All three are judgement.
std::optional<double> most_enhanced_hu(TissueClass tissue, double ct_kev) {
  constexpr double kBloodMgMl = 30.0, kOrganMgMl = 16.0, kUrineMgMl = 60.0;
  switch (tissue) {
    case TissueClass::vessel:
      return volume::typical_hu(tissue) + kBloodMgMl * iodine_hu_per_mg_ml(ct_kev);
    case TissueClass::liver:
    case TissueClass::kidney:
    case TissueClass::spleen:
      return volume::typical_hu(tissue) + kOrganMgMl * iodine_hu_per_mg_ml(ct_kev);
    case TissueClass::fluid:
      return volume::typical_hu(tissue) + kUrineMgMl * iodine_hu_per_mg_ml(ct_kev);
    default:
      return std::nullopt;
  }
}

Inserted EnhancedTissue::inserted_here(const Inserted& inserted) const {
  CHECK(inserted.lesions.size() <= lesions_hu->size());
  Inserted here = inserted;
  for (std::size_t i = 0; i < here.lesions.size(); ++i) here.lesions[i].hu = (*lesions_hu)[i];
  return here;
}

PathLengths EnhancedTissue::project(const XrayGeometry& geometry, const CpuOptions& options) const {
  CpuOptions sum = options;
  sum.basis = Basis::total;
  return projector->project(geometry, ProjectionMethod::exact, sum);
}

void tell_iodine(const EnhancedTissue& tissue, const XrayGeometry& geometry, const Inserted& inserted,
                 PathLengths enhanced, PathLengths& lengths) {
  CHECK(enhanced.water_mm.size() == lengths.water_mm.size());
  overlay_instruments(*tissue.volume, geometry, tissue.inserted_here(inserted), ProjectionMethod::exact, enhanced);
  lengths.contrast_mm.resize(lengths.water_mm.size(), 0.0F);
  const auto contrast_mm = static_cast<float>(tissue.contrast_mm);
  for (std::size_t i = 0; i < lengths.water_mm.size(); ++i) {
    lengths.mineral_mm[i] = std::max(0.0F, lengths.mineral_mm[i] - enhanced.water_mm[i]);
    lengths.contrast_mm[i] += contrast_mm * enhanced.water_mm[i];
  }
}

Enhancement::Enhancement(const cases::Case& scene) : ct_kev_(ct_effective_kev(scene.ct_tube_kv)) {
  if (scene.classes.empty()) return;
  CHECK(scene.classes.size() == scene.volume.hu.size());
  lay(scene, ct_kev_);
  // A drawn lesion is of the class that the CT has in its middle: a calyx that is drawn over itself.
  for (const cases::Lesion& lesion : scene.lesions) {
    double more = 0.0;
    const glm::ivec3 at(
        glm::round(glm::dvec3(volume::voxel_from_lps(scene.volume) * glm::dvec4(lesion.center_lps_mm, 1.0))));
    if (!lesion.in_volume() && glm::all(glm::greaterThanEqual(at, glm::ivec3(0))) &&
        glm::all(glm::lessThan(at, scene.volume.size_voxels))) {
      const Levels level = levels_of(scene.classes[scene.volume.index(at.x, at.y, at.z)], ct_kev_);
      if (level.hold(lesion.hu) && lesion.hu >= level.plain_hu + kLeastEnhancementHu)
        more = lesion.hu - level.plain_hu;
    }
    lesions_hu_.push_back(kNotEnhancedHu + more);
  }
  const bool any_lesion =
      std::any_of(lesions_hu_.begin(), lesions_hu_.end(), [](double hu) { return hu > kNotEnhancedHu; });
  if (volume_.hu.empty() && any_lesion) {  // a voxel with nothing in it, over which they are laid
    volume_.size_voxels = glm::ivec3(1);
    volume_.spacing_mm = scene.volume.spacing_mm;
    volume_.lps_from_voxel = scene.volume.lps_from_voxel;
    volume_.hu = {static_cast<std::int16_t>(kNotEnhancedHu)};
  }
  if (!volume_.hu.empty()) projector_.emplace(volume_);
}

// The box has a voxel more on each side, for interpolation of what moves; it begins where voxels of the moved
// patient do, so that both are resampled at the same places.
void Enhancement::lay(const cases::Case& scene, double ct_kev) {
  const volume::Volume& patient = scene.volume;
  const AllLevels levels = all_levels(ct_kev);
  struct Found {
    std::uint32_t voxel;
    std::int16_t hu;
  };
  std::vector<Found> found;
  glm::ivec3 low = patient.size_voxels, high(-1);
  std::size_t voxel = 0;
  for (int k = 0; k < patient.size_voxels.z; ++k)
    for (int j = 0; j < patient.size_voxels.y; ++j)
      for (int i = 0; i < patient.size_voxels.x; ++i, ++voxel) {
        if (levels[static_cast<std::size_t>(scene.classes[voxel])].highest_hu == 0) continue;
        const glm::ivec3 at(i, j, k);
        const int more = more_hu(scene, levels, at, voxel);
        if (more == 0) continue;
        low = glm::min(low, at);
        high = glm::max(high, at);
        found.push_back({static_cast<std::uint32_t>(voxel), static_cast<std::int16_t>(kNotEnhancedHu + more)});
      }
  if (found.empty()) return;
  const glm::ivec3 joined = joined_voxels(patient, {});
  low = (low - 1 + joined) / joined * joined - joined;  // down to a multiple, also below 0
  high += 1;
  volume_.size_voxels = high - low + 1;
  volume_.spacing_mm = patient.spacing_mm;
  volume_.lps_from_voxel = patient.lps_from_voxel;
  volume_.lps_from_voxel[3] = patient.lps_from_voxel * glm::dvec4(glm::dvec3(low), 1.0);
  volume_.hu.assign(static_cast<std::size_t>(volume_.size_voxels.x) *
                        static_cast<std::size_t>(volume_.size_voxels.y) *
                        static_cast<std::size_t>(volume_.size_voxels.z),
                    static_cast<std::int16_t>(kNotEnhancedHu));
  for (const Found& one : found) {
    const auto row = static_cast<std::uint32_t>(patient.size_voxels.x);
    const std::uint32_t slice = row * static_cast<std::uint32_t>(patient.size_voxels.y);
    const glm::ivec3 at = glm::ivec3(one.voxel % row, one.voxel % slice / row, one.voxel / slice) - low;
    volume_.hu[volume_.index(at.x, at.y, at.z)] = one.hu;
  }
}

EnhancedTissue Enhancement::at_rest() const {
  CHECK(any());
  return {&volume_, &*projector_, &lesions_hu_, contrast_mm_of_1000_hu(ct_kev_)};
}

EnhancedTissue Enhancement::moved(const tissue::Displacement& displacement, const XrayGeometry& geometry) {
  CHECK(any());
  if (!moved_) moved_.emplace(volume_);
  moved_->move(displacement, geometry);
  return {&moved_->volume(), &moved_->projector(), &lesions_hu_, contrast_mm_of_1000_hu(ct_kev_)};
}

}  // namespace seldinger::imaging
