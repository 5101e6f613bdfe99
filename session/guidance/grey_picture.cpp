#include "session/guidance/grey_picture.h"

#include <algorithm>
#include <cstddef>

namespace seldinger::session {

void cut_black_edges(std::vector<GreyPicture>& pictures) {
  const auto sized =
      std::find_if(pictures.begin(), pictures.end(), [](const GreyPicture& p) { return p.width_px > 0; });
  if (sized == pictures.end()) return;
  const int width = sized->width_px, height = sized->height_px;
  const auto alike = [&](const GreyPicture& p) { return p.width_px == width && p.height_px == height; };
  int left = width, right = -1, top = height, bottom = -1;
  for (const GreyPicture& picture : pictures) {
    if (!alike(picture)) continue;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        if (picture.grey[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x)] != 0) {
          left = std::min(left, x);
          right = std::max(right, x);
          top = std::min(top, y);
          bottom = std::max(bottom, y);
        }
  }
  if (right < left) return;
  for (GreyPicture& picture : pictures) {
    if (!alike(picture)) continue;
    GreyPicture cut{{}, right - left + 1, bottom - top + 1};
    for (int y = top; y <= bottom; ++y) {
      const auto row = picture.grey.begin() + static_cast<std::ptrdiff_t>(y) * width;
      cut.grey.insert(cut.grey.end(), row + left, row + right + 1);
    }
    picture = std::move(cut);
  }
}

}  // namespace seldinger::session
