#include "app/cli/state_folder.h"

#include <cstdlib>

namespace seldinger::app {

std::filesystem::path state_folder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  if (state != nullptr && *state == '/') return std::filesystem::path(state) / "seldinger";
  const char* home = std::getenv("HOME");
  return std::filesystem::path(home != nullptr && *home != '\0' ? home : "/") / ".local/state/seldinger";
}

}  // namespace seldinger::app
