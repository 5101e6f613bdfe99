// Ultrasound-like pictures as in Vidal's thesis (2008) §4.6, for comparison only: windowed HU, times a mask of
// shadows that thresholds of HU cast, times noise from a stack of noisy slices, with edges along the beam made
// bright by Sobel's operator. The thesis gives no numbers; those here are our judgement.
#pragma once

#include "sim/imaging/ultrasound/view/motion.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

constexpr double kThesisBlackHu = -160.0, kThesisWhiteHu = 240.0;    // the abdominal window of CT
constexpr double kThesisBoneHu = 150.0, kThesisGasHu = -500.0;       // thresholds
constexpr double kThesisBoneShadow = 0.15, kThesisGasShadow = 0.25;  // what is left behind them (design)
constexpr double kThesisNeedleShadow = 0.6;                          // (design)
constexpr double kThesisNoiseMm = 0.5, kThesisNoiseLeast = 0.5;      // texel; uniform in [least, 1)
constexpr double kThesisEdgeStepMm = 1.0, kThesisEdgeFrom = 0.15;    // of the window, per step (design)

// As ultrasound_polar; a level that the default console shows as the grey that the recipe asks for.
void thesis_polar(const TissueVolume& tissue, const UltrasoundView& view, const Inserted& inserted,
                  const PictureMotion* motion, PolarPicture& picture);

}  // namespace seldinger::imaging
