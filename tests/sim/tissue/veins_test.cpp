// Tests of sim/tissue/veins: a probe closes the vein and leaves the artery beside it, as in the graded case 4.
#include "sim/tissue/veins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

#include "sim/base/rng.h"
#include "tests/fixtures/allocations.h"

namespace seldinger::tissue {
namespace {

constexpr double kShearNMm2 = 0.0033;  // haptics' SoftContact

// Skin at z = 0, inwards +z. The vein of 12 mm lies 25 mm deep, the artery of 7 mm 12 mm beside and 10 mm deeper.
cases::Case neck() {
  cases::Case scene;
  const auto tube = [&](const char* name, const glm::dvec3& middle, double radius_mm) {
    scene.structures.push_back(
        {name, volume::TissueClass::vessel, cases::StructureRule::critical,
         cases::Tube{{middle - glm::dvec3(1, 60, 1), middle + glm::dvec3(1, 60, 1)}, radius_mm}});
  };
  tube("carotid", {12, 0, 35}, 3.5);
  tube("Jugular_Vein", {0, 0, 25}, 6.0);
  return scene;
}
SkinPress press_of(double depth_mm) {
  return {.at_lps_mm = glm::dvec3(0.0), .inward = {0, 0, 1}, .radius_mm = 20.0, .depth_mm = depth_mm};
}
Displacement pressed(const cases::Case& scene, double depth_mm) {
  const SkinPress press = press_of(depth_mm);
  std::vector<SqueezedVein> closing;
  for (const CompressibleVein& vein : compressible_veins(scene))
    if (const auto by = squeezed(vein, press, kShearNMm2)) closing.push_back(*by);
  return displacement_of({.presses = {&press, 1}, .veins = closing});
}
// Of a vessel next to the press, along it, as a share of what it is at rest.
double ap_share(const Displacement& displacement, const glm::dvec3& middle, double radius_mm) {
  const glm::dvec3 half(0.0, 0.0, radius_mm);
  return (displaced(displacement, middle + half).z - displaced(displacement, middle - half).z) / (2.0 * radius_mm);
}

TEST(Veins, AreDrawnTubesThatSaySo) {
  cases::Case scene = neck();
  ASSERT_EQ(compressible_veins(scene).size(), 1U);
  EXPECT_EQ(compressible_veins(scene)[0].name, "Jugular_Vein");
  scene.structures[1].tissue = volume::TissueClass::fluid;
  EXPECT_TRUE(compressible_veins(scene).empty());
  scene.structures[1] = {"vein", volume::TissueClass::vessel, cases::StructureRule::major,
                         cases::Sphere{{0, 0, 12}, 6.0}};
  EXPECT_TRUE(compressible_veins(scene).empty()) << "no tube";
  scene.structures.clear();
  for (int i = 0; i < 20; ++i) {
    const auto one = neck();
    scene.structures.push_back(one.structures[1]);
  }
  EXPECT_EQ(compressible_veins(scene).size(), static_cast<std::size_t>(kMostVeins)) << "bounded";
}

TEST(Veins, APressClosesTheVeinAndNotTheCarotid) {
  const cases::Case scene = neck();
  const glm::dvec3 vein(0, 0, 25), carotid(12, 0, 35);
  const Displacement closed = pressed(scene, 6.0);
  EXPECT_LT(ap_share(closed, vein, 6.0), 0.2);
  EXPECT_NEAR(ap_share(closed, carotid, 3.5), 1.0, 0.05);
  // Held lightly, both are open; and the way from one to the other has no step.
  EXPECT_GT(ap_share(pressed(scene, 2.0), vein, 6.0), 0.9);
  double last = 1.0;
  for (double depth_mm = 0.0; depth_mm <= 6.0; depth_mm += 0.002) {
    const double now = ap_share(pressed(scene, depth_mm), vein, 6.0);
    EXPECT_LT(now, last + 1e-9) << depth_mm;
    EXPECT_GT(now, last - 0.08) << depth_mm;
    last = now;
  }
  // Without a name that says vein nothing closes but by what is pushed.
  cases::Case artery = scene;
  artery.structures[1].name = "artery";
  EXPECT_GT(ap_share(pressed(artery, 6.0), vein, 6.0), 0.8);
}

TEST(Veins, ThatAreClosedFoldNothingAndComeBack) {
  for (const double depth_mm : {3.0, 4.0, 6.0, 12.0}) {
    const Displacement closed = pressed(neck(), depth_mm);
    base::Rng rng(8);
    double squares = 0.0;
    constexpr int kPlaces = 20000;
    for (int i = 0; i < kPlaces; ++i) {
      const glm::dvec3 rest(40.0 * rng.uniform() - 20.0, 90.0 * rng.uniform() - 45.0, 45.0 * rng.uniform() + 0.5);
      EXPECT_GT(volume_ratio(closed, rest), 0.005);
      // By where it is now: at rest, what is closed is as much wider again.
      const glm::dvec3 now = displaced(closed, rest);
      const double miss_mm = glm::distance(displaced(closed, rest_of(closed, now)), now);
      squares += miss_mm * miss_mm;
    }
    EXPECT_LT(std::sqrt(squares / kPlaces), 0.15) << depth_mm;
  }
}

TEST(Veins, FollowThePressAlongABendAndAllocateNothing) {
  const CompressibleVein bent{"vein", cases::Tube{{{0, -50, 12}, {0, 0, 12}, {30, 40, 12}}, 6.0}};
  SkinPress press = press_of(4.0);
  for (const glm::dvec3& at : {glm::dvec3(0, -30, 0), glm::dvec3(3, 5, 0), glm::dvec3(18, 24, 0)}) {
    press.at_lps_mm = at;
    const long before = fixtures::allocations_of_this_thread();
    const auto piece = squeezed(bent, press, kShearNMm2);
    EXPECT_EQ(fixtures::allocations_of_this_thread(), before);
    ASSERT_TRUE(piece.has_value());
    EXPECT_LT(piece->area_share, 0.1);
    const glm::dvec3 middle = 0.5 * (piece->from_lps_mm + piece->to_lps_mm);
    EXPECT_LT(cases::signed_distance_mm(cases::Shape{bent.tube}, middle, 20.0), -5.9) << "on its axis";
    EXPECT_NEAR(glm::distance(piece->from_lps_mm, piece->to_lps_mm), kClosedLengthMm, 1e-9);
  }
  press.at_lps_mm = {80, -30, 0};
  EXPECT_FALSE(squeezed(bent, press, kShearNMm2).has_value()) << "far away";
  press = press_of(0.0);
  EXPECT_FALSE(squeezed(bent, press, kShearNMm2).has_value());
}

}  // namespace
}  // namespace seldinger::tissue
