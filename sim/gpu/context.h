// A GL 4.3 core context without a window: first EGL_EXT_platform_device with a device that is not software, else
// EGL_PLATFORM_SURFACELESS_MESA (llvmpipe anywhere). The door of EGL and GLEW is this folder.
//
// What is made with a context (program, texture, buffer) shares it: the GL context itself ends with the last of
// them, so they may be destroyed in any order. All of them are used on the thread that made the context.
#pragma once

#include <memory>
#include <string>

namespace seldinger::gpu {

class Handles;  // the EGL side (handles.h), shared by everything made with a context

class Context {
 public:
  Context();  // current on this thread; throws base::Failure("gl") when no GL 4.3 can be had
  // The context of a window, which its maker made current on this thread and keeps so, and which outlives all that
  // is made with it. Throws as above when it is less than GL 4.3.
  static Context of_window();
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  Context(Context&&) noexcept = default;

  const std::string& renderer() const noexcept { return renderer_; }  // GL_RENDERER
  const std::string& version() const noexcept { return version_; }    // GL_VERSION
  bool software() const noexcept { return software_; }
  const std::shared_ptr<Handles>& handles() const noexcept { return handles_; }

 private:
  explicit Context(std::shared_ptr<Handles> handles);

  std::shared_ptr<Handles> handles_;
  std::string renderer_, version_;
  bool software_ = false;
};

}  // namespace seldinger::gpu
