// How many bytes a file really holds, packed or not: none of its own counts is believed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace seldinger::casedb {

enum class ByteState { complete, too_few, damaged };

// The bytes of a file from `offset`, at most `limit`; nothing when it cannot be read.
std::optional<std::vector<std::byte>> read_bytes(const std::filesystem::path& file, std::uint64_t offset,
                                                 std::uint64_t limit);

std::uint64_t file_size_bytes(const std::filesystem::path& file);  // 0 when there is none

enum class Packing { none, gzip_or_zlib, deflate };

// Where packed bytes lie in a file and how many of them may be read and made.
struct PackedBytes {
  std::filesystem::path file;
  std::uint64_t offset = 0;
  std::uint64_t packed_limit = UINT64_MAX;
  std::uint64_t unpacked_limit =
      UINT64_MAX;  // unpacking.h; more is `damaged`: a small file must not unpack without end
  Packing packing = Packing::gzip_or_zlib;
};

struct Unpacked {
  ByteState state = ByteState::damaged;  // complete: the stream ended, and its check sum is right
  std::uint64_t size = 0;
};

// Unpacks to the end; the bytes go to `take`, piece by piece, where it is given.
using TakeBytes = std::function<void(std::span<const std::byte>)>;
Unpacked unpack(const PackedBytes& source, const TakeBytes& take = {});

// The first `count` unpacked bytes of a gzip file, fewer when it ends before.
std::vector<std::byte> unpack_start(const std::filesystem::path& file, std::size_t count);

}  // namespace seldinger::casedb
