// Lossless compression of bytes: the door of zstd (recording chunks, assets).
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::base {

std::vector<std::byte> compress(std::span<const std::byte> bytes);

// Refused (`damaged`) when the bytes are not one whole frame, its checksum fails, or it would exceed `max_bytes`. A
// frame that claims more than kTakenAtItsWord is unpacked piecemeal before room is made for it, so that a lie costs
// no memory.
constexpr std::size_t kTakenAtItsWord = std::size_t{24} << 20;
Result<std::vector<std::byte>> decompress(std::span<const std::byte> bytes, std::size_t max_bytes);

// What a frame says it unpacks to; nothing when it says nothing or is none.
std::optional<std::uint64_t> claimed_size(std::span<const std::byte> bytes);

}  // namespace seldinger::base
