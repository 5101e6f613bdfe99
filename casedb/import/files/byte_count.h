// How many bytes a file really holds. ITK reads truncated .mha and .nii.gz without a word, so counting is ours.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

namespace seldinger::casedb {

enum class ByteState { complete, too_few, damaged };

// The bytes of a file from `offset`, at most `limit`; nothing when it cannot be read.
std::optional<std::vector<std::byte>> read_bytes(const std::filesystem::path& file, std::uint64_t offset,
                                                 std::uint64_t limit);

std::uint64_t file_size_bytes(const std::filesystem::path& file) noexcept;  // 0 when there is none

enum class Packing { none, gzip_or_zlib, deflate };

// Where packed bytes lie in a file and how many of them may be read and made.
struct PackedBytes {
  std::filesystem::path file;
  std::uint64_t offset = 0;
  std::uint64_t packed_limit = UINT64_MAX;
  std::uint64_t unpacked_limit = UINT64_MAX;  // more is `damaged`: a small file must not unpack without end
  Packing packing = Packing::gzip_or_zlib;
};

struct Unpacked {
  ByteState state = ByteState::damaged;  // complete: the stream ended, and its check sum is right
  std::uint64_t size = 0;
};

// Unpacks to the end; the bytes go to `keep` where given (limited by unpacked_limit).
Unpacked unpack(const PackedBytes& source, std::vector<std::byte>* keep = nullptr);

// The first `count` unpacked bytes of a gzip file, fewer when it ends before.
std::vector<std::byte> unpack_start(const std::filesystem::path& file, std::size_t count);

}  // namespace seldinger::casedb
