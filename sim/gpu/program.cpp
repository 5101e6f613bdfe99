#include "sim/gpu/program.h"

#include <GL/glew.h>

#include "sim/base/check.h"
#include "sim/gpu/handles.h"
#include "sim/gpu/shader_link.h"

namespace seldinger::gpu {

Program::Program(Context& context, std::string_view compute_text) : handles_(context.handles()) {
  handles_->make_current();
  const ShaderStage stage{GL_COMPUTE_SHADER, "compute", compute_text};
  name_ = link_shaders({&stage, 1});
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
