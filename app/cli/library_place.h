// Where a command's library is: one rule for all of them.
#pragma once

#include <filesystem>

#include "app/cli/arguments.h"
#include "sim/base/result.h"

namespace seldinger::app {

inline constexpr const char* kLibraryVariable = "SELDINGER_LIBRARY";

// --library, else what SELDINGER_LIBRARY holds, else the demo's: seldinger/demo under the user's data folder.
// Throws UsageError (an empty --library) and base::Failure("disk") when there is no home folder to look in.
std::filesystem::path library_folder(const Arguments& arguments);

// The same for what may need no library at all: empty where there is no home folder.
std::filesystem::path library_folder_if_any(const Arguments& arguments);

// With how the library was told: "--library "libary": there is no library in that folder".
base::Error error_of_library(const Arguments& arguments, base::Error error);

}  // namespace seldinger::app
