// Whole files in and out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "app/cli/arguments.h"
#include "sim/base/result.h"

namespace seldinger::app {

// Refused: `not_found`, `not_readable`, `too_large`.
base::Result<std::string> read_text(const std::filesystem::path& path, std::size_t max_bytes = 256U << 20U);

// The file that was typed as an option's value, or as the word of that name in the synopsis ("SCENE.json").
base::Result<std::string> read_text_of(const Arguments& arguments, const std::string& what,
                                       std::size_t max_bytes = 256U << 20U);

// Whole or not at all. Throws base::Failure("disk").
void write_file(const std::filesystem::path& path, const std::string& text);
void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes);

}  // namespace seldinger::app
