// What a window's own framebuffer is asked for: everything else is drawn by whoever draws the window.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

// All of one colour, and everything from here on falls on all of it. On software GL this is the only cheap ground:
// a rectangle that is drawn costs as much as what lies on it.
void clear_window(Context& context, int width_px, int height_px, glm::vec3 colour);

// Red, green, blue of what was drawn and is not shown yet, row by row from the upper left.
std::vector<unsigned char> window_pixels(Context& context, int width_px, int height_px);

}  // namespace seldinger::gpu
