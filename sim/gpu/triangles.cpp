#include "sim/gpu/triangles.h"

#include <GL/glew.h>

#include <algorithm>

#include "sim/base/check.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {

Triangles::Triangles(Context& context, std::span<const Vertex> vertices, std::span<const glm::uvec3> corners)
    : handles_(context.handles()), count_(corners.size()) {
  CHECK(!corners.empty());
  CHECK(std::all_of(corners.begin(), corners.end(), [&](const glm::uvec3& one) {
    return std::max({one.x, one.y, one.z}) < vertices.size();
  }));
  handles_->make_current();
  glGenVertexArrays(1, &array_);
  glGenBuffers(2, buffers_);
  glBindVertexArray(array_);
  glBindBuffer(GL_ARRAY_BUFFER, buffers_[0]);
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size_bytes()), vertices.data(), GL_STATIC_DRAW);
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers_[1]);
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(corners.size_bytes()), corners.data(),
               GL_STATIC_DRAW);
  const auto attribute = [](GLuint at, GLint numbers, GLenum type, GLboolean normalised, std::size_t offset) {
    glEnableVertexAttribArray(at);
    glVertexAttribPointer(at, numbers, type, normalised, sizeof(Vertex), reinterpret_cast<const void*>(offset));
  };
  attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, place_mm));
  attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
  attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, paint));
  glBindVertexArray(0);
  glBindBuffer(GL_ARRAY_BUFFER, 0);
  try {
    handles_->check_errors("uploading triangles");
  } catch (...) {
    glDeleteVertexArrays(1, &array_);
    glDeleteBuffers(2, buffers_);
    throw;
  }
}

Triangles::~Triangles() {
  if (!handles_->try_make_current()) return;
  glDeleteVertexArrays(1, &array_);
  glDeleteBuffers(2, buffers_);
}

void Triangles::draw() const {
  glBindVertexArray(array_);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * count_), GL_UNSIGNED_INT, nullptr);
}

}  // namespace seldinger::gpu
