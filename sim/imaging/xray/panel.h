// What a fluoroscope's detector does to its pictures beyond noise and blur: an option of the screen, by kind of
// detector. What metrics hold to have been visible, and dose, are an ideal one's.
#pragma once

#include "sim/base/names.h"

namespace seldinger::imaging {

struct PanelFlaws {
  double glare_share = 0.0;  // of the signal, spread over the open field; evenly, as scatter is
  double lag_share = 0.0;    // of the picture before, that is still in this one
  constexpr bool any() const noexcept { return glare_share > 0.0 || lag_share > 0.0; }
};

enum class Panel { ideal, flat_panel, intensifier };
inline constexpr auto kPanelNames = base::names<Panel>(
    {{Panel::ideal, "ideal"}, {Panel::flat_panel, "flat_panel"}, {Panel::intensifier, "intensifier"}});

// A flat panel of amorphous silicon: first-frame lag 2 to 10 % by exposure (Siewerdsen and Jaffray, Med. Phys. 26,
// 1999, abstract; the second 0.7 %, here 0.25 %), "little or no veiling glare" (Seibert, Pediatr. Radiol. 36, 2006,
// abstract). An image intensifier: contrast of 20 to 1 in the shadow of lead (15 to 30, recalled), a camera of CCD
// without lag.
constexpr PanelFlaws flaws_of(Panel panel) noexcept {
  if (panel == Panel::flat_panel) return {0.0, 0.05};
  if (panel == Panel::intensifier) return {0.05, 0.0};
  return {};
}

}  // namespace seldinger::imaging
