// Compares two HU pictures. A failing comparison leaves result, reference and difference as PGM files below
// the folder of tests' output and says where, and which pixel is worst.
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "sim/imaging/mpr/mpr.h"

namespace seldinger::imaging {

using PixelMask = std::vector<bool>;  // true: left out of the comparison; empty: everything is compared

// `name` is the folder of the pictures: one for each comparison of a test.
testing::AssertionResult images_agree(const HuImage& result, const HuImage& reference, int width_px,
                                      double tolerance_hu, const PixelMask& left_out, const std::string& name);

double share_of(const PixelMask& mask);

}  // namespace seldinger::imaging
