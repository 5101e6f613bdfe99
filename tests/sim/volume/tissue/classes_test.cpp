// Tissue classes against shapes whose truth is known: blurred and noisy as a CT makes them.
#include "sim/volume/classes.h"
#include "sim/volume/tissue/find_tissue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <glm/geometric.hpp>
#include <map>
#include <string>

#include "sim/base/rng.h"
#include "sim/volume/analytic.h"
#include "sim/volume/phantom.h"

namespace seldinger::volume {
namespace {

using Classes = std::vector<TissueClass>;
constexpr double kNever = 1e9;

// The point spread of a scanner, about 1.2 mm wide at half height with 0.8 mm voxels: [1 2 1] in x and in y, twice.
void blur(Volume& volume) {
  const glm::ivec3 n = volume.size_voxels;
  for (int round = 0; round < 4; ++round) {
    const Volume before = volume;
    const glm::ivec3 way = round % 2 == 0 ? glm::ivec3(1, 0, 0) : glm::ivec3(0, 1, 0);
    for (int k = 0; k < n.z; ++k)
      for (int j = 0; j < n.y; ++j)
        for (int i = 0; i < n.x; ++i) {
          const auto hu = [&](int step) {
            return int{
                before.at(std::clamp(i + step * way.x, 0, n.x - 1), std::clamp(j + step * way.y, 0, n.y - 1), k)};
          };
          volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>((hu(-1) + 2 * hu(0) + hu(1)) / 4);
        }
  }
}

void add_noise(Volume& volume, double sd_hu, std::uint64_t seed) {
  for (std::size_t at = 0; at < volume.hu.size(); ++at)
    volume.hu[at] = static_cast<std::int16_t>(
        std::clamp(std::lround(volume.hu[at] + sd_hu * base::normal_at(seed, at)), long{kAirHu}, 3071L));
}

// A trunk of 150 mm in room air, a fat layer of 15 mm, tissue inside; voxels 0.8 x 0.8 x 3 mm. x to the left, y to
// the back, z along it.
AnalyticVolume trunk() {
  AnalyticVolume made;
  made.size_voxels = {210, 210, 16};
  made.spacing_mm = glm::dvec3(0.8, 0.8, 3.0);
  made.origin_mm = {-84.0, -84.0, 0.0};
  made.shapes = {{Cylinder{{0, 0, -10}, {0, 0, 60}, 75.0}, -100.0},
                 {Cylinder{{0, 0, -10}, {0, 0, 60}, 60.0}, 50.0}};
  return made;
}

void add_tube(AnalyticVolume& scene, double x_mm, double y_mm, double radius_mm, double hu) {
  scene.shapes.push_back({Cylinder{{x_mm, y_mm, -10}, {x_mm, y_mm, 60}, radius_mm}, hu});
}

// A vertebra: 18 mm, cortex of 1.6 mm.
void add_vertebra(AnalyticVolume& scene, double x_mm, double y_mm) {
  add_tube(scene, x_mm, y_mm, 18.0, 1000.0);
  add_tube(scene, x_mm, y_mm, 16.4, 200.0);
}

struct Scene {
  Volume volume;
  Classes classes;
};

Scene scene_of(const AnalyticVolume& analytic, double noise_hu) {
  Scene scene{rasterize(analytic), {}};
  blur(scene.volume);
  add_noise(scene.volume, noise_hu, 7);
  scene.classes = tissue_classes(scene.volume);
  return scene;
}

// Share of a class among the voxels whose distance to a tube's axis lies between the two.
double share(const Scene& scene, TissueClass tissue, double x_mm, double y_mm, double from_mm, double to_mm,
             const std::function<bool(const glm::dvec3&)>& where = {}) {
  std::size_t all = 0, are = 0;
  const Volume& v = scene.volume;
  for (int k = 0; k < v.size_voxels.z; ++k)
    for (int j = 0; j < v.size_voxels.y; ++j)
      for (int i = 0; i < v.size_voxels.x; ++i) {
        const glm::dvec3 p(v.lps_from_voxel * glm::dvec4(i, j, k, 1.0));
        const double distance_mm = std::hypot(p.x - x_mm, p.y - y_mm);
        if (distance_mm < from_mm || distance_mm > to_mm || (where && !where(p))) continue;
        ++all;
        are += scene.classes[v.index(i, j, k)] == tissue ? 1 : 0;
      }
  EXPECT_GT(all, 0U);
  return static_cast<double>(are) / static_cast<double>(all);
}

TEST(Classes, ATrunkIsFatAndTissueInAir) {
  for (const double noise_hu : {0.0, 12.0, 30.0}) {
    const Scene scene = scene_of(trunk(), noise_hu);
    EXPECT_EQ(share(scene, TissueClass::air, 0, 0, 77, kNever), 1.0) << noise_hu;
    EXPECT_GE(share(scene, TissueClass::fat, 0, 0, 62, 73), 0.998) << noise_hu;
    EXPECT_GE(share(scene, TissueClass::soft_tissue, 0, 0, 0, 58), 0.998) << noise_hu;
  }
}

TEST(Classes, PaddingIsAirAndSoIsACouch) {
  AnalyticVolume analytic = trunk();
  analytic.shapes.push_back({Box{{-84, 79, -10}, {84, 84, 60}}, 100.0});  // not touching
  Scene scene{rasterize(analytic), {}};
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 20; ++j) scene.volume.hu[scene.volume.index(j, j, k)] = kAirHu;
  scene.classes = tissue_classes(scene.volume);
  EXPECT_EQ(share(scene, TissueClass::air, 0, 0, 76, kNever), 1.0);
}

TEST(Classes, ABlurredVertebraIsBoneToItsEdgeAndThroughItsMarrow) {
  for (const double noise_hu : {0.0, 12.0, 30.0}) {
    AnalyticVolume analytic = trunk();
    add_vertebra(analytic, 0, 20);
    const Scene scene = scene_of(analytic, noise_hu);
    EXPECT_GE(share(scene, TissueClass::bone, 0, 20, 0, 17.5), 0.999) << noise_hu;
    EXPECT_EQ(share(scene, TissueClass::bone, 0, 20, 17.0, 18.0), 1.0) << noise_hu << ": the edge, 18 mm";
    EXPECT_LE(share(scene, TissueClass::bone, 0, 20, 20.5, kNever), 0.0001) << noise_hu;
  }
}

TEST(Classes, AThinCortexBelowTheCoresHuIsBoneWhereItJoinsOne) {
  AnalyticVolume analytic = trunk();
  add_tube(analytic, 0, 20, 8.0, 1000.0);
  // A lamina 1.6 mm thick: blurred to about 300 HU.
  analytic.shapes.push_back({Box{{0, 19.2, -10}, {40, 20.8, 60}}, 500.0});
  const Scene scene = scene_of(analytic, 12.0);
  int highest = 0;
  for (int i = 0; i < 210; ++i) {
    const double x_mm = -84.0 + 0.8 * i;
    if (x_mm > 15 && x_mm < 35) highest = std::max(highest, int{scene.volume.at(i, 130, 8)});
  }
  EXPECT_LT(highest, 450);
  const double found = share(scene, TissueClass::bone, 0, 20, 9, 38,
                             [](const glm::dvec3& p) { return p.x > 0 && p.x < 38 && std::abs(p.y - 20.0) < 0.5; });
  EXPECT_GE(found, 0.98) << "peak " << highest << " HU";
}

// Contrast that lies against bone, over its whole length. Within 2.5 mm of the bone its blur
// decides; a little remains where the two blurred edges meet in a wedge.
TEST(Classes, AVesselFullOfContrastBesideBoneIsNoBone) {
  for (const double noise_hu : {0.0, 12.0, 30.0})
    for (const double hu : {145.0, 200.0, 250.0, 300.0, 350.0, 400.0, 450.0, 500.0}) {
      AnalyticVolume analytic = trunk();
      add_vertebra(analytic, 0, 20);
      add_tube(analytic, 0, 20 - 18.0 - 11.0, 11.0, hu);
      const Scene scene = scene_of(analytic, noise_hu);
      const auto off_the_bone = [](const glm::dvec3& p) { return std::hypot(p.x, p.y - 20.0) > 20.5; };
      const double bone = share(scene, TissueClass::bone, 0, -9, 0, 11, off_the_bone);
      EXPECT_LE(bone, 0.01) << hu << " HU, noise " << noise_hu;
      if (hu >= 250.0) {
        EXPECT_GE(share(scene, TissueClass::vessel, 0, -9, 0, 9, off_the_bone), 0.99)
            << hu << ", noise " << noise_hu;
      }
      EXPECT_GE(share(scene, TissueClass::bone, 0, 20, 0, 17.5), 0.99) << hu << ", noise " << noise_hu;
    }
}

TEST(Classes, AnEnhancedKidneyBesideARibIsNoBone) {
  for (const double hu : {160.0, 200.0, 250.0, 300.0}) {
    AnalyticVolume analytic = trunk();
    analytic.shapes.push_back({Ellipsoid{{-25, 10, 24}, {22, 28, 60}}, hu});
    add_tube(analytic, -50.0, 10, 4.0, 800.0);  // 1 mm of tissue between them before the blur
    const Scene scene = scene_of(analytic, 12.0);
    EXPECT_LE(share(scene, TissueClass::bone, -25, 10, 0, 19), 0.001) << hu;
    EXPECT_GE(share(scene, TissueClass::bone, -50, 10, 0, 4), 0.99) << hu;
  }
}

TEST(Classes, LungGasAndRoomAreToldApart) {
  AnalyticVolume analytic = trunk();
  analytic.shapes.push_back({Ellipsoid{{30, 0, 24}, {25, 45, 200}}, -850.0});
  add_tube(analytic, -25, -25, 12.0, -980.0);  // bowel
  add_tube(analytic, -25, 25, 3.0, -980.0);
  for (const double noise_hu : {0.0, 12.0, 30.0}) {
    const Scene scene = scene_of(analytic, noise_hu);
    EXPECT_GE(share(scene, TissueClass::lung, 30, 0, 0, 22), 0.999) << noise_hu;
    EXPECT_EQ(share(scene, TissueClass::gas, -25, -25, 0, 11), 1.0) << noise_hu;
    EXPECT_GE(share(scene, TissueClass::gas, -25, 25, 0, 2), 0.99) << noise_hu;
    EXPECT_EQ(share(scene, TissueClass::air, 0, 0, 0, 72), 0.0) << noise_hu;
    // Its blurred edge passes the HU of fat, and is none.
    EXPECT_LE(share(scene, TissueClass::fat, -25, -25, 0, 20), 0.01) << noise_hu;
  }
}

TEST(Classes, ATracheaInLungIsGas) {
  AnalyticVolume analytic = trunk();
  analytic.shapes.push_back({Ellipsoid{{0, 0, 24}, {45, 45, 200}}, -850.0});
  add_tube(analytic, 0, 0, 9.0, -1000.0);
  const Scene scene = scene_of(analytic, 12.0);
  EXPECT_GE(share(scene, TissueClass::gas, 0, 0, 0, 8), 0.99);
  EXPECT_GE(share(scene, TissueClass::lung, 0, 0, 13, 43), 0.99);
}

TEST(Classes, FluidIsFluidAndTheEdgeOfFatIsNot) {
  AnalyticVolume analytic = trunk();
  add_tube(analytic, 25, 0, 12.0, 8.0);
  add_tube(analytic, -25, 0, 12.0, -100.0);
  for (const double noise_hu : {0.0, 12.0}) {
    const Scene scene = scene_of(analytic, noise_hu);
    EXPECT_GE(share(scene, TissueClass::fluid, 25, 0, 0, 9), 0.97) << noise_hu;
    EXPECT_EQ(share(scene, TissueClass::fluid, 25, 0, 14, kNever), 0.0) << noise_hu;
    EXPECT_GE(share(scene, TissueClass::fat, -25, 0, 0, 10.5), 0.99) << noise_hu;
  }
}

TEST(Classes, AMetalPinIsMetal) {
  AnalyticVolume analytic = trunk();
  add_vertebra(analytic, 0, 20);
  add_tube(analytic, 0, 20, 3.0, 3071.0);
  add_tube(analytic, 30, -20, 3.0, 3071.0);
  const Scene scene = scene_of(analytic, 12.0);
  EXPECT_GE(share(scene, TissueClass::metal, 0, 20, 0, 2.5), 0.99);
  EXPECT_GE(share(scene, TissueClass::metal, 30, -20, 0, 2.5), 0.99);
  EXPECT_EQ(share(scene, TissueClass::metal, 30, -20, 6, kNever, [](const glm::dvec3& p) { return p.y < 0; }), 0.0);
}

TEST(Classes, SpongyBoneWithoutABrightRimIsBoneBetweenSlicesOfIt) {
  AnalyticVolume analytic = trunk();
  add_vertebra(analytic, 0, 20);
  analytic.shapes.push_back({Cylinder{{0, 20, 20}, {0, 20, 22}, 18.0}, 260.0});  // one slice, as thick as a vessel
  const Scene scene = scene_of(analytic, 12.0);
  EXPECT_GE(share(scene, TissueClass::bone, 0, 20, 0, 17), 0.999);
}

TEST(Classes, KnownLabelsWinAndUnknownOnesFallBackToHu) {
  AnalyticVolume analytic = trunk();
  analytic.shapes.push_back({Cylinder{{0, 0, -10}, {0, 0, 60}, 10.0}, 600.0, "collecting_system"});
  analytic.shapes.push_back({Cylinder{{30, 0, -10}, {30, 0, 60}, 10.0}, 1000.0, "unheard_of"});
  analytic.shapes.push_back({Cylinder{{-30, 0, -10}, {-30, 0, 60}, 10.0}, 50.0, "rib"});
  LabelMap labels;
  Scene scene{rasterize(analytic, labels), {}};
  scene.classes = tissue_classes(scene.volume, &labels);
  EXPECT_EQ(share(scene, TissueClass::fluid, 0, 0, 0, 9.9), 1.0);
  EXPECT_EQ(share(scene, TissueClass::bone, 30, 0, 0, 9.5), 1.0);
  EXPECT_EQ(share(scene, TissueClass::bone, -30, 0, 0, 9.9), 1.0);
}

TEST(Classes, NamesComeBackAndEveryOneOfTheTorsoIsKnown) {
  for (std::size_t at = 0; at < kTissueClasses; ++at) {
    const auto tissue = static_cast<TissueClass>(at);
    EXPECT_EQ(tissue_of_name(about(tissue).name), tissue);
    EXPECT_STRNE(about(tissue).told_by, "");
    EXPECT_STRNE(about(tissue).source, "");
  }
  EXPECT_FALSE(tissue_of_name("").has_value());
  EXPECT_FALSE(tissue_of_name("none").has_value());
  EXPECT_FALSE(tissue_of_name("Liver").has_value());
  const LabelMap labels = make_phantom({.spacing_mm = glm::dvec3(6, 6, 9)}).labels;
  for (std::size_t at = 1; at < labels.names.size(); ++at)
    EXPECT_TRUE(tissue_of_name(labels.names[at]).has_value()) << labels.names[at];
}

TEST(Classes, SmallAndEvenVolumesAreTaken) {
  for (const glm::ivec3& size :
       {glm::ivec3(1, 1, 1), glm::ivec3(2, 1, 3), glm::ivec3(1, 5, 2), glm::ivec3(4, 3, 1)})
    for (const int hu : {-1024, -500, -100, 5, 50, 250, 800, 3071}) {
      Volume volume = make_volume(size, {1, 1, 1}, glm::dmat3(1.0), {0, 0, 0});
      volume.hu.assign(volume.hu.size(), static_cast<std::int16_t>(hu));
      const Classes classes = tissue_classes(volume);
      ASSERT_EQ(classes.size(), volume.hu.size());
      if (hu < -300) {
        EXPECT_EQ(classes[0], TissueClass::air);
      }
      if (hu == -100) {
        EXPECT_EQ(classes[0], TissueClass::fat);
      }
      if (hu == 50) {
        EXPECT_EQ(classes[0], TissueClass::soft_tissue);
      }
      if (hu == 800) {
        EXPECT_EQ(classes[0], TissueClass::bone);
      }
      if (hu == 3071) {
        EXPECT_EQ(classes[0], TissueClass::metal);
      }
    }
}

TEST(Classes, BytesComeBackAndDamageIsRefused) {
  Classes classes;
  for (std::size_t at = 0; at < 5000; ++at) classes.push_back(static_cast<TissueClass>(at / 7 % kTissueClasses));
  const std::vector<std::byte> bytes = bytes_from_classes(classes);
  EXPECT_LT(bytes.size(), classes.size() / 4);
  EXPECT_EQ(classes_from_bytes(bytes, 5000).value(), classes);
  EXPECT_EQ(classes_from_bytes(bytes, 4999).error().code, "damaged");
  for (std::size_t length = 0; length < bytes.size(); length += 5)
    EXPECT_EQ(classes_from_bytes(std::span(bytes).first(length), 5000).error().code, "damaged") << length;
  for (std::size_t at = 0; at < bytes.size(); at += 3) {
    std::vector<std::byte> changed = bytes;
    changed[at] ^= std::byte{0x10};
    const auto read = classes_from_bytes(changed, 5000);
    if (read) {
      EXPECT_EQ(*read, classes) << at;
    }  // a bit without meaning in the frame
  }
  classes[3] = static_cast<TissueClass>(kTissueClasses);
  EXPECT_EQ(classes_from_bytes(bytes_from_classes(classes), 5000).error().code, "damaged");
}

// What HU alone make of the built-in torso, whose labels are the truth.
TEST(Classes, HuAloneFindTheTorsosTissues) {
  const Phantom phantom = make_phantom();
  const Classes truth = tissue_classes(phantom.volume, &phantom.labels);
  const Classes found = tissue_classes(phantom.volume);
  // What cannot be told from HU counts as its nearest: organs and unenhanced or faintly enhanced blood as tissue.
  std::array<std::array<std::size_t, kTissueClasses>, kTissueClasses> table{};
  for (std::size_t at = 0; at < truth.size(); ++at)
    ++table[static_cast<std::size_t>(truth[at])][static_cast<std::size_t>(found[at])];
  std::printf("%-12s", "truth\\found");
  for (std::size_t f = 0; f < kTissueClasses; ++f) std::printf(" %6.6s", about(static_cast<TissueClass>(f)).name);
  std::printf("   (%%)\n");
  std::map<TissueClass, double> right;
  std::map<TissueClass, double> as_bone;
  for (std::size_t t = 0; t < kTissueClasses; ++t) {
    std::size_t all = 0;
    for (const std::size_t count : table[t]) all += count;
    if (all == 0) continue;
    std::printf("%-12s", about(static_cast<TissueClass>(t)).name);
    for (std::size_t f = 0; f < kTissueClasses; ++f)
      std::printf(" %6.2f", 100.0 * static_cast<double>(table[t][f]) / static_cast<double>(all));
    std::printf("   of %zu\n", all);
    const auto tissue = static_cast<TissueClass>(t);
    const bool organ = tissue >= TissueClass::liver && tissue <= TissueClass::vessel;
    right[tissue] = static_cast<double>(table[t][organ ? std::size_t{5} : t]) / static_cast<double>(all);
    as_bone[tissue] =
        static_cast<double>(table[t][static_cast<std::size_t>(TissueClass::bone)]) / static_cast<double>(all);
  }
  EXPECT_EQ(right[TissueClass::air], 1.0);
  EXPECT_GE(right[TissueClass::lung], 0.99);
  EXPECT_GE(right[TissueClass::gas], 0.95);
  EXPECT_GE(right[TissueClass::fat], 0.95);
  EXPECT_GE(right[TissueClass::bone], 0.97);
  for (const TissueClass tissue :
       {TissueClass::liver, TissueClass::kidney, TissueClass::spleen, TissueClass::muscle})
    EXPECT_GE(right[tissue], 0.97) << about(tissue).name;
  for (const TissueClass tissue :
       {TissueClass::liver, TissueClass::kidney, TissueClass::spleen, TissueClass::muscle})
    EXPECT_LE(as_bone[tissue], 0.005) << about(tissue).name;
  EXPECT_LE(as_bone[TissueClass::vessel], 0.025) << "more than bundles of 3 mm beside a rib, 130 HU";
}

}  // namespace
}  // namespace seldinger::volume
