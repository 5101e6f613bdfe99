#include "sim/volume/classes.h"

#include <algorithm>
#include <cstring>

#include "sim/base/check.h"
#include "sim/base/codec.h"
#include "sim/base/hash.h"

namespace seldinger::volume {
namespace {

constexpr std::uint32_t kMagic = 0x434c4453;  // "SDLC"
constexpr std::uint32_t kFormat = 1;

struct Header {
  std::uint32_t magic = kMagic, format = kFormat;
  std::uint64_t voxels = 0;
  std::uint64_t checksum = 0;  // of all before it; the classes have the codec's
};
static_assert(sizeof(Header) == 24);

std::uint64_t checksum_of(const Header& header) {
  return base::hash_bytes(std::as_bytes(std::span(&header, 1)).first(sizeof header - sizeof header.checksum));
}

base::Error damaged(const char* text) {
  return {"damaged", text};
}

}  // namespace

std::array<std::size_t, kTissueClasses> count_classes(std::span<const TissueClass> classes) {
  std::array<std::size_t, 256> count{};
  for (const TissueClass tissue : classes) ++count[static_cast<std::size_t>(tissue)];
  std::array<std::size_t, kTissueClasses> known{};
  std::copy_n(count.begin(), kTissueClasses, known.begin());
  return known;
}

std::vector<std::byte> bytes_from_classes(std::span<const TissueClass> classes) {
  CHECK(classes.size() <= kMaxVoxels);
  Header header;
  header.voxels = classes.size();
  header.checksum = checksum_of(header);
  const std::vector<std::byte> packed = base::compress(std::as_bytes(classes));
  std::vector<std::byte> out(sizeof header + packed.size());
  std::memcpy(out.data(), &header, sizeof header);
  std::memcpy(out.data() + sizeof header, packed.data(), packed.size());
  return out;
}

base::Result<std::vector<TissueClass>> classes_from_bytes(std::span<const std::byte> bytes, std::size_t voxels) {
  Header header;
  const Header expected;
  if (bytes.size() < sizeof header) return damaged("the stored header is cut short");
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.magic != expected.magic || header.format != expected.format)
    return damaged("the stored bytes are of another kind");
  if (header.checksum != checksum_of(header)) return damaged("the stored header's checksum does not hold");
  if (header.voxels != voxels || voxels > kMaxVoxels) return damaged("the stored classes are not the volume's");
  const auto raw = base::decompress(bytes.subspan(sizeof header), voxels);
  if (!raw || raw->size() != voxels) return damaged("the stored classes are damaged");
  std::vector<TissueClass> classes(voxels);
  if (voxels > 0) std::memcpy(classes.data(), raw->data(), voxels);
  for (const TissueClass tissue : classes)
    if (static_cast<std::size_t>(tissue) >= kTissueClasses) return damaged("a stored class is not known");
  return classes;
}

}  // namespace seldinger::volume
