// Triangles in GPU memory. Attributes of the vertex shader: 0 place (vec3), 1 normal (vec3), 2 paint (vec4).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

struct Vertex {
  glm::vec3 place_mm{0.0F};
  glm::vec3 normal{0.0F, 0.0F, 1.0F};                        // unit
  std::array<std::uint8_t, 4> paint = {255, 255, 255, 255};  // 0 to 255 arrives as 0 to 1
};

class Triangles {
 public:
  // Corners are indices of `vertices` (CHECKed), counter-clockwise seen from outside. At least one triangle. Throws
  // base::Failure("gl").
  Triangles(Context& context, std::span<const Vertex> vertices, std::span<const glm::uvec3> corners);
  ~Triangles();
  Triangles(const Triangles&) = delete;
  Triangles& operator=(const Triangles&) = delete;

  std::size_t count() const noexcept { return count_; }
  void draw() const;  // with the program, target and state that are set

 private:
  std::shared_ptr<Handles> handles_;
  std::size_t count_ = 0;
  unsigned int array_ = 0, buffers_[2] = {0, 0};
};

}  // namespace seldinger::gpu
