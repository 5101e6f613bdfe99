#include "app/attempts/this_program.h"

#include "app/cli/version.h"
#include "app/replay/png.h"

namespace seldinger::app {

session::Program this_program() {
  return {kVersion, [](const session::GreyPicture& picture) { return png_of(picture); }};
}

}  // namespace seldinger::app
