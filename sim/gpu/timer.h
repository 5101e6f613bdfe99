// What the GPU itself spends between two points, by timer queries: time stamps, as GL_TIME_ELAPSED answers 0 for
// compute shaders on llvmpipe.
#pragma once

#include <memory>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

class Timer {
 public:
  explicit Timer(Context& context);
  ~Timer();
  Timer(const Timer&) = delete;
  Timer& operator=(const Timer&) = delete;

  void start();      // after everything before has finished (glFinish)
  double stop_ms();  // waits for everything since start; throws base::Failure("gl")

 private:
  std::shared_ptr<Handles> handles_;
  unsigned int names_[2] = {0, 0};
};

}  // namespace seldinger::gpu
