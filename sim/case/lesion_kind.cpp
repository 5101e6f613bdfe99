#include "sim/case/lesion_kind.h"

#include <array>

namespace seldinger::cases {
namespace {

using volume::TissueClass;

// Which way a kind differs from liver, its halo and what lies behind it: as textbooks of abdominal ultrasound have
// them (recalled), and so its texture. By how many dB is tuned for display, so that kinds are told apart and none
// but fluid is black: few have measured it. HU: plain CT, recalled. Forces: no needle was measured in human lesions
// by kind; their order follows elastography (metastases and HCC stiffer than liver, haemangioma not much), amounts
// are design.
constexpr std::array<LesionKindRow, kLesionKinds> kKindRows{{
    {LesionKind::by_hu, "by its HU", {}, {}, {}, "", ""},
    {LesionKind::cyst,
     "cyst",
     {.speckled = false, .sound = TissueClass::fluid},
     {8.0, false},
     {.edge_n = 0.9, .dent_mm = 4.0},
     "recalled: black, sharp, bright behind",
     "design: a thin wall, then fluid"},
    {LesionKind::hcc,
     "hepatocellular carcinoma",
     {.inside_db = -5.0, .rim_mm = 1.5, .rim_db = -10.0, .texture = {2.0, 4.0}},
     {-10.0, true},
     {.slope_n_mm = 0.025, .cutting_n = 0.70, .tip_stiffness_n_mm = 0.25, .edge_n = 1.9, .dent_mm = 6.0},
     "small ones darker than liver, a thin dark halo, a mosaic (recalled); dB and mm tuned",
     "design: a fibrous capsule, firmer than liver"},
    {LesionKind::metastasis,
     "metastasis",
     {.inside_db = -4.0, .rim_mm = 2.5, .rim_db = -12.0, .margin_mm = 1.5, .texture = {1.5, 2.5}},
     {-20.0, true},
     {.slope_n_mm = 0.030, .cutting_n = 1.00, .tip_stiffness_n_mm = 0.30, .edge_n = 1.6, .dent_mm = 5.0},
     "a target: darker, a broad dark halo, uneven, ill-defined (recalled); dB and mm tuned",
     "design: no capsule, the firmest of these"},
    {LesionKind::haemangioma,
     "haemangioma",
     {.inside_db = 7.0, .sound = TissueClass::spleen},
     {-15.0, true},
     {.slope_n_mm = 0.018, .cutting_n = 0.30, .tip_stiffness_n_mm = 0.12, .edge_n = 0.6, .dent_mm = 4.0},
     "brighter than liver, even, sharp, no halo, a little brighter behind (recalled); dB tuned; loss as spleen's",
     "design: a sponge of blood, softer than liver"},
    {LesionKind::abscess,
     "abscess",
     {.inside_db = -12.0,
      .rim_mm = 2.0,
      .rim_db = 2.0,
      .margin_mm = 2.0,
      .texture = {3.0, 3.0},
      .sound = TissueClass::vessel},
     {25.0, false},
     {.slope_n_mm = 0.005, .cutting_n = 0.05, .tip_stiffness_n_mm = 0.05, .edge_n = 1.7, .dent_mm = 6.0},
     "clumps of debris in fluid, a wall, ill-defined, bright behind (recalled); dB and mm tuned; loss as blood's",
     "design: a thick wall, then pus"},
    {LesionKind::node,
     "lymph node",
     {.inside_db = -9.0},
     {-5.0, true},
     {.slope_n_mm = 0.015, .cutting_n = 0.60, .tip_stiffness_n_mm = 0.20, .edge_n = 1.2, .dent_mm = 4.0},
     "darker than what lies about it, even, sharp (recalled); dB tuned",
     "design: a thin capsule, firm"},
    {LesionKind::isoechoic,
     "isoechoic mass",
     {},
     {-15.0, true},
     {.slope_n_mm = 0.022, .cutting_n = 0.55, .tip_stiffness_n_mm = 0.20, .edge_n = 1.3, .dent_mm = 6.0},
     "by its name: neither level nor texture of its own, no halo",
     "design: somewhat firmer than liver"},
}};

}  // namespace

std::span<const LesionKindRow, kLesionKinds> lesion_kinds() noexcept {
  return kKindRows;
}

const LesionKindRow& about(LesionKind kind) noexcept {
  const auto at = static_cast<std::size_t>(kind);
  return kKindRows[at < kKindRows.size() ? at : 0];
}

TissueClass tissue_of_lesion(double hu) noexcept {
  using enum TissueClass;
  if (!(hu >= -500.0)) return gas;  // also NaN
  if (hu < -30.0) return fat;
  if (hu < 18.0) return fluid;
  if (hu < 300.0) return soft_tissue;
  return hu < 2500.0 ? bone : metal;
}

}  // namespace seldinger::cases
