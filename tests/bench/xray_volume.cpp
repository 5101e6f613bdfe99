// xray_volume FILE.mha: the timing volume of the projectors' comparison. 512×512×62 voxels of 0.74×0.74×3 mm centred at
// the origin: air (−1000 HU), a water cylinder of 150 mm radius along z, five bone spheres. All that is not air
// carries noise, uniform in ±10 HU: of uniform cells a projector could take many in one step, of a patient's it
// cannot. One voxel of air all around, because the peer leaves out the last voxel of every ray.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <glm/vector_relational.hpp>
#include <vector>

#include "sim/base/rng.h"

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

int main(int count, char** words) {
  if (count != 2) {
    std::fprintf(stderr, "xray_volume FILE.mha\n");
    return 2;
  }
  const glm::dvec3 first_mm = -0.5 * kSpacingMm * glm::dvec3(kSize - 1);
  std::vector<std::int16_t> hu;
  hu.reserve(static_cast<std::size_t>(kSize.x) * static_cast<std::size_t>(kSize.y) *
             static_cast<std::size_t>(kSize.z));
  seldinger::base::Rng rng(kSeed);
  for (int k = 0; k < kSize.z; ++k)
    for (int j = 0; j < kSize.y; ++j)
      for (int i = 0; i < kSize.x; ++i) {
        const glm::ivec3 inner = glm::ivec3(i, j, k) - 1;
        const bool border = glm::any(glm::lessThan(inner, glm::ivec3(0))) ||
                            glm::any(glm::greaterThanEqual(inner, kInner));
        int value = border ? kAirHu : tissue_hu(first_mm + kSpacingMm * glm::dvec3(i, j, k));
        if (value != kAirHu) value += static_cast<int>(rng.uniform() * 21.0) - 10;
        hu.push_back(static_cast<std::int16_t>(value));
      }
  std::ofstream file(words[1], std::ios::binary);
  file << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
          "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\n"
       << "Offset = " << first_mm.x << ' ' << first_mm.y << ' ' << first_mm.z << '\n'
       << "ElementSpacing = " << kSpacingMm.x << ' ' << kSpacingMm.y << ' ' << kSpacingMm.z << '\n'
       << "DimSize = " << kSize.x << ' ' << kSize.y << ' ' << kSize.z << '\n'
       << "ElementType = MET_SHORT\nElementDataFile = LOCAL\n";
  file.write(reinterpret_cast<const char*>(hu.data()),
             static_cast<std::streamsize>(hu.size() * sizeof(std::int16_t)));
  file.close();
  if (!file) {
    std::fprintf(stderr, "xray_volume: %s cannot be written\n", words[1]);
    return 1;
  }
  return 0;
}
