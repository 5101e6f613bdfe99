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

// No wider than so many pixels: means of squares of so many pixels as that takes; what is left over at the right
// and below is cut.
GreyPicture shrunk_to(const GreyPicture& picture, int most_width_px);

}  // namespace seldinger::session
