// Tests of casedb/import/diffusion: noise goes, edges stay.
#include "casedb/import/diffusion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/base/rng.h"

namespace seldinger::casedb {
namespace {

volume::Volume with_noise(volume::Volume volume, double sd_hu, std::uint64_t seed) {
  base::Rng rng(seed);
  for (std::int16_t& hu : volume.hu)
    hu = static_cast<std::int16_t>(std::max<long>(volume::kAirHu, std::lround(hu + sd_hu * rng.normal())));
  return volume;
}

// A plane between 0 and 100 HU.
volume::Volume step_volume() {
  volume::Volume volume = volume::make_volume({40, 40, 20}, {0.8, 0.8, 2.0}, glm::dmat3(1.0), glm::dvec3(0.0));
  for (int k = 0; k < 20; ++k)
    for (int j = 0; j < 40; ++j)
      for (int i = 0; i < 40; ++i) volume.hu[volume.index(i, j, k)] = i < 20 ? 0 : 100;
  return volume;
}

TEST(Diffusion, ItsStepIsInsideTheStableLimit) {
  // Explicit diffusion in N dimensions: at most the smallest spacing / 2^(N+1) (ITK refuses more).
  EXPECT_LT(stable_step(step_volume()), 0.8 / 16.0);
  EXPECT_GT(stable_step(step_volume()), 0.8 / 20.0);
  const volume::Volume coarse = volume::make_volume({4, 4, 4}, glm::dvec3(3.0), glm::dmat3(1.0), glm::dvec3(0.0));
  EXPECT_LT(stable_step(coarse), 1.0 / 16.0);
}

TEST(Diffusion, NoiseIsMeasured) {
  EXPECT_EQ(noise_sd_hu(step_volume()), 0.0);
  for (const double sd : {5.0, 15.0, 30.0})
    EXPECT_NEAR(noise_sd_hu(with_noise(step_volume(), sd, 1)), sd, 0.1 * sd);
}

TEST(Diffusion, NoiseGoesAndTheEdgeStays) {
  const volume::Volume noisy = with_noise(step_volume(), 20.0, 3), smooth = diffused(noisy);
  EXPECT_EQ(smooth.size_voxels, noisy.size_voxels);
  EXPECT_LT(noise_sd_hu(smooth), 0.6 * noise_sd_hu(noisy));
  // The edge where it was: means of the two layers beside it.
  double before = 0.0, behind = 0.0;
  for (int k = 2; k < 18; ++k)
    for (int j = 2; j < 38; ++j) {
      before += smooth.at(19, j, k);
      behind += smooth.at(20, j, k);
    }
  EXPECT_GT((behind - before) / (16 * 36), 70.0);
  const volume::Volume flat = volume::make_volume({12, 12, 12}, glm::dvec3(1.0), glm::dmat3(1.0), glm::dvec3(0.0));
  EXPECT_EQ(diffused(flat).hu, flat.hu) << "what is flat stays as it is";
}

}  // namespace
}  // namespace seldinger::casedb
