// What a lesion is: how it looks in ultrasound and CT and how a needle feels it, a row each. Pictures, what they
// are said to show, and touch read this one table.
#pragma once

#include <cstdint>
#include <span>

#include "sim/base/names.h"
#include "sim/volume/classes.h"

namespace seldinger::cases {

// by_hu: a tissue of the class its HU tell, as every lesion was before there were kinds.
enum class LesionKind : std::uint8_t { by_hu, cyst, hcc, metastasis, haemangioma, abscess, node, isoechoic };
constexpr std::size_t kLesionKinds = 8;
inline constexpr auto kLesionKindNames = base::names<LesionKind>({{LesionKind::by_hu, "by_hu"},
                                                                  {LesionKind::cyst, "cyst"},
                                                                  {LesionKind::hcc, "hcc"},
                                                                  {LesionKind::metastasis, "metastasis"},
                                                                  {LesionKind::haemangioma, "haemangioma"},
                                                                  {LesionKind::abscess, "abscess"},
                                                                  {LesionKind::node, "node"},
                                                                  {LesionKind::isoechoic, "isoechoic"}});

// How its inside varies from place to place: smooth blotches of the grain's size. The mean square stays.
struct LesionTexture {
  double sd_db = 0.0, grain_mm = 0.0;  // 0 dB: even
};

// Mean square echo over that of what lies about it. The rim, `rim_mm` of the lesion's own outside, is its halo or
// its wall. Over the outermost `margin_mm`, rim or not, it passes into its surroundings.
struct LesionLook {
  bool speckled = true;  // else it is black, whatever lies about it
  double inside_db = 0.0;
  double rim_mm = 0.0, rim_db = 0.0;
  double margin_mm = 0.0;  // 0: sharp
  LesionTexture texture{};
  // What it is to sound beyond that: attenuation behind which tissue is brighter or darker. soft_tissue: as what
  // lies about it, so that it casts neither.
  volume::TissueClass sound = volume::TissueClass::soft_tissue;
};

// On plain CT. `adds`: over what lies about it.
struct LesionHu {
  double hu = 0.0;
  bool adds = true;
};

// As NeedleTissue (sim/haptics/needle/needle_tissue.h) of a 22-gauge needle: `edge_n` is the force at which its
// edge opens, `dent_mm` how far it gives way before.
struct LesionTouch {
  double slope_n_mm = 0.0, cutting_n = 0.0, tip_stiffness_n_mm = 0.0, edge_n = 0.0, dent_mm = 0.0;
};

struct LesionKindRow {
  LesionKind kind;
  const char* words;  // on pages and screens
  LesionLook look;
  LesionHu ct;
  LesionTouch touch;
  const char *look_source, *touch_source;  // measured, recalled or tuned, and from where
};

// One row per kind, in the kinds' order; by_hu's says nothing but its words.
std::span<const LesionKindRow, kLesionKinds> lesion_kinds() noexcept;
const LesionKindRow& about(LesionKind kind) noexcept;

// What a lesion by_hu of this HU is.
volume::TissueClass tissue_of_lesion(double hu) noexcept;

}  // namespace seldinger::cases
