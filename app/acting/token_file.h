// The file in which a person's session of the command line is kept: theirs alone (0600).
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "sim/base/result.h"

namespace seldinger::app {

// In $XDG_STATE_HOME/seldinger, else ~/.local/state/seldinger: one file a library.
std::filesystem::path token_file_of(const std::filesystem::path& library);

// Made or replaced; throws base::Failure("disk").
void write_token(const std::filesystem::path& file, const std::string& token);
// None when there is no file. `bad_token_file`: no file of ours, a link, or others may read it. Whoever called
// wipes it.
base::Result<std::optional<std::string>> read_token(const std::filesystem::path& file);

}  // namespace seldinger::app
