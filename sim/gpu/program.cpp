#include "sim/gpu/program.h"

#include <GL/glew.h>

#include <string>

#include "sim/base/check.h"
#include "sim/base/failure.h"
#include "sim/gpu/handles.h"

namespace seldinger::gpu {
namespace {

// The log of a shader or program, without the closing zero.
template <typename GetParameter, typename GetLog>
std::string log_of(GLuint name, GetParameter get_parameter, GetLog get_log) {
  GLint length = 0;
  get_parameter(name, GL_INFO_LOG_LENGTH, &length);
  if (length <= 1) return "no log";
  std::string log(static_cast<std::size_t>(length), '\0');
  GLsizei written = 0;
  get_log(name, length, &written, log.data());
  log.resize(static_cast<std::size_t>(written));
  return log;
}

}  // namespace

Program::Program(Context& context, std::string_view compute_text) : handles_(context.handles()) {
  handles_->make_current();
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const GLchar* text = compute_text.data();
  const GLint length = static_cast<GLint>(compute_text.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done != GL_TRUE) {
    const std::string log = log_of(shader, glGetShaderiv, glGetShaderInfoLog);
    glDeleteShader(shader);
    throw base::Failure("gl", "compute shader: " + log);
  }
  name_ = glCreateProgram();
  glAttachShader(name_, shader);
  glLinkProgram(name_);
  glDeleteShader(shader);  // lives on while attached
  glGetProgramiv(name_, GL_LINK_STATUS, &done);
  if (done != GL_TRUE) {
    const std::string log = log_of(name_, glGetProgramiv, glGetProgramInfoLog);
    glDeleteProgram(name_);
    throw base::Failure("gl", "compute program: " + log);
  }
}

Program::~Program() {
  if (handles_->try_make_current()) glDeleteProgram(name_);
}

void Program::dispatch(int groups_x, int groups_y, int groups_z) {
  CHECK(groups_x > 0 && groups_y > 0 && groups_z > 0);
  handles_->make_current();
  glUseProgram(name_);
  glDispatchCompute(static_cast<GLuint>(groups_x), static_cast<GLuint>(groups_y), static_cast<GLuint>(groups_z));
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
  handles_->check_errors("running a compute program");
}

}  // namespace seldinger::gpu
