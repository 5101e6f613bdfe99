#include "tests/bench/timing_volume.h"

#include <array>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vector_relational.hpp>

#include "sim/base/rng.h"

namespace seldinger::bench {
namespace {

constexpr glm::ivec3 kInner{512, 512, 62}, kSize{514, 514, 64};
constexpr glm::dvec3 kSpacingMm{0.74, 0.74, 3.0};
constexpr double kCylinderMm = 150.0;
constexpr int kAirHu = -1000;
constexpr std::uint64_t kSeed = 62;

struct Sphere {
  glm::dvec3 center_mm;
  double radius_mm;
  int hu;
};
constexpr std::array<Sphere, 5> kBones = {{{{0.0, 90.0, 0.0}, 25.0, 700},
                                           {{80.0, 0.0, 30.0}, 20.0, 900},
                                           {{-80.0, 0.0, -30.0}, 20.0, 1100},
                                           {{40.0, -70.0, 40.0}, 15.0, 1300},
                                           {{-40.0, -70.0, -40.0}, 30.0, 1500}}};

int tissue_hu(const glm::dvec3& at_mm) {
  for (const Sphere& bone : kBones)
    if (glm::distance(at_mm, bone.center_mm) <= bone.radius_mm) return bone.hu;
  return at_mm.x * at_mm.x + at_mm.y * at_mm.y <= kCylinderMm * kCylinderMm ? 0 : kAirHu;
}

}  // namespace

volume::Volume timing_volume() {
  const glm::dvec3 first_mm = -0.5 * kSpacingMm * glm::dvec3(kSize - 1);
  volume::Volume volume = volume::make_volume(kSize, kSpacingMm, glm::dmat3(1.0), first_mm);
  base::Rng rng(kSeed);
  for (int k = 0; k < kSize.z; ++k)
    for (int j = 0; j < kSize.y; ++j)
      for (int i = 0; i < kSize.x; ++i) {
        const glm::ivec3 inner = glm::ivec3(i, j, k) - 1;
        const bool border =
            glm::any(glm::lessThan(inner, glm::ivec3(0))) || glm::any(glm::greaterThanEqual(inner, kInner));
        int hu = border ? kAirHu : tissue_hu(first_mm + kSpacingMm * glm::dvec3(i, j, k));
        if (hu != kAirHu) hu += static_cast<int>(rng.uniform() * 21.0) - 10;
        volume.hu[volume.index(i, j, k)] = static_cast<std::int16_t>(hu);
      }
  return volume;
}

}  // namespace seldinger::bench
