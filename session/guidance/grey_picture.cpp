#include "session/guidance/grey_picture.h"

#include <algorithm>
#include <cstddef>

#include "sim/imaging/ultrasound/colour_screen.h"

namespace seldinger::session {

std::vector<unsigned char> rgb_of(const GreyPicture& picture) {
  return imaging::in_colour(picture.grey, picture.colour);
}

std::vector<unsigned char> rgba_of(const GreyPicture& picture) {
  const std::vector<unsigned char> rgb = rgb_of(picture);
  std::vector<unsigned char> rgba(4 * picture.grey.size(), 255);
  for (std::size_t i = 0; i < picture.grey.size(); ++i)
    std::copy_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * i), 3,
                rgba.begin() + static_cast<std::ptrdiff_t>(4 * i));
  return rgba;
}

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
    const auto keep = [&](const std::vector<unsigned char>& from, std::vector<unsigned char>& to) {
      for (int y = top; y <= bottom && !from.empty(); ++y) {
        const auto row = from.begin() + static_cast<std::ptrdiff_t>(y) * width;
        to.insert(to.end(), row + left, row + right + 1);
      }
    };
    keep(picture.grey, cut.grey);
    keep(picture.colour, cut.colour);
    picture = std::move(cut);
  }
}

GreyPicture shrunk_to(const GreyPicture& picture, int most_width_px) {
  const int side = std::max(1, (picture.width_px + most_width_px - 1) / most_width_px);
  GreyPicture small{{}, picture.width_px / side, picture.height_px / side};
  const unsigned pixels = static_cast<unsigned>(side) * static_cast<unsigned>(side);
  for (int y = 0; y < small.height_px; ++y)
    for (int x = 0; x < small.width_px; ++x) {
      unsigned sum = pixels / 2;
      for (int in_y = y * side; in_y < (y + 1) * side; ++in_y)
        for (int in_x = x * side; in_x < (x + 1) * side; ++in_x)
          sum += picture.grey[static_cast<std::size_t>(in_y) * static_cast<std::size_t>(picture.width_px) +
                              static_cast<std::size_t>(in_x)];
      small.grey.push_back(static_cast<unsigned char>(sum / pixels));
    }
  return small;
}

}  // namespace seldinger::session
