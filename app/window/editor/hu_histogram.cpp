#include "app/window/editor/hu_histogram.h"

#include <algorithm>
#include <cmath>

namespace seldinger::app {

std::size_t HuHistogram::bin_of(double hu) noexcept {
  return static_cast<std::size_t>(std::clamp((hu - kLowHu) / kBinHu, 0.0, kBins - 1.0));
}

double HuHistogram::height(std::size_t bin) const noexcept {
  if (most == 0) return 0.0;
  return std::log1p(static_cast<double>(counts.at(bin))) / std::log1p(static_cast<double>(most));
}

HuHistogram histogram_of(const volume::Volume& volume) {
  HuHistogram made;
  for (const std::int16_t hu : volume.hu) ++made.counts[HuHistogram::bin_of(hu)];
  made.most = *std::max_element(made.counts.begin(), made.counts.end());
  return made;
}

}  // namespace seldinger::app
