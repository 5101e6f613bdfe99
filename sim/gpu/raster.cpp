#include "sim/gpu/raster.h"

#include <GL/glew.h>

#include <algorithm>

#include "sim/base/check.h"
#include "sim/base/failure.h"
#include "sim/gpu/handles.h"
#include "sim/gpu/shader_link.h"

namespace seldinger::gpu {
namespace {

constexpr GLenum kSwitches[] = {GL_DEPTH_TEST,          GL_CULL_FACE,      GL_BLEND,      GL_SCISSOR_TEST,
                                GL_POLYGON_OFFSET_FILL, GL_CLIP_DISTANCE0, GL_DEPTH_CLAMP};

void turn(GLenum what, bool on) {
  if (on)
    glEnable(what);
  else
    glDisable(what);
}

void check_complete() {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
    throw base::Failure("gl", "OpenGL cannot draw into a picture of this size");
}

// An RGBA8 texture of one level.
GLuint colour_texture(int width_px, int height_px) {
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA8, width_px, height_px);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindTexture(GL_TEXTURE_2D, 0);
  return name;
}

}  // namespace

RasterProgram::RasterProgram(Context& context, std::string_view vertex_text, std::string_view fragment_text)
    : handles_(context.handles()) {
  handles_->make_current();
  const ShaderStage stages[] = {{GL_VERTEX_SHADER, "vertex", vertex_text},
                                {GL_FRAGMENT_SHADER, "fragment", fragment_text}};
  name_ = link_shaders(stages);
}

RasterProgram::~RasterProgram() {
  if (handles_->try_make_current()) glDeleteProgram(name_);
}

void RasterProgram::use() const {
  glUseProgram(name_);
}

Picture::Picture(Context& context) : handles_(context.handles()) {}

Picture::~Picture() {
  if (handles_->try_make_current()) free();
}

void Picture::free() noexcept {
  for (GLuint* frame : {&frame_, &resolved_frame_}) {
    if (*frame != 0) glDeleteFramebuffers(1, frame);
    *frame = 0;
  }
  if (samples_ > 1)
    glDeleteRenderbuffers(1, &colour_);
  else if (colour_ != 0)
    glDeleteTextures(1, &colour_);
  if (resolved_ != 0) glDeleteTextures(1, &resolved_);
  if (depth_ != 0) glDeleteRenderbuffers(1, &depth_);
  colour_ = resolved_ = depth_ = 0;
  width_px_ = height_px_ = samples_ = 0;
}

void Picture::resize(int width_px, int height_px, int samples) {
  CHECK(width_px > 0 && height_px > 0 && samples >= 1);
  handles_->make_current();
  GLint most = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most);
  samples = std::max(1, std::min(samples, static_cast<int>(most)));
  if (width_px == width_px_ && height_px == height_px_ && samples == samples_) return;
  free();
  width_px_ = width_px;
  height_px_ = height_px;
  samples_ = samples;
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  try {
    glGenFramebuffers(1, &frame_);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    if (samples > 1) {
      glGenRenderbuffers(1, &colour_);
      glBindRenderbuffer(GL_RENDERBUFFER, colour_);
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_RGBA8, width_px, height_px);
      glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, colour_);
    } else {
      colour_ = colour_texture(width_px, height_px);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_, 0);
    }
    glGenRenderbuffers(1, &depth_);
    glBindRenderbuffer(GL_RENDERBUFFER, depth_);
    if (samples > 1)
      glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, GL_DEPTH_COMPONENT32F, width_px, height_px);
    else
      glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT32F, width_px, height_px);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth_);
    handles_->check_errors("making a picture");
    check_complete();
    if (samples > 1) {
      glGenFramebuffers(1, &resolved_frame_);
      glBindFramebuffer(GL_FRAMEBUFFER, resolved_frame_);
      resolved_ = colour_texture(width_px, height_px);
      glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, resolved_, 0);
      handles_->check_errors("making a picture");
      check_complete();
    }
  } catch (...) {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(before));
    free();
    throw;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(before));
}

void Picture::begin(glm::vec4 ground) const {
  CHECK(frame_ != 0);
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, width_px_, height_px_);
  glDepthMask(GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(ground.r, ground.g, ground.b, ground.a);
  glClearDepth(1.0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void Picture::finish() const {
  if (samples_ <= 1) return;
  glBindFramebuffer(GL_READ_FRAMEBUFFER, frame_);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, resolved_frame_);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, width_px_, height_px_, 0, 0, width_px_, height_px_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

unsigned int Picture::texture() const noexcept {
  return samples_ > 1 ? resolved_ : colour_;
}

void Picture::read(std::span<std::uint8_t> rgba) const {
  const std::size_t row = static_cast<std::size_t>(width_px_) * 4;
  CHECK(rgba.size() == row * static_cast<std::size_t>(height_px_));
  handles_->make_current();
  GLint before = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &before);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, samples_ > 1 ? resolved_frame_ : frame_);
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, width_px_, height_px_, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(before));
  handles_->check_errors("reading a picture");
  for (int low = 0, high = height_px_ - 1; low < high; ++low, --high) {
    const auto from = rgba.begin() + static_cast<std::ptrdiff_t>(row) * low;
    std::swap_ranges(from, from + static_cast<std::ptrdiff_t>(row),
                     rgba.begin() + static_cast<std::ptrdiff_t>(row) * high);
  }
}

DepthMap::DepthMap(Context& context, int side_px) : handles_(context.handles()), side_px_(side_px) {
  CHECK(side_px > 0);
  handles_->make_current();
  GLint before = 0;
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &before);
  try {
    glGenTextures(1, &depth_);
    glBindTexture(GL_TEXTURE_2D, depth_);
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_DEPTH_COMPONENT32F, side_px, side_px);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
    const float lit[] = {1.0F, 1.0F, 1.0F, 1.0F};
    glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, lit);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    glGenFramebuffers(1, &frame_);
    glBindFramebuffer(GL_FRAMEBUFFER, frame_);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_, 0);
    glDrawBuffer(GL_NONE);
    glReadBuffer(GL_NONE);
    handles_->check_errors("making a depth map");
    check_complete();
  } catch (...) {
    glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(before));
    glDeleteFramebuffers(1, &frame_);
    glDeleteTextures(1, &depth_);
    throw;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(before));
}

DepthMap::~DepthMap() {
  if (!handles_->try_make_current()) return;
  glDeleteFramebuffers(1, &frame_);
  glDeleteTextures(1, &depth_);
}

void DepthMap::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, frame_);
  glViewport(0, 0, side_px_, side_px_);
  glDepthMask(GL_TRUE);
  glDisable(GL_SCISSOR_TEST);
  glClearDepth(1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
}

void DepthMap::bind(int unit) const {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_2D, depth_);
}

Raster::Raster(Context& context) : handles_(context.handles()) {
  handles_->make_current();
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &frame_);
  glGetIntegerv(GL_CURRENT_PROGRAM, &program_);
  glGetIntegerv(GL_VERTEX_ARRAY_BINDING, &array_);
  glGetIntegerv(GL_VIEWPORT, viewport_);
  glGetIntegerv(GL_ACTIVE_TEXTURE, &active_unit_);
  for (std::size_t i = 0; i < enabled_.size(); ++i) enabled_[i] = glIsEnabled(kSwitches[i]) == GL_TRUE;
  for (const GLenum one : kSwitches) glDisable(one);
  glEnable(GL_DEPTH_TEST);
  glEnable(GL_CULL_FACE);
  glCullFace(GL_BACK);
  glFrontFace(GL_CCW);
  glDepthFunc(GL_LESS);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glBlendEquation(GL_FUNC_ADD);
  // Alpha stays 1 where the ground is opaque.
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
}

Raster::~Raster() {
  if (!handles_->try_make_current()) return;
  for (std::size_t i = 0; i < enabled_.size(); ++i) turn(kSwitches[i], enabled_[i]);
  glDepthMask(GL_TRUE);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(frame_));
  glUseProgram(static_cast<GLuint>(program_));
  glBindVertexArray(static_cast<GLuint>(array_));
  glViewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
  glActiveTexture(static_cast<GLenum>(active_unit_));
}

void Raster::part(int left_px, int bottom_px, int width_px, int height_px) {
  glViewport(left_px, bottom_px, width_px, height_px);
  glEnable(GL_SCISSOR_TEST);
  glScissor(left_px, bottom_px, width_px, height_px);
}

void Raster::blend(bool on) {
  turn(GL_BLEND, on);
  glDepthMask(on ? GL_FALSE : GL_TRUE);
}

void Raster::depth_test(bool on) {
  turn(GL_DEPTH_TEST, on);
}

void Raster::both_sides(bool on) {
  turn(GL_CULL_FACE, !on);
}

void Raster::depth_offset(float by_slope, float constant) {
  turn(GL_POLYGON_OFFSET_FILL, by_slope != 0.0F || constant != 0.0F);
  glPolygonOffset(by_slope, constant);
}

void Raster::clip(bool on) {
  turn(GL_CLIP_DISTANCE0, on);
}

void Raster::clamp_depth(bool on) {
  turn(GL_DEPTH_CLAMP, on);
}

void Raster::finish() const {
  glFinish();
}

void Raster::check(const char* doing) const {
  handles_->check_errors(doing);
}

}  // namespace seldinger::gpu
