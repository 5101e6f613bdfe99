// A flat panel with a caesium iodide screen, and what it makes of a beam behind water, mineral and iron.
#pragma once

#include <vector>

#include "sim/imaging/xray/spectrum.h"

namespace seldinger::imaging {

// The panel adds up the energy of the photons that interact in its screen (fluorescence is taken as stopped again).
// 0.6 mm of needles packed to 75 %: Zhao, Ristic and Rowlands, Med. Phys. 31 (2004) 2594, describe screens of 0.15
// to 0.6 mm at about 75 %, with Swank factors about 0.9 beyond the spread of photon energies. The spread of light
// is a Gaussian with an MTF of 0.6 at 1 lp/mm, as of fluoroscopic panels (Granfors and Aufrichtig, Med. Phys. 27
// (2000) 1324).
struct Detector {
  double csi_mm = 0.6, packing = 0.75;
  double swank = 0.9;
  double blur_sigma_mm = 0.16;
  // Read-out noise of one pixel, as the standard deviation in quanta: an assumption; amorphous silicon panels are
  // limited by quantum noise down to a few quanta a pixel.
  double electronic_quanta = 2.0;
};

// One spectrum seen by one detector. Signals are shares of the signal in the open beam, as logarithms, which
// neither overflow nor underflow behind anything.
class BeamSignal {
 public:
  BeamSignal(const Spectrum& spectrum, const Detector& detector);

  // The sum over the spectrum. Lengths of projection.h; negative ones count as 0.
  double log_share(double water_mm, double mineral_mm, double iron_mm = 0.0) const;

  // The same for `count` pixels by a table over water (to kTableWaterMm) and mineral (to kTableMineralMm), bilinear
  // in the logarithm; beyond the table, and where there is iron (`iron_mm` may be null), by the sum. The worst
  // error of the table's signal is measured in tests/sim/imaging/xray/detector_test.cpp: < 1e-3. The same bits on
  // every machine.
  void log_shares(const float* water_mm, const float* mineral_mm, const float* iron_mm, int count,
                  float* out) const;

  // In the open beam at 1 m.
  double open_quanta_per_mas_mm2() const noexcept { return open_quanta_; }
  double open_kerma_mgy_per_mas() const noexcept { return open_kerma_mgy_; }
  // Air kerma at the detector per signal share and mAs at 1 m: calibrated behind 200 mm of water, as panels are
  // behind a phantom.
  double kerma_mgy_per_mas_share() const noexcept { return kerma_per_share_; }
  double kv() const noexcept { return kv_; }

  static constexpr double kTableWaterMm = 600.0, kTableMineralMm = 200.0;

 private:
  struct Bin {
    double signal, water_per_mm, mineral_per_mm, iron_per_mm;
  };
  float log_share_in_float(float water_mm, float mineral_mm, float iron_mm) const;
  std::vector<Bin> bins_;             // by energy
  std::vector<float> float_bins_[4];  // the members of bins_
  std::vector<float> table_;          // [mineral][water] of log share
  double kv_, open_quanta_, open_kerma_mgy_, kerma_per_share_;
};

}  // namespace seldinger::imaging
