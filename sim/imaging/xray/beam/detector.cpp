#include "sim/imaging/xray/beam/detector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "sim/base/check.h"
#include "sim/base/exact_math.h"
#include "sim/imaging/float_math.h"
#include "sim/imaging/xray/beam/attenuation.h"

namespace seldinger::imaging {
namespace {

using base::exact_exp, base::exact_log;

constexpr double kLowestSeenKev = 20.0;  // photons below do not pass a patient, and attenuation.h begins here
constexpr double kCalibrationWaterMm = 200.0;

// Steps of the table: the curvature of log share is the spectrum's variance of μ, far greater for mineral.
constexpr float kWaterStepMm = 5.0F, kMineralStepMm = 1.0F;
constexpr int kWaterPoints = 121, kMineralPoints = 201;
constexpr std::size_t kMaxBins = 160;
// What contrast takes off depends on water and mineral through the beam's hardness alone, which changes little
// behind the first centimetres. Points, the last of which is only reached by rounding up.
constexpr float kHardWaterStepMm = 20.0F, kHardMineralStepMm = 3.0F, kContrastStepMm = 0.25F;
constexpr float kLeastHardWaterMm = 40.0F, kMostHardMineralMm = 60.0F;
constexpr std::size_t kHardWaterPoints = 30, kHardMineralPoints = 22, kContrastPoints = 42;

}  // namespace

BeamSignal::BeamSignal(const Spectrum& spectrum, const Detector& detector, const BehindCt& ct) : kv_(spectrum.kv) {
  double open_signal = 0.0, open_kerma = 0.0;                            // keV/mm², keV cm²/(g mm²)
  double hard_signal = 0.0, hard_energy_signal = 0.0, hard_kerma = 0.0;  // behind the calibration's water
  for (std::size_t i = 0; i < spectrum.energy_kev.size(); ++i) {
    const double energy_kev = spectrum.energy_kev[i], photons = spectrum.photons_per_mas_mm2[i];
    const double kerma = photons * energy_kev * air_energy_absorption_cm2_g(energy_kev);
    open_kerma += kerma;
    if (energy_kev < kLowestSeenKev) continue;
    const double seen = 1.0 - exact_exp(-detector.csi_mm * detector.packing *
                                        attenuation_per_mm(Material::caesium_iodide, energy_kev));
    const Attenuation attenuation = attenuation_at(energy_kev, ct.kev);
    const double signal = photons * seen * energy_kev;
    bins_.push_back({signal, attenuation.water_per_mm, attenuation.mineral_per_mm, attenuation.iron_per_mm,
                     attenuation.contrast_per_mm});
    const double through = exact_exp(-kCalibrationWaterMm * attenuation.water_per_mm);
    open_signal += signal;
    hard_signal += signal * through;
    hard_energy_signal += signal * energy_kev * through;
    hard_kerma += kerma * through;
  }
  CHECK(open_signal > 0.0 && bins_.size() <= kMaxBins);
  for (Bin& bin : bins_) {
    bin.signal /= open_signal;
    const double members[5] = {bin.signal, bin.water_per_mm, bin.mineral_per_mm, bin.iron_per_mm,
                               bin.contrast_per_mm};
    for (std::size_t i = 0; i < 5; ++i) float_bins_[i].push_back(static_cast<float>(members[i]));
  }
  while (float_bins_[0].size() % 4 != 0) {  // of no signal, so that four are added at a time
    float_bins_[0].push_back(0.0F);
    for (std::size_t i = 1; i < 5; ++i) float_bins_[i].push_back(float_bins_[i].back());
  }
  // Adding up energies, a detector's noise is that of this many quanta of equal energy.
  const double quantum_kev = hard_energy_signal / hard_signal / detector.swank;
  open_quanta_ = open_signal / quantum_kev;
  constexpr double kMgyPerKevCm2 = 100.0 * 1000.0 * 1.602176634e-16 * 1000.0;  // as in air_kerma_mgy_per_mas
  open_kerma_mgy_ = open_kerma * kMgyPerKevCm2;
  kerma_per_share_ = hard_kerma * kMgyPerKevCm2 / (hard_signal / open_signal);

  // exp(−μw)·exp(−μm) by bin: one product of two small matrices instead of an exponential per entry and bin.
  std::vector<double> through_water(bins_.size() * kWaterPoints);
  std::array<double, kWaterPoints> row;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin)
    for (std::size_t i = 0; i < kWaterPoints; ++i)
      through_water[bin * kWaterPoints + i] =
          bins_[bin].signal * exact_exp(-bins_[bin].water_per_mm * kWaterStepMm * static_cast<double>(i));
  table_.resize(static_cast<std::size_t>(kWaterPoints) * kMineralPoints + 1);  // x may round up to the last point
  for (std::size_t j = 0; j < kMineralPoints; ++j) {
    row.fill(0.0);
    for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
      const double through = exact_exp(-bins_[bin].mineral_per_mm * kMineralStepMm * static_cast<double>(j));
      for (std::size_t i = 0; i < kWaterPoints; ++i) row[i] += through * through_water[bin * kWaterPoints + i];
    }
    for (std::size_t i = 0; i < kWaterPoints; ++i)
      table_[j * kWaterPoints + i] = static_cast<float>(exact_log(row[i]));
  }
  if (ct.enhanced) tabulate_contrast();
}

void BeamSignal::tabulate_contrast() {
  const std::size_t bins = bins_.size();
  std::vector<double> water(kHardWaterPoints * bins), mineral(kHardMineralPoints * bins),
      contrast(kContrastPoints * bins), weight(bins);
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const auto fill = [&](std::vector<double>& through, std::size_t points, double per_mm, float from_mm,
                          float step_mm) {
      for (std::size_t i = 0; i < points; ++i)
        through[i * bins + bin] = exact_exp(
            -per_mm * (static_cast<double>(from_mm) + static_cast<double>(step_mm) * static_cast<double>(i)));
    };
    fill(water, kHardWaterPoints, bins_[bin].water_per_mm, kLeastHardWaterMm, kHardWaterStepMm);
    fill(mineral, kHardMineralPoints, bins_[bin].mineral_per_mm, 0.0F, kHardMineralStepMm);
    fill(contrast, kContrastPoints, bins_[bin].contrast_per_mm, 0.0F, kContrastStepMm);
  }
  constexpr std::size_t kPlane = kHardMineralPoints * kHardWaterPoints;
  std::vector<double> without(kPlane);
  contrast_table_.resize(kContrastPoints * kPlane);
  for (std::size_t k = 0; k < kContrastPoints; ++k)
    for (std::size_t j = 0; j < kHardMineralPoints; ++j) {
      for (std::size_t bin = 0; bin < bins; ++bin)
        weight[bin] = bins_[bin].signal * mineral[j * bins + bin] * contrast[k * bins + bin];
      for (std::size_t i = 0; i < kHardWaterPoints; ++i) {
        double sum = 0.0;
        for (std::size_t bin = 0; bin < bins; ++bin) sum += weight[bin] * water[i * bins + bin];
        const std::size_t at = j * kHardWaterPoints + i;
        if (k == 0) without[at] = exact_log(sum);
        contrast_table_[k * kPlane + at] = static_cast<float>(exact_log(sum) - without[at]);
      }
    }
}

float BeamSignal::by_contrast_table(float water_mm, float mineral_mm, float contrast_mm) const {
  const float x = (water_mm - kLeastHardWaterMm) * (1.0F / kHardWaterStepMm),
              y = mineral_mm * (1.0F / kHardMineralStepMm), z = contrast_mm * (1.0F / kContrastStepMm);
  const int column = static_cast<int>(x), row = static_cast<int>(y), plane = static_cast<int>(z);
  const float u = x - static_cast<float>(column), v = y - static_cast<float>(row),
              w = z - static_cast<float>(plane);
  constexpr std::ptrdiff_t kRow = kHardWaterPoints, kPlane = kHardMineralPoints * kRow;
  const float* cell = contrast_table_.data() + plane * kPlane + row * kRow + column;
  const auto in_plane = [&](const float* at) {
    const float upper = at[0] + u * (at[1] - at[0]), lower = at[kRow] + u * (at[kRow + 1] - at[kRow]);
    return upper + v * (lower - upper);
  };
  const float near = in_plane(cell), far = in_plane(cell + kPlane);
  return near + w * (far - near);
}

// What is weakened least is taken out of the sum, which so keeps its digits behind anything: the last bin, since
// water, mineral and iron weaken the less the higher the energy is, or, behind much iodine, one below its K edge.
double BeamSignal::log_share(double water_mm, double mineral_mm, double iron_mm, double contrast_mm) const {
  const double water = std::max(water_mm, 0.0), mineral = std::max(mineral_mm, 0.0), iron = std::max(iron_mm, 0.0),
               contrast = std::max(contrast_mm, 0.0);
  const auto exponent = [&](const Bin& bin) {
    return bin.water_per_mm * water + bin.mineral_per_mm * mineral + bin.iron_per_mm * iron +
           bin.contrast_per_mm * contrast;
  };
  double least = exponent(bins_.back());
  if (contrast > 0.0)
    for (const Bin& bin : bins_) least = std::min(least, exponent(bin));
  double sum = 0.0;
  for (const Bin& bin : bins_) sum += bin.signal * exact_exp(least - exponent(bin));
  return exact_log(sum) - least;
}

float BeamSignal::log_share_in_float(float water_mm, float mineral_mm, float iron_mm, float contrast_mm) const {
  const std::size_t bins = float_bins_[0].size();
  const float* signal = float_bins_[0].data();
  const float* water = float_bins_[1].data();
  const float* mineral = float_bins_[2].data();
  const float* iron = float_bins_[3].data();
  const float* contrast = float_bins_[4].data();
  std::array<float, kMaxBins> exponents{}, shares;
  for (std::size_t i = 0; i < bins; ++i)
    exponents[i] = water[i] * water_mm + mineral[i] * mineral_mm + iron[i] * iron_mm;
  float least = exponents[bins - 1];
  if (contrast_mm > 0.0F) {
    for (std::size_t i = 0; i < bins; ++i) exponents[i] += contrast[i] * contrast_mm;
    least = *std::min_element(exponents.begin(), exponents.begin() + static_cast<std::ptrdiff_t>(bins));
  }
  for (std::size_t i = 0; i < bins; ++i) shares[i] = signal[i] * float_exp(least - exponents[i]);
  float sums[4] = {0.0F, 0.0F, 0.0F, 0.0F};
  for (std::size_t i = 0; i < bins; i += 4)
    for (std::size_t lane = 0; lane < 4; ++lane) sums[lane] += shares[i + lane];
  return float_log((sums[0] + sums[1]) + (sums[2] + sums[3])) - least;
}

void BeamSignal::log_shares(const float* water_mm, const float* mineral_mm, const float* iron_mm,
                            const float* contrast_mm, int count, float* out) const {
  const float* table = table_.data();
  const auto at = [](const float* mm, int i) { return mm == nullptr ? 0.0F : std::max(mm[i], 0.0F); };
  for (int i = 0; i < count; ++i) {
    const float water = std::max(water_mm[i], 0.0F), mineral = at(mineral_mm, i), iron = at(iron_mm, i),
                contrast = at(contrast_mm, i);
    const bool in_table =
        water < static_cast<float>(kTableWaterMm) && mineral < static_cast<float>(kTableMineralMm);
    const bool by_tables =
        !(contrast > 0.0F) || (!contrast_table_.empty() && water >= kLeastHardWaterMm &&
                               mineral < kMostHardMineralMm && contrast < static_cast<float>(kTableContrastMm));
    if (!in_table || iron > 0.0F || !by_tables) {
      out[i] = log_share_in_float(water, mineral, iron, contrast);
      continue;
    }
    const float x = water * (1.0F / kWaterStepMm), y = mineral * (1.0F / kMineralStepMm);
    const int column = static_cast<int>(x), row = static_cast<int>(y);
    const float u = x - static_cast<float>(column), v = y - static_cast<float>(row);
    const float* cell = table + row * kWaterPoints + column;
    const float upper = cell[0] + u * (cell[1] - cell[0]);
    const float lower = cell[kWaterPoints] + u * (cell[kWaterPoints + 1] - cell[kWaterPoints]);
    out[i] = upper + v * (lower - upper);
    if (contrast > 0.0F) out[i] += by_contrast_table(water, mineral, contrast);
  }
}

}  // namespace seldinger::imaging
