// A GL 4.3 core context without a window: first EGL_EXT_platform_device with a device that is not software, else
// EGL_PLATFORM_SURFACELESS_MESA (llvmpipe anywhere). The door of EGL and GLEW is this folder.
#pragma once

#include <memory>
#include <string>

namespace seldinger::gpu {

class Context {
 public:
  Context();  // current on this thread; throws base::Failure("gl") when no GL 4.3 can be had
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  const std::string& renderer() const noexcept { return renderer_; }  // GL_RENDERER
  const std::string& version() const noexcept { return version_; }    // GL_VERSION
  bool software() const noexcept { return software_; }

 private:
  struct Handles;
  std::unique_ptr<Handles> handles_;
  std::string renderer_, version_;
  bool software_ = false;
};

}  // namespace seldinger::gpu
