#include "sim/gpu/buffer.h"

#include <GL/glew.h>

#include "sim/base/check.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {
namespace {

GLenum target_of(BufferUse use) {
  return use == BufferUse::uniform ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER;
}

}  // namespace

Buffer::Buffer(Context& context, BufferUse use, std::size_t bytes) : handles_(context.handles()), use_(use) {
  handles_->make_current();
  glGenBuffers(1, &name_);
  try {
    resize(bytes);
  } catch (...) {
    glDeleteBuffers(1, &name_);
    throw;
  }
}

Buffer::~Buffer() {
  if (handles_->try_make_current()) glDeleteBuffers(1, &name_);
}

void Buffer::resize(std::size_t bytes) {
  CHECK(bytes > 0);
  handles_->make_current();
  glBindBuffer(target_of(use_), name_);
  glBufferData(target_of(use_), static_cast<GLsizeiptr>(bytes), nullptr,
               use_ == BufferUse::uniform ? GL_DYNAMIC_DRAW : GL_DYNAMIC_READ);
  handles_->check_errors("making a buffer");
  bytes_ = bytes;
}

void Buffer::bind(int binding) const {
  handles_->make_current();
  glBindBufferBase(target_of(use_), static_cast<GLuint>(binding), name_);
}

void Buffer::bind_part(int binding, std::size_t from, std::size_t bytes) const {
  CHECK(use_ == BufferUse::uniform && from % kUniformAlignment == 0 && from + bytes <= bytes_);
  glBindBufferRange(GL_UNIFORM_BUFFER, static_cast<GLuint>(binding), name_, static_cast<GLintptr>(from),
                    static_cast<GLsizeiptr>(bytes));
}

void Buffer::clear() {
  handles_->make_current();
  glBindBuffer(target_of(use_), name_);
  glClearBufferData(target_of(use_), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
  handles_->check_errors("clearing a buffer");
}

void Buffer::write(std::span<const std::byte> bytes) {
  CHECK(bytes.size() <= bytes_);
  handles_->make_current();
  glBindBuffer(target_of(use_), name_);
  glBufferSubData(target_of(use_), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
  handles_->check_errors("writing a buffer");
}

void Buffer::read(std::span<std::byte> bytes) const {
  CHECK(bytes.size() <= bytes_);
  handles_->make_current();
  glBindBuffer(target_of(use_), name_);
  glGetBufferSubData(target_of(use_), 0, static_cast<GLsizeiptr>(bytes.size()), bytes.data());
  handles_->check_errors("reading a buffer");
}

}  // namespace seldinger::gpu
