#include "sim/base/codec.h"

#include <zstd.h>

#include <memory>

namespace seldinger::base {
namespace {

// Whether the frame really holds that many bytes, found out without keeping them.
bool holds(std::span<const std::byte> frame, std::uint64_t size) {
  const std::unique_ptr<ZSTD_DCtx, decltype(&ZSTD_freeDCtx)> context(ZSTD_createDCtx(), &ZSTD_freeDCtx);
  CHECK(context != nullptr);
  // Level 3 looks back 2 MB at most (zstd's clevels.h); more than 8 MB was not written by us.
  ZSTD_DCtx_setParameter(context.get(), ZSTD_d_windowLogMax, 23);
  std::vector<std::byte> piece(ZSTD_DStreamOutSize());
  ZSTD_inBuffer in{frame.data(), frame.size(), 0};
  for (std::uint64_t done = 0;;) {
    ZSTD_outBuffer out{piece.data(), piece.size(), 0};
    const std::size_t left = ZSTD_decompressStream(context.get(), &out, &in);
    done += out.pos;
    if (ZSTD_isError(left) != 0 || done > size) return false;
    if (left == 0) return done == size && in.pos == in.size;
    if (out.pos < out.size && in.pos == in.size) return false;  // wants more than there is
  }
}

}  // namespace

std::vector<std::byte> compress(std::span<const std::byte> bytes) {
  const std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context(ZSTD_createCCtx(), &ZSTD_freeCCtx);
  CHECK(context != nullptr);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_compressionLevel, 3);
  ZSTD_CCtx_setParameter(context.get(), ZSTD_c_checksumFlag, 1);
  std::vector<std::byte> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress2(context.get(), out.data(), out.size(), bytes.data(), bytes.size());
  CHECK(ZSTD_isError(size) == 0);
  out.resize(size);
  return out;
}

Result<std::vector<std::byte>> decompress(std::span<const std::byte> bytes, std::size_t max_bytes) {
  const Error damaged{"damaged", "compressed bytes are damaged"};
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN || size > max_bytes) return damaged;
  // ZSTD_decompress also takes several frames in a row: an empty or skippable one behind would pass.
  if (ZSTD_findFrameCompressedSize(bytes.data(), bytes.size()) != bytes.size()) return damaged;
  if (size > kTakenAtItsWord && !holds(bytes, size)) return damaged;
  std::vector<std::byte> out(static_cast<std::size_t>(size));
  const std::size_t got = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(got) != 0 || got != out.size()) return damaged;
  return out;
}

std::optional<std::uint64_t> claimed_size(std::span<const std::byte> bytes) {
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_ERROR || size == ZSTD_CONTENTSIZE_UNKNOWN) return std::nullopt;
  return size;
}

}  // namespace seldinger::base
