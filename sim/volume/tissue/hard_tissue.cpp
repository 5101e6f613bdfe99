// Bone by hysteresis and connectivity, metal, and contrast that must be neither. Candidates are bright voxels;
// bone's core is denser than enhanced blood; a thick bright plateau that bone does not surround is contrast; what
// remains and is joined to a core is bone, however blurred.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "sim/volume/axial_slices.h"
#include "sim/volume/components.h"
#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace {

// HU of smoothed voxels. Blood and kidney reach 300; in an early angiogram blood passes the core's HU.
constexpr int kBrightHu = 150, kContrastHu = 200, kCoreHu = 380;
constexpr int kPlateauHu = 105;   // so that noise tears no hole into vessels of 145
constexpr int kSureCoreHu = 600;  // a single raw voxel of a thin cortex
constexpr int kDenseFromHu = 280, kDenseContrastHu = 650;
constexpr int kMetalHu = 2500, kMetalRimHu = 1000;
constexpr double kMetalRimMm = 1.5;
constexpr double kPlateauRadiusMm = 3.5;  // thicker than blurred cortex of ribs and laminae
constexpr double kCoreReachMm = 1.5;      // blur of a core's edge: nearer is bone whatever the plateau
constexpr double kPlateauReachMm = 3.0;   // blur of the plateau's edge
constexpr int kCortexAboveMarrowHu = 60;  // five times the noise of a smoothed noisy picture
constexpr int kSurroundedBy = 6;          // of 8 directions in the slice; a vessel beside a vertebra: at most 4
constexpr double kHeldByBone = 0.4;       // of a plateau's surface; a vessel that lies on bone: less than a third
constexpr int kMarrowHu = 100;            // more than muscle and what the spinal canal holds
constexpr double kAcrossMarrowMm = 32.0;  // half a vertebral body and a little
constexpr double kAcrossPoreMm = 6.0;     // less than half a spinal canal
constexpr int kNothing = -32768;

enum Mark : std::uint8_t {
  kBright = 1,
  kCore = 2,
  kContrast = 4,
  kMetal = 8,
  kPlateau = 16,
  kMarrow = 32,
  kPale = 64
};

class Slice {
 public:
  Slice(const Volume& volume, std::uint8_t* marks)
      : width_(volume.size_voxels.x),
        height_(volume.size_voxels.y),
        spacing_mm_(volume.spacing_mm),
        marks_(marks),
        low_(width_, height_) {
    for (int y = 0; y < height_; ++y) {
      const std::uint8_t *first = marks + at(0, y), *end = first + width_;
      const auto marked = [](std::uint8_t m) { return m != 0; };
      const std::uint8_t* begin = std::find_if(first, end, marked);
      if (begin == end) continue;
      while (end[-1] == 0) --end;
      low_ = glm::min(low_, glm::ivec2(begin - first, y));
      high_ = glm::max(high_, glm::ivec2(end - first - 1, y));
    }
  }

  glm::ivec2 radius(double mm) const {
    return {std::max(1, static_cast<int>(std::lround(mm / spacing_mm_.x))),
            std::max(1, static_cast<int>(std::lround(mm / spacing_mm_.y)))};
  }

  // Voxels of `where` within `mm` of marked ones along such voxels get the mark too, if none of `but`.
  void spread(std::uint8_t mark, std::uint8_t where, std::uint8_t but, double mm) {
    const glm::ivec2 r = radius(mm);
    const auto w = static_cast<std::size_t>(width_);
    front_.clear();
    for (int y = low_.y; y <= high_.y; ++y)
      for (std::size_t v = at(low_.x, y); v <= at(high_.x, y); ++v)
        if ((marks_[v] & mark) != 0) front_.push_back(v);
    for (int step = 0; step < std::max(r.x, r.y); ++step, std::swap(front_, reached_)) {
      reached_.clear();
      const auto reach = [&](std::size_t v) {
        if ((marks_[v] & where) == 0 || (marks_[v] & (mark | but)) != 0) return;
        marks_[v] |= mark;
        reached_.push_back(v);
      };
      for (const std::size_t v : front_) {
        const std::size_t x = v % w;
        if (step < r.x && x > 0) reach(v - 1);
        if (step < r.x && x + 1 < w) reach(v + 1);
        if (step < r.y && v >= w) reach(v - w);
        if (step < r.y && v / w + 1 < static_cast<std::size_t>(height_)) reach(v + w);
      }
    }
  }

  // Pale voxels with something much brighter in most directions, before the pale part ends, are marrow.
  void mark_marrow(const std::vector<std::int16_t>& smooth) {
    count_directions([&](std::size_t v, int brightest) -> int {
      if ((marks_[v] & kPale) == 0) return kNothing;
      if (brightest >= smooth[v] + kCortexAboveMarrowHu) ++directions_[v];
      return std::max<int>(brightest, smooth[v]);
    });
    for (std::size_t v = 0; v < directions_.size(); ++v)
      if (directions_[v] >= kSurroundedBy) marks_[v] |= kMarrow;
  }

  void fill_holes(const std::vector<std::int16_t>& smooth, TissueClass* classes) {
    const double mm = std::max(spacing_mm_.x, spacing_mm_.y);
    const int marrow = static_cast<int>(kAcrossMarrowMm / mm),
              pore = std::max(1, static_cast<int>(kAcrossPoreMm / mm));
    near_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    count_directions([&](std::size_t v, int since) -> int {
      if (classes[v] == TissueClass::bone) return 0;
      if (since == kNothing || since >= marrow) return kNothing;
      ++directions_[v];
      if (since < pore) ++near_[v];
      return since + 1;
    });
    for (std::size_t v = 0; v < directions_.size(); ++v)
      if (classes[v] == TissueClass::soft_tissue &&
          (near_[v] == 8 || (directions_[v] >= kSurroundedBy && smooth[v] >= kMarrowHu)))
        classes[v] = TissueClass::bone;
  }

  // What is as dense as a core but wide and even, without denser rim, is contrast of an early phase. Bone like that
  // comes back by the bone that holds it.
  void mark_dense_plateaus(const std::vector<std::int16_t>& smooth) {
    if (!open_where([&](std::size_t v) {
          return (marks_[v] & (kPale | kMarrow | kMetal)) == kPale && smooth[v] >= kDenseFromHu &&
                 smooth[v] < kDenseContrastHu;
        }))
      return;
    const std::size_t w = static_cast<std::size_t>(width_);
    for (std::size_t v = 0; v < opened_.size(); ++v)
      if (opened_[v] != 0) marks_[v] = static_cast<std::uint8_t>((marks_[v] & ~kCore) | kPlateau);
    // And the core that is left of its round edge.
    for (std::size_t v = w; v + w < opened_.size(); ++v)
      if ((marks_[v] & kCore) != 0 && smooth[v] < kDenseContrastHu &&
          (opened_[v - 1] != 0 || opened_[v + 1] != 0 || opened_[v - w] != 0 || opened_[v + w] != 0))
        marks_[v] = static_cast<std::uint8_t>((marks_[v] & ~kCore) | kPlateau);
  }

  // Pale voxels that are neither core nor marrow and that a square of them covers.
  void mark_plateaus() {
    if (!open_where([&](std::size_t v) { return (marks_[v] & (kPale | kCore | kMarrow)) == kPale; })) return;
    for (std::size_t v = 0; v < opened_.size(); ++v)
      if (opened_[v] != 0) marks_[v] |= kPlateau;
  }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  // What a square of such voxels covers is left in opened_; false when there is none such.
  template <typename Which>
  bool open_where(const Which& which) {
    glm::ivec2 low(width_, height_), high(-1);
    opened_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    for (int y = low_.y; y <= high_.y; ++y)
      for (int x = low_.x; x <= high_.x; ++x) {
        if (!which(at(x, y))) continue;
        opened_[at(x, y)] = 1;
        low = glm::min(low, glm::ivec2(x, y));
        high = glm::max(high, glm::ivec2(x, y));
      }
    if (high.x < 0) return false;
    // Only where there is something, with a rim of nothing around it.
    const glm::ivec2 r = radius(kPlateauRadiusMm);
    low = glm::max(low - r - 1, glm::ivec2(0));
    high = glm::min(high + r + 1, glm::ivec2(width_, height_) - 1);
    const glm::ivec2 size = high - low + 1;
    const auto w = static_cast<std::size_t>(size.x);
    part_.resize(w * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
      std::copy_n(opened_.data() + at(low.x, low.y + y), w, part_.data() + static_cast<std::size_t>(y) * w);
    grow_slice(part_, size.x, size.y, r, 0, scratch_);
    grow_slice(part_, size.x, size.y, r, 1, scratch_);
    for (int y = 0; y < size.y; ++y)
      std::copy_n(part_.data() + static_cast<std::size_t>(y) * w, w, opened_.data() + at(low.x, low.y + y));
    return true;
  }

  // Walks through the slice in 8 directions; step(voxel, what it returned one voxel before).
  template <typename Step>
  void count_directions(const Step& step) {
    directions_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_), 0);
    if (high_.x < low_.x) return;
    const auto w = static_cast<std::size_t>(high_.x - low_.x + 1);
    std::vector<int> before(w + 2), here(w + 2);  // one beyond each end of a row
    for (const bool forward : {true, false}) {
      for (const std::size_t across : {0U, 1U, 2U}) {
        std::fill(before.begin(), before.end(), kNothing);
        std::fill(here.begin(), here.end(), kNothing);
        for (int row = 0; row <= high_.y - low_.y; ++row) {
          const std::size_t start = at(low_.x, forward ? low_.y + row : high_.y - row);
          for (std::size_t x = 0; x < w; ++x) here[x + 1] = step(start + x, before[x + across]);
          std::swap(before, here);
        }
      }
      for (int y = low_.y; y <= high_.y; ++y) {
        int last = kNothing;
        const std::size_t start = at(low_.x, y);
        for (std::size_t x = 0; x < w; ++x) last = step(start + (forward ? x : w - 1 - x), last);
      }
    }
  }

  int width_, height_;
  glm::dvec3 spacing_mm_;
  std::uint8_t* marks_;
  glm::ivec2 low_, high_{-1};  // the box around all marks; empty: high < low
  std::vector<std::size_t> front_, reached_;
  std::vector<std::uint8_t> directions_, near_, opened_, part_;
  std::vector<int> scratch_;
};

// 0 where nothing is bright.
std::uint8_t marks_of(int smooth_hu, int raw_hu) {
  // The smooth picture alone would widen bone by the voxel that smoothing spreads it over.
  const bool bright = raw_hu >= kSureCoreHu || (smooth_hu >= kBrightHu && raw_hu >= kPlateauHu);
  if (!bright) return smooth_hu >= kPlateauHu ? kPale : 0;
  std::uint8_t marks = kBright | kPale;
  if (smooth_hu >= kContrastHu) marks |= kContrast;
  if (smooth_hu >= kCoreHu || raw_hu >= kSureCoreHu) marks |= kCore;
  if (raw_hu >= kMetalHu) marks |= kMetal;
  return marks;
}

void mark_metal_rim(const Volume& volume, std::uint8_t* marks, const std::int16_t* hu) {
  const int radius = std::clamp(static_cast<int>(std::lround(kMetalRimMm / volume.spacing_mm.x)), 1, 8);
  const int width = volume.size_voxels.x, height = volume.size_voxels.y;
  std::vector<std::size_t> rim;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      if ((marks[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)] &
           kMetal) == 0)
        continue;
      for (int b = std::max(0, y - radius); b <= std::min(height - 1, y + radius); ++b)
        for (int a = std::max(0, x - radius); a <= std::min(width - 1, x + radius); ++a) {
          const std::size_t v =
              static_cast<std::size_t>(b) * static_cast<std::size_t>(width) + static_cast<std::size_t>(a);
          if (hu[v] >= kMetalRimHu) rim.push_back(v);
        }
    }
  for (const std::size_t v : rim) marks[v] |= kBright | kMetal;
}

// Bone is whatever is bright, no plateau, and joined to a core.
void flood_bone(const Volume& volume, const std::vector<std::uint8_t>& marks, std::vector<TissueClass>& classes) {
  std::vector<std::uint8_t> open(marks.size());
  std::transform(marks.begin(), marks.end(), open.begin(), [](std::uint8_t m) {
    return static_cast<std::uint8_t>((m & kBright) != 0 && ((m & kPlateau) == 0 || (m & kCore) != 0) ? 1 : 0);
  });
  Components pieces(volume.size_voxels, open);
  std::vector<std::uint8_t> has_core(pieces.numbers(), 0);
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at)
      if ((marks[at] & kCore) != 0) has_core[piece] = 1;
  });
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    if (has_core[piece] != 0)
      for (std::size_t at = begin; at < end; ++at) classes[at] = TissueClass::bone;
  });
}

// A plateau that bone holds is its spongy part: a vertebra's end between two slices has no bright rim.
void join_held_plateaus(const Volume& volume, const std::vector<std::uint8_t>& marks,
                        std::vector<TissueClass>& classes) {
  const glm::ivec3 n = volume.size_voxels;
  std::vector<std::uint8_t> plateau(marks.size());
  for (std::size_t at = 0; at < marks.size(); ++at)
    plateau[at] =
        (marks[at] & (kPlateau | kBright)) == (kPlateau | kBright) && classes[at] != TissueClass::bone ? 1 : 0;
  Components pieces(n, plateau);
  struct Surface {
    double bone_mm2 = 0.0, all_mm2 = 0.0;
  };
  std::vector<Surface> surfaces(pieces.numbers());
  const glm::dvec3 mm = volume.spacing_mm, area_mm2(mm.y * mm.z, mm.x * mm.z, mm.x * mm.y);
  const std::size_t row = static_cast<std::size_t>(n.x), slice = row * static_cast<std::size_t>(n.y);
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    Surface& surface = surfaces[piece];
    const auto look = [&](bool there, std::size_t other, double face_mm2) {
      if (!there || plateau[other] != 0) return;
      surface.all_mm2 += face_mm2;
      if (classes[other] == TissueClass::bone) surface.bone_mm2 += face_mm2;
    };
    const std::size_t j = begin / row % static_cast<std::size_t>(n.y), k = begin / slice;
    look(begin % row != 0, begin - 1, area_mm2.x);
    look(end % row != 0, end, area_mm2.x);
    for (std::size_t at = begin; at < end; ++at) {
      look(j > 0, at - row, area_mm2.y);
      look(j + 1 < static_cast<std::size_t>(n.y), at + row, area_mm2.y);
      look(k > 0, at - slice, area_mm2.z);
      look(k + 1 < static_cast<std::size_t>(n.z), at + slice, area_mm2.z);
    }
  });
  pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
    if (surfaces[piece].bone_mm2 <= kHeldByBone * surfaces[piece].all_mm2) return;
    for (std::size_t at = begin; at < end; ++at) classes[at] = TissueClass::bone;
  });
}

}  // namespace

void fill_marrow(const Volume& volume, std::vector<TissueClass>& classes) {
  const std::size_t slice_voxels =
      static_cast<std::size_t>(volume.size_voxels.x) * static_cast<std::size_t>(volume.size_voxels.y);
  std::vector<std::uint8_t> marks(slice_voxels);
  std::vector<std::int16_t> smooth;
  for (int k = 0; k < volume.size_voxels.z; ++k) {
    TissueClass* const here = classes.data() + static_cast<std::size_t>(k) * slice_voxels;
    if (std::find(here, here + slice_voxels, TissueClass::bone) == here + slice_voxels) continue;
    std::transform(here, here + slice_voxels, marks.begin(), [](TissueClass tissue) {
      return static_cast<std::uint8_t>(tissue == TissueClass::bone ? 1 : 0);
    });
    smooth_slice(volume, k, smooth);
    Slice(volume, marks.data()).fill_holes(smooth, here);
  }
}

void smooth_slice(const Volume& volume, int k, std::vector<std::int16_t>& smooth) {
  const int width = volume.size_voxels.x, height = volume.size_voxels.y;
  const auto w = static_cast<std::size_t>(width);
  smooth.resize(w * static_cast<std::size_t>(height));
  std::vector<int> columns(w);
  const std::int16_t* hu = volume.hu.data() + volume.index(0, 0, k);
  for (int y = 0; y < height; ++y) {
    const std::int16_t* above = hu + static_cast<std::size_t>(std::max(0, y - 1)) * w;
    const std::int16_t* here = hu + static_cast<std::size_t>(y) * w;
    const std::int16_t* below = hu + static_cast<std::size_t>(std::min(height - 1, y + 1)) * w;
    for (std::size_t x = 0; x < w; ++x) columns[x] = above[x] + 2 * here[x] + below[x];
    std::int16_t* out = smooth.data() + static_cast<std::size_t>(y) * w;
    const auto sixteenth = [](int sum) { return static_cast<std::int16_t>(sum >> 4); };  // downwards for all signs
    for (std::size_t x = 1; x + 1 < w; ++x) out[x] = sixteenth(columns[x - 1] + 2 * columns[x] + columns[x + 1]);
    out[0] = sixteenth(3 * columns[0] + columns[std::min<std::size_t>(1, w - 1)]);
    out[w - 1] = sixteenth(3 * columns[w - 1] + columns[w >= 2 ? w - 2 : 0]);
  }
}

void mark_hard_tissue(const Volume& volume, std::vector<TissueClass>& classes) {
  const std::size_t slice_voxels =
      static_cast<std::size_t>(volume.size_voxels.x) * static_cast<std::size_t>(volume.size_voxels.y);
  std::vector<std::uint8_t> marks(classes.size(), 0);
  std::vector<std::int16_t> smooth;
  for (int k = 0; k < volume.size_voxels.z; ++k) {
    const std::size_t start = static_cast<std::size_t>(k) * slice_voxels;
    std::uint8_t* const here = marks.data() + start;
    smooth_slice(volume, k, smooth);
    std::uint8_t all = 0;
    for (std::size_t at = 0; at < slice_voxels; ++at) {
      if (classes[start + at] == TissueClass::air) continue;
      here[at] = marks_of(smooth[at], volume.hu[start + at]);
      all |= here[at];
    }
    if ((all & kBright) == 0) continue;
    if ((all & kMetal) != 0) mark_metal_rim(volume, here, volume.hu.data() + start);
    Slice slice(volume, here);
    slice.mark_marrow(smooth);
    slice.mark_dense_plateaus(smooth);
    slice.mark_plateaus();
    slice.spread(kCore, kBright, kMarrow, kCoreReachMm);
    slice.spread(kPlateau, kPale, kCore | kMarrow, kPlateauReachMm);
  }

  flood_bone(volume, marks, classes);
  join_held_plateaus(volume, marks, classes);
  fill_marrow(volume, classes);
  for (std::size_t at = 0; at < classes.size(); ++at) {
    if ((marks[at] & kMetal) != 0)
      classes[at] = TissueClass::metal;
    else if ((marks[at] & kContrast) != 0 && classes[at] != TissueClass::bone)
      classes[at] = TissueClass::vessel;
  }
}

}  // namespace seldinger::volume
