// Speckle as complex noise on the nodes of a lattice in tissue coordinates, interpolated where the beams run and
// smoothed across them. Fast, for a node costs a hash; but its cells must be as wide as the beams lie apart, so
// that depth is resolved no better than the lattice, and it has no thickness: a tilted probe sees new speckle at
// once (docs/decisions/0014). The cells double with the spacing of the beams.
#pragma once

#include "sim/imaging/ultrasound/speckle/speckle.h"

namespace seldinger::imaging {

class LatticeField final : public SpeckleField {
 public:
  LatticeField(const UltrasoundView& view, const TissueAt& tissue_at, const PictureMotion* motion);

  int fine() const noexcept override { return 1; }
  void add_beams(int first, int end, std::vector<std::int32_t>& out) const override;

  static constexpr int kLinesPerBeam = 2;  // enough that a shift below the beams' spacing moves the speckle with it
  static constexpr double kLeastCellMm = 0.125;

  // What holds at one depth.
  struct AtSample {
    float per_mm;         // cells
    std::uint32_t key;    // of the cells' bits
    float lateral_scale;  // of (lines off)²: −log of the weight
    int lateral_reach;    // lines
    float gain;           // so that liver's mean square is 1 after everything
  };
  const AtSample& at_sample(int sample) const { return at_sample_[static_cast<std::size_t>(sample)]; }

 private:
  void noise_line(double beam, std::vector<float>& re, std::vector<float>& im) const;

  const UltrasoundView& view_;
  const TissueAt& tissue_at_;
  const PictureMotion* motion_;
  Fan fan_;
  int most_reach_ = 0;
  std::vector<AtSample> at_sample_;
};

}  // namespace seldinger::imaging
