#include "app/window/hands/console_picture.h"

#include <algorithm>
#include <cmath>

#include "sim/base/check.h"

namespace seldinger::app {
namespace {

constexpr int kLeastWidthPx = 640, kRulerPx = 64, kMarginPx = 12, kLinePx = 20, kTextScale = 2;
constexpr Colour kGround{0, 0, 0}, kInk{200, 220, 230}, kMeasured{255, 220, 90};

}  // namespace

glm::dvec2 mm_of(const session::ShownPicture& shown, bool flip, const glm::dvec2& pixel) {
  CHECK(shown.pixel_mm > 0.0);
  const double x_mm = (pixel.x - 0.5 * (shown.picture.width_px - 1)) * shown.pixel_mm;
  return {flip ? -x_mm : x_mm, shown.top_mm + (pixel.y + 0.5) * shown.pixel_mm};
}

glm::dvec2 pixel_of(const session::ShownPicture& shown, bool flip, const glm::dvec2& at_mm) {
  CHECK(shown.pixel_mm > 0.0);
  const double x_px = (flip ? -at_mm.x : at_mm.x) / shown.pixel_mm;
  return {x_px + 0.5 * (shown.picture.width_px - 1), (at_mm.y - shown.top_mm) / shown.pixel_mm - 0.5};
}

std::vector<double> depth_marks_mm(const session::ShownPicture& shown) {
  std::vector<double> marks;
  if (shown.pixel_mm <= 0.0) return marks;
  for (double mm = 0.0; mm <= shown.console.depth_mm + 1e-6; mm += 10.0) marks.push_back(mm);
  return marks;
}

int numbered_every(double px_per_cm) {
  constexpr double kApartPx = 18.0;
  for (const int every : {1, 2})
    if (every * px_per_cm >= kApartPx) return every;
  return 5;
}

Canvas console_picture(const session::ShownPicture& shown, bool flip, const Calipers& calipers,
                       const std::vector<std::string>& words) {
  CHECK(shown.picture.width_px > 0);
  const bool scaled = shown.pixel_mm > 0.0;
  std::vector<std::string> lines = scaled ? calipers.words() : std::vector<std::string>{};
  lines.insert(lines.begin(), words.begin(), words.end());
  const double zoom = std::max(1.0, static_cast<double>(kLeastWidthPx) / shown.picture.width_px);
  const int width = static_cast<int>(zoom * shown.picture.width_px),
            height = static_cast<int>(zoom * shown.picture.height_px);
  Canvas canvas(width + (scaled ? kRulerPx : 0) + 2 * kMarginPx,
                height + 2 * kMarginPx + kLinePx * static_cast<int>(lines.size()) + kMarginPx, kGround);
  const Rectangle at = canvas.picture({kMarginPx, kMarginPx, width, height}, shown.picture);
  const auto place = [&](const glm::dvec2& at_mm) {
    return glm::dvec2(at.left, at.top) + zoom * (pixel_of(shown, flip, at_mm) + 0.5);
  };
  if (scaled) {
    const int right = at.left + at.width, every = numbered_every(10.0 * zoom / shown.pixel_mm);
    for (const double mm : depth_marks_mm(shown)) {
      const double y = place({0.0, mm}).y;
      const bool is_long = std::lround(mm) % (10 * every) == 0;
      canvas.line({right + 4.0, y}, {right + (is_long ? 16.0 : 10.0), y}, 1.5, kInk);
      if (is_long && mm > 0.0)
        canvas.text(right + 20, static_cast<int>(y) - 7, kTextScale, std::to_string(std::lround(0.1 * mm)), kInk);
    }
    if (shown.console.focus_mm > 0.0) {
      const double y = place({0.0, shown.console.focus_mm}).y;
      for (const double side : {-6.0, 6.0}) canvas.line({right + 1.0, y}, {right + 9.0, y + side}, 2.0, kMeasured);
    }
    const std::vector<glm::dvec2>& ends = calipers.ends_mm();
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const glm::dvec2 end = place(ends[i]);
      canvas.line({end.x - 6.0, end.y}, {end.x + 6.0, end.y}, 1.5, kMeasured);
      canvas.line({end.x, end.y - 6.0}, {end.x, end.y + 6.0}, 1.5, kMeasured);
      if (i % 2 == 0) continue;
      canvas.line(place(ends[i - 1]), end, 1.0, kMeasured);
      const char name = static_cast<char>('A' + i / 2);
      canvas.text(static_cast<int>(end.x) + 9, static_cast<int>(end.y) - 18, kTextScale, {&name, 1}, kMeasured);
    }
  }
  int top = at.top + at.height + kMarginPx;
  for (const std::string& line : lines) {
    canvas.text(kMarginPx, top, kTextScale, line, kInk);
    top += kLinePx;
  }
  return canvas;
}

}  // namespace seldinger::app
