// Where the program keeps, for this user of the computer, what is neither library nor setting.
#pragma once

#include <filesystem>

namespace seldinger::app {

// $XDG_STATE_HOME/seldinger, else ~/.local/state/seldinger. It need not be there.
std::filesystem::path state_folder();

}  // namespace seldinger::app
