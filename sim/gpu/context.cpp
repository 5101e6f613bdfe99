#include "sim/gpu/context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glew.h>

#include <array>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <vector>

#include "sim/base/failure.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {

// An initialised EGL display. EGL answers the same display for the same device and counts no users, so eglTerminate
// waits here for the last one.
class EglDisplay {
 public:
  static std::shared_ptr<EglDisplay> shared(EGLDisplay handle) {
    if (handle == EGL_NO_DISPLAY) return nullptr;
    const std::lock_guard lock(mutex());
    std::weak_ptr<EglDisplay>& known = displays()[handle];
    if (auto alive = known.lock()) return alive;
    if (eglInitialize(handle, nullptr, nullptr) != EGL_TRUE) return nullptr;
    std::shared_ptr<EglDisplay> fresh(new EglDisplay(handle));
    known = fresh;
    return fresh;
  }
  ~EglDisplay() {
    const std::lock_guard lock(mutex());
    // Another thread may have initialised it again between the last user's end and this lock.
    if (displays()[handle_].expired()) eglTerminate(handle_);
  }
  EglDisplay(const EglDisplay&) = delete;
  EglDisplay& operator=(const EglDisplay&) = delete;
  EGLDisplay handle() const noexcept { return handle_; }

 private:
  explicit EglDisplay(EGLDisplay handle) noexcept : handle_(handle) {}
  static std::mutex& mutex() {
    static std::mutex instance;
    return instance;
  }
  static std::map<EGLDisplay, std::weak_ptr<EglDisplay>>& displays() {
    static std::map<EGLDisplay, std::weak_ptr<EglDisplay>> instance;
    return instance;
  }
  EGLDisplay handle_;
};

namespace {

template <typename Function>
Function egl_function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

// Extension names are words of a list; none that we ask for is the beginning of another.
bool has_extension(const char* list, const char* name) {
  return list != nullptr && std::strstr(list, name) != nullptr;
}

std::vector<EGLDisplay> hardware_displays(PFNEGLGETPLATFORMDISPLAYEXTPROC get_platform_display) {
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  if (!has_extension(client, "EGL_EXT_platform_device")) return {};
  const auto query_devices = egl_function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto query_string = egl_function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (query_devices == nullptr || query_string == nullptr) return {};
  std::array<EGLDeviceEXT, 16> devices{};
  EGLint count = 0;
  if (query_devices(static_cast<EGLint>(devices.size()), devices.data(), &count) != EGL_TRUE) return {};
  std::vector<EGLDisplay> displays;
  for (EGLint i = 0; i < count; ++i) {
    const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
    if (has_extension(query_string(device, EGL_EXTENSIONS), "EGL_MESA_device_software")) continue;
    displays.push_back(get_platform_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr));
  }
  return displays;
}

// A GL 4.3 core context on this display; null when it has none.
std::shared_ptr<Handles> context_on(EGLDisplay raw_display) {
  std::shared_ptr<EglDisplay> display = EglDisplay::shared(raw_display);
  if (!display) return nullptr;
  if (!has_extension(eglQueryString(display->handle(), EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
    return nullptr;
  if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) return nullptr;
  // Any surface type: without a window none is needed, and the default asks for windows.
  const EGLint config_wish[] = {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, 0, EGL_NONE};
  EGLConfig config = nullptr;
  EGLint configs = 0;
  if (eglChooseConfig(display->handle(), config_wish, &config, 1, &configs) != EGL_TRUE || configs < 1)
    return nullptr;
  const EGLint context_wish[] = {
      EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  const EGLContext context = eglCreateContext(display->handle(), config, EGL_NO_CONTEXT, context_wish);
  if (context == EGL_NO_CONTEXT) return nullptr;
  auto handles = std::make_shared<Handles>(std::move(display), context);
  return handles->try_make_current() ? handles : nullptr;
}

// GLEW's entry points are globals; libglvnd sends each call to the context that is current, so loading them again
// for every context changes nothing for the others.
void load_entry_points() {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  glewExperimental = GL_TRUE;
  const GLenum code = glewInit();
  // Without a GLX display every GL entry point is loaded and only GLX's are missing.
  if (code != GLEW_OK && code != GLEW_ERROR_NO_GLX_DISPLAY)
    throw base::Failure("gl", "the OpenGL entry points cannot be loaded");
  if (glDispatchCompute == nullptr) throw base::Failure("gl", "OpenGL has no compute shaders");
  while (glGetError() != GL_NO_ERROR) {
  }
}

std::string gl_text(GLenum name) {
  const GLubyte* text = glGetString(name);
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

}  // namespace

Handles::Handles(std::shared_ptr<EglDisplay> display, void* context) noexcept
    : display_(std::move(display)), context_(context) {}

Handles::~Handles() {
  if (!display_) return;
  if (eglGetCurrentContext() == context_)
    eglMakeCurrent(display_->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  eglDestroyContext(display_->handle(), context_);
}

bool Handles::try_make_current() const noexcept {
  if (!display_) return true;
  if (eglGetCurrentContext() == context_) return true;
  return eglMakeCurrent(display_->handle(), EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_TRUE;
}

void Handles::make_current() const {
  if (!try_make_current()) throw base::Failure("gl", "the OpenGL context cannot be made current on this thread");
}

void Handles::check_errors(const char* doing) const {
  std::optional<GLenum> first;
  for (GLenum code = glGetError(); code != GL_NO_ERROR; code = glGetError())
    if (!first) first = code;
  if (!first) return;
  const std::string what = *first == GL_OUT_OF_MEMORY ? "out of memory" : "error " + std::to_string(*first);
  throw base::Failure("gl", std::string("OpenGL: ") + what + " while " + doing);
}

namespace {

std::shared_ptr<Handles> context_without_window() {
  const auto get_platform_display = egl_function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (get_platform_display == nullptr) throw base::Failure("gl", "EGL has no platform displays");
  for (const EGLDisplay display : hardware_displays(get_platform_display))
    if (auto handles = context_on(display)) return handles;
  auto handles = context_on(get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr));
  if (!handles) throw base::Failure("gl", "no OpenGL 4.3 core context can be had");
  return handles;
}

}  // namespace

Context::Context() : Context(context_without_window()) {}

Context Context::of_window() {
  return Context(std::make_shared<Handles>(nullptr, nullptr));
}

Context::Context(std::shared_ptr<Handles> handles) : handles_(std::move(handles)) {
  load_entry_points();
  renderer_ = gl_text(GL_RENDERER);
  version_ = gl_text(GL_VERSION);
  for (const char* name : {"llvmpipe", "softpipe", "swrast"})
    software_ = software_ || renderer_.find(name) != std::string::npos;
}

Context::~Context() = default;

}  // namespace seldinger::gpu
