#include "casedb/import/diffusion.h"

#include <itkCurvatureAnisotropicDiffusionImageFilter.h>
#include <itkImage.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

namespace seldinger::casedb {

double stable_step(const volume::Volume& volume) {
  const glm::dvec3& spacing = volume.spacing_mm;
  return 0.9 * std::min({1.0, spacing.x, spacing.y, spacing.z}) / 16.0;
}

double noise_sd_hu(const volume::Volume& volume) {
  constexpr int kLow = -100, kHigh = 200;
  constexpr double kMedianOfNormal = 0.6745;  // of |x|, in standard deviations
  std::vector<int> differences;
  const glm::ivec3 size = volume.size_voxels;
  const auto soft = [](int hu) { return hu >= kLow && hu <= kHigh; };
  for (int k = 0; k < size.z; ++k)
    for (int j = 0; j < size.y; j += 2)  // every other row is enough
      for (int i = 1; i + 1 < size.x; i += 2) {
        const int before = volume.at(i - 1, j, k), here = volume.at(i, j, k), after = volume.at(i + 1, j, k);
        if (soft(before) && soft(here) && soft(after)) differences.push_back(std::abs(before - 2 * here + after));
      }
  if (differences.empty()) return 0.0;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle / (std::sqrt(6.0) * kMedianOfNormal);
}

volume::Volume diffused(const volume::Volume& volume, const DiffusionOptions& options) {
  using Image = itk::Image<float, 3>;
  const auto image = Image::New();
  Image::SizeType size;
  Image::SpacingType spacing;
  for (int axis = 0; axis < 3; ++axis) {
    size[static_cast<unsigned>(axis)] = static_cast<itk::SizeValueType>(volume.size_voxels[axis]);
    spacing[static_cast<unsigned>(axis)] = volume.spacing_mm[axis];
  }
  image->SetRegions(size);
  image->SetSpacing(spacing);
  image->Allocate();
  std::copy(volume.hu.begin(), volume.hu.end(), image->GetBufferPointer());

  const auto filter = itk::CurvatureAnisotropicDiffusionImageFilter<Image, Image>::New();
  filter->SetInput(image);
  filter->SetNumberOfIterations(static_cast<unsigned>(options.iterations));
  filter->SetConductanceParameter(options.conductance);
  filter->SetTimeStep(stable_step(volume));
  filter->SetInPlace(true);
  filter->Update();

  volume::Volume made = volume;
  const float* from = filter->GetOutput()->GetBufferPointer();
  for (std::size_t at = 0; at < made.hu.size(); ++at)
    made.hu[at] =
        static_cast<std::int16_t>(std::clamp(std::lround(from[at]), long{volume::kAirHu}, long{INT16_MAX}));
  return made;
}

base::Problem denoise(volume::Volume& volume, int iterations) {
  const double before_hu = noise_sd_hu(volume);
  volume = diffused(volume, {.iterations = iterations});
  char text[128];
  std::snprintf(text, sizeof text, "asked for: anisotropic diffusion took noise from %.1f to %.1f HU", before_hu,
                noise_sd_hu(volume));
  return {"denoised", text};
}

}  // namespace seldinger::casedb
