// A grey picture in memory, with what is shown over it in colour.
#pragma once

#include <vector>

namespace seldinger::session {

struct GreyPicture {
  std::vector<unsigned char> grey;  // row-major, width · height
  int width_px = 0, height_px = 0;
  std::vector<unsigned char> colour{};  // as grey, numbers of imaging::colour_table; empty: grey alone
};

// Three bytes a pixel, with what is over it; four, the last one opaque.
std::vector<unsigned char> rgb_of(const GreyPicture& picture);
std::vector<unsigned char> rgba_of(const GreyPicture& picture);

// Without the black edges that all of them have; pictures of one size are cut alike, of another not at all.
void cut_black_edges(std::vector<GreyPicture>& pictures);

// No wider than so many pixels: means of squares of so many pixels as that takes; what is left over at the right
// and below is cut. Grey alone.
GreyPicture shrunk_to(const GreyPicture& picture, int most_width_px);

}  // namespace seldinger::session
