// The last seconds of a force or a place, to be looked at: the least and the most of every kTraceBinS, so that no
// peak of a millisecond is lost however slowly it is drawn. A plain value: a servo adds to its own and puts it into
// a base::Snapshot now and then.
#pragma once

#include <array>
#include <cstddef>

namespace seldinger::devices {

inline constexpr double kTraceBinS = 0.01;
inline constexpr std::size_t kTraceBins = 512;  // 5 s

class LiveTrace {
 public:
  struct Bin {
    float least = 0.0F, most = 0.0F;
    bool filled = false;  // else nothing was told: a gap is drawn, not a zero
  };

  // Of one tick. No number: a gap.
  void add(double value, double elapsed_s) noexcept;

  // i = 0 is the bin that is being filled, kTraceBins − 1 the oldest.
  const Bin& bin(std::size_t i) const noexcept { return bins_[(newest_ + kTraceBins - i) % kTraceBins]; }

 private:
  std::array<Bin, kTraceBins> bins_{};
  std::size_t newest_ = 0;
  double in_bin_s_ = 0.0;
};

}  // namespace seldinger::devices
