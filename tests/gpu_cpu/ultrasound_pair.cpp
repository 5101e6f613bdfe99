#include "tests/gpu_cpu/ultrasound_pair.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace seldinger::imaging {

ScreenPair screen_pair(UltrasoundGpu& gpu, const TissueVolume& tissue, const UltrasoundView& view,
                       const Inserted& inserted, std::span<const float> depth_below_skin_mm,
                       const UltrasoundKnobs& knobs, DisplaySize size, const tissue::Displacement& displacement) {
  constexpr std::uint64_t kFrame = 7;
  ScreenPair pair;
  PolarPicture polar;
  const ScanConverter converter(view, size);
  const auto show = [&](std::vector<unsigned char>& grey) {
    add_receiver_noise(view.seed, kFrame, polar);
    converter.grey(view, knobs, polar, grey);
  };
  ultrasound_polar(tissue, view, inserted, depth_below_skin_mm, polar, displacement);
  show(pair.cpu);
  gpu.polar(view, inserted, depth_below_skin_mm, polar, displacement);
  show(pair.gpu);
  if (pair.cpu.size() != pair.gpu.size()) return pair;
  std::size_t lit = 0, far = 0;
  for (std::size_t i = 0; i < pair.cpu.size(); ++i) {
    lit += pair.cpu[i] > 0 || pair.gpu[i] > 0;
    far += std::abs(int{pair.cpu[i]} - int{pair.gpu[i]}) > 1;
  }
  pair.lit = static_cast<double>(lit) / static_cast<double>(pair.cpu.size());
  pair.far_apart = static_cast<double>(far) / static_cast<double>(std::max<std::size_t>(lit, 1));
  return pair;
}

testing::AssertionResult alike(const ScreenPair& pair) {
  if (pair.lit > 0.02 && pair.far_apart <= 0.001) return testing::AssertionSuccess();
  return testing::AssertionFailure() << 100.0 * pair.far_apart
                                     << " % of the lit pixels are more than a grey apart, " << 100.0 * pair.lit
                                     << " % are lit";
}

testing::AssertionResult alike(const PolarPicture& cpu, const PolarPicture& gpu, double share) {
  if (cpu.beams != gpu.beams || cpu.samples != gpu.samples || cpu.envelope.size() != gpu.envelope.size())
    return testing::AssertionFailure() << "not of one size";
  std::size_t far = 0;
  for (std::size_t i = 0; i < cpu.envelope.size(); ++i) {
    const float a = cpu.envelope[i], b = gpu.envelope[i];
    if (!std::isfinite(a) || !std::isfinite(b)) return testing::AssertionFailure() << "not finite at " << i;
    far += !(std::abs(a - b) < 0.01F * std::max({a, b, 1e-3F}));
  }
  if (static_cast<double>(far) <= share * static_cast<double>(cpu.envelope.size()))
    return testing::AssertionSuccess();
  return testing::AssertionFailure() << far << " of " << cpu.envelope.size() << " samples are 1 % apart or more";
}

}  // namespace seldinger::imaging
