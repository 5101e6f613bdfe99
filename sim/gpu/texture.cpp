#include "sim/gpu/texture.h"

#include <GL/glew.h>

#include <algorithm>

#include "sim/base/check.h"
#include "sim/base/failure.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {

namespace {

std::size_t count(glm::ivec3 size) {
  CHECK(size.x > 0 && size.y > 0 && size.z > 0);
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * static_cast<std::size_t>(size.z);
}

}  // namespace

Texture::Texture(Context& context, glm::ivec3 size, std::span<const std::int16_t> values)
    : handles_(context.handles()) {
  CHECK(values.size() == count(size));
  upload(size, GL_R16I, GL_RED_INTEGER, GL_SHORT, values.data());
}

Texture::Texture(const std::shared_ptr<Handles>& handles, glm::ivec3 size, std::span<const std::uint16_t> values,
                 int numbers)
    : handles_(handles) {
  CHECK(numbers == 1 || numbers == 2);
  CHECK(values.size() == count(size) * static_cast<std::size_t>(numbers));
  if (numbers == 1)
    upload(size, GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, values.data());
  else
    upload(size, GL_RG16UI, GL_RG_INTEGER, GL_UNSIGNED_SHORT, values.data());
}

void Texture::check_size(const std::shared_ptr<Handles>& handles, glm::ivec3 size) {
  handles->make_current();
  GLint largest_side = 0, most_slices = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest_side);
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most_slices);
  if (std::max(size.x, size.y) > largest_side || size.z > most_slices)
    throw base::Failure("gl", "the volume exceeds the largest texture of this OpenGL, " +
                                  std::to_string(most_slices) + " slices of " + std::to_string(largest_side) +
                                  " voxels along a side");
}

void Texture::upload(glm::ivec3 size, unsigned int inner, unsigned int outer, unsigned int type,
                     const void* values) {
  check_size(handles_, size);
  glGenTextures(1, &name_);
  try {
    glBindTexture(GL_TEXTURE_2D_ARRAY, name_);
    // Integer textures are incomplete with any other filter.
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 2);  // rows of 16-bit numbers follow each other without padding
    glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(inner), size.x, size.y, size.z, 0, outer, type, values);
    handles_->check_errors("uploading a volume");
  } catch (...) {
    glDeleteTextures(1, &name_);
    throw;
  }
}

Texture::~Texture() {
  if (handles_->try_make_current()) glDeleteTextures(1, &name_);
}

void Texture::bind(int unit) const {
  handles_->make_current();
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D_ARRAY, name_);
}

}  // namespace seldinger::gpu
