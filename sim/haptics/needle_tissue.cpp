#include "sim/haptics/needle_tissue.h"

namespace seldinger::haptics {
namespace {

// The lines of kidney and liver are the thesis' (§5.3.2, 500 mm/min, in vitro). "Recalled" marks what
// knowledge/haptics.md §2.1 lists as recalled from the literature and not yet checked against it.
constexpr NeedleTissue kTissues[] = {
    {"kidney", 0.010, 1.53, 0.25, 2.6, 10.0, false,
     "line and dent: thesis §5.3.2, porcine, in vitro; rupture (design): within 1-3 N above the plateau's foot "
     "(Maurin 2004, recalled), below the 3.3 N the thesis names as its bound; stiffness (design)",
     "the thesis' line, 500 mm/min"},
    {"liver", 0.020, 0.38, 0.15, 1.1, 8.0, false,
     "line: thesis §5.3.2, ox, in vitro; rupture (design): 0.3-1 N over the plateau (Maurin 2004, recalled); dent, "
     "stiffness (design)",
     "the thesis' line, 500 mm/min"},
    {"muscle", 0.010, 0.75, 0.20, 1.4, 6.0, false,
     "plateau within 0.5-1.5 N (recalled, wide scatter); slope, rupture, dent, stiffness (design)", "nothing yet"},
    {"fat", 0.003, 0.15, 0.10, 0.35, 3.0, false,
     "plateau within 0.1-0.4 N (recalled, wide scatter); slope, rupture, dent, stiffness (design)", "nothing yet"},
    {"skin", 0.010, 0.60, 0.25, 2.5, 9.5, false,
     "rupture within 2-4 N at 18-22 G (van Gerwen 2012, Healey 2005, recalled); plateau, dent, stiffness (design)",
     "nothing yet"},
    {"bone", 0.0, 0.0, 1.0, 0.0, 0.0, true, "a wall as stiff as the device may show (haptics.md §2.2, item 5)",
     "nothing yet"},
};

}  // namespace

std::span<const NeedleTissue> needle_tissues() {
  return kTissues;
}

const NeedleTissue* find_needle_tissue(std::string_view name) {
  for (const NeedleTissue& tissue : kTissues)
    if (name == tissue.name) return &tissue;
  return nullptr;
}

NeedleTissue at_gauge(const NeedleTissue& tissue, const cases::Gauge& gauge) {
  const double ratio = gauge.outer_mm / cases::gauge(kTableGauge)->outer_mm;
  NeedleTissue scaled = tissue;
  scaled.slope_n_mm *= ratio;
  scaled.intercept_n *= ratio;
  scaled.tip_stiffness_n_mm *= ratio;
  scaled.rupture_n *= ratio;
  return scaled;
}

}  // namespace seldinger::haptics
