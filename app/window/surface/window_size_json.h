// How large the window was when it was closed, kept for the next time at this computer.
#pragma once

#include <filesystem>
#include <optional>

namespace seldinger::app {

struct WindowSize {
  int width = 0, height = 0;  // with its frame, where it takes the whole screen too
  bool whole_screen = false;
  bool operator==(const WindowSize&) const = default;
};

// In state_folder().
std::filesystem::path window_size_file();

// Nothing where there is no such file, or none of ours: a size is a comfort, and no reason to fail.
std::optional<WindowSize> read_window_size(const std::filesystem::path& file);
// False: it could not be kept.
bool keep_window_size(const std::filesystem::path& file, const WindowSize& size);

}  // namespace seldinger::app
