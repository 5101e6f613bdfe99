// What a fluoroscope's detector does to its pictures beyond noise and blur: an option of the screen, by kind of
// detector. What metrics hold to have been visible, and dose, are an ideal one's.
#pragma once

#include <array>

#include "sim/base/names.h"

namespace seldinger::imaging {

struct PanelFlaws {
  double glare_share = 0.0;  // of the signal, spread over the open field; evenly, as scatter is
  bool lags = false;         // what was seen is still in pictures to come, by kLag
  constexpr bool any() const noexcept { return glare_share > 0.0 || lags; }
};

enum class Panel { ideal, flat_panel, intensifier };
inline constexpr auto kPanelNames = base::names<Panel>(
    {{Panel::ideal, "ideal"}, {Panel::flat_panel, "flat_panel"}, {Panel::intensifier, "intensifier"}});

// What a panel of amorphous silicon keeps of what it saw: of all but a hundredth 4 % each frame, which reading
// leaves behind; of a hundredth, which is trapped, 75 %. Of a signal that ends, 4.7, 0.69, 0.41 and 0.30 % are so
// in the first four frames: published are 2 to 10 by exposure, 0.7, 0.4 and 0.3 (Siewerdsen and Jaffray, Med. Phys.
// 26, 1999, abstract). Both parts go on between pulses, as charge does; a frame is taken to be that of 15 pulses a
// second.
struct LagPart {
  double share, left_each_frame;
};
inline constexpr std::array<LagPart, 2> kLag{{{0.9905, 0.04}, {0.0095, 0.75}}};
inline constexpr double kLagFrameS = 1.0 / 15.0;

// A flat panel of amorphous silicon: "little or no veiling glare" (Seibert, Pediatr. Radiol. 36, 2006, abstract).
// An image intensifier: contrast of 20 to 1 in the shadow of lead (15 to 30, recalled), a camera of CCD without
// lag.
constexpr PanelFlaws flaws_of(Panel panel) noexcept {
  if (panel == Panel::flat_panel) return {0.0, true};
  if (panel == Panel::intensifier) return {0.05, false};
  return {};
}

}  // namespace seldinger::imaging
