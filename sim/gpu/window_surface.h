// What a window's own framebuffer is asked for: everything else is drawn by whoever draws the window.
#pragma once

#include <vector>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

// Black, and everything from here on falls on all of it.
void clear_window(Context& context, int width_px, int height_px);

// Red, green, blue of what was drawn and is not shown yet, row by row from the upper left.
std::vector<unsigned char> window_pixels(Context& context, int width_px, int height_px);

}  // namespace seldinger::gpu
