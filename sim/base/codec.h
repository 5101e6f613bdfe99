// Lossless compression of bytes: the door of zstd (recording chunks, assets).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::base {

std::vector<std::byte> compress(std::span<const std::byte> bytes);

// Refused (`damaged`) when the bytes are not one whole frame, its checksum fails, or it would exceed `max_bytes`.
Result<std::vector<std::byte>> decompress(std::span<const std::byte> bytes, std::size_t max_bytes);

}  // namespace seldinger::base
