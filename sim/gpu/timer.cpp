#include "sim/gpu/timer.h"

#include <GL/glew.h>

#include "sim/gpu/handles.h"

namespace seldinger::gpu {

Timer::Timer(Context& context) : handles_(context.handles()) {
  handles_->make_current();
  glGenQueries(1, &name_);
}

Timer::~Timer() {
  if (handles_->try_make_current()) glDeleteQueries(1, &name_);
}

void Timer::start() {
  handles_->make_current();
  glFinish();
  glBeginQuery(GL_TIME_ELAPSED, name_);
}

double Timer::stop_ms() {
  handles_->make_current();
  glEndQuery(GL_TIME_ELAPSED);
  GLuint64 ns = 0;
  glGetQueryObjectui64v(name_, GL_QUERY_RESULT, &ns);  // waits
  handles_->check_errors("timing");
  return 1e-6 * static_cast<double>(ns);
}

}  // namespace seldinger::gpu
