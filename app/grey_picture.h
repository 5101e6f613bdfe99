// A grey picture in memory.
#pragma once

#include <vector>

namespace seldinger::app {

struct GreyPicture {
  std::vector<unsigned char> grey;  // row-major, width · height
  int width_px = 0, height_px = 0;
};

}  // namespace seldinger::app
