#include "sim/haptics/needle/needle_tissue.h"

#include <algorithm>
#include <array>

namespace seldinger::haptics {
namespace {

using volume::TissueClass;

constexpr const char* kNothingYet = "nothing yet";
constexpr const char* kNoTissue = "no resistance: nothing there to cut or to drag (design)";
constexpr const char* kWall = "a wall as stiff as the device may show (design)";

// The lines of kidney and liver are the thesis' (§5.3.2, 500 mm/min, in vitro). "Recalled" marks what
// is recalled from the literature and not yet checked against it.
constexpr std::array<NeedleTissueRow, volume::kTissueClasses> kTissues{{
    {TissueClass::air, {}, kNoTissue, kNothingYet},
    {TissueClass::gas, {}, kNoTissue, kNothingYet},
    {TissueClass::lung, {0.001, 0.05, 0.05, 0.30, 3.0}, "(design): soft behind the pleura", kNothingYet},
    {TissueClass::fat,
     {0.003, 0.15, 0.10, 0.35, 3.0},
     "plateau within 0.1-0.4 N (recalled, wide scatter); slope, rupture, dent, stiffness (design)",
     kNothingYet},
    {TissueClass::fluid, {}, kNoTissue, kNothingYet},
    {TissueClass::soft_tissue,
     {0.010, 0.75, 0.20, 1.4, 6.0},
     "as muscle: HU cannot tell which tissue it is (design)",
     kNothingYet},
    {TissueClass::liver,
     {0.020, 0.38, 0.15, 1.1, 8.0},
     "line: thesis §5.3.2, ox, in vitro; rupture (design): 0.3-1 N over the plateau (Maurin 2004, recalled); dent, "
     "stiffness (design)",
     "the thesis' line, 500 mm/min"},
    {TissueClass::kidney,
     {0.010, 1.53, 0.25, 2.6, 10.0},
     "line and dent: thesis §5.3.2, porcine, in vitro; rupture (design): 1-3 N (Maurin 2004, recalled), below the "
     "3.3 N the thesis names as its bound; stiffness (design)",
     "the thesis' line, 500 mm/min"},
    {TissueClass::spleen, {0.020, 0.38, 0.15, 1.1, 8.0}, "as liver (design)", kNothingYet},
    {TissueClass::muscle,
     {0.010, 0.75, 0.20, 1.4, 6.0},
     "plateau within 0.5-1.5 N (recalled, wide scatter); slope, rupture, dent, stiffness (design)",
     kNothingYet},
    {TissueClass::skin,
     {0.010, 0.60, 0.25, 2.5, 9.5},
     "rupture within 2-4 N at 18-22 G (van Gerwen 2012, Healey 2005, recalled), nearly the same at any speed "
     "(Schneider 1978; Frick, J Biomech 2001: 1-10 mm/s, abstracts read); plateau, dent, stiffness (design)",
     kNothingYet},
    {TissueClass::connective, {0.020, 1.5, 0.25, 2.6, 8.0}, "(design): above muscle", kNothingYet},
    {TissueClass::vessel, {0.005, 0.10, 0.10, 0.8, 4.0}, "(design): a wall, then blood", kNothingYet},
    {TissueClass::bone, {.impenetrable = true}, kWall, kNothingYet},
    {TissueClass::metal, {.impenetrable = true}, kWall, kNothingYet},
}};

// Bevel is the needle of the rows above. Jiang 2014 reports that the tip's form changes the force much (abstract
// read); the order blunt, conical, diamond, bevel from most to least is recalled, and how far they lie apart is
// design.
constexpr std::array<NeedleTipRow, cases::kNeedleTipNames.size()> kTips{{
    {cases::NeedleTip::bevel, 1.0, 1.0, 1.0, "the tissues' own rows: a Chiba"},
    {cases::NeedleTip::diamond, 1.15, 1.05, 1.0,
     "(design): above a bevel of the same diameter (Jiang, J Biomech 2014, order recalled)"},
    {cases::NeedleTip::trocar, 1.35, 1.15, 1.0,
     "(design): three facets with a wider angle than a diamond's, so nearer to Jiang's cone"},
    {cases::NeedleTip::core, 1.10, 0.90, 1.15,
     "(design): the stylet, thinner than its cannula, opens; the cannula's edge follows and the notch drags"},
}};
// Of what a needle takes but friction: tearing 61 %, spreading 18 % (Barnett, Lee and Moore, J Manuf Sci Eng 2015,
// doi 10.1115/1.4030374, abstract read).
constexpr double kTornPart = 0.61 / (0.61 + 0.18);

NeedleTissue scaled(NeedleTissue tissue, double ratio) {
  tissue.slope_n_mm *= ratio;
  tissue.intercept_n *= ratio;
  tissue.tip_stiffness_n_mm *= ratio;
  tissue.rupture_n *= ratio;
  return tissue;
}

}  // namespace

std::span<const NeedleTissueRow, volume::kTissueClasses> needle_tissues() noexcept {
  return kTissues;
}

const NeedleTissue& needle_tissue(volume::TissueClass tissue) noexcept {
  const auto at = static_cast<std::size_t>(tissue);
  return kTissues[at < kTissues.size() ? at : 0].needle;
}

NeedleTissue needle_tissue(const cases::Lesion& lesion) noexcept {
  if (lesion.kind != cases::LesionKind::by_hu) {
    const cases::LesionTouch& touch = cases::about(lesion.kind).touch;
    return {.slope_n_mm = touch.slope_n_mm,
            .intercept_n = touch.cutting_n,
            .tip_stiffness_n_mm = touch.tip_stiffness_n_mm,
            .rupture_n = touch.edge_n,
            .dent_mm = touch.dent_mm};
  }
  const TissueClass tissue = cases::tissue_of_lesion(lesion.hu);
  return tissue == TissueClass::soft_tissue ? soft_tissue_of_hu(lesion.hu) : needle_tissue(tissue);
}

NeedleTissue soft_tissue_of_hu(double hu) noexcept {
  constexpr double kFatHu = -100.0, kTissueHu = 40.0;
  const double share = std::clamp((hu - kFatHu) / (kTissueHu - kFatHu), 0.0, 1.0);
  const NeedleTissue &fat = needle_tissue(TissueClass::fat), &full = needle_tissue(TissueClass::soft_tissue);
  const auto between = [&](double a, double b) { return a + share * (b - a); };
  return {.slope_n_mm = between(fat.slope_n_mm, full.slope_n_mm),
          .intercept_n = between(fat.intercept_n, full.intercept_n),
          .tip_stiffness_n_mm = between(fat.tip_stiffness_n_mm, full.tip_stiffness_n_mm),
          .rupture_n = between(fat.rupture_n, full.rupture_n),
          .dent_mm = between(fat.dent_mm, full.dent_mm)};
}

std::span<const NeedleTipRow, cases::kNeedleTipNames.size()> needle_tips() noexcept {
  return kTips;
}

NeedleTissue felt_by(const NeedleTissue& tissue, const cases::Gauge& gauge, const cases::Touch& touch) {
  if (touch.law == cases::TouchLaw::steady) return at_gauge(tissue, gauge);
  const NeedleTipRow& tip = kTips[static_cast<std::size_t>(touch.tip)];
  const double wide = gauge.outer_mm / cases::gauge(kTableGauge)->outer_mm;
  const double blade = wide * (kTornPart + (1.0 - kTornPart) * wide);
  NeedleTissue felt = tissue;
  felt.slope_n_mm *= tip.friction * wide;
  felt.intercept_n *= tip.cutting * blade;
  felt.rupture_n *= tip.rupture * wide;
  felt.tip_stiffness_n_mm *= wide;
  return felt;
}

NeedleTissue felt_instead(const NeedleTissue& felt, const FeltNeedle& by, const FeltNeedle& instead) {
  constexpr NeedleTissue kUnit{1.0, 1.0, 1.0, 1.0, 1.0};
  const NeedleTissue was = felt_by(kUnit, by.gauge, by.touch);
  const NeedleTissue is = felt_by(kUnit, instead.gauge, instead.touch);
  NeedleTissue now = felt;
  now.slope_n_mm *= is.slope_n_mm / was.slope_n_mm;
  now.intercept_n *= is.intercept_n / was.intercept_n;
  now.tip_stiffness_n_mm *= is.tip_stiffness_n_mm / was.tip_stiffness_n_mm;
  now.rupture_n *= is.rupture_n / was.rupture_n;
  return now;
}

FeltNeedle introducer_for(const FeltNeedle& needle) {
  FeltNeedle introducer = needle;
  introducer.gauge = {0, needle.gauge.outer_mm + 2.0 * cases::kIntroducerWallMm, 0.0};
  introducer.touch.tip = cases::NeedleTip::trocar;
  return introducer;
}

NeedleTissue at_gauge(const NeedleTissue& tissue, const cases::Gauge& gauge) {
  return scaled(tissue, gauge.outer_mm / cases::gauge(kTableGauge)->outer_mm);
}

NeedleTissue at_table_gauge(const NeedleTissue& measured, const cases::Gauge& gauge) {
  return scaled(measured, cases::gauge(kTableGauge)->outer_mm / gauge.outer_mm);
}

}  // namespace seldinger::haptics
