// Drawing triangles: programs of a vertex and a fragment shader, pictures and depth maps to draw into, and how.
// All of it on the context's thread, between the construction and the end of a Raster.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>
#include <memory>
#include <span>
#include <string_view>

#include "sim/gpu/context.h"

namespace seldinger::gpu {

class RasterProgram {
 public:
  // Throws base::Failure("gl", the compiler's or linker's log).
  RasterProgram(Context& context, std::string_view vertex_text, std::string_view fragment_text);
  ~RasterProgram();
  RasterProgram(const RasterProgram&) = delete;
  RasterProgram& operator=(const RasterProgram&) = delete;
  void use() const;

 private:
  std::shared_ptr<Handles> handles_;
  unsigned int name_ = 0;
};

// An RGBA8 picture with depth. With samples > 1 a pixel is drawn as so many and averaged by finish().
class Picture {
 public:
  explicit Picture(Context& context);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  // Nothing happens when it is so already; `samples` at most what this GL can. Throws base::Failure("gl").
  void resize(int width_px, int height_px, int samples);
  int width_px() const noexcept { return width_px_; }
  int height_px() const noexcept { return height_px_; }
  void begin(glm::vec4 ground) const;     // draw into it from now on, all of it cleared
  void finish() const;                    // what was drawn is in texture()
  unsigned int texture() const noexcept;  // its GL name; the first row is the lowest
  // width · height · 4 bytes, the first row the highest (CHECKed); waits for what was drawn.
  void read(std::span<std::uint8_t> rgba) const;

 private:
  void free() noexcept;
  std::shared_ptr<Handles> handles_;
  int width_px_ = 0, height_px_ = 0, samples_ = 0;
  unsigned int frame_ = 0, colour_ = 0, depth_ = 0;  // what is drawn into
  unsigned int resolved_frame_ = 0, resolved_ = 0;   // with several samples only
};

// Depth alone, square, as a light sees it: sampler2DShadow in shaders, filtered between four texels; beyond its
// border everything is lit.
class DepthMap {
 public:
  DepthMap(Context& context, int side_px);  // throws base::Failure("gl")
  ~DepthMap();
  DepthMap(const DepthMap&) = delete;
  DepthMap& operator=(const DepthMap&) = delete;
  int side_px() const noexcept { return side_px_; }
  void begin() const;  // draw into it from now on, cleared
  void bind(int unit) const;

 private:
  std::shared_ptr<Handles> handles_;
  int side_px_;
  unsigned int frame_ = 0, depth_ = 0;
};

// While it lives, drawing is set up for triangles with depth; then GL is as it was (framebuffer, viewport, what is
// enabled, program), so that a window's own drawing is not disturbed.
class Raster {
 public:
  explicit Raster(Context& context);
  ~Raster();
  Raster(const Raster&) = delete;
  Raster& operator=(const Raster&) = delete;

  void part(int left_px, int bottom_px, int width_px, int height_px);  // draw into this part only
  void blend(bool on);       // over what is there, by alpha; depth is then read, not written
  void depth_test(bool on);  // off: hidden by nothing
  void both_sides(bool on);  // also triangles seen from behind
  void depth_offset(float by_slope, float constant);  // pushes back what is drawn (0, 0: not)
  void clip(bool on);                                 // gl_ClipDistance[0]
  void clamp_depth(bool on);                          // what lies before the near plane is drawn on it
  void finish() const;                                // waits for everything
  void check(const char* doing) const;                // throws base::Failure("gl") on any pending GL error

 private:
  std::shared_ptr<Handles> handles_;
  int frame_ = 0, program_ = 0, array_ = 0, viewport_[4] = {0, 0, 0, 0}, active_unit_ = 0;
  std::array<bool, 7> enabled_{};
};

}  // namespace seldinger::gpu
