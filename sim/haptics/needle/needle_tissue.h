// What a needle feels in each tissue class: plateau line, capsule, stiffness; every row says where its numbers come
// from.
#pragma once

#include <span>

#include "sim/case/case.h"
#include "sim/case/gauge.h"
#include "sim/volume/classes.h"

namespace seldinger::haptics {

// Forces on a Chiba needle driven along its axis; x is depth in mm from the first touch. All ≥ 0.
struct NeedleTissue {
  double slope_n_mm = 0.0;          // plateau force = slope · x + intercept: shaft friction per mm,
  double intercept_n = 0.0;         // and what the tip takes to cut
  double tip_stiffness_n_mm = 0.0;  // of the tissue before the tip, before it is cut; > slope where intercept > 0
  double rupture_n = 0.0;           // force on the tip at which the tissue's capsule opens; 0: there is none
  double dent_mm = 0.0;             // how far the capsule gives way before
  bool impenetrable = false;        // bone, metal: nothing opens or is cut
};

struct NeedleTissueRow {
  volume::TissueClass tissue;
  NeedleTissue needle;  // at kTableGauge
  const char* provenance;
  const char* validated_against;
};

// One gauge, to which the rows belong (our choice; the thesis names none).
inline constexpr int kTableGauge = 22;

// One row per class, in the classes' order.
std::span<const NeedleTissueRow, volume::kTissueClasses> needle_tissues() noexcept;

// Of the class's row.
const NeedleTissue& needle_tissue(volume::TissueClass tissue) noexcept;

// Where HU alone must tell (soft_tissue): between fat's row at -100 HU and the class's own from 40 HU on, as HU
// lies (Prokop's HU, as classes.h; that forces follow them in a straight line is design).
NeedleTissue soft_tissue_of_hu(double hu) noexcept;

// Of a lesion: its kind's row, or that of the class its HU tell (what HU cannot tell apart: as HU lie).
NeedleTissue needle_tissue(const cases::Lesion& lesion) noexcept;

// What a form of tip does with the force of a tissue's row, which is a Chiba's: the parts of it.
struct NeedleTipRow {
  cases::NeedleTip tip;
  double cutting, rupture, friction;
  const char* provenance;
};
// One row per form, in their order.
std::span<const NeedleTipRow, cases::kNeedleTipNames.size()> needle_tips() noexcept;

// The row for another gauge: forces grow in proportion to the outer diameter (design; Jiang, J Biomech 2014,
// reports strong growth from 0.7 to 3.2 mm, and friction acts on the circumference).
NeedleTissue at_gauge(const NeedleTissue& tissue, const cases::Gauge& gauge);
// The row for another needle, as the case's law of touch says: that of before by gauge alone; the newest by its
// parts. What is torn grows with the blade, so with the diameter, what is spread with its square; a capsule opens
// by being torn alone; friction grows with the circumference. Each as the tip's row says.
NeedleTissue felt_by(const NeedleTissue& tissue, const cases::Gauge& gauge, const cases::Touch& touch);
// A needle, as far as touch tells it from others.
struct FeltNeedle {
  cases::Gauge gauge;
  cases::Touch touch;
};
// A tissue that one needle feels so, as another feels it.
NeedleTissue felt_instead(const NeedleTissue& felt, const FeltNeedle& by, const FeltNeedle& instead);
// What stands about a needle that goes through an introducer, the introducer's stylet being in: 17 G about 18 G,
// 0.2 mm wider (catalogues of coaxial sets), with a trocar's point (design).
FeltNeedle introducer_for(const FeltNeedle& needle);
// The other way round: what was measured with that gauge, as a row of the table.
NeedleTissue at_table_gauge(const NeedleTissue& measured, const cases::Gauge& gauge);

}  // namespace seldinger::haptics
