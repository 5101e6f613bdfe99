#include "casedb/import/dicom/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

// Along one axis: the two pixels around each of the layer's, and the second's share; first < 0 is outside.
struct Taps {
  int first = -1, second = -1;
  double share = 0.0;
};

std::vector<Taps> taps_along(int layer_px, int slice_px, double shift_px) {
  std::vector<Taps> all(static_cast<std::size_t>(layer_px));
  for (int i = 0; i < layer_px; ++i) {
    const double at = i - shift_px;
    if (!(at >= -0.5 && at <= slice_px - 0.5)) continue;  // faces are half a pixel beyond the centres
    const double held = std::clamp(at, 0.0, slice_px - 1.0), floor = std::floor(held);
    const int first = static_cast<int>(floor);
    all[static_cast<std::size_t>(i)] = {first, std::min(first + 1, slice_px - 1), held - floor};
  }
  return all;
}

double sample(std::span<const std::int16_t> hu, int width, const Taps& x, const Taps& y) {
  const auto at = [&](int i, int j) {
    return static_cast<double>(
        hu[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) + static_cast<std::size_t>(i)]);
  };
  const double upper = at(x.first, y.first) * (1.0 - x.share) + at(x.second, y.first) * x.share;
  const double lower = at(x.first, y.second) * (1.0 - x.share) + at(x.second, y.second) * x.share;
  return upper * (1.0 - y.share) + lower * y.share;
}

}  // namespace

void blend_layer(const PlacedSlice& below, const PlacedSlice& above, double weight, glm::ivec2 slice_px,
                 glm::ivec2 layer_px, std::span<std::int16_t> layer) {
  struct Part {
    const PlacedSlice& slice;
    double weight;
    std::vector<Taps> x, y;
  };
  std::array<Part, 2> parts = {Part{below, 1.0 - weight, {}, {}}, Part{above, weight, {}, {}}};
  for (Part& part : parts) {
    part.x = taps_along(layer_px.x, slice_px.x, part.slice.shift_px.x);
    part.y = taps_along(layer_px.y, slice_px.y, part.slice.shift_px.y);
  }
  std::size_t out = 0;
  for (std::size_t j = 0; j < static_cast<std::size_t>(layer_px.y); ++j)
    for (std::size_t i = 0; i < static_cast<std::size_t>(layer_px.x); ++i) {
      double sum = 0.0, weights = 0.0;
      for (const Part& part : parts) {
        if (part.weight <= 0.0 || part.x[i].first < 0 || part.y[j].first < 0) continue;
        sum += part.weight * sample(part.slice.hu, slice_px.x, part.x[i], part.y[j]);
        weights += part.weight;
      }
      layer[out++] = weights > 0.0 ? static_cast<std::int16_t>(std::lround(sum / weights)) : volume::kAirHu;
    }
}

}  // namespace seldinger::casedb
