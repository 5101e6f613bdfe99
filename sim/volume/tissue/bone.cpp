// Bone by shape and place: what is bright, drains from no pool of contrast, and is as bright, as large and as
// shallow as bone. Its share of a voxel follows from the voxel's HU, which lies between that of its surroundings
// and bone's.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "sim/volume/components.h"
#include "sim/volume/tissue/class_steps.h"
#include "sim/volume/tissue/pools.h"

namespace seldinger::volume {
namespace by_shape {  // files of a folder are compiled as one
namespace {

constexpr int kMetalHu = 2500, kMetalRimHu = 1000;  // as rule 1
constexpr double kMetalRimMm = 1.5;
constexpr int kContrastHu = 200;    // the highest of enhanced parenchyma
constexpr double kMuscleHu = 55.0;  // Prokop and Galanski, Spiral and Multislice CT of the Body (Thieme 2003)
constexpr double kFromHu = 130.0, kNoiseAbove = 3.0;     // an eighth of cortex in muscle; and above its noise
constexpr double kCoreHu = 180.0, kAboveBloodHu = 60.0;  // a fifth of cortex; and more than any contrast here
// Of a rib and its marrow where a coarse voxel averages both: cortex 700 and more, a third marrow of 250.
constexpr double kWholeHu = 600.0;
constexpr double kRibMl = 1.0;                              // a piece of an artery beyond its tree is smaller
constexpr double kHeldByContrast = 0.5, kHeldByBone = 0.4;  // of a surface; a vessel on bone: less than a third
constexpr int kNoContrastHu =
    200;  // above the brightest contrast: a rib beside a kidney, whose blurred rim the kidney takes
constexpr double kHeldBrightByBone = 0.5;               // as bright as blood of an early angiogram
constexpr double kEnhancedMl = 30.0;                    // more than thyroid and cartilage without contrast
constexpr double kDrainedMl = 100.0;                    // the same with its blurred edge
constexpr double kDeepMm = 35.0, kDeepBoneMl = 20.0;    // ribs lie above; deeper bones are larger or have marrow
constexpr double kDeepShare = 0.9;                      // a rib is deep beside the spine only
constexpr double kByLungMm = 15.0, kByLungShare = 0.5;  // as ribs are named (docs/decisions/0086)
constexpr double kInLungMm = 2.0, kInLungShare = 0.8;   // and a voxel; a vessel of the lung has lung all around
constexpr double kSkinMm = 4.0, kGapMm = 2.0, kUnit = 8.0;
constexpr int kLeastFatHu = -200, kFatHu = -30;                // the middle between fat, -100, and tissue, 40
constexpr double kClassShare = 0.4, kCoarseClassShare = 0.35;  // a rib of 7 mm fills a third of many of 5 mm
constexpr double kWhole = 255.0;
constexpr int kLeastMarrowHu = 90;  // below it a voxel is muscle, fat or nearly so

struct Left {  // a piece of what is bright and no contrast
  std::size_t voxels = 0, faces = 0, contrast_faces = 0, deep = 0, by_lung = 0, in_lung = 0;
  int peak_hu = -1024;
  bool marrow = false;  // holds spongy bone
  bool cut = false;     // by a side of the field

  bool mostly(std::size_t some, double share) const {
    return static_cast<double>(some) > share * static_cast<double>(voxels);
  }
};

class BoneFinder {
 public:
  BoneFinder(const Volume& volume, std::vector<TissueClass>& classes, std::vector<std::uint8_t>& share)
      : volume_(volume),
        classes_(classes),
        share_(share),
        n_(volume.size_voxels),
        row_(static_cast<std::size_t>(n_.x)),
        slice_(row_ * static_cast<std::size_t>(n_.y)),
        voxel_ml_(volume.spacing_mm.x * volume.spacing_mm.y * volume.spacing_mm.z * 1e-3),
        smooth_(smooth_of(volume, classes)) {}

  void find() {
    mark_metal();
    pools_ = find_pools(volume_, smooth_, classes_);
    bone_.assign(classes_.size(), 0);
    mark_left();
    join_held_pools();
    fill_holes();
    weigh();
    // Where a pool reaches, blood makes a voxel brighter too.
    const bool coarse = is_coarse(volume_);
    for (std::size_t at = 0; at < classes_.size(); ++at) {
      if (classes_[at] == TissueClass::air || classes_[at] == TissueClass::metal) continue;
      const double least = coarse && !pools_.enhanced(at) ? kCoarseClassShare : kClassShare;
      if (share_[at] >= kWhole * least)
        classes_[at] = TissueClass::bone;
      else if (classes_[at] == TissueClass::bone)
        classes_[at] = TissueClass::soft_tissue;
      else if (classes_[at] == TissueClass::soft_tissue && smooth_.hu[at] >= kContrastHu && bone_[at] == 0)
        classes_[at] = TissueClass::vessel;
    }
  }

 private:
  // Visits the voxels across the faces of a run of a row; false where the volume ends.
  template <typename Face>
  void each_face(std::size_t begin, std::size_t end, const Face& face) const {
    const std::size_t j = begin / row_ % static_cast<std::size_t>(n_.y), k = begin / slice_;
    if (begin % row_ != 0) face(begin - 1);
    if (end % row_ != 0) face(end);
    for (std::size_t at = begin; at < end; ++at) {
      if (j > 0) face(at - row_);
      if (j + 1 < static_cast<std::size_t>(n_.y)) face(at + row_);
      if (k > 0) face(at - slice_);
      if (k + 1 < static_cast<std::size_t>(n_.z)) face(at + slice_);
    }
  }

  void mark_metal() {
    const int r = std::clamp(static_cast<int>(std::lround(kMetalRimMm / volume_.spacing_mm.x)), 1, 8);
    std::vector<std::size_t> metal;
    for (int k = 0; k < n_.z; ++k)
      for (int j = 0; j < n_.y; ++j)
        for (int i = 0; i < n_.x; ++i) {
          if (volume_.at(i, j, k) < kMetalHu || classes_[volume_.index(i, j, k)] == TissueClass::air) continue;
          for (int y = std::max(0, j - r); y <= std::min(n_.y - 1, j + r); ++y)
            for (int x = std::max(0, i - r); x <= std::min(n_.x - 1, i + r); ++x)
              if (volume_.at(x, y, k) >= kMetalRimHu) metal.push_back(volume_.index(x, y, k));
        }
    for (const std::size_t at : metal) classes_[at] = TissueClass::metal;
  }

  // From the marked voxels, in eighths of a mm up to `far`, along the axes.
  std::vector<std::uint16_t> distance_from(const std::vector<std::uint8_t>& marked, std::uint16_t far) const {
    std::vector<std::uint16_t> distance(marked.size(), far);
    const glm::ivec3 step(glm::round(volume_.spacing_mm * kUnit));
    for (const bool forward : {true, false})
      for (int kk = 0; kk < n_.z; ++kk)
        for (int jj = 0; jj < n_.y; ++jj)
          for (int ii = 0; ii < n_.x; ++ii) {
            const std::size_t at =
                forward ? volume_.index(ii, jj, kk) : volume_.index(n_.x - 1 - ii, n_.y - 1 - jj, n_.z - 1 - kk);
            int least = marked[at] != 0 ? 0 : distance[at];
            if (ii > 0) least = std::min(least, distance[forward ? at - 1 : at + 1] + step.x);
            if (jj > 0) least = std::min(least, distance[forward ? at - row_ : at + row_] + step.y);
            if (kk > 0) least = std::min(least, distance[forward ? at - slice_ : at + slice_] + step.z);
            distance[at] = static_cast<std::uint16_t>(least);
          }
    return distance;
  }

  // Farther than kDeepMm below the outermost muscle: the fat under the skin, which may be thick, does not count.
  std::vector<std::uint8_t> deep() const {
    std::vector<std::uint8_t> outer(classes_.size());
    for (std::size_t at = 0; at < outer.size(); ++at) outer[at] = classes_[at] == TissueClass::air ? 1 : 0;
    const auto skin = distance_from(outer, static_cast<std::uint16_t>(2.0 * kSkinMm * kUnit));
    const auto fat = [&](std::size_t at) {
      return outer[at] != 0 || skin[at] <= kSkinMm * kUnit ||
             (classes_[at] == TissueClass::soft_tissue && smooth_.hu[at] > kLeastFatHu && smooth_.hu[at] < kFatHu);
    };
    const auto far = [&](double spacing_mm) {
      return static_cast<std::size_t>(std::max(1L, std::lround(kGapMm / spacing_mm)));
    };
    const std::size_t dx = far(volume_.spacing_mm.x), dy = far(volume_.spacing_mm.y) * row_;
    std::vector<std::size_t> front;
    for (std::size_t at = 0; at < outer.size(); ++at)
      if (outer[at] == 0 && skin[at] <= kSkinMm * kUnit) front.push_back(at);
    while (!front.empty()) {
      const std::size_t at = front.back();
      front.pop_back();
      if (outer[at] != 0) continue;
      outer[at] = 1;
      each_face(at, at + 1, [&](std::size_t other) {
        if (outer[other] != 0 || !fat(other) || other < dy || other + dy >= outer.size()) return;
        // Through no gap that is narrower than twice this.
        if (fat(other - dx) && fat(other + dx) && fat(other - dy) && fat(other + dy)) front.push_back(other);
      });
    }
    const auto limit = static_cast<std::uint16_t>(kDeepMm * kUnit);
    const auto distance = distance_from(outer, limit);
    std::vector<std::uint8_t> made(distance.size());
    std::transform(distance.begin(), distance.end(), made.begin(),
                   [&](std::uint16_t d) { return static_cast<std::uint8_t>(d >= limit ? 1 : 0); });
    return made;
  }

  // The level of the brightest contrast, and whether there is any.
  void weigh_contrast() {
    double ml = 0.0;
    for (const Pool& pool : pools_.pools) {
      const double here_ml = static_cast<double>(pool.inner) * voxel_ml_;
      if (pool.marrow) continue;
      ml += here_ml;
      if (here_ml >= 1.0) contrast_hu_ = std::max(contrast_hu_, pool.level_hu);
    }
    double drained_ml = 0.0;
    for (std::size_t at = 0; at < classes_.size(); ++at) drained_ml += pools_.enhanced(at) ? voxel_ml_ : 0.0;
    enhanced_ = ml >= kEnhancedMl || drained_ml >= kDrainedMl;
  }

  bool is_bone(const Left& piece) const {
    if (piece.marrow) return true;
    const double ml = static_cast<double>(piece.voxels) * voxel_ml_;
    const bool in_lung = piece.mostly(piece.in_lung, kInLungShare);
    const bool by_lung = !in_lung && piece.mostly(piece.by_lung, kByLungShare);
    const bool held_by_contrast =
        static_cast<double>(piece.contrast_faces) > kHeldByContrast * static_cast<double>(piece.faces);
    if (piece.peak_hu < contrast_hu_ + kNoContrastHu && (held_by_contrast || (enhanced_ && in_lung))) return false;
    // Of what a side of the field cuts nobody knows where the rest lies.
    const bool deep = piece.mostly(piece.deep, kDeepShare) && !by_lung && !piece.cut;
    if (enhanced_ && deep && ml < kDeepBoneMl) return false;
    return piece.peak_hu >= std::max(kCoreHu, contrast_hu_ + kAboveBloodHu) ||
           ((ml >= kRibMl || (by_lung && is_coarse(volume_))) && piece.peak_hu >= kCoreHu);
  }

  bool at_side(std::size_t at) const {
    const std::size_t i = at % row_, j = at / row_ % static_cast<std::size_t>(n_.y);
    return i == 0 || j == 0 || i + 1 == row_ || j + 1 == static_cast<std::size_t>(n_.y);
  }

  void mark_left() {
    weigh_contrast();
    const double from_hu = std::max(kFromHu, kMuscleHu + kNoiseAbove * smooth_.noise_sd_hu);
    const std::vector<std::uint8_t> is_deep = enhanced_ ? deep() : std::vector<std::uint8_t>(classes_.size(), 0);
    std::vector<std::uint8_t> open(classes_.size()), lung(classes_.size());
    for (std::size_t at = 0; at < lung.size(); ++at) lung[at] = classes_[at] == TissueClass::lung ? 1 : 0;
    const auto from_lung = distance_from(lung, static_cast<std::uint16_t>(2.0 * kByLungMm * kUnit));
    for (std::size_t at = 0; at < open.size(); ++at)
      open[at] = classes_[at] == TissueClass::soft_tissue && smooth_.hu[at] >= from_hu && !pools_.enhanced(at);
    const double in_lung_mm = kInLungMm + std::max(volume_.spacing_mm.x, volume_.spacing_mm.y);
    Components pieces(n_, open);
    std::vector<Left> left(pieces.numbers());
    pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
      Left& one = left[piece];
      one.voxels += end - begin;
      for (std::size_t at = begin; at < end; ++at) {
        one.peak_hu = std::max<int>(one.peak_hu, smooth_.hu[at]);
        one.deep += is_deep[at];
        one.by_lung += from_lung[at] <= kByLungMm * kUnit ? 1 : 0;
        one.in_lung += from_lung[at] <= in_lung_mm * kUnit ? 1 : 0;
        one.cut = one.cut || at_side(at);
        one.marrow = one.marrow || (pools_.core[at] != 0 && pools_.pools[pools_.of[at] - 1U].spongy);
      }
      each_face(begin, end, [&](std::size_t other) {
        if (open[other] != 0) return;
        ++one.faces;
        one.contrast_faces += pools_.enhanced(other) ? 1 : 0;
      });
    });
    pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
      if (is_bone(left[piece]))
        std::fill(bone_.begin() + static_cast<std::ptrdiff_t>(begin),
                  bone_.begin() + static_cast<std::ptrdiff_t>(end), std::uint8_t{1});
    });
  }

  // A pool that bone holds is its spongy part: a vertebra's end between two slices has no bright rim.
  void join_held_pools() {
    std::vector<std::size_t> faces(pools_.pools.size() + 1, 0), held(pools_.pools.size() + 1, 0);
    for (std::size_t at = 0; at < classes_.size(); ++at) {
      if (!pools_.enhanced(at)) continue;
      const std::uint16_t pool = pools_.of[at];
      each_face(at, at + 1, [&](std::size_t other) {
        if (pools_.of[other] == pool) return;
        ++faces[pool];
        held[pool] += bone_[other];
      });
    }
    for (std::size_t pool = 1; pool < faces.size(); ++pool)
      held[pool] = static_cast<double>(held[pool]) >
                           (pools_.pools[pool - 1].level_hu < kAboveSpongyHu ? kHeldByBone : kHeldBrightByBone) *
                               static_cast<double>(faces[pool])
                       ? 1
                       : 0;
    for (std::size_t at = 0; at < classes_.size(); ++at)
      if (pools_.enhanced(at) && held[pools_.of[at]] != 0) bone_[at] = 1;
  }

  void fill_holes() {
    for (std::size_t at = 0; at < classes_.size(); ++at)
      if (bone_[at] != 0) classes_[at] = TissueClass::bone;
    fill_marrow(volume_, classes_);
    for (std::size_t at = 0; at < classes_.size(); ++at)
      if (classes_[at] == TissueClass::bone) bone_[at] = 1;
  }

  // Inside bone, and in marrow with one pore beside it, a voxel is whole; at the surface and one voxel beyond its
  // HU tells.
  void weigh() {
    share_.assign(classes_.size(), 0);
    for (int k = 0; k < n_.z; ++k)
      for (int j = 0; j < n_.y; ++j)
        for (int i = 0; i < n_.x; ++i) {
          const std::size_t at = volume_.index(i, j, k);
          if (classes_[at] == TissueClass::air || classes_[at] == TissueClass::metal) continue;
          int bones = 0, faces = 0;
          each_face(at, at + 1, [&](std::size_t other) {
            ++faces;
            bones += bone_[other];
          });
          if (bone_[at] == 0 && bones == 0) continue;
          // Marrow with a pore beside it is no surface; muscle that smoothing made bright is.
          const bool whole =
              bone_[at] != 0 && (bones == faces || (bones + 1 == faces && volume_.hu[at] >= kLeastMarrowHu));
          share_[at] = whole ? std::uint8_t{255} : share_at(i, j, k);
        }
  }

  std::uint8_t share_at(int i, int j, int k) const {
    double around_hu = 0.0;
    int count = 0;
    for (int z = std::max(0, k - 1); z <= std::min(n_.z - 1, k + 1); ++z)
      for (int y = std::max(0, j - 1); y <= std::min(n_.y - 1, j + 1); ++y)
        for (int x = std::max(0, i - 1); x <= std::min(n_.x - 1, i + 1); ++x) {
          const std::size_t other = volume_.index(x, y, z);
          if (bone_[other] != 0 || classes_[other] == TissueClass::air || volume_.hu[other] >= kFromHu) continue;
          around_hu += volume_.hu[other];
          ++count;
        }
    const double around = count > 0 ? std::clamp(around_hu / count, -100.0, 120.0) : kMuscleHu;
    const double share = (volume_.at(i, j, k) - around) / (kWholeHu - around);
    return static_cast<std::uint8_t>(std::lround(kWhole * std::clamp(share, 0.0, 1.0)));
  }

  const Volume& volume_;
  std::vector<TissueClass>& classes_;
  std::vector<std::uint8_t>& share_;
  glm::ivec3 n_;
  std::size_t row_, slice_;
  double voxel_ml_;
  Smooth smooth_;
  Pools pools_;
  std::vector<std::uint8_t> bone_;
  int contrast_hu_ = 0;
  bool enhanced_ = false;
};

}  // namespace
}  // namespace by_shape

void mark_bone_by_shape(const Volume& volume, std::vector<TissueClass>& classes, std::vector<std::uint8_t>& bone) {
  by_shape::BoneFinder(volume, classes, bone).find();
}

}  // namespace seldinger::volume
