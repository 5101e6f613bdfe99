// A picture in memory as a texture that a window shows: grey, or red, green, blue and opacity, 8 bits each.
#pragma once

#include <span>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

class ScreenPicture {
 public:
  enum class Pixels { grey, rgba };

  ScreenPicture(Context& context, Pixels pixels);
  ~ScreenPicture();
  ScreenPicture(const ScreenPicture&) = delete;
  ScreenPicture& operator=(const ScreenPicture&) = delete;

  // Row-major, the upper row first; width · height pixels (CHECKed). Of the same size as before: no new memory.
  void show(int width_px, int height_px, std::span<const unsigned char> bytes);

  // As before anything was shown.
  void clear() noexcept { width_px_ = height_px_ = 0; }

  int width_px() const noexcept { return width_px_; }  // 0: nothing is shown
  int height_px() const noexcept { return height_px_; }
  unsigned int name() const noexcept { return name_; }  // GL's

 private:
  std::shared_ptr<Handles> handles_;
  Pixels pixels_;
  unsigned int name_ = 0;
  int width_px_ = 0, height_px_ = 0;
};

}  // namespace seldinger::gpu
