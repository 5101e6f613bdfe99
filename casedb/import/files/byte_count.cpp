#include "casedb/import/files/byte_count.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>

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

std::uint64_t file_size_bytes(const std::filesystem::path& file) noexcept {
  std::error_code error;
  const auto size = std::filesystem::file_size(file, error);
  return error ? 0 : size;
}

std::optional<std::vector<std::byte>> read_bytes(const std::filesystem::path& file, std::uint64_t offset,
                                                 std::uint64_t limit) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  const std::uint64_t size = file_size_bytes(file);
  if (offset > size) return std::nullopt;
  std::vector<std::byte> bytes(std::min(size - offset, limit));
  in.seekg(static_cast<std::streamoff>(offset));
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (static_cast<std::size_t>(in.gcount()) != bytes.size()) return std::nullopt;
  return bytes;
}

Unpacked unpack(const PackedBytes& source, std::vector<std::byte>* keep) {
  Unpacked result;
  std::ifstream in(source.file, std::ios::binary);
  Inflater inflater(source.packing);
  if (!in || !inflater.ready()) return result;
  in.seekg(static_cast<std::streamoff>(source.offset));
  std::array<char, kChunk> packed;
  std::array<std::byte, kChunk> unpacked;
  z_stream& stream = inflater.stream();
  std::uint64_t left = source.packed_limit;
  bool ended = false;
  for (;;) {
    if (stream.avail_in == 0) {
      in.read(packed.data(), static_cast<std::streamsize>(std::min<std::uint64_t>(packed.size(), left)));
      stream.next_in = reinterpret_cast<Bytef*>(packed.data());
      stream.avail_in = static_cast<uInt>(in.gcount());
      left -= static_cast<std::uint64_t>(in.gcount());
      if (stream.avail_in == 0) {
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
    if (keep) keep->insert(keep->end(), unpacked.begin(), unpacked.begin() + static_cast<std::ptrdiff_t>(made));
    ended = code == Z_STREAM_END;
  }
}

std::vector<std::byte> unpack_start(const std::filesystem::path& file, std::size_t count) {
  std::vector<std::byte> bytes(count);
  std::ifstream in(file, std::ios::binary);
  Inflater inflater(Packing::gzip_or_zlib);
  if (!in || !inflater.ready()) return {};
  z_stream& stream = inflater.stream();
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(count);
  std::array<char, 4096> packed;
  for (int code = Z_OK; code == Z_OK && stream.avail_out > 0;) {
    in.read(packed.data(), packed.size());
    stream.next_in = reinterpret_cast<Bytef*>(packed.data());
    stream.avail_in = static_cast<uInt>(in.gcount());
    code = stream.avail_in == 0 ? Z_STREAM_END : inflate(&stream, Z_NO_FLUSH);
  }
  bytes.resize(count - stream.avail_out);
  return bytes;
}

}  // namespace seldinger::casedb
