#include "sim/imaging/xray/projection/coarse.h"

#include <algorithm>
#include <cmath>

#include "sim/base/check.h"

namespace seldinger::imaging {
namespace {

struct Between {
  int low, high;
  float part;
};

// Where the centre of fine pixel `i` lies among coarse pixels.
Between between(int i, int by, int coarse_size) {
  const float at = std::clamp((static_cast<float>(i) + 0.5F) / static_cast<float>(by) - 0.5F, 0.0F,
                              static_cast<float>(coarse_size - 1));
  const int low = static_cast<int>(at);
  return {low, std::min(low + 1, coarse_size - 1), at - static_cast<float>(low)};
}

std::vector<float> enlarged_plane(const std::vector<float>& coarse, int width_px, int height_px, int by) {
  std::vector<float> fine;
  fine.reserve(coarse.size() * static_cast<std::size_t>(by) * static_cast<std::size_t>(by));
  std::vector<Between> columns;
  for (int column = 0; column < width_px * by; ++column) columns.push_back(between(column, by, width_px));
  for (int row = 0; row < height_px * by; ++row) {
    const Between r = between(row, by, height_px);
    const float* upper = coarse.data() + std::ptrdiff_t{r.low} * width_px;
    const float* lower = coarse.data() + std::ptrdiff_t{r.high} * width_px;
    for (const Between& c : columns) {
      const float a = upper[c.low] + c.part * (upper[c.high] - upper[c.low]);
      const float b = lower[c.low] + c.part * (lower[c.high] - lower[c.low]);
      fine.push_back(a + r.part * (b - a));
    }
  }
  return fine;
}

std::vector<float> averaged_plane(const std::vector<float>& fine, int width_px, int height_px, int by) {
  std::vector<float> means(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  for (int row = 0; row < height_px; ++row)
    for (int column = 0; column < width_px; ++column) {
      double sum = 0.0;
      for (int r = 0; r < by; ++r)
        for (int c = 0; c < by; ++c)
          sum += static_cast<double>(
              fine[static_cast<std::size_t>(std::ptrdiff_t{row * by + r} * width_px * by + column * by + c)]);
      means[static_cast<std::size_t>(std::ptrdiff_t{row} * width_px + column)] =
          static_cast<float>(sum / (static_cast<double>(by) * by));
    }
  return means;
}

}  // namespace

XrayGeometry coarser(XrayGeometry geometry, int by) {
  CHECK(by > 0 && geometry.width_px % by == 0 && geometry.height_px % by == 0);
  geometry.pixel_mm *= by;
  geometry.width_px /= by;
  geometry.height_px /= by;
  return geometry;
}

PathLengths enlarged(const PathLengths& coarse, int by) {
  CHECK(by > 0 && coarse.iron_mm.empty() && coarse.contrast_mm.empty());  // both are laid over the full picture
  PathLengths fine{coarse.width_px * by, coarse.height_px * by, {}, {}, {}};
  fine.water_mm = enlarged_plane(coarse.water_mm, coarse.width_px, coarse.height_px, by);
  if (!coarse.mineral_mm.empty())
    fine.mineral_mm = enlarged_plane(coarse.mineral_mm, coarse.width_px, coarse.height_px, by);
  return fine;
}

XrayGeometry finer(XrayGeometry geometry, int by) {
  CHECK(by > 0);
  geometry.pixel_mm /= by;
  geometry.width_px *= by;
  geometry.height_px *= by;
  return geometry;
}

PathLengths averaged(const PathLengths& fine, int by) {
  CHECK(by > 0 && fine.width_px % by == 0 && fine.height_px % by == 0);
  PathLengths means{fine.width_px / by, fine.height_px / by, {}, {}, {}};
  const auto plane = [&](const std::vector<float>& of) {
    return of.empty() ? std::vector<float>() : averaged_plane(of, means.width_px, means.height_px, by);
  };
  means.water_mm = plane(fine.water_mm);
  means.mineral_mm = plane(fine.mineral_mm);
  means.iron_mm = plane(fine.iron_mm);
  means.contrast_mm = plane(fine.contrast_mm);
  return means;
}

}  // namespace seldinger::imaging
