// The last pictures, to scroll through when frozen. Polar, so that gain, sliders and range still act; levels in 16
// bits, a 128th of a dB, which no grey can tell.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sim/imaging/ultrasound/colour.h"
#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::imaging {

struct CinePicture {
  double t_s = 0.0;
  std::uint64_t number = 0;
  UltrasoundView view;  // with the pose that it was taken from
  PolarPicture picture;
  std::optional<ColourPicture> colour;  // over it
};

class CineLoop {
 public:
  // 96 pictures of 128 × 1024 are 24 MiB; memory is taken as pictures come.
  static constexpr int kPictures = 96;

  void clear() noexcept { count_ = 0; }
  int size() const noexcept { return count_; }
  void push(double t_s, std::uint64_t number, const UltrasoundView& view, const PolarPicture& picture,
            std::optional<ColourPicture> colour = {});
  // 0 the newest; nothing when there are not so many.
  std::optional<CinePicture> back(int pictures) const;

 private:
  struct Kept {
    double t_s = 0.0;
    std::uint64_t number = 0;
    UltrasoundView view;
    int beams = 0, samples = 0;
    std::vector<std::uint16_t> levels;
    std::optional<ColourPicture> colour;
  };
  std::vector<Kept> kept_;
  int count_ = 0, next_ = 0;
};

}  // namespace seldinger::imaging
