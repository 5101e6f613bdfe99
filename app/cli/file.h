// Whole files in and out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "sim/base/result.h"

namespace seldinger::app {

// Refused: `not_found`, `not_readable`, `too_large`.
base::Result<std::string> read_text(const std::filesystem::path& path, std::size_t max_bytes = 256U << 20U);

// Whole or not at all. Throws base::Failure("disk").
void write_file(const std::filesystem::path& path, const std::string& text);

}  // namespace seldinger::app
