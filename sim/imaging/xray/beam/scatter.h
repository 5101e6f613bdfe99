// What is scattered in the patient onto the panel, as a pedestal under the picture: its share of the primary signal
// by thickness, field, air gap and grid.
//
// In the middle of a square field behind water whose middle lies at the isocentre, within 20 % of our own Monte
// Carlo for 100 to 300 mm, fields of 100 to 300 mm at the panel and 60 to 100 kV
// (tests/sim/imaging/xray/beam/scatter_test.cpp), from which its four numbers are:
//   0.89 · (thickness/200 mm)^1.65 · (field/200 mm)^1.5 · (gap/315 mm)^−1.4
// That is with a gap of 315 mm; through 100 and 200 mm of water it is also within 20 % from 185 mm on. A panel can
// come as near as 115 mm (a source-image distance of 900 mm). There the law still grows as gap^−1.4, and the Monte
// Carlo less: at 150 mm the law is 0.88 to 1.37 of it, at 115 mm 0.78 to 1.86, too much in wide fields (60 to 100
// kV). It is taken as the same all over the field, which scatter nearly is.
#pragma once

namespace seldinger::imaging {

// The primary that a focused grid lets through, and the scatter: of a usual fluoroscopic grid (design, within what
// makers state for ratios of 10 to 13).
constexpr double kGridPrimaryShare = 0.70, kGridScatterShare = 0.15;

struct ScatterGeometry {
  double water_mm = 200.0;  // that weakens the beam as the patient does
  double field_mm = 300.0;  // side of a square field of the same area, at the panel
  double gap_mm = 315.0;    // from the patient's middle to the panel
  bool grid = false;
};

// Signal of scatter over signal of primary at the panel. What is not > 0 of the lengths gives 0.
double scatter_to_primary(const ScatterGeometry& geometry) noexcept;

}  // namespace seldinger::imaging
