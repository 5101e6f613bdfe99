// What a drill or a graded case is made of: built in, or which CT.
#include <array>
#include <glm/mat4x4.hpp>

#include "app/cases/import_case.h"
#include "app/demo/demo_cases.h"

namespace seldinger::app {
namespace {

constexpr double kHalfMm = 3.0;  // of the window, at steps of 1 mm

// After the readme of each volume, ± 20 HU, ± 60 in bone; the last from its slices.
constexpr std::array<Landmark, 4> kContrastLiver = {{{{-14, 25, -153}, 125, 165},      // aorta
                                                     {{-115, -5, -98}, 83, 123},       // liver
                                                     {{89, 55, -98}, 105, 145},        // spleen
                                                     {{-107, 51, -153}, 140, 184}}};   // right kidney's cortex
constexpr std::array<Landmark, 4> kAbdomenPelvis = {{{{63, 77, -583}, 13, 53},         // left kidney
                                                     {{-104, 33, -506}, 44, 84},       // liver
                                                     {{-16, 48, -583}, 139, 259},      // vertebral body
                                                     {{-16, -79, -583}, -126, -86}}};  // subcutaneous fat
constexpr std::array<Landmark, 3> kThoraxInlet = {{{{13.6, -189.9, 88}, 274, 394},     // vertebral body
                                                   {{-51.7, -207.2, 88}, 364, 484},    // right clavicle
                                                   {{-60, -150, 60}, -850, -690}}};    // right lung's apex

bool fits(const volume::Volume& volume, const Landmark& mark) {
  const glm::dmat4 voxel_from_lps = volume::voxel_from_lps(volume);
  double sum = 0.0;
  int count = 0;
  for (double y = -kHalfMm; y <= kHalfMm; y += 1.0)
    for (double x = -kHalfMm; x <= kHalfMm; x += 1.0, ++count) {
      const glm::dvec3 p = mark.at_lps_mm + glm::dvec3(x, y, 0.0);
      const auto hu = volume::sample_trilinear(volume, glm::dvec3(voxel_from_lps * glm::dvec4(p, 1.0)));
      if (!hu) return false;
      sum += *hu;
    }
  return sum / count >= mark.low_hu && sum / count <= mark.high_hu;
}

}  // namespace

std::span<const Landmark> landmarks_of(DemoSource source) {
  switch (source) {
    case DemoSource::contrast_liver:
      return kContrastLiver;
    case DemoSource::abdomen_pelvis:
      return kAbdomenPelvis;
    case DemoSource::thorax_inlet:
      return kThoraxInlet;
    default:
      return {};
  }
}

std::optional<base::Result<casedb::NewCase>> built_in(DemoSource source) {
  switch (source) {
    case DemoSource::gel_plane:
      return import_gel_block(volume::GelBlock::find_the_plane);
    case DemoSource::gel_tip:
      return import_gel_block(volume::GelBlock::keep_the_tip);
    case DemoSource::gel_across:
      return import_gel_block(volume::GelBlock::out_of_plane);
    case DemoSource::torso:
      return import_phantom({.calyces = volume::Calyces::normal});
    case DemoSource::torso_dilated:
      return import_phantom({.calyces = volume::Calyces::dilated});
    case DemoSource::torso_opacified:
      return import_phantom({.calyces = volume::Calyces::opacified});
    case DemoSource::torso_prone:
      return import_phantom({.posture = volume::Posture::prone});
    case DemoSource::neck:
      return import_phantom({.region = volume::Region::neck});
    case DemoSource::neck_obese:
      return import_phantom({.region = volume::Region::neck, .body = volume::Body::obese});
    case DemoSource::groin_child:
      return import_phantom({.region = volume::Region::groin, .body = volume::Body::child});
    case DemoSource::groin_lean:
      return import_phantom({.region = volume::Region::groin, .body = volume::Body::lean});
    default:
      return std::nullopt;
  }
}

std::optional<DemoSource> source_of(const volume::Volume& volume) {
  for (const DemoSource source :
       {DemoSource::contrast_liver, DemoSource::abdomen_pelvis, DemoSource::thorax_inlet}) {
    bool all = true;
    for (const Landmark& mark : landmarks_of(source)) all = all && fits(volume, mark);
    if (all) return source;
  }
  return std::nullopt;
}

}  // namespace seldinger::app
