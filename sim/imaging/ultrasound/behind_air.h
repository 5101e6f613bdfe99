// Where beams come from tissue to lung or gas, and the haze that shows behind: sound goes to and fro between there
// and what lies before it, comes back late, and seems to lie where no sound has been (docs/decisions/0099).
#pragma once

#include <span>
#include <vector>

#include "sim/imaging/ultrasound/view/fan.h"
#include "sim/imaging/ultrasound/view/motion.h"

namespace seldinger::imaging {

constexpr double kNoAirMm = 1e6;

// What a beam meets first that lets no sound on, where that is lung or gas in the body.
struct AirMet {
  volume::TissueClass tissue = volume::TissueClass::air;  // neither
  double depth_mm = kNoAirMm, shown_mm = kNoAirMm;        // where it is, and where the picture shows it
  double mrayl = 0.0;                                     // of the tissue before it
  double loss_db = 0.0;                                   // two-way, down to it
  double source_db = 0.0;                                 // of what scatters before it, over liver
};
// One a beam; none at all where no beam meets any, or the view shows no artefacts. Gas only where it has a haze.
// `motion`: of tissue that moves; else null.
std::vector<AirMet> air_met(const UltrasoundView& view, const TissueAt& tissue_at, const PictureMotion* motion,
                            std::span<const float> depth_below_skin_mm);

// Lung nearer than this lies behind the chest's wall: no mirror's picture is seen there, but haze (design).
constexpr double kLeastMirrorMm = 40.0;
// Behind gas there are echoes, behind stones few: the shadow is dirty (Sommer and Taylor, Radiology 135 (1980) 399;
// Rubin, Adler, Bude et al., Radiology 181 (1991) 231). How far from liver at that depth it begins and how fast it
// falls is a judgement: grey for 2 cm, gone after 5; and before that gas, which is no smooth mirror, rings for some
// mm, so that its front has no sharp lower edge.
// What scatters in the last 20 mm before it makes it: behind fluid, and right below the skin, there is hardly any.
constexpr double kHazeFromMm = 20.0;
constexpr double kHazeBelowDb = 8.0, kHazeFallDbMm = 0.6, kRingDb = 10.0, kRingFallDbMm = 5.0;
// In cases of the law that clutter came with; what is told of pictures knows nothing of it.
inline bool shows_haze(const UltrasoundView& view) {
  return shows_clutter(view);
}
bool has_haze(const UltrasoundView& view, const AirMet& met) noexcept;
// Its mean square so far behind where the picture shows what was met; liver's speckle at the face is 0.
double haze_db(const UltrasoundView& view, const AirMet& met, double behind_mm) noexcept;

// Of lung the surface that the beam meets squarely shows again and again, at multiples of its depth: A-lines
// (Lichtenstein and Mezière, Chest 134 (2008) 117), by the law of gas (us_repeat). The haze: speckle of its own, as
// long as the pulse and as wide as the beam, counted from what was met on: so it lies along that, and still where
// that lies still. By the view's seed; nothing of the tissue is in it.
void add_haze(const UltrasoundView& view, std::span<const AirMet> met, PolarPicture& picture);

}  // namespace seldinger::imaging
