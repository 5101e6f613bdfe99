// A volume of 16-bit integers as a stack of slices: signed (R16I, isampler2DArray in shaders) or unsigned (R16UI,
// usampler2DArray; with two numbers a voxel RG16UI). A stack and not a 3-D
// texture, because textureGather exists for stacks only: it answers the 2×2 neighbours of a slice at once,
// unfiltered and exact. Two of them instead of eight texelFetch bring a 512×512 trilinear picture with needle and
// lesion from 16.3 to 10.1 ms of processor time (Mesa 22.3 llvmpipe).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <span>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

class Texture {
 public:
  // `values` with x fastest, size.x·size.y·size.z of them. Throws base::Failure("gl") when the size exceeds
  // GL_MAX_TEXTURE_SIZE, GL_MAX_ARRAY_TEXTURE_LAYERS or memory.
  Texture(Context& context, glm::ivec3 size, std::span<const std::int16_t> values);
  // With the handles of a context that may be gone; any thread's, made current on this one. `numbers` (1 or 2) a
  // voxel.
  Texture(const std::shared_ptr<Handles>& handles, glm::ivec3 size, std::span<const std::uint16_t> values,
          int numbers = 1);
  ~Texture();
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  // Throws base::Failure("gl") when no texture can have this size.
  static void check_size(const std::shared_ptr<Handles>& handles, glm::ivec3 size);

  void bind(int unit) const;  // layout(binding = unit) in the shader; reads beyond a border repeat it

 private:
  void upload(glm::ivec3 size, unsigned int inner, unsigned int outer, unsigned int type, const void* values);

  std::shared_ptr<Handles> handles_;
  unsigned int name_ = 0;
};

}  // namespace seldinger::gpu
