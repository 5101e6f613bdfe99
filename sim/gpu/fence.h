// A mark in what GL was told to do: whether it has come so far. With it a thread that waits for a picture can do
// something else meanwhile.
#pragma once

#include <memory>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

class Fence {
 public:
  // After everything that was said so far, which is sent off.
  explicit Fence(Context& context);
  ~Fence();
  Fence(const Fence&) = delete;
  Fence& operator=(const Fence&) = delete;

  // Waits no longer than told; 0: not at all. Throws base::Failure("gl").
  bool passed(double most_s);

 private:
  std::shared_ptr<Handles> handles_;
  void* sync_ = nullptr;  // GL's
};

}  // namespace seldinger::gpu
