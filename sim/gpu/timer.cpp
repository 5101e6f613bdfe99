#include "sim/gpu/timer.h"

#include <GL/glew.h>

#include "sim/gpu/handles.h"

namespace seldinger::gpu {

Timer::Timer(Context& context) : handles_(context.handles()) {
  handles_->make_current();
  glGenQueries(2, names_);
}

Timer::~Timer() {
  if (handles_->try_make_current()) glDeleteQueries(2, names_);
}

void Timer::start() {
  handles_->make_current();
  glFinish();
  glQueryCounter(names_[0], GL_TIMESTAMP);
}

double Timer::stop_ms() {
  handles_->make_current();
  glQueryCounter(names_[1], GL_TIMESTAMP);
  GLuint64 from_ns = 0, to_ns = 0;
  glGetQueryObjectui64v(names_[0], GL_QUERY_RESULT, &from_ns);
  glGetQueryObjectui64v(names_[1], GL_QUERY_RESULT, &to_ns);  // waits
  handles_->check_errors("timing");
  return 1e-6 * static_cast<double>(to_ns - from_ns);
}

}  // namespace seldinger::gpu
