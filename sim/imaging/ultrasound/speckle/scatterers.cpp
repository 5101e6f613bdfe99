#include "sim/imaging/ultrasound/speckle/scatterers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_cube.glsl.h"
#include "sim/base/check.h"
#include "sim/base/clones.h"
#include "sim/base/exact_math.h"
#include "sim/base/hash.h"
#include "sim/imaging/ultrasound/speckle/phase.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

constexpr int kBands = 20;  // of depth, with one lattice and one thickness each
// The most that the carrier may turn within a fine sample: keeps the lattice's mean out of the picture, and the
// error of rounding scatterers to fine samples 24 dB below them (tests/sim/imaging/ultrasound/reference_test.cpp).
constexpr double kMostTurns = 0.25;
constexpr int kTable = 1024;
constexpr double kLeastSpacingMm = 0.1;

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

// Cubes of a lattice that may hold scatterers of a tile, a few hundred at a time.
constexpr int kChunk = 512;
struct Chunk {
  int count = 0;
  std::uint32_t seed[kChunk];             // of the lattice
  float x[kChunk], y[kChunk], z[kChunk];  // the cube's corner, in the tile's frame
  float depth[kChunk], beam[kChunk];      // of the scatterer; y becomes its own
  std::uint32_t inside[kChunk];
  std::uint32_t phase[kChunk];  // steps of kPhases that the echo is turned by

  // Used only where tissue moves: then `y` is where the scatterer is now; x, at_y and z are where it is at rest.
  // The slab's column for its row gives the difference along the tile's axes, layer by layer.
  float at_y[kChunk];
  std::int32_t column[kChunk];  // where its row's column begins; later, the layer below it
  float part[kChunk];           // of the way from there to the layer above
  float moved_x[kChunk], moved_y[kChunk], moved_z[kChunk];
};
struct Columns {
  static constexpr int kRoom = 4096;
  int count = 0;
  float mm[kRoom][4];                  // xyz
  float low_mm = 0.0F, per_mm = 0.0F;  // height of the first layer; layers a mm
  int layers = 0;                      // ≥ 2
};

struct TileFrame {
  float radius, per_radian, beam_middle;  // straight: per_radian is per mm
  float a[3], b[3], c[3];                 // the cube's edges
  float from, to, half_thickness, first_beam, end_beam;
};

// Where each cube's scatterer lies: plain loops that the compiler vectorises, eight at a time.
[[gnu::always_inline]] inline void rest(const TileFrame& f, std::uint32_t bits, float& x, float& y, float& z) {
  const float u = shaders::us_cube_u(bits), v = shaders::us_cube_v(bits), w = shaders::us_cube_w(bits);
  x = x + u * f.a[0] + v * f.b[0] + w * f.c[0];
  y = y + u * f.a[1] + v * f.b[1] + w * f.c[1];
  z = z + u * f.a[2] + v * f.b[2] + w * f.c[2];
}
template <bool curved>
[[gnu::always_inline]] inline void see(const TileFrame& f, int n, float x, float y, float z, Chunk& chunk) {
  float depth = z, beam = 0.0F;
  if constexpr (curved) {
    const float from_center = z + f.radius;
    depth = std::sqrt(x * x + from_center * from_center) - f.radius;
    const float angle = shaders::us_narrow_angle(x / from_center);
    beam = f.beam_middle + angle * f.per_radian;
  } else {
    beam = f.beam_middle + x * f.per_radian;
  }
  chunk.depth[n] = depth;
  chunk.beam[n] = beam;
  chunk.inside[n] =
      static_cast<std::uint32_t>((depth >= f.from) & (depth < f.to) & (std::abs(y) < f.half_thickness) &
                                 (beam > f.first_beam) & (beam < f.end_beam));
}
template <bool curved>
[[gnu::always_inline]] inline void place(const TileFrame& f, Chunk& chunk) noexcept {
  for (int n = 0; n < chunk.count; ++n) {
    const std::uint32_t bits = shaders::us_lattice_bits(chunk.seed[n]);
    float x = chunk.x[n], y = chunk.y[n], z = chunk.z[n];
    rest(f, bits, x, y, z);
    chunk.x[n] = x;
    chunk.y[n] = y;
    chunk.z[n] = z;
    chunk.phase[n] = shaders::us_lattice_turned(bits) * (kPhases / 2);
    see<curved>(f, n, x, y, z, chunk);
  }
}
// Three loops, so that only the middle one, which looks up columns, runs one scatterer at a time.
template <bool curved>
[[gnu::always_inline]] inline void place_moving(const TileFrame& f, const Columns& columns, Chunk& chunk) noexcept {
  const float low_mm = columns.low_mm, per_mm = columns.per_mm;
  const int last = columns.layers - 2;
  for (int n = 0; n < chunk.count; ++n) {
    const std::uint32_t bits = shaders::us_lattice_bits(chunk.seed[n]);
    float x = chunk.x[n], y = chunk.y[n], z = chunk.z[n];
    rest(f, bits, x, y, z);
    chunk.x[n] = x;
    chunk.at_y[n] = y;
    chunk.z[n] = z;
    chunk.phase[n] = shaders::us_lattice_turned(bits) * (kPhases / 2);
    const float layer = std::min(std::max((y - low_mm) * per_mm, 0.0F), static_cast<float>(last + 1));
    const int below = std::min(static_cast<int>(layer), last);
    chunk.part[n] = layer - static_cast<float>(below);
    chunk.column[n] += below;
  }
  for (int n = 0; n < chunk.count; ++n) {
    const float *low = columns.mm[chunk.column[n]], *high = low + 4;
    const float part = chunk.part[n];
    chunk.moved_x[n] = low[0] + part * (high[0] - low[0]);
    chunk.moved_y[n] = low[1] + part * (high[1] - low[1]);
    chunk.moved_z[n] = low[2] + part * (high[2] - low[2]);
  }
  for (int n = 0; n < chunk.count; ++n) {
    const float y = chunk.at_y[n] + chunk.moved_y[n];
    chunk.y[n] = y;
    see<curved>(f, n, chunk.x[n] + chunk.moved_x[n], y, chunk.z[n] + chunk.moved_z[n], chunk);
  }
}
SELDINGER_FOR_AVX2_TOO void place_curved(const TileFrame& f, Chunk& chunk) noexcept {
  place<true>(f, chunk);
}
SELDINGER_FOR_AVX2_TOO void place_straight(const TileFrame& f, Chunk& chunk) noexcept {
  place<false>(f, chunk);
}
SELDINGER_FOR_AVX2_TOO void place_moving_curved(const TileFrame& f, const Columns& columns, Chunk& chunk) noexcept {
  place_moving<true>(f, columns, chunk);
}
SELDINGER_FOR_AVX2_TOO void place_moving_straight(const TileFrame& f, const Columns& columns,
                                                  Chunk& chunk) noexcept {
  place_moving<false>(f, columns, chunk);
}

}  // namespace

ScattererField::ScattererField(const UltrasoundView& view, const TissueAt& tissue_at, const PictureMotion* motion)
    : view_(view), tissue_at_(tissue_at), motion_(motion), fan_(fan_of(view)) {
  const double frequency_mhz = working_mhz(view);
  wavelength_mm_ = shaders::us_wavelength_mm(frequency_mhz);
  fine_ = std::max(1, static_cast<int>(std::ceil(2.0 * fan_.sample_mm / (wavelength_mm_ * kMostTurns))));
  const auto widths = [&](double depth_mm) {
    return beam_width(view.probe, frequency_mhz, view.focus_mm, std::max(depth_mm, 0.01));
  };
  for (int i = 0; i < kBands; ++i) {
    Band band{};
    band.first_sample = static_cast<int>(std::int64_t{view.samples} * i / kBands);
    band.end_sample = static_cast<int>(std::int64_t{view.samples} * (i + 1) / kBands);
    if (band.first_sample == band.end_sample) continue;
    band.from_mm = band.first_sample * fan_.sample_mm;
    band.to_mm = band.end_sample * fan_.sample_mm;
    const double middle_mm = 0.5 * (band.from_mm + band.to_mm);
    const BeamWidth width = widths(middle_mm);
    // Widths fall towards the focus and rise beyond it, so a band is widest at one of its ends.
    band.half_thickness_mm = shaders::kUsReachSigmas * std::max(widths(band.from_mm).elevation_sigma_mm,
                                                                widths(band.to_mm).elevation_sigma_mm);
    // The lattice's spacing gives the wanted number of effective scatterers in a Gaussian PSF, which is
    // density · Π(∫w²)²/∫w⁴ = density · Π √(2π)·σ.
    const double cell_mm3 = 15.749610 * width.axial_sigma_mm * width.lateral_sigma_mm * width.elevation_sigma_mm;
    const double wanted_mm = std::cbrt(cell_mm3 / view.scatterers_per_cell);
    // In quarter octaves, so that turning the depth knob leaves most of the speckle where it was.
    const double level = std::floor(4.0 * std::log2(std::max(wanted_mm, kLeastSpacingMm)));
    band.spacing_mm = std::exp2(0.25 * level);
    band.key = static_cast<std::uint32_t>(
        base::hash_combine(view.seed, static_cast<std::uint64_t>(static_cast<std::int64_t>(level))));
    bands_.push_back(band);
  }
  at_sample_.resize(static_cast<std::size_t>(view.samples));
  for (const Band& band : bands_)
    for (int k = band.first_sample; k < band.end_sample; ++k) {
      const double depth_mm = (k + 0.5) * fan_.sample_mm, spacing_mm = fan_.beam_spacing_mm(depth_mm);
      const BeamWidth width = widths(depth_mm);
      const auto weight = shaders::us_beam_weight(width.lateral_sigma_mm, width.elevation_sigma_mm, spacing_mm,
                                                  band.spacing_mm, shaders::kUsReachSigmas);
      AtSample& at = at_sample_[static_cast<std::size_t>(k)];
      at.lateral_scale = static_cast<float>(weight.x) * kUsTablePerQ;
      at.lateral_reach = static_cast<float>(weight.y);
      at.elevation_scale = static_cast<float>(weight.z) * kUsTablePerQ;
      at.amplitude = static_cast<float>(kUnit * weight.w);
    }
}

ScattererField::Lattice ScattererField::lattice_at(double depth_mm) const noexcept {
  for (const Band& band : bands_)
    if (depth_mm < band.to_mm) return {band.spacing_mm, band.key};
  return {bands_.back().spacing_mm, bands_.back().key};
}

void ScattererField::add_beams(int first, int end, std::vector<std::int32_t>& out) const {
  out.assign(static_cast<std::size_t>(end - first) * static_cast<std::size_t>(view_.samples) *
                 static_cast<std::size_t>(fine_) * 2,
             0);
  for (const Band& band : bands_) add_band(band, first, end, out);
}

float ScattererField::most_reach(const Band& band) const noexcept {
  float reach = 0.0F;
  for (int k = band.first_sample; k < band.end_sample; ++k)
    reach = std::max(reach, at_sample_[static_cast<std::size_t>(k)].lateral_reach);
  return reach;
}

ScattererField::Tile ScattererField::tile(const Band& band, double middle, double beams_half) const noexcept {
  Tile t;
  t.start_lps_mm = fan_.start_lps_mm(middle);
  const glm::dvec3 z_axis = fan_.direction(middle), y_axis = fan_.elevation,
                   x_axis = fan_.curved ? glm::cross(y_axis, z_axis) : fan_.lateral;
  t.axes[0] = x_axis, t.axes[1] = y_axis, t.axes[2] = z_axis;
  const double wide = beams_half * fan_.beam_step;  // half, radians or mm
  glm::dvec3 low, high;
  if (fan_.curved) {
    const double half_mm = (fan_.radius_mm + band.to_mm) * std::sin(wide);
    low = {-half_mm, -band.half_thickness_mm, (fan_.radius_mm + band.from_mm) * std::cos(wide) - fan_.radius_mm};
    high = {half_mm, band.half_thickness_mm, band.to_mm};
  } else {
    low = {-wide, -band.half_thickness_mm, band.from_mm};
    high = {wide, band.half_thickness_mm, band.to_mm};
  }
  if (motion_ != nullptr) to_rest(t, low, high);
  const double s = band.spacing_mm;
  t.center_mm = 0.5 * (low + high);
  t.half_mm = 0.5 * (high - low);
  t.half_cells = glm::dvec3(0.0);
  for (int a = 0; a < 3; ++a) {
    t.half_mm[a] += 0.5 * s * (std::abs(t.axes[a].x) + std::abs(t.axes[a].y) + std::abs(t.axes[a].z));
    for (int l = 0; l < 3; ++l) t.half_cells[l] += t.half_mm[a] * std::abs(t.axes[a][l]) / s;
  }
  t.center_lps_mm = t.start_lps_mm + t.center_mm.x * x_axis + t.center_mm.y * y_axis + t.center_mm.z * z_axis;
  t.center_cell = t.center_lps_mm / s - 0.5;
  t.inner = 0;
  for (int l = 1; l < 3; ++l)
    if (std::abs(y_axis[l]) > std::abs(y_axis[t.inner])) t.inner = l;
  return t;
}

// Grows a box until it holds, at rest, all tissue that now lies in the tile. The range of the displacement u over
// the box says how far to grow, and a larger box may have a larger range: repeat until it no longer grows.
void ScattererField::to_rest(const Tile& tile, glm::dvec3& low_mm, glm::dvec3& high_mm) const noexcept {
  const tissue::MovedSlab& slab = motion_->slab();
  const auto at = [&](const glm::dvec3& in_frame) {
    return tile.start_lps_mm + in_frame.x * tile.axes[0] + in_frame.y * tile.axes[1] + in_frame.z * tile.axes[2];
  };
  const glm::dvec3 low = low_mm, high = high_mm;
  const glm::dvec3 middle = at(0.5 * (low + high)), back = slab.rest_of(middle, middle) - middle;
  glm::dvec3 least(glm::dot(-back, tile.axes[0]), glm::dot(-back, tile.axes[1]), glm::dot(-back, tile.axes[2]));
  glm::dvec3 most = least;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    low_mm = low - most;
    high_mm = high - least;
    glm::dvec3 box_low(1e9), box_high(-1e9);
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 p =
          slab.slab_of(at({(corner & 1) != 0 ? high_mm.x : low_mm.x, (corner & 2) != 0 ? high_mm.y : low_mm.y,
                           (corner & 4) != 0 ? high_mm.z : low_mm.z}));
      box_low = glm::min(box_low, p);
      box_high = glm::max(box_high, p);
    }
    const auto range = slab.range(box_low, box_high, tile.axes);
    const bool more =
        glm::any(glm::lessThan(range.low_mm, least)) || glm::any(glm::greaterThan(range.high_mm, most));
    if (!more) break;
    least = glm::min(least, range.low_mm);
    most = glm::max(most, range.high_mm);
  }
}

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
  const bool moving_;
  const double middle_beam_;
  const float reach_;  // beams
  const Tile tile_;
  const int inner_, outer_, middle_;  // the lattice's axes
  TileFrame frame_{};
  Chunk chunk_;
  Columns columns_;
  int first_layer_ = 0;  // of the slab's, in the tile's box
};

ScattererField::BandWriter::BandWriter(const ScattererField& field, const Band& band, int first, int end,
                                       std::vector<std::int32_t>& out)
    : field_(field),
      band_(band),
      first_(first),
      end_(end),
      out_(out),
      moving_(field.motion_ != nullptr),
      middle_beam_(0.5 * (first + end - 1)),
      reach_(field.most_reach(band)),
      tile_(field.tile(band, middle_beam_, 0.5 * (end - 1 - first) + static_cast<double>(reach_))),
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
    if (chunk_.count < kChunk) continue;
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
}

// All scatterers of a row move as the slab's column at the row's middle does.
void ScattererField::BandWriter::add_column(const Row& row) {
  if (columns_.count + columns_.layers > Columns::kRoom) flush();
  const double s = band_.spacing_mm;
  const auto at = field_.motion_->slab().columns((row.outer + 0.5) * s, (row.middle + 0.5) * s);
  const glm::vec3 x(tile_.axes[0]), y(tile_.axes[1]), z(tile_.axes[2]);
  for (int l = 0; l < columns_.layers; ++l) {
    const glm::vec3 u = at.at(first_layer_ + l);
    float* mm = columns_.mm[columns_.count++];
    mm[0] = glm::dot(u, x);
    mm[1] = glm::dot(u, y);
    mm[2] = glm::dot(u, z);
  }
}

// Finds where the chunk's scatterers lie, lays them, and empties the chunk.
void ScattererField::BandWriter::flush() {
  const bool curved = field_.fan_.curved;
  if (moving_)
    curved ? place_moving_curved(frame_, columns_, chunk_) : place_moving_straight(frame_, columns_, chunk_);
  else
    curved ? place_curved(frame_, chunk_) : place_straight(frame_, chunk_);
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
  const bool blends = blends_voxels(field.view_), in_lps = !blends || tissue_at.has_lesions();
  const glm::vec3 start_voxels(tissue_at.voxels_at(start)), x_voxels(tissue_at.voxels_along(x_axis)),
      y_voxels(tissue_at.voxels_along(y_axis)), z_voxels(tissue_at.voxels_along(z_axis));

  // The scatterers that the tile holds.
  std::array<int, kChunk> chosen;
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
    } else if (const float* of_lesion = in_lps ? tissue_at.speckle_of_lesion(p) : nullptr) {
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
