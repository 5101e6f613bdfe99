// A small picture in colour to draw on: rectangles, lines, grey pictures, text of one fixed font.
#pragma once

#include <glm/vec2.hpp>
#include <string_view>
#include <vector>

#include "session/guidance/grey_picture.h"

namespace seldinger::app {

struct Colour {
  unsigned char red = 0, green = 0, blue = 0;
};

struct Rectangle {
  int left = 0, top = 0, width = 0, height = 0;
};

class Canvas {
 public:
  Canvas(int width_px, int height_px, Colour ground);
  int width_px() const noexcept { return width_px_; }
  int height_px() const noexcept { return height_px_; }
  const std::vector<unsigned char>& rgb() const noexcept { return rgb_; }  // row-major, three bytes a pixel

  // All of these are cut at the canvas' edges.
  void fill(const Rectangle& area, Colour colour);
  void line(glm::dvec2 from, glm::dvec2 to, double width_px, Colour colour);  // smoothed
  void circle(glm::dvec2 center, double radius_px, double width_px, Colour colour);
  // Bilinear, as large as fits, in the middle. Where it came to lie.
  Rectangle picture(const Rectangle& area, const session::GreyPicture& picture);
  // 5 × 7 dots a letter, each `scale` pixels wide; ASCII, any other letter is a box. Its width.
  int text(int left, int top, int scale, std::string_view words, Colour colour);
  static int text_width(int scale, std::string_view words) noexcept;

 private:
  void blend(int x, int y, double share, Colour colour);
  int width_px_, height_px_;
  std::vector<unsigned char> rgb_;
};

}  // namespace seldinger::app
