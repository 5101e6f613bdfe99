// A grey picture in memory.
#pragma once

#include <vector>

namespace seldinger::session {

struct GreyPicture {
  std::vector<unsigned char> grey;  // row-major, width · height
  int width_px = 0, height_px = 0;
};

// Without the black edges that all of them have; pictures of one size are cut alike, of another not at all.
void cut_black_edges(std::vector<GreyPicture>& pictures);

}  // namespace seldinger::session
