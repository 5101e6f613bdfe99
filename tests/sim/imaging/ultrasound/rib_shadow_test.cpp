// Ribs of coarse CTs without labels cast their shadows: beams from the side of the chest, against the torso's
// labels at 2 mm.
#include <cstdio>
#include <glm/mat4x4.hpp>
#include <optional>

#include "sim/imaging/ultrasound/line.h"
#include "sim/imaging/ultrasound/view/fan.h"
#include "tests/sim/imaging/ultrasound/ultrasound_scene.h"
#include "tests/sim/volume/tissue/enhanced_torso.h"

namespace seldinger::imaging {
namespace {

using volume::EnhancedTorso;
using volume::TorsoPhase;

struct Patient {
  volume::Volume volume;
  std::vector<TissueClass> classes;
  TissueVolume tissue() const { return {&volume, classes}; }
};

UltrasoundView view_from(const glm::dvec3& skin_lps_mm) {
  UltrasoundView view = straight_view(60.0);
  view.origin_lps_mm = skin_lps_mm;
  view.axial = {1.0, 0.0, 0.0};  // from the patient's right
  view.lateral = {0.0, 1.0, 0.0};
  view.attenuation_db_cm_mhz = 0.0;  // of soft tissue, which is no shadow
  return view;
}

Line line_from(const Patient& patient, const glm::dvec3& skin_lps_mm) {
  const UltrasoundView view = view_from(skin_lps_mm);
  const Inserted nothing;
  const TissueAt tissue_at(patient.tissue(), nothing);
  Line line;
  LineWalker(view, tissue_at, patient.volume, nothing).walk(view.beams / 2, true, line);
  return line;
}

std::optional<glm::dvec3> skin_at(const Patient& patient, double y_mm, double z_mm) {
  const TissueAt tissue_at(patient.tissue(), {});
  for (double x_mm = -250.0; x_mm < 0.0; x_mm += 0.5)
    if (tissue_at({x_mm, y_mm, z_mm}) != TissueClass::air) return glm::dvec3(x_mm, y_mm, z_mm);
  return std::nullopt;
}

struct Span {  // of bone on a beam, in samples
  std::size_t first = 0, last = 0;
};
// The first bone before anything with gas; nothing where there is none.
std::optional<Span> rib_on(const Line& line) {
  std::optional<Span> rib;
  for (std::size_t k = 0; k < line.tissue.size(); ++k) {
    if (line.tissue[k] == TissueClass::bone) {
      if (!rib) rib = Span{k, k};
      rib->last = k;
    } else if (rib || is_gas(line.tissue[k]) || line.tissue[k] == TissueClass::lung) {
      break;
    }
  }
  return rib;
}

TEST(RibShadow, IsThereInCoarseCtsOfEveryPhase) {
  constexpr double kShadowDb = 15.0, kLeastRibMm = 4.0;
  std::printf("%-10s %-3s %8s %8s %8s %8s\n", "phase", "mm", "ribs", "shadowed", "gaps", "shadowed");
  for (const TorsoPhase phase : {TorsoPhase::none, TorsoPhase::arterial}) {
    EnhancedTorso fine = volume::enhanced_torso({.phase = phase, .spacing_mm = glm::ivec3(2)});
    const Patient truth{fine.volume, volume::tissue_classes(fine.volume, &fine.truth)};
    for (const int spacing_mm : {3, 5}) {
      const EnhancedTorso torso = volume::enhanced_torso({.phase = phase, .spacing_mm = glm::ivec3(spacing_mm)});
      const Patient found{torso.volume, volume::tissue_classes(torso.volume)};
      const UltrasoundView view = view_from({});
      const double sample_mm = view.depth_mm / view.samples;
      const auto off = static_cast<std::size_t>(std::lround(spacing_mm / sample_mm));
      int ribs = 0, shadows = 0, gaps = 0, false_shadows = 0;
      for (double z_mm = 20.0; z_mm <= 120.0; z_mm += 2.0)
        for (double y_mm = -40.0; y_mm <= 40.0; y_mm += 10.0) {
          const auto skin = skin_at(truth, y_mm, z_mm);
          ASSERT_TRUE(skin);
          const Line line = line_from(truth, *skin), coarse = line_from(found, *skin);
          const auto loss_db = [&](std::size_t from, std::size_t to) {
            return double{coarse.loss_db[std::min(to, coarse.loss_db.size() - 1)]} - double{coarse.loss_db[from]};
          };
          if (const auto rib = rib_on(line)) {
            if (static_cast<double>(rib->last - rib->first) * sample_mm < kLeastRibMm || rib->first < off) continue;
            ++ribs;
            shadows += loss_db(rib->first - off, rib->last + off) >= kShadowDb ? 1 : 0;
            continue;
          }
          // Farther than a voxel beside any rib.
          bool beside = false;
          for (const double dz_mm : {-1.5 * spacing_mm, 1.5 * spacing_mm})
            beside = beside || rib_on(line_from(truth, *skin + glm::dvec3(0.0, 0.0, dz_mm)));
          if (beside) continue;
          std::size_t gas = 0;
          while (gas < line.tissue.size() && line.tissue[gas] != TissueClass::lung && !is_gas(line.tissue[gas]))
            ++gas;
          if (gas < 3 * off) continue;
          ++gaps;
          false_shadows += loss_db(off, gas - 2 * off) >= kShadowDb ? 1 : 0;
        }
      std::printf("%-10s %-3d %8d %8d %8d %8d\n", name_of(phase).c_str(), spacing_mm, ribs, shadows, gaps,
                  false_shadows);
      EXPECT_GE(ribs, 50);
      EXPECT_GE(gaps, 20);
      EXPECT_GE(shadows, 0.9 * ribs) << name_of(phase) << ", " << spacing_mm << " mm";
      EXPECT_LE(false_shadows, 0.1 * gaps) << name_of(phase) << ", " << spacing_mm << " mm";
    }
  }
}

}  // namespace
}  // namespace seldinger::imaging
