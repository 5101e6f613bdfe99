// Pictures as PNG: the door of libpng.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "session/guidance/grey_picture.h"

namespace seldinger::app {

// 8-bit grey, row-major, width · height.
std::vector<std::byte> png_from_grey(std::span<const unsigned char> grey, int width_px, int height_px);
// The same in 2 to 256 even greys, smaller: speckle compresses badly.
std::vector<std::byte> png_in_greys(std::span<const unsigned char> grey, int width_px, int height_px, int greys);
// 8 bits each of red, green and blue.
std::vector<std::byte> png_from_rgb(std::span<const unsigned char> rgb, int width_px, int height_px);
// Grey, or in colour where there is any; nothing of a picture without pixels.
std::vector<std::byte> png_of(const session::GreyPicture& picture);

}  // namespace seldinger::app
