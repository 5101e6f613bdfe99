#include "app/png.h"

#include <png.h>

#include "sim/base/check.h"

namespace seldinger::app {

std::vector<std::byte> png_from_grey(std::span<const unsigned char> grey, int width_px, int height_px) {
  CHECK(width_px > 0 && height_px > 0);
  CHECK(grey.size() == static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px));
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width_px);
  image.height = static_cast<png_uint_32>(height_px);
  image.format = PNG_FORMAT_GRAY;
  png_alloc_size_t size = 0;
  CHECK(png_image_write_to_memory(&image, nullptr, &size, 0, grey.data(), 0, nullptr) != 0);
  std::vector<std::byte> bytes(size);
  CHECK(png_image_write_to_memory(&image, bytes.data(), &size, 0, grey.data(), 0, nullptr) != 0);
  bytes.resize(size);
  return bytes;
}

}  // namespace seldinger::app
