#include "sim/devices/arms/live_trace.h"

#include <algorithm>
#include <cmath>

namespace seldinger::devices {

void LiveTrace::add(double value, double elapsed_s) noexcept {
  if (!(elapsed_s > 0.0)) return;
  if (std::isfinite(value)) {
    Bin& bin = bins_[newest_];
    const auto newest = static_cast<float>(value);
    bin.least = bin.filled ? std::min(bin.least, newest) : newest;
    bin.most = bin.filled ? std::max(bin.most, newest) : newest;
    bin.filled = true;
  }
  in_bin_s_ += elapsed_s;
  // After a stall as long as all of it, nothing of before is left to show.
  in_bin_s_ = std::min(in_bin_s_, kTraceBinS * static_cast<double>(kTraceBins + 1));
  constexpr double kRounding = 1e-9;  // ten ticks of a millisecond are a bin
  while (in_bin_s_ >= kTraceBinS - kRounding) {
    in_bin_s_ = std::max(0.0, in_bin_s_ - kTraceBinS);
    newest_ = (newest_ + 1) % kTraceBins;
    bins_[newest_] = {};
  }
}

}  // namespace seldinger::devices
