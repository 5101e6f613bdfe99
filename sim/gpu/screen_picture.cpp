#include "sim/gpu/screen_picture.h"

#include <GL/glew.h>

#include <cstddef>

#include "sim/base/check.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {

ScreenPicture::ScreenPicture(Context& context, Pixels pixels) : handles_(context.handles()), pixels_(pixels) {
  handles_->make_current();
  glGenTextures(1, &name_);
  glBindTexture(GL_TEXTURE_2D, name_);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  if (pixels_ == Pixels::grey) {
    const GLint as_grey[] = {GL_RED, GL_RED, GL_RED, GL_ONE};
    glTexParameteriv(GL_TEXTURE_2D, GL_TEXTURE_SWIZZLE_RGBA, as_grey);
  }
  handles_->check_errors("making a picture for the screen");
}

ScreenPicture::~ScreenPicture() {
  if (handles_->try_make_current()) glDeleteTextures(1, &name_);
}

void ScreenPicture::show(int width_px, int height_px, std::span<const unsigned char> bytes) {
  const bool grey = pixels_ == Pixels::grey;
  CHECK(width_px > 0 && height_px > 0);
  CHECK(bytes.size() ==
        static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) * (grey ? 1U : 4U));
  handles_->make_current();
  glBindTexture(GL_TEXTURE_2D, name_);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  const GLenum format = grey ? GL_RED : GL_RGBA;
  if (width_px != width_px_ || height_px != height_px_)
    glTexImage2D(GL_TEXTURE_2D, 0, grey ? GL_R8 : GL_RGBA8, width_px, height_px, 0, format, GL_UNSIGNED_BYTE,
                 bytes.data());
  else
    glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_px, height_px, format, GL_UNSIGNED_BYTE, bytes.data());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  handles_->check_errors("showing a picture");
  width_px_ = width_px;
  height_px_ = height_px;
}

}  // namespace seldinger::gpu
