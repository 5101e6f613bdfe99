#include "sim/gpu/fence.h"

#include <GL/glew.h>

#include <algorithm>

#include "sim/base/failure.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {

Fence::Fence(Context& context) : handles_(context.handles()) {
  handles_->make_current();
  sync_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
  handles_->check_errors("setting a fence");
}

Fence::~Fence() {
  if (handles_->try_make_current()) glDeleteSync(static_cast<GLsync>(sync_));
}

bool Fence::passed(double most_s) {
  handles_->make_current();
  const auto most_ns = static_cast<GLuint64>(1e9 * std::clamp(most_s, 0.0, 10.0));
  const GLenum answer = glClientWaitSync(static_cast<GLsync>(sync_), 0, most_ns);
  if (answer == GL_WAIT_FAILED) throw base::Failure("gl", "OpenGL cannot wait for a picture");
  return answer != GL_TIMEOUT_EXPIRED;
}

}  // namespace seldinger::gpu
