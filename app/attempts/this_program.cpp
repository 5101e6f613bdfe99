#include "app/attempts/this_program.h"

#include "app/cli/version.h"
#include "app/replay/png.h"

namespace seldinger::app {
namespace {

std::vector<std::byte> png_of(const session::GreyPicture& picture) {
  if (picture.grey.empty()) return {};
  return png_from_grey(picture.grey, picture.width_px, picture.height_px);
}

}  // namespace

session::Program this_program() {
  return {kVersion, &png_of};
}

}  // namespace seldinger::app
