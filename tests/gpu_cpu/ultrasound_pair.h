// One view on the CPU and on the GPU, and how far apart the two are.
#pragma once

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "sim/imaging/ultrasound/ultrasound_gpu.h"

namespace seldinger::imaging {

struct ScreenPair {
  std::vector<unsigned char> cpu, gpu;
  double far_apart = 1.0;  // share of the lit pixels that differ by more than one grey
  double lit = 0.0;        // share of pixels that either shows
};

ScreenPair screen_pair(UltrasoundGpu& gpu, const TissueVolume& tissue, const UltrasoundView& view,
                       const Inserted& inserted = {}, std::span<const float> depth_below_skin_mm = {},
                       const UltrasoundKnobs& knobs = {}, DisplaySize size = {400, 350},
                       const tissue::Displacement& displacement = {});

// At most one grey apart on 99.9 % of what is lit, and lit at all.
testing::AssertionResult alike(const ScreenPair& pair);

// The envelopes: samples 1 % (of the louder, or of the receiver's noise) apart or more are at most `share`. Every
// number is finite.
testing::AssertionResult alike(const PolarPicture& cpu, const PolarPicture& gpu, double share);

}  // namespace seldinger::imaging
