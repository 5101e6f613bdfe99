#include "sim/imaging/ultrasound/speckle/scatterers.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "shaders/shared/ultrasound.glsl.h"
#include "shaders/shared/ultrasound_cube.glsl.h"
#include "sim/base/hash.h"
#include "sim/imaging/ultrasound/view/view.h"

namespace seldinger::imaging {
namespace {

using shaders::kUsTablePerQ;

constexpr int kBands = 20;  // of depth, with one lattice and one thickness each
// The most that the carrier may turn within a fine sample: keeps the lattice's mean out of the picture, and the
// error of rounding scatterers to fine samples 24 dB below them (tests/sim/imaging/ultrasound/reference_test.cpp).
constexpr double kMostTurns = 0.25;
constexpr double kLeastSpacingMm = 0.1;

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

// What holds a box of the tile's frame, in the slab's coordinates.
std::pair<glm::dvec3, glm::dvec3> ScattererField::box_in_slab(const Tile& tile, const glm::dvec3& low_mm,
                                                              const glm::dvec3& high_mm) const noexcept {
  const tissue::MovedSlab& slab = motion_->slab();
  glm::dvec3 box_low(1e9), box_high(-1e9);
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p = slab.slab_of(
        tile.lps_mm({(corner & 1) != 0 ? high_mm.x : low_mm.x, (corner & 2) != 0 ? high_mm.y : low_mm.y,
                     (corner & 4) != 0 ? high_mm.z : low_mm.z}));
    box_low = glm::min(box_low, p);
    box_high = glm::max(box_high, p);
  }
  return {box_low, box_high};
}

// Grows a box until it holds, at rest, all tissue that now lies in the tile. The range of the displacement u over
// the box says how far to grow, and a larger box may have a larger range: repeat until it no longer grows.
void ScattererField::to_rest(const Tile& tile, glm::dvec3& low_mm, glm::dvec3& high_mm) const noexcept {
  const glm::dvec3 low = low_mm, high = high_mm;
  const glm::dvec3 middle = tile.lps_mm(0.5 * (low + high)),
                   back = motion_->slab().rest_of(middle, middle) - middle;
  glm::dvec3 least(glm::dot(-back, tile.axes[0]), glm::dot(-back, tile.axes[1]), glm::dot(-back, tile.axes[2]));
  glm::dvec3 most = least;
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    low_mm = low - most;
    high_mm = high - least;
    const auto [box_low, box_high] = box_in_slab(tile, low_mm, high_mm);
    const auto range = motion_->slab().range(box_low, box_high, tile.axes);
    const bool more =
        glm::any(glm::lessThan(range.low_mm, least)) || glm::any(glm::greaterThan(range.high_mm, most));
    if (!more) break;
    least = glm::min(least, range.low_mm);
    most = glm::max(most, range.high_mm);
  }
}

// Nothing moves where its cubes lie, as nearly everywhere about an artery that beats.
bool ScattererField::lies_still(const Tile& tile) const noexcept {
  if (motion_ == nullptr) return true;
  const auto [low, high] = box_in_slab(tile, tile.center_mm - tile.half_mm, tile.center_mm + tile.half_mm);
  return motion_->slab().is_still(low, high);
}

}  // namespace seldinger::imaging
