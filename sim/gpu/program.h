// A compute program from GLSL text.
#pragma once

#include <memory>
#include <string_view>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

class Program {
 public:
  // Throws base::Failure("gl", the compiler's or linker's log).
  Program(Context& context, std::string_view compute_text);
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  // Runs the program over work groups, with the textures and buffers bound last. Buffers read afterwards
  // (Buffer::read) hold what it wrote.
  void dispatch(int groups_x, int groups_y, int groups_z);

 private:
  std::shared_ptr<Handles> handles_;
  unsigned int name_ = 0;
};

}  // namespace seldinger::gpu
