// The header before what the library stores compressed: magic, format, sizes, and last a checksum of all before it.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "sim/base/codec.h"
#include "sim/base/hash.h"
#include "sim/base/result.h"

namespace seldinger::volume {

static_assert(std::endian::native == std::endian::little);  // headers are copied as they lie

inline base::Error damaged(const char* text) {
  return {"damaged", text};
}

template <typename Header>
std::uint64_t checksum_of(const Header& header) {
  return base::hash_bytes(std::as_bytes(std::span(&header, 1)).first(sizeof header - sizeof header.checksum));
}

// Header, its checksum made, and compressed data.
template <typename Header>
std::vector<std::byte> joined(Header header, std::span<const std::byte> raw) {
  header.checksum = checksum_of(header);
  const std::vector<std::byte> packed = base::compress(raw);
  std::vector<std::byte> out(sizeof header + packed.size());
  std::memcpy(out.data(), &header, sizeof header);
  std::memcpy(out.data() + sizeof header, packed.data(), packed.size());
  return out;
}

template <typename Header>
base::Result<Header> header_at(std::span<const std::byte> bytes) {
  Header header;
  const Header expected;
  if (bytes.size() < sizeof header) return damaged("the stored header is cut short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != expected.magic) return damaged("the stored bytes are of another kind");
  if (header.format != expected.format) return damaged("the stored bytes have an unknown format version");
  if (header.checksum != checksum_of(header)) return damaged("the stored header's checksum does not hold");
  return header;
}

}  // namespace seldinger::volume
