#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_cube.glsl.h"
#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/imaging/ultrasound/speckle/cubes.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/speckle/scatterers.h"
#include "sim/imaging/ultrasound/speckle/turned_columns.h"

namespace seldinger::imaging {
namespace {

constexpr int kTable = 1024;

// exp(−q), q up to the end of two Gaussians.
using shaders::kUsTablePerQ;
static_assert(kUsTablePerQ == kTable / (0.5F * 2.0F * 6.25F));
struct Tables {
  std::array<float, kTable + 1> gauss;
  Tables() {
    for (std::size_t i = 0; i <= kTable; ++i)
      gauss[i] = static_cast<float>(base::exact_exp(-(static_cast<double>(i) + 0.5) / kUsTablePerQ));
  }
};
const Tables& tables() {
  static const Tables kTables;
  return kTables;
}

}  // namespace

// Lays one band's scatterers into the beams first to end: finds the tile that these beams see of the band, walks
// the lattice's rows through the tile, gathers the cubes of the rows in chunks, and adds each chunk's scatterers to
// the beams that they reach.
class ScattererField::BandWriter {
 public:
  BandWriter(const ScattererField& field, const Band& band, int first, int end, std::vector<std::int32_t>& out);
  void write();

 private:
  // Cubes of the lattice in a line along its inner axis; none: last < first.
  struct Row {
    int outer, middle;  // their numbers along the other two axes
    int first, last;    // and along the inner one
  };
  Row row_in_box(int outer, int middle) const noexcept;
  void add_row(const Row& row);
  void choose_layers() noexcept;
  void add_column(const Row& row);
  void flush();
  void lay_chunk() const;

  const ScattererField& field_;
  const Band& band_;
  const int first_, end_;
  std::vector<std::int32_t>& out_;
  const double middle_beam_;
  const float reach_;  // beams
  const Tile tile_;
  const bool moving_;
  const bool lesions_;                // about the tile, of which no scatterer lies farther than a cube from its box
  const int inner_, outer_, middle_;  // the lattice's axes
  TileFrame frame_{};
  Chunk chunk_;
  Columns columns_;
  int first_layer_ = 0;  // of the slab's, in the tile's box
  TurnedColumns turned_;
  std::optional<int> line_at_;  // the outer number of the row that turned_ went to
};

ScattererField::BandWriter::BandWriter(const ScattererField& field, const Band& band, int first, int end,
                                       std::vector<std::int32_t>& out)
    : field_(field),
      band_(band),
      first_(first),
      end_(end),
      out_(out),
      middle_beam_(0.5 * (first + end - 1)),
      reach_(field.most_reach(band)),
      tile_(field.tile(band, middle_beam_, 0.5 * (end - 1 - first) + static_cast<double>(reach_))),
      moving_(!field.lies_still(tile_)),
      lesions_(
          field.tissue_at_.has_lesions_near(tile_.center_lps_mm, glm::length(tile_.half_mm) + band.spacing_mm)),
      inner_(tile_.inner),
      outer_((tile_.inner + 1) % 3),
      middle_((tile_.inner + 2) % 3) {
  TileFrame& f = frame_;
  f.radius = static_cast<float>(field.fan_.radius_mm);
  f.per_radian = static_cast<float>(1.0 / field.fan_.beam_step);
  f.beam_middle = static_cast<float>(middle_beam_);
  for (int a = 0; a < 3; ++a) {
    f.a[a] = static_cast<float>(band.spacing_mm * tile_.axes[a].x);
    f.b[a] = static_cast<float>(band.spacing_mm * tile_.axes[a].y);
    f.c[a] = static_cast<float>(band.spacing_mm * tile_.axes[a].z);
  }
  f.from = static_cast<float>(band.from_mm);
  f.to = static_cast<float>(band.to_mm);
  f.half_thickness = static_cast<float>(band.half_thickness_mm);
  f.first_beam = static_cast<float>(first) - reach_;
  f.end_beam = static_cast<float>(end - 1) + reach_;
  if (moving_) choose_layers();
}

void ScattererField::BandWriter::write() {
  const auto cubes = [&](int axis) {
    return std::pair<int, int>{static_cast<int>(std::ceil(tile_.center_cell[axis] - tile_.half_cells[axis])),
                               static_cast<int>(std::floor(tile_.center_cell[axis] + tile_.half_cells[axis]))};
  };
  const auto [outer_first, outer_last] = cubes(outer_);
  const auto [middle_first, middle_last] = cubes(middle_);
  for (int i = outer_first; i <= outer_last; ++i)
    for (int j = middle_first; j <= middle_last; ++j) {
      const Row row = row_in_box(i, j);
      if (row.first <= row.last) add_row(row);
    }
  if (chunk_.count > 0) flush();
}

// The cubes of a row whose centres lie in the tile's box: |axis·(cube − centre)| ≤ half on each of the box's axes.
ScattererField::BandWriter::Row ScattererField::BandWriter::row_in_box(int outer, int middle) const noexcept {
  const glm::dvec3& center = tile_.center_cell;
  double low = -1e9, high = 1e9;
  for (int a = 0; a < 3; ++a) {
    const glm::dvec3& axis = tile_.axes[a];
    const double fixed = axis[outer_] * (outer - center[outer_]) + axis[middle_] * (middle - center[middle_]);
    const double slope = axis[inner_], half = tile_.half_mm[a] / band_.spacing_mm;
    if (std::abs(slope) < 1e-9) {
      if (std::abs(fixed) > half) high = -1e10;
      continue;
    }
    const double one = (-half - fixed) / slope, other = (half - fixed) / slope;
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
  }
  if (!(low + center[inner_] <= high + center[inner_])) return {outer, middle, 0, -1};
  return {outer, middle, static_cast<int>(std::ceil(low + center[inner_])),
          static_cast<int>(std::floor(high + center[inner_]))};
}

// Gathers a row's cubes, each one's seed and corner made from those of the one before it.
void ScattererField::BandWriter::add_row(const Row& row) {
  constexpr std::uint32_t kSteps[3] = {shaders::kUsStepI, shaders::kUsStepJ, shaders::kUsStepK};
  const std::uint32_t seed_step = kSteps[inner_];
  const glm::dvec3 &x_axis = tile_.axes[0], &y_axis = tile_.axes[1], &z_axis = tile_.axes[2];
  const double s = band_.spacing_mm;
  if (moving_) add_column(row);
  int column = columns_.count - columns_.layers;
  glm::ivec3 cube;
  cube[outer_] = row.outer, cube[middle_] = row.middle, cube[inner_] = row.first;
  std::uint32_t seed = shaders::us_lattice_seed(band_.key, cube.x, cube.y, cube.z);
  glm::dvec3 corner;
  corner[outer_] = row.outer * s, corner[middle_] = row.middle * s, corner[inner_] = row.first * s;
  corner -= tile_.start_lps_mm;
  glm::dvec3 at{glm::dot(corner, x_axis), glm::dot(corner, y_axis), glm::dot(corner, z_axis)};
  const glm::dvec3 step{s * x_axis[inner_], s * y_axis[inner_], s * z_axis[inner_]};
  for (int k = row.first; k <= row.last; ++k, at += step, seed += seed_step) {
    const int n = chunk_.count++;
    chunk_.seed[n] = seed;
    chunk_.x[n] = static_cast<float>(at.x);
    chunk_.y[n] = static_cast<float>(at.y);
    chunk_.z[n] = static_cast<float>(at.z);
    if (moving_) chunk_.column[n] = column;
    if (chunk_.count < Chunk::kRoom) continue;
    // The columns went with the chunk: the rest of the row needs its own again.
    flush();
    if (moving_ && k < row.last) {
      add_column(row);
      column = 0;
    }
  }
}

// Which of the slab's layers the tile's box touches.
void ScattererField::BandWriter::choose_layers() noexcept {
  const tissue::MovedSlab& slab = field_.motion_->slab();
  const tissue::SlabPart& part = slab.part();
  const int most = slab.size().z - 2;
  const auto layer_at = [&](double y_mm) {
    return std::clamp(static_cast<int>(std::floor((y_mm - part.low_mm.z) / part.layer_mm)), 0, most);
  };
  first_layer_ = layer_at(tile_.center_mm.y - tile_.half_mm.y);
  columns_.layers = layer_at(tile_.center_mm.y + tile_.half_mm.y) + 2 - first_layer_;
  columns_.low_mm = static_cast<float>(part.low_mm.z + first_layer_ * part.layer_mm);
  columns_.per_mm = static_cast<float>(1.0 / part.layer_mm);
  CHECK(columns_.layers <= Columns::kRoom);
  const glm::vec3 axes[3] = {glm::vec3(tile_.axes[0]), glm::vec3(tile_.axes[1]), glm::vec3(tile_.axes[2])};
  const auto across_mm = [&](double side) {
    return glm::dvec2(tile_.center_lps_mm[outer_] + side * tile_.half_cells[outer_] * band_.spacing_mm,
                      tile_.center_lps_mm[middle_] + side * tile_.half_cells[middle_] * band_.spacing_mm);
  };
  turned_.turn(slab, axes, across_mm(-1.0), across_mm(1.0), first_layer_, columns_.layers);
}

// All scatterers of a row move as the slab's column at the row's middle does.
void ScattererField::BandWriter::add_column(const Row& row) {
  if (columns_.count + columns_.layers > Columns::kRoom) flush();
  const double s = band_.spacing_mm;
  if (line_at_ != row.outer) turned_.go_to((row.outer + 0.5) * s);
  line_at_ = row.outer;
  turned_.lay((row.middle + 0.5) * s, columns_.mm + columns_.count);
  columns_.count += columns_.layers;
}

// Finds where the chunk's scatterers lie, lays them, and empties the chunk.
void ScattererField::BandWriter::flush() {
  place(frame_, field_.fan_.curved, moving_ ? &columns_ : nullptr, chunk_);
  lay_chunk();
  chunk_.count = 0;
  columns_.count = 0;
}

void ScattererField::BandWriter::lay_chunk() const {
  // Copies: the sums written below are integers too, and could as well be any of these.
  const ScattererField& field = field_;
  const int first = first_, end = end_, fine_per_sample = field.fine_;
  const int first_fine = band_.first_sample * fine_per_sample, end_fine = band_.end_sample * fine_per_sample;
  const bool moving = moving_;
  const glm::dvec3 start = tile_.start_lps_mm, x_axis = tile_.axes[0], y_axis = tile_.axes[1],
                   z_axis = tile_.axes[2];
  const float per_fine = static_cast<float>(fine_per_sample / field.fan_.sample_mm);
  const float turns = static_cast<float>(2.0 / field.wavelength_mm_ * kPhases);
  const auto fine_samples =
      static_cast<std::size_t>(field.view_.samples) * static_cast<std::size_t>(fine_per_sample);
  const AtSample* const at_sample = field.at_sample_.data();
  std::int32_t* const out = out_.data();
  const float* const gauss = tables().gauss.data();
  const auto& phase = phases();
  const TissueAt& tissue_at = field.tissue_at_;
  // As the GPU has it: a tile's frame in voxels.
  const bool blends = blends_voxels(field.view_), in_lps = !blends || lesions_;
  const glm::vec3 start_voxels(tissue_at.voxels_at(start)), x_voxels(tissue_at.voxels_along(x_axis)),
      y_voxels(tissue_at.voxels_along(y_axis)), z_voxels(tissue_at.voxels_along(z_axis));

  // The scatterers that the tile holds.
  std::array<int, Chunk::kRoom> chosen;
  int kept = 0;
  for (int n = 0; n < chunk_.count; ++n) {
    chosen[static_cast<std::size_t>(kept)] = n;
    kept += static_cast<int>(chunk_.inside[n]);
  }
  for (int m = 0; m < kept; ++m) {
    const int n = chosen[static_cast<std::size_t>(m)];
    // The beams that it reaches at its depth, and how weak it is there for lying beside the plane.
    const int fine = std::clamp(static_cast<int>(chunk_.depth[n] * per_fine), first_fine, end_fine - 1);
    const AtSample& at = at_sample[fine / fine_per_sample];
    const float q_y = chunk_.y[n] * chunk_.y[n] * at.elevation_scale;
    if (q_y >= 0.5F * kTable) continue;
    const float beam = chunk_.beam[n];
    const int from = std::max(first, static_cast<int>(std::ceil(beam - at.lateral_reach)));
    const int to = std::min(end - 1, static_cast<int>(std::floor(beam + at.lateral_reach)));
    if (from > to) continue;
    // Its amplitude, by the tissue in which it lies at rest, and its phase.
    const float at_x = chunk_.x[n], at_y = moving ? chunk_.at_y[n] : chunk_.y[n], at_z = chunk_.z[n];
    glm::dvec3 p(0.0);
    if (in_lps)
      p = start + static_cast<double>(at_x) * x_axis + static_cast<double>(at_y) * y_axis +
          static_cast<double>(at_z) * z_axis;
    float tissue = 0.0F;
    if (!blends) {
      tissue = tissue_at.speckle(p);
    } else if (const auto of_lesion = in_lps ? tissue_at.speckle_of_lesion(p) : std::nullopt) {
      tissue = *of_lesion;
    } else {
      const std::uint32_t bits = shaders::us_stray_bits(chunk_.seed[n]);
      const glm::vec3 stray(shaders::us_stray(bits), shaders::us_stray(bits >> 10U),
                            shaders::us_stray(bits >> 20U));
      tissue =
          tissue_at.speckle_of_voxel(start_voxels + at_x * x_voxels + at_y * y_voxels + at_z * z_voxels + stray);
    }
    if (tissue == 0.0F) continue;
    const float amplitude = tissue * at.amplitude;
    const auto& turn = phase[(static_cast<std::uint32_t>(chunk_.depth[n] * turns) + chunk_.phase[n]) % kPhases];
    const float re = amplitude * turn[0], im = amplitude * turn[1];
    // Its share in each of these beams.
    std::int32_t* sum =
        out + (static_cast<std::size_t>(from - first) * fine_samples + static_cast<std::size_t>(fine)) * 2;
    float off = static_cast<float>(from) - beam;
    for (int b = from; b <= to; ++b, off += 1.0F, sum += 2 * fine_samples) {
      const float w = gauss[static_cast<std::size_t>(off * off * at.lateral_scale + q_y)];
      sum[0] += static_cast<std::int32_t>(std::lrintf(re * w));
      sum[1] += static_cast<std::int32_t>(std::lrintf(im * w));
    }
  }
}

void ScattererField::add_band(const Band& band, int first, int end, std::vector<std::int32_t>& out) const {
  BandWriter(*this, band, first, end, out).write();
}

}  // namespace seldinger::imaging