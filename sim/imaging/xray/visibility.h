// What an X-ray picture shows: inside the collimated field, contrast ≥ 3 σ; of a pulse with scatter, whose signal
// and noise that is part of, 5 σ, from which on details are told apart reliably (Rose, J. Opt. Soc. Am. 38 (1948)
// 196). Expected values along one ray per question: no picture is made, and no seed matters.
//
// Contrast is the relative difference of the signal with and without the object on the ray through it, of a drawn
// target to what lies about it in its place; σ is the
// relative quantum noise of a patch of the panel: for the needle as wide as its shadow and as long as the shadow of
// its last kTipElementMm, for the lesion as large as its shadow, but at most kLargestPatchMm2. That limit is
// chosen: the eye does not add up ever larger patches, and anatomy hides more than quanta do, so that a few per
// cent are the least contrast of large details in fluoroscopy whatever their size; 3 σ of 15 mm² at 30 nGy are 3 %.
// So a needle is seen in an abdomen, an opacified calyx too, and a soft-tissue lesion is not.
#pragma once

#include "sim/imaging/inserted.h"
#include "sim/imaging/visible.h"
#include "sim/imaging/xray/enhanced.h"
#include "sim/imaging/xray/exposure.h"
#include "sim/imaging/xray/projection/projection.h"

namespace seldinger::imaging {

constexpr double kVisibleSigmas = 3.0, kVisibleSigmasInScatter = 5.0;
constexpr double kTipElementMm = 2.0;
constexpr double kLargestPatchMm2 = 15.0;  // at the panel

struct Contrast {
  double relative = 0.0;  // of the signal, ≥ 0; with the object against without it
  double sigma = 0.0;     // relative noise of the patch; +∞ where nothing arrives
  double least_sigmas = kVisibleSigmas;
  bool visible() const noexcept { return relative >= least_sigmas * sigma; }
};

// In `geometry`, of the whole field, with the pulse's technique and collimator (of a parallel geometry also its
// sid_mm, for the dose). The target is inserted.lesions[0]; the other lesions and the needle lie in the volume as
// inserted. `contrast`: what contrast medium there is (ContrastMedium::shown); null: none;
// `enhanced`: what of the volume is iodine; null: nothing. A pose that is not
// finite is not shown; `needle_length_mm` is the length of the shaft inside the field, 0 where the middle of that
// part is not visible. `geometry` in order (check_geometry).
Visible xray_visible(const volume::Volume& volume, const XrayGeometry& geometry, const BeamSignal& beam,
                     const Pulse& pulse, const Inserted& inserted, const volume::Volume* contrast = nullptr,
                     const EnhancedTissue* enhanced = nullptr);

// Of the shaft at this distance behind the tip, 0 ≤ behind_tip_mm ≤ length; none when the needle is not there, or
// the point is not between source and panel.
std::optional<Contrast> needle_contrast(const volume::Volume& volume, const XrayGeometry& geometry,
                                        const BeamSignal& beam, const Pulse& pulse, const Inserted& inserted,
                                        double behind_tip_mm, const volume::Volume* contrast = nullptr,
                                        const EnhancedTissue* enhanced = nullptr);
// Of the target on the ray through its centre.
std::optional<Contrast> target_contrast(const volume::Volume& volume, const XrayGeometry& geometry,
                                        const BeamSignal& beam, const Pulse& pulse, const Inserted& inserted,
                                        const volume::Volume* contrast = nullptr,
                                        const EnhancedTissue* enhanced = nullptr);

}  // namespace seldinger::imaging
