#include "casedb/import/files/byte_count.h"

#include <zlib.h>

#include <algorithm>
#include <array>

#include "casedb/import/jail/input.h"

namespace seldinger::casedb {
namespace {

constexpr std::size_t kChunk = 1 << 16;

int window_bits(Packing packing) {
  return packing == Packing::deflate ? -MAX_WBITS : MAX_WBITS + 32;  // zlib.h: +32 finds gzip or zlib by itself
}

class Inflater {
 public:
  explicit Inflater(Packing packing) { ready_ = inflateInit2(&stream_, window_bits(packing)) == Z_OK; }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;
  ~Inflater() {
    if (ready_) inflateEnd(&stream_);
  }
  bool ready() const noexcept { return ready_; }
  z_stream& stream() noexcept { return stream_; }

 private:
  z_stream stream_{};
  bool ready_ = false;
};

}  // namespace

std::uint64_t file_size_bytes(const std::filesystem::path& file) {
  return InputFile(file).size();
}

std::optional<std::vector<std::byte>> read_bytes(const std::filesystem::path& file, std::uint64_t offset,
                                                 std::uint64_t limit) {
  const InputFile in(file);
  if (!in || offset > in.size()) return std::nullopt;
  std::vector<std::byte> bytes(std::min(in.size() - offset, limit));
  if (in.read(offset, bytes) != bytes.size()) return std::nullopt;
  return bytes;
}

Unpacked unpack(const PackedBytes& source, const TakeBytes& take) {
  Unpacked result;
  const InputFile in(source.file);
  Inflater inflater(source.packing);
  if (!in || !inflater.ready()) return result;
  std::array<std::byte, kChunk> packed, unpacked;
  z_stream& stream = inflater.stream();
  std::uint64_t at = source.offset, left = source.packed_limit;
  bool ended = false;
  for (;;) {
    if (stream.avail_in == 0) {
      const std::size_t got =
          in.read(at, std::span(packed).first(static_cast<std::size_t>(std::min<std::uint64_t>(kChunk, left))));
      stream.next_in = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_in = static_cast<uInt>(got);
      at += got;
      left -= got;
      if (got == 0) {
        result.state = ended ? ByteState::complete : ByteState::too_few;
        return result;
      }
    }
    if (ended) {  // a gzip file may be several members one after the other; anything else behind the end is padding
      if (source.packing != Packing::gzip_or_zlib || *stream.next_in != 0x1F) {
        result.state = ByteState::complete;
        return result;
      }
      if (inflateReset(&stream) != Z_OK) return result;
      ended = false;
    }
    stream.next_out = reinterpret_cast<Bytef*>(unpacked.data());
    stream.avail_out = static_cast<uInt>(unpacked.size());
    const int code = inflate(&stream, Z_NO_FLUSH);
    const std::size_t made = unpacked.size() - stream.avail_out;
    if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR) return result;  // damaged
    result.size += made;
    if (result.size > source.unpacked_limit) return result;
    if (take) take(std::span(unpacked).first(made));
    ended = code == Z_STREAM_END;
  }
}

std::vector<std::byte> unpack_start(const std::filesystem::path& file, std::size_t count) {
  std::vector<std::byte> bytes(count);
  const InputFile in(file);
  Inflater inflater(Packing::gzip_or_zlib);
  if (!in || !inflater.ready()) return {};
  z_stream& stream = inflater.stream();
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(count);
  std::array<std::byte, 4096> packed;
  std::uint64_t at = 0;
  for (int code = Z_OK; code == Z_OK && stream.avail_out > 0;) {
    const std::size_t got = in.read(at, packed);
    at += got;
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(got);
    code = got == 0 ? Z_STREAM_END : inflate(&stream, Z_NO_FLUSH);
  }
  bytes.resize(count - stream.avail_out);
  return bytes;
}

}  // namespace seldinger::casedb
