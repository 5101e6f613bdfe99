// A buffer in GPU memory: uniform blocks going in, storage blocks coming back.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

// What every GL 4.3 accepts as the beginning of a part (GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT is at most this).
constexpr std::size_t kUniformAlignment = 256;

enum class BufferUse { uniform, storage };

class Buffer {
 public:
  Buffer(Context& context, BufferUse use, std::size_t bytes);  // throws base::Failure("gl") when out of memory
  ~Buffer();
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;

  std::size_t size() const noexcept { return bytes_; }
  void resize(std::size_t bytes);  // the content is lost; throws base::Failure("gl") when out of memory
  void bind(int binding) const;    // layout(binding = …) of the block in the shader
  // Of a uniform buffer: a part, for a block of so many bytes. `from` is a multiple of kUniformAlignment.
  void bind_part(int binding, std::size_t from, std::size_t bytes) const;
  void clear();                                  // all bits 0
  void write(std::span<const std::byte> bytes);  // from the beginning
  void read(std::span<std::byte> bytes) const;   // from the beginning; waits for the programs before it

 private:
  std::shared_ptr<Handles> handles_;
  BufferUse use_;
  std::size_t bytes_ = 0;
  unsigned int name_ = 0;
};

}  // namespace seldinger::gpu
