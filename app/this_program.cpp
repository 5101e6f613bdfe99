#include "app/this_program.h"

#include "app/png.h"
#include "app/version.h"

namespace seldinger::app {
namespace {

std::vector<std::byte> png_of(const GreyPicture& picture) {
  if (picture.grey.empty()) return {};
  return png_from_grey(picture.grey, picture.width_px, picture.height_px);
}

}  // namespace

Program this_program() {
  return {kVersion, &png_of};
}

}  // namespace seldinger::app
