// A slice of the CT below the probe, as the screen shows it.
#pragma once

#include <array>

#include "session/guidance/grey_picture.h"
#include "sim/case/case.h"
#include "sim/case/console.h"
#include "sim/case/record/recording.h"
#include "sim/imaging/mpr/mpr.h"
#include "sim/tissue/displacement.h"

namespace seldinger::session {

constexpr double kSlicePixelMm = 0.4;  // a 22-gauge needle is 1.8 of these
constexpr double kMostSliceMm = 50.0;  // beside the probe's plane, either way

// Which HU are black and white: the screen's alone, no part of an attempt.
struct HuWindow {
  const char* name;
  double center_hu, width_hu;
};
// As radiologists set them for the abdomen (soft tissue, liver), chest and skeleton. The first is the one to begin
// with.
inline constexpr std::array<HuWindow, 4> kHuWindows = {
    {{"soft tissue", 60.0, 400.0}, {"liver", 90.0, 150.0}, {"lung", -600.0, 1500.0}, {"bone", 400.0, 1800.0}}};

// In the plane of the probe, or as far beside it as the console says.
imaging::MprView slice_view(const cases::Picture& picture, const cases::PoseSample& pose,
                            const cases::ConsoleSetting& console);

GreyPicture slice_under_probe(const cases::Case& scene, const cases::PoseSample& pose,
                              const cases::ConsoleSetting& console, const imaging::NeedlePose& needle,
                              const tissue::Displacement& displacement, const HuWindow& window = kHuWindows[0]);

}  // namespace seldinger::session
