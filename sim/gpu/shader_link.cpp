#include "sim/gpu/shader_link.h"

#include <GL/glew.h>

#include <string>

#include "sim/base/failure.h"

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

GLuint compiled(const ShaderStage& stage) {
  const GLuint shader = glCreateShader(stage.kind);
  const GLchar* text = stage.text.data();
  const GLint length = static_cast<GLint>(stage.text.size());
  glShaderSource(shader, 1, &text, &length);
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  const std::string log = log_of(shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  throw base::Failure("gl", std::string(stage.name) + " shader: " + log);
}

}  // namespace

unsigned int link_shaders(std::span<const ShaderStage> stages) {
  const GLuint program = glCreateProgram();
  try {
    for (const ShaderStage& stage : stages) {
      const GLuint shader = compiled(stage);
      glAttachShader(program, shader);
      glDeleteShader(shader);  // lives on while attached
    }
    glLinkProgram(program);
    GLint done = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &done);
    if (done != GL_TRUE)
      throw base::Failure("gl", std::string(stages.front().name) +
                                    " program: " + log_of(program, glGetProgramiv, glGetProgramInfoLog));
  } catch (...) {
    glDeleteProgram(program);
    throw;
  }
  return program;
}

}  // namespace seldinger::gpu
