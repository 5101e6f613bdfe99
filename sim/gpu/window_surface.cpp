#include "sim/gpu/window_surface.h"

#include <GL/glew.h>

#include <algorithm>
#include <cstddef>

#include "sim/gpu/handles.h"

namespace seldinger::gpu {

void clear_window(Context& context, int width_px, int height_px, glm::vec3 colour) {
  context.handles()->make_current();
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glViewport(0, 0, width_px, height_px);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(colour.r, colour.g, colour.b, 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
}

std::vector<unsigned char> window_pixels(Context& context, int width_px, int height_px) {
  context.handles()->make_current();
  const auto row = 3 * static_cast<std::size_t>(width_px);
  std::vector<unsigned char> pixels(row * static_cast<std::size_t>(height_px));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, 0);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_px, height_px, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  context.handles()->check_errors("reading the window");
  for (std::size_t upper = 0, lower = static_cast<std::size_t>(height_px) - 1; upper < lower; ++upper, --lower)
    std::swap_ranges(pixels.begin() + static_cast<std::ptrdiff_t>(upper * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>((upper + 1) * row),
                     pixels.begin() + static_cast<std::ptrdiff_t>(lower * row));
  return pixels;
}

}  // namespace seldinger::gpu
