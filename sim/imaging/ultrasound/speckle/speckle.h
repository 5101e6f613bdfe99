// Where speckle comes from, before loss and pulse: complex sums along the beams, in tissue coordinates.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/motion.h"

namespace seldinger::imaging {

class SpeckleField {
 public:
  // With the pulse of unit energy, liver's mean square is 1. The least part of a sum that rounding can hide is
  // 100 dB below liver; 80 dB above it there is still room.
  static constexpr float kUnit = 524288.0F;

  SpeckleField() = default;
  SpeckleField(const SpeckleField&) = delete;
  SpeckleField& operator=(const SpeckleField&) = delete;
  virtual ~SpeckleField() = default;

  // Fine samples to a sample.
  virtual int fine() const noexcept = 0;

  // The sum, complex, in units of 1/kUnit, of beams [first, end): fine sample n of a beam is
  // out[((beam − first)·samples·fine + n)·2]. Whole numbers, so that the order of adding says nothing.
  virtual void add_beams(int first, int end, std::vector<std::int32_t>& out) const = 0;
};

// That of the view's method; null for thesis, which has none. The arguments outlive it; `motion` is null where
// tissue lies still.
std::unique_ptr<SpeckleField> speckle_field(const UltrasoundView& view, const TissueAt& tissue_at,
                                            const PictureMotion* motion);

}  // namespace seldinger::imaging
