// The EGL context behind gpu::Context and everything made with it. Only sim/gpu/*.cpp include this.
#pragma once

#include <memory>
#include <string>

namespace seldinger::gpu {

class EglDisplay;

class Handles {
 public:
  // Without a display: a window's, which is current on its thread and stays so.
  Handles(std::shared_ptr<EglDisplay> display, void* context) noexcept;
  ~Handles();
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;

  void make_current() const;                   // throws base::Failure("gl")
  bool try_make_current() const noexcept;      // for destructors
  void check_errors(const char* doing) const;  // throws base::Failure("gl") on any pending GL error

 private:
  std::shared_ptr<EglDisplay> display_;
  void* context_;  // EGLContext
};

}  // namespace seldinger::gpu
