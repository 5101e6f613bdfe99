#include "app/replay/png.h"

#include <png.h>

#include "sim/base/check.h"

namespace seldinger::app {

namespace {

// `palette`: of the pixels, which are its numbers; empty: they are greys or colours.
std::vector<std::byte> encoded(std::span<const unsigned char> pixels, int width_px, int height_px,
                               png_uint_32 format, std::span<const unsigned char> palette = {}) {
  CHECK(width_px > 0 && height_px > 0);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = format;
  image.colormap_entries = static_cast<png_uint_32>(palette.size());
  CHECK(pixels.size() == PNG_IMAGE_SIZE(image));
  if (format == PNG_FORMAT_RGB) image.flags = PNG_IMAGE_FLAG_FAST;  // a replay has hundreds
  const void* colours = palette.empty() ? nullptr : palette.data();
  png_alloc_size_t size = 0;
  CHECK(png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, colours) != 0);
  std::vector<std::byte> bytes(size);
  CHECK(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, colours) != 0);
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::vector<std::byte> png_from_grey(std::span<const unsigned char> grey, int width_px, int height_px) {
  return encoded(grey, width_px, height_px, PNG_FORMAT_GRAY);
}

std::vector<std::byte> png_in_greys(std::span<const unsigned char> grey, int width_px, int height_px, int greys) {
  CHECK(greys >= 2 && greys <= 256);
  std::vector<unsigned char> palette, numbers;
  for (int i = 0; i < greys; ++i)
    palette.push_back(static_cast<unsigned char>((255 * i + (greys - 1) / 2) / (greys - 1)));
  for (const unsigned char one : grey)
    numbers.push_back(static_cast<unsigned char>((one * (greys - 1) + 127) / 255));
  return encoded(numbers, width_px, height_px, PNG_FORMAT_GRAY | PNG_FORMAT_FLAG_COLORMAP, palette);
}

std::vector<std::byte> png_from_rgb(std::span<const unsigned char> rgb, int width_px, int height_px) {
  return encoded(rgb, width_px, height_px, PNG_FORMAT_RGB);
}

std::vector<std::byte> png_of(const session::GreyPicture& picture) {
  if (picture.width_px == 0) return {};
  if (picture.colour.empty()) return png_from_grey(picture.grey, picture.width_px, picture.height_px);
  return png_from_rgb(session::rgb_of(picture), picture.width_px, picture.height_px);
}

}  // namespace seldinger::app
