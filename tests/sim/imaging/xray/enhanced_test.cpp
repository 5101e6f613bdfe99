// What a CT's contrast medium is under X-rays: as much iodine as its HU say, by class, and nothing else.
#include "sim/imaging/xray/enhanced.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sim/imaging/xray/beam/attenuation.h"
#include "sim/imaging/xray/exposure.h"
#include "sim/imaging/xray/instruments.h"
#include "sim/imaging/xray/visibility.h"
#include "tests/sim/imaging/xray/xray_scene.h"

namespace seldinger::imaging {
namespace {

using volume::TissueClass;

constexpr double kSlabMm = 24.0;

// Soft tissue of 40 HU, 80 mm in the rays' way, with a slab of 24 mm of something in it.
cases::Case slab(TissueClass tissue, int hu, std::optional<double> tube_kv = {}) {
  cases::Case scene;
  scene.volume = centered({40, 40, 40}, glm::dvec3(2.0), 40);
  scene.classes.assign(scene.volume.hu.size(), TissueClass::soft_tissue);
  scene.ct_tube_kv = tube_kv;
  for (int k = 0; k < 40; ++k)
    for (int j = 12; j < 24; ++j)
      for (int i = 0; i < 40; ++i) {
        scene.volume.hu[scene.volume.index(i, j, k)] = static_cast<std::int16_t>(hu);
        scene.classes[scene.volume.index(i, j, k)] = tissue;
      }
  return scene;
}

XrayGeometry through() {
  return facing({0, 1, 0}, 2.0, 1);
}

PathLengths lengths_of(const cases::Case& scene, const XrayGeometry& g, const Inserted& inserted = {}) {
  PathLengths lengths = XrayCpu(scene.volume).project(g, ProjectionMethod::exact);
  overlay_instruments(scene.volume, g, inserted, ProjectionMethod::exact, lengths);
  const Enhancement enhancement(scene);
  if (enhancement.any()) {
    const EnhancedTissue tissue = enhancement.at_rest();
    tell_iodine(tissue, g, inserted, tissue.project(g, {}), lengths);
  }
  return lengths;
}

double contrast_mm(const PathLengths& lengths) {
  return lengths.contrast_mm.empty() ? 0.0 : static_cast<double>(lengths.contrast_mm.front());
}

// By a ray, in closed form: so many mm of so much more HU, at the HU that a mg of iodine makes at the CT's energy.
TEST(Enhanced, ASlabHasTheIodineThatItsHuSay) {
  for (const double kv : {80.0, 100.0, 120.0, 140.0})
    for (const auto& [tissue, hu] : {std::pair{TissueClass::vessel, 173},
                                     {TissueClass::vessel, 443},
                                     {TissueClass::fluid, 608},
                                     {TissueClass::kidney, 182},
                                     {TissueClass::liver, 110},
                                     {TissueClass::spleen, 120}}) {
      const cases::Case scene = slab(tissue, hu, kv);
      const PathLengths lengths = lengths_of(scene, through());
      const double ct_kev = ct_effective_kev(kv), more_hu = hu - volume::typical_hu(tissue);
      const double mg_ml = more_hu / iodine_hu_per_mg_ml(ct_kev);
      EXPECT_NEAR(contrast_mm(lengths) / (mg_ml / 150.0 * kSlabMm), 1.0, 0.01) << kv << ' ' << hu;
      const double mineral_mm = 0.040 * (80.0 - kSlabMm) + volume::typical_hu(tissue) / 1000.0 * kSlabMm;
      EXPECT_NEAR(static_cast<double>(lengths.mineral_mm.front()), mineral_mm, 1e-3 * mineral_mm)
          << kv << ' ' << hu;
      EXPECT_NEAR(static_cast<double>(lengths.water_mm.front()), 80.0, 1e-3);
    }
}

// At the CT's own energy it does not matter what HU are of; under fluoroscopy it does, as the tables say.
TEST(Enhanced, OnlyTheDependenceOnEnergyDiffers) {
  for (const double kv : {80.0, 100.0, 120.0, 140.0}) {
    const cases::Case scene = slab(TissueClass::vessel, 243, kv);
    const PathLengths as_mineral = XrayCpu(scene.volume).project(through(), ProjectionMethod::exact);
    const PathLengths lengths = lengths_of(scene, through());
    const double ct_kev = ct_effective_kev(kv);
    const auto taken = [&](const PathLengths& of, double kev) {
      const Attenuation at = attenuation_at(kev, ct_kev);
      return at.water_per_mm * static_cast<double>(of.water_mm.front()) +
             at.mineral_per_mm * static_cast<double>(of.mineral_mm.front()) + at.contrast_per_mm * contrast_mm(of);
    };
    EXPECT_NEAR(taken(lengths, ct_kev), taken(as_mineral, ct_kev), 1e-5);
    for (const double kev : {40.0, 55.0}) {
      const Attenuation at = attenuation_at(kev, ct_kev), ct = attenuation_at(ct_kev, ct_kev);
      const double more_mm = static_cast<double>(as_mineral.mineral_mm.front() - lengths.mineral_mm.front());
      const double by_tables =
          more_mm * (at.contrast_per_mm * ct.water_per_mm / ct.contrast_per_mm - at.mineral_per_mm);
      EXPECT_NEAR(taken(lengths, kev) - taken(as_mineral, kev), by_tables, 1e-5) << kev;
      EXPECT_GT(by_tables, 0.0) << "iodine's K edge lies at 33 keV";
    }
    EXPECT_LT(taken(lengths, 33.0), taken(as_mineral, 33.0)) << "below it iodine is thinner than bone";
  }
}

// Bone, what is no lumen or organ, plaque and stones in a lumen, and noise about the level of plain blood.
TEST(Enhanced, WhatIsNoIodineStaysAsItWas) {
  for (const auto& [tissue, hu] : {std::pair{TissueClass::bone, 400},
                                   {TissueClass::soft_tissue, 180},
                                   {TissueClass::muscle, 150},
                                   {TissueClass::metal, 3000},
                                   {TissueClass::vessel, 900},
                                   {TissueClass::kidney, 500},
                                   {TissueClass::fluid, 1500},
                                   {TissueClass::vessel, 60},
                                   {TissueClass::fluid, 8},
                                   {TissueClass::fluid, -100}})
    EXPECT_FALSE(Enhancement(slab(tissue, hu)).any()) << hu;
  cases::Case unknown = slab(TissueClass::vessel, 200);
  unknown.classes.clear();
  EXPECT_FALSE(Enhancement(unknown).any());
  cases::Case noisy_blood = slab(TissueClass::vessel, 43);
  for (std::size_t i = 0; i < noisy_blood.volume.hu.size(); ++i)
    noisy_blood.volume.hu[i] =
        static_cast<std::int16_t>(noisy_blood.volume.hu[i] + std::lround(12.0 * base::normal_at(3, i)));
  EXPECT_FALSE(Enhancement(noisy_blood).any());
  // A plaque in blood is left out, and blood about it stays iodine.
  cases::Case plaque = slab(TissueClass::vessel, 243);
  for (int j = 16; j < 18; ++j)
    for (int k = 0; k < 40; ++k)
      for (int i = 0; i < 40; ++i) plaque.volume.hu[plaque.volume.index(i, j, k)] = 900;
  const double whole_mm = contrast_mm(lengths_of(slab(TissueClass::vessel, 243), through()));
  EXPECT_NEAR(contrast_mm(lengths_of(plaque, through())), whole_mm * (kSlabMm - 4.0) / kSlabMm, 0.001 * whole_mm);
}

// Noise is neither cut off below nor counted twice: in the mean as much iodine as without.
TEST(Enhanced, NoiseLeavesTheMean) {
  const cases::Case plain = slab(TissueClass::vessel, 163);
  cases::Case noisy = plain;
  for (std::size_t i = 0; i < noisy.volume.hu.size(); ++i)
    noisy.volume.hu[i] = static_cast<std::int16_t>(noisy.volume.hu[i] + std::lround(12.0 * base::normal_at(3, i)));
  XrayGeometry g = parallel({0, 1, 0}, 60.0, 30);
  const auto mean = [&](const cases::Case& scene) {
    double sum = 0.0;
    for (const float mm : lengths_of(scene, g).contrast_mm) sum += static_cast<double>(mm) / 900.0;
    return sum;
  };
  EXPECT_NEAR(mean(noisy) / mean(plain), 1.0, 0.01);
}

// A calyx that is drawn over itself is as full of iodine as it, whatever the voxels say; a lesion beside it
// displaces iodine, and is none.
TEST(Enhanced, DrawnLesions) {
  for (const double voxels_hu : {8.0, 608.0}) {
    cases::Case scene = slab(TissueClass::fluid, static_cast<int>(voxels_hu));
    scene.lesions.push_back({glm::dvec3(0.0, -4.0, 0.0), 10.0, 608.0});
    const PathLengths lengths = lengths_of(scene, through(), {{}, scene.lesions});
    const double per_mm = 0.6 * contrast_mm_of_1000_hu(kHuEnergyKev);
    EXPECT_NEAR(contrast_mm(lengths), per_mm * (voxels_hu > 100.0 ? kSlabMm : 20.0), 0.02 * contrast_mm(lengths));
    EXPECT_NEAR(static_cast<double>(lengths.mineral_mm.front()), 0.04 * (80.0 - kSlabMm) + 0.008 * kSlabMm, 0.02);
  }
  // The voxel in its middle is bone: a calcified lesion.
  cases::Case hole = slab(TissueClass::liver, 160);
  hole.lesions.push_back({glm::dvec3(0.0, -4.0, 0.0), 10.0, 609.0});
  hole.classes[hole.volume.index(20, 18, 20)] = TissueClass::bone;
  const cases::Case without = slab(TissueClass::liver, 160);
  const double left = contrast_mm(lengths_of(hole, through(), {{}, hole.lesions}));
  EXPECT_NEAR(left / contrast_mm(lengths_of(without, through())), 4.0 / kSlabMm, 0.02);
}

// What is told of a target is what lengths with and without it give: a calyx of 308 HU drawn over one of urine is
// iodine, and over itself nothing at all.
TEST(Enhanced, IsInWhatIsToldOfATarget) {
  Beams beams{cases::Fluoroscope{}};
  const BeamSignal& beam = beams.at(70.0);
  const XrayGeometry g = through();
  for (const int voxels_hu : {8, 308}) {
    cases::Case scene = slab(TissueClass::fluid, voxels_hu);
    scene.lesions.push_back({glm::dvec3(0.0, -4.0, 0.0), 8.0, 308.0});
    const Enhancement enhancement(scene);
    ASSERT_TRUE(enhancement.any());
    const EnhancedTissue tissue = enhancement.at_rest();
    const Inserted inserted{{}, scene.lesions};
    const auto as_bone = target_contrast(scene.volume, g, beam, {}, inserted);
    const auto as_iodine = target_contrast(scene.volume, g, beam, {}, inserted, nullptr, &tissue);
    ASSERT_TRUE(as_bone && as_iodine);
    if (voxels_hu == 308) {
      EXPECT_NEAR(as_iodine->relative, 0.0, 1e-6);
      continue;
    }
    const double mineral_mm = 0.04 * 56.0 + 0.008 * kSlabMm;
    const double with = beam.log_share(80.0, mineral_mm, 0.0, 0.3 * 16.0 * tissue.contrast_mm);
    EXPECT_NEAR(as_iodine->relative, -std::expm1(with - beam.log_share(80.0, mineral_mm)),
                1e-3 * as_iodine->relative);
    EXPECT_GT(as_iodine->relative, 1.2 * as_bone->relative);
  }
}

// It goes where tissue goes.
TEST(Enhanced, MovesWithTheTissue) {
  cases::Case scene = slab(TissueClass::soft_tissue, 40);
  tissue::Breath breath;
  breath.region.half_width_mm = 160.0;
  breath.amount_mm = glm::dvec3(0.0, 0.0, 12.0);
  const tissue::Displacement moved = tissue::displacement_of({.breath = breath});
  double goes_mm = 0.0;
  for (int k = 17; k < 23; ++k)
    for (int j = 17; j < 23; ++j)
      for (int i = 17; i < 23; ++i) {
        scene.volume.hu[scene.volume.index(i, j, k)] = 343;
        scene.classes[scene.volume.index(i, j, k)] = TissueClass::vessel;
        const glm::dvec3 at = 2.0 * glm::dvec3(i, j, k) - 39.0;
        goes_mm += (tissue::displaced(moved, at).z - at.z) / 216.0;
      }
  ASSERT_GT(std::abs(goes_mm), 2.0);
  Enhancement enhancement(scene);
  XrayGeometry g = parallel({0, 1, 0}, 70.0, 70);
  g.u = {1, 0, 0};
  g.v = {0, 0, -1};
  const auto middle_z_mm = [&](const PathLengths& lengths) {
    double sum = 0.0, weighed = 0.0;
    for (std::size_t i = 0; i < lengths.water_mm.size(); ++i) {
      sum += static_cast<double>(lengths.water_mm[i]);
      weighed += static_cast<double>(lengths.water_mm[i]) * (34.5 - static_cast<double>(i / 70)) * g.pixel_mm;
    }
    return std::pair(weighed / sum, sum);
  };
  const auto [still_mm, still] = middle_z_mm(enhancement.at_rest().project(g, {}));
  const auto [there_mm, there] = middle_z_mm(enhancement.moved(moved, g).project(g, {}));
  EXPECT_NEAR(there_mm - still_mm, goes_mm, 0.5);
  EXPECT_NEAR(there / still, 1.0, 0.1);
}

}  // namespace
}  // namespace seldinger::imaging
