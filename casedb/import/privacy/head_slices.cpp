#include "casedb/import/privacy/head_slices.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "sim/volume/axial_slices.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/components.h"

namespace seldinger::casedb {
namespace {

constexpr double kCellMm = 3.0;
constexpr double kMostCells = 3.0e7;  // a grid of a body of 1.8 m at 3 mm has 2e7
constexpr int kBoneHu = 250;          // of any of eight samples in a cell: thin bone counts
constexpr int kBrainLowHu = -50, kBrainHighHu = 130;
constexpr double kClosedMm = 6.0;     // grown by this, bone closes fissures and sutures up to twice as wide
constexpr double kBrainMm2 = 3000.0;  // after growing; at the pons it is 5000
constexpr double kBrainShare = 0.7;   // of the ring's inside is soft tissue
// A head is 140 to 170 mm wide (Farkas 1994), a neck less; shoulders and bodies are wider.
constexpr double kHeadWidthMm = 195.0, kHeadDepthMm = 260.0, kHeadMm2 = 6000.0;
constexpr double kFrontMm = 45.0, kFrontShare = 0.4;  // of the section's depth
constexpr double kRearMm = 30.0, kRearShare = 0.25;
constexpr double kJawWidthMm = 60.0;  // hyoid and larynx stay below 50

struct Grid {
  volume::Volume volume;           // mean HU, along LPS
  std::vector<std::uint8_t> bone;  // some of the cell is
};

Grid resampled(const volume::Volume& source) {
  glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 index(((corner & 1) != 0 ? source.size_voxels.x - 0.5 : -0.5),
                           ((corner & 2) != 0 ? source.size_voxels.y - 0.5 : -0.5),
                           ((corner & 4) != 0 ? source.size_voxels.z - 0.5 : -0.5));
    const glm::dvec3 p(source.lps_from_voxel * glm::dvec4(index, 1.0));
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  const glm::dvec3 extent = high - low;
  const double cell_mm = std::max(kCellMm, std::cbrt(extent.x * extent.y * extent.z / kMostCells));
  const glm::ivec3 size = glm::max(glm::ivec3(1), glm::ivec3(glm::ceil(extent / cell_mm - 1e-6)));
  Grid grid;
  grid.volume = volume::make_volume(size, glm::dvec3(cell_mm), glm::dmat3(1.0), low + cell_mm / 2.0);
  grid.bone.assign(grid.volume.hu.size(), 0);
  const glm::dmat4 index_from_cell = volume::voxel_from_lps(source) * grid.volume.lps_from_voxel;
  std::array<glm::dvec3, 8> offset;
  for (int i = 0; i < 8; ++i)
    offset[static_cast<std::size_t>(i)] =
        glm::dvec3(index_from_cell * glm::dvec4((i & 1) != 0 ? 0.25 : -0.25, (i & 2) != 0 ? 0.25 : -0.25,
                                                (i & 4) != 0 ? 0.25 : -0.25, 0.0));
  const glm::dvec3 step(index_from_cell[0]);
  std::size_t cell = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j) {
      glm::dvec3 centre(index_from_cell * glm::dvec4(0.0, j, k, 1.0));
      for (int i = 0; i < size.x; ++i, ++cell, centre += step) {
        int sum = 0, most = volume::kAirHu;
        for (const glm::dvec3& away : offset) {
          const int hu = volume::sample_nearest(source, centre + away).value_or(volume::kAirHu);
          sum += std::min(hu, 3000);
          most = std::max(most, hu);
        }
        grid.volume.hu[cell] = static_cast<std::int16_t>(sum / 8);
        grid.bone[cell] = most >= kBoneHu ? 1 : 0;
      }
    }
  return grid;
}

// The bytes of a slice, and places in it.
struct Plane {
  int width, height;
  std::size_t start;  // its first cell in the grid
  std::size_t cells() const noexcept { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
};

std::vector<std::uint8_t> cut(const std::vector<std::uint8_t>& grid, const Plane& plane) {
  const auto first = grid.begin() + static_cast<std::ptrdiff_t>(plane.start);
  return {first, first + static_cast<std::ptrdiff_t>(plane.cells())};
}

// What the border does not reach except through what is set.
std::vector<std::uint8_t> enclosed(const std::vector<std::uint8_t>& walls, const Plane& plane) {
  std::vector<std::uint8_t> free(walls.size());
  std::transform(walls.begin(), walls.end(), free.begin(), [](std::uint8_t wall) { return wall == 0 ? 1 : 0; });
  volume::Components pieces({plane.width, plane.height, 1}, free);
  pieces.paint(
      [&](const volume::Piece& piece) {
        return piece.low.x == 0 || piece.low.y == 0 || piece.high.x == plane.width - 1 ||
               piece.high.y == plane.height - 1;
      },
      0, free);
  volume::Components(glm::ivec3(plane.width, plane.height, 1), free).keep_largest(free);
  return free;
}

double area_mm2(const std::vector<std::uint8_t>& cells, double cell_mm) {
  return static_cast<double>(std::count(cells.begin(), cells.end(), std::uint8_t{1})) * cell_mm * cell_mm;
}

class SliceReader {
 public:
  SliceReader(const Grid& grid, const std::vector<std::uint8_t>& body)
      : grid_(grid), body_(body), cell_mm_(grid.volume.spacing_mm.x) {}

  HeadSlice read(int k) {
    const glm::ivec3 size = grid_.volume.size_voxels;
    plane_ = {size.x, size.y, grid_.volume.index(0, 0, k)};
    HeadSlice slice;
    look_for_brain(slice);
    look_for_jaw(slice);
    return slice;
  }

 private:
  std::vector<std::uint8_t> grown(std::vector<std::uint8_t> cells, double by_mm) {
    const int radius = std::max(1, static_cast<int>(std::lround(by_mm / cell_mm_)));
    volume::grow_slice(cells, plane_.width, plane_.height, glm::ivec2(radius), 1, scratch_);
    return cells;
  }

  // How far the set cells reach along each direction.
  std::array<double, kFronts> reach_mm(const std::vector<std::uint8_t>& cells) const {
    std::array<double, kFronts> reach;
    reach.fill(-std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (cells[i] == 0) continue;
      const glm::dvec3 p(static_cast<double>(i % static_cast<std::size_t>(plane_.width)),
                         static_cast<double>(i / static_cast<std::size_t>(plane_.width)), 0.0);
      for (std::size_t f = 0; f < kFronts; ++f)
        reach[f] = std::max(reach[f], cell_mm_ * glm::dot(p, front_direction_cached(f)));
    }
    return reach;
  }
  static const glm::dvec3& front_direction_cached(std::size_t f) {
    static const std::array<glm::dvec3, kFronts> directions = [] {
      std::array<glm::dvec3, kFronts> all;
      for (std::size_t i = 0; i < kFronts; ++i) all[i] = front_direction(i);
      return all;
    }();
    return directions[f];
  }

  void look_for_brain(HeadSlice& slice) {
    const std::vector<std::uint8_t> inside = enclosed(grown(cut(grid_.bone, plane_), kClosedMm), plane_);
    if (area_mm2(inside, cell_mm_) < kBrainMm2) return;
    std::size_t all = 0, soft = 0;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (inside[i] == 0) continue;
      const int hu = grid_.volume.hu[plane_.start + i];
      ++all;
      soft += hu >= kBrainLowHu && hu <= kBrainHighHu ? 1 : 0;
    }
    if (static_cast<double>(soft) < kBrainShare * static_cast<double>(all)) return;
    slice.brain = true;
    // The section of the body that the brain lies in: arms beside the head are others.
    std::vector<std::uint8_t> section = cut(body_, plane_);
    const std::size_t seed = static_cast<std::size_t>(std::find(inside.begin(), inside.end(), 1) - inside.begin());
    keep_piece_of(section, seed);
    const auto skin = reach_mm(section), brain = reach_mm(inside);
    for (std::size_t f = 0; f < kFronts; ++f) slice.block_mm[f] = skin[f] - brain[f] - kClosedMm;
  }

  void keep_piece_of(std::vector<std::uint8_t>& section, std::size_t cell) const {
    volume::Components pieces({plane_.width, plane_.height, 1}, section);
    std::vector<std::size_t> number(section.size(), section.size());
    pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
      std::fill(number.begin() + static_cast<std::ptrdiff_t>(begin),
                number.begin() + static_cast<std::ptrdiff_t>(end), piece);
    });
    const std::size_t wanted = number[cell];
    if (wanted == section.size()) return;
    for (std::size_t i = 0; i < section.size(); ++i) section[i] = number[i] == wanted ? 1 : 0;
  }

  struct Box {
    int left = std::numeric_limits<int>::max(), right = -1, front = std::numeric_limits<int>::max(), back = -1;
    std::size_t cells = 0;
  };

  double bone_width_mm(const std::vector<std::uint8_t>& section, const Box& box, int from_row, int to_row) const {
    int left = plane_.width, right = -1;
    for (int y = from_row; y < to_row; ++y)
      for (int x = box.left; x <= box.right; ++x) {
        const std::size_t cell =
            static_cast<std::size_t>(y) * static_cast<std::size_t>(plane_.width) + static_cast<std::size_t>(x);
        if (section[cell] == 0 || grid_.bone[plane_.start + cell] == 0) continue;
        left = std::min(left, x);
        right = std::max(right, x);
      }
    return right < left ? 0.0 : (right - left + 1) * cell_mm_;
  }

  void look_for_jaw(HeadSlice& slice) const {
    const std::vector<std::uint8_t> section = cut(body_, plane_);
    volume::Components pieces({plane_.width, plane_.height, 1}, section);
    std::vector<Box> boxes(pieces.numbers());
    const auto width = static_cast<std::size_t>(plane_.width);
    pieces.each_run([&](std::size_t piece, std::size_t begin, std::size_t end) {
      Box& box = boxes[piece];
      box.left = std::min(box.left, static_cast<int>(begin % width));
      box.right = std::max(box.right, static_cast<int>((end - 1) % width));
      box.front = std::min(box.front, static_cast<int>(begin / width));
      box.back = std::max(box.back, static_cast<int>(begin / width));
      box.cells += end - begin;
    });
    for (const Box& box : boxes) {
      const double wide_mm = (box.right - box.left + 1) * cell_mm_, deep_mm = (box.back - box.front + 1) * cell_mm_;
      const bool head = static_cast<double>(box.cells) * cell_mm_ * cell_mm_ >= kHeadMm2 &&
                        wide_mm <= kHeadWidthMm && deep_mm <= kHeadDepthMm;
      if (!head) continue;
      const int front = static_cast<int>(std::min(kFrontMm, kFrontShare * deep_mm) / cell_mm_);
      const int rear = static_cast<int>(std::min(kRearMm, kRearShare * deep_mm) / cell_mm_);
      // Behind a jaw lies the neck; a ring of bone is a skull's, with a forehead in front.
      slice.jaw = slice.jaw || (bone_width_mm(section, box, box.front, box.front + front) >= kJawWidthMm &&
                                bone_width_mm(section, box, box.back + 1 - rear, box.back + 1) < kJawWidthMm);
    }
  }

  const Grid& grid_;
  const std::vector<std::uint8_t>& body_;
  double cell_mm_;
  Plane plane_{0, 0, 0};
  std::vector<int> scratch_;
};

}  // namespace

glm::dvec3 front_direction(std::size_t i) {
  const double angle = (static_cast<double>(i) - static_cast<double>(kFronts / 2)) * 0.17453292519943295;  // 10°
  return {std::sin(angle), -std::cos(angle), 0.0};
}

double HeadSlices::foremost_mm(const glm::dvec3& front, double from_z_mm, double to_z_mm) const {
  double foremost = -std::numeric_limits<double>::infinity();
  std::size_t cell = 0;
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; ++j)
      for (int i = 0; i < size.x; ++i, ++cell)
        if (body[cell] != 0 && z_of(k) >= from_z_mm && z_of(k) <= to_z_mm)
          foremost = std::max(foremost, glm::dot(front, origin_lps_mm + spacing_mm * glm::dvec3(i, j, k)));
  return foremost + spacing_mm / 2.0;
}

HeadSlices head_slices(const volume::Volume& volume) {
  const Grid grid = resampled(volume);
  HeadSlices head;
  head.spacing_mm = grid.volume.spacing_mm.x;
  head.origin_lps_mm = glm::dvec3(grid.volume.lps_from_voxel[3]);
  head.size = grid.volume.size_voxels;
  head.body = volume::body_mask(grid.volume);
  SliceReader reader(grid, head.body);
  for (int k = 0; k < head.size.z; ++k) head.slices.push_back(reader.read(k));
  return head;
}

}  // namespace seldinger::casedb
