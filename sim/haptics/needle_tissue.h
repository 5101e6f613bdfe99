// What a needle feels in each tissue: plateau line, capsule, stiffness; every row says where its numbers come from.
#pragma once

#include <span>
#include <string_view>

#include "sim/case/gauge.h"

namespace seldinger::haptics {

// Forces of a Chiba needle of 22 G driven along its axis; x is depth in mm from the first touch.
struct NeedleTissue {
  const char* name;
  double slope_n_mm;          // plateau force = slope · x + intercept: shaft friction per mm,
  double intercept_n;         // and what the tip takes to cut
  double tip_stiffness_n_mm;  // of the tissue before the tip, before it is cut
  double rupture_n;           // force on the tip at which the tissue's capsule opens
  double dent_mm;             // how far the capsule gives way before
  bool impenetrable;          // bone: nothing opens or is cut
  const char* provenance;
  const char* validated_against;
};

// One gauge, to which the rows belong (contracts.md; the thesis names none).
inline constexpr int kTableGauge = 22;

std::span<const NeedleTissue> needle_tissues();

// nullptr for a name that is not in the table.
const NeedleTissue* find_needle_tissue(std::string_view name);

// The row for another gauge: forces grow in proportion to the outer diameter (design; Jiang, J Biomech 2014,
// reports strong growth from 0.7 to 3.2 mm, and friction acts on the circumference).
NeedleTissue at_gauge(const NeedleTissue& tissue, const cases::Gauge& gauge);

}  // namespace seldinger::haptics
