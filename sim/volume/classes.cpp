#include "sim/volume/classes.h"

#include <algorithm>
#include <cstring>

#include "sim/base/check.h"
#include "sim/base/codec.h"
#include "sim/volume/stored_header.h"

namespace seldinger::volume {
namespace {

constexpr std::uint32_t kMagic = 0x434c4453;  // "SDLC"
constexpr std::uint32_t kFormat = 1;

struct ClassesHeader {
  std::uint32_t magic = kMagic, format = kFormat;
  std::uint64_t voxels = 0;
  std::uint64_t checksum = 0;  // of all before it; the classes have the codec's
};
static_assert(sizeof(ClassesHeader) == 24);

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
  ClassesHeader header;
  header.voxels = classes.size();
  return joined(header, std::as_bytes(classes));
}

base::Result<std::vector<TissueClass>> classes_from_bytes(std::span<const std::byte> bytes, std::size_t voxels) {
  const auto header = header_at<ClassesHeader>(bytes);
  if (!header) return header.error();
  if (header->voxels != voxels || voxels > kMaxVoxels) return damaged("the stored classes are not the volume's");
  const auto raw = base::decompress(bytes.subspan(sizeof(ClassesHeader)), voxels);
  if (!raw || raw->size() != voxels) return damaged("the stored classes are damaged");
  std::vector<TissueClass> classes(voxels);
  if (voxels > 0) std::memcpy(classes.data(), raw->data(), voxels);
  for (const TissueClass tissue : classes)
    if (static_cast<std::size_t>(tissue) >= kTissueClasses) return damaged("a stored class is not known");
  return classes;
}

}  // namespace seldinger::volume
