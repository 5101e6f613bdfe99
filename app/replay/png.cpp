#include "app/replay/png.h"

#include <png.h>

#include "sim/base/check.h"

namespace seldinger::app {

namespace {

std::vector<std::byte> png_of(std::span<const unsigned char> pixels, int width_px, int height_px, bool colour) {
  CHECK(width_px > 0 && height_px > 0);
  CHECK(pixels.size() == static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) *
                             (colour ? std::size_t{3} : std::size_t{1}));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = colour ? PNG_FORMAT_RGB : PNG_FORMAT_GRAY;
  if (colour) image.flags = PNG_IMAGE_FLAG_FAST;  // a replay has hundreds
  png_alloc_size_t size = 0;
  CHECK(png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr) != 0);
  std::vector<std::byte> bytes(size);
  CHECK(png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr) != 0);
  bytes.resize(size);
  return bytes;
}

}  // namespace

std::vector<std::byte> png_from_grey(std::span<const unsigned char> grey, int width_px, int height_px) {
  return png_of(grey, width_px, height_px, false);
}

std::vector<std::byte> png_from_rgb(std::span<const unsigned char> rgb, int width_px, int height_px) {
  return png_of(rgb, width_px, height_px, true);
}

}  // namespace seldinger::app
