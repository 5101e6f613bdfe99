// A flat panel with a caesium iodide screen, and what it makes of a beam behind water, mineral, iron and iodine.
#pragma once

#include <vector>

#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/beam/spectrum.h"

namespace seldinger::imaging {

// The panel adds up the energy of the photons that interact in its screen (fluorescence is taken as stopped again).
// Screens of 0.15 to 0.6 mm and their Swank factor beyond the spread of photon energies, 0.91 to 0.93: Zhao, Ristic
// and Rowlands, Med. Phys. 31 (2004) 2594. Assumptions: needles packed to 75 %; spread of light as a Gaussian with
// an MTF of 0.6 at 1 lp/mm; a read-out noise of two quanta a pixel, panels being limited by quantum noise.
struct Detector {
  double csi_mm = 0.6, packing = 0.75;
  double swank = 0.92;
  double blur_sigma_mm = 0.16;
  double electronic_quanta = 2.0;  // standard deviation
};

// What is known of the CT that a patient's lengths come of: at which energy its numbers are true (attenuation.h),
// and whether contrast medium lies on many rays, so that a table of its own pays (some 2 ms more).
struct BehindCt {
  double kev = kHuEnergyKev;
  bool enhanced = false;
};

// One spectrum seen by one detector. Signals are shares of the signal in the open beam, as logarithms, which
// neither overflow nor underflow behind anything.
class BeamSignal {
 public:
  BeamSignal(const Spectrum& spectrum, const Detector& detector, const BehindCt& ct = {});

  // The sum over the spectrum. Lengths of projection.h; negative ones count as 0.
  double log_share(double water_mm, double mineral_mm, double iron_mm = 0.0, double contrast_mm = 0.0) const;

  // The same for `count` pixels by a table over water (to kTableWaterMm) and mineral (to kTableMineralMm), bilinear
  // in the logarithm; beyond the table, and where there is iron or contrast (either may be null), by the sum;
  // behind an enhanced CT contrast to kTableContrastMm by a second table of what it takes off, linear in all three,
  // from 40 mm of water and to 60 mm of mineral. The worst error of the table's signal is measured in
  // tests/sim/imaging/xray/detector_test.cpp: < 1e-3. The same bits on every machine.
  void log_shares(const float* water_mm, const float* mineral_mm, const float* iron_mm, const float* contrast_mm,
                  int count, float* out) const;

  // In the open beam at 1 m.
  double open_quanta_per_mas_mm2() const noexcept { return open_quanta_; }
  double open_kerma_mgy_per_mas() const noexcept { return open_kerma_mgy_; }
  // Air kerma at the detector per signal share and mAs at 1 m: calibrated behind 200 mm of water, as panels are
  // behind a phantom.
  double kerma_mgy_per_mas_share() const noexcept { return kerma_per_share_; }
  double kv() const noexcept { return kv_; }

  static constexpr double kTableWaterMm = 600.0, kTableMineralMm = 200.0, kTableContrastMm = 10.0;

 private:
  struct Bin {
    double signal, water_per_mm, mineral_per_mm, iron_per_mm, contrast_per_mm;
  };
  float log_share_in_float(float water_mm, float mineral_mm, float iron_mm, float contrast_mm) const;
  void tabulate_contrast();
  float by_contrast_table(float water_mm, float mineral_mm, float contrast_mm) const;
  std::vector<Bin> bins_;              // by energy
  std::vector<float> float_bins_[5];   // the members of bins_
  std::vector<float> table_;           // [mineral][water] of log share
  std::vector<float> contrast_table_;  // [contrast][mineral][water] of what contrast adds to it; or empty
  double kv_, open_quanta_, open_kerma_mgy_, kerma_per_share_;
};

}  // namespace seldinger::imaging
