#include "sim/volume/volume_bytes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <glm/geometric.hpp>
#include <string>

#include "sim/base/codec.h"
#include "sim/volume/stored_header.h"

namespace seldinger::volume {
namespace {

constexpr std::uint32_t kVolumeMagic = 0x564c4453;  // "SDLV"
constexpr std::uint32_t kLabelMagic = 0x4c4c4453;   // "SDLL"
constexpr std::uint32_t kVolumeFormat = 1;
constexpr std::uint32_t kMaxNames = 256;
constexpr std::uint32_t kMaxNameBytes = 1024;

struct VolumeHeader {
  std::uint32_t magic = kVolumeMagic, format = kVolumeFormat;
  std::int32_t size_voxels[3] = {};
  std::uint32_t reserved = 0;
  double spacing_mm[3] = {};
  double lps_from_voxel[16] = {};  // column by column
  std::uint64_t checksum = 0;      // of all before it; the voxels have the codec's
};
static_assert(sizeof(VolumeHeader) == 184);

struct LabelHeader {
  std::uint32_t magic = kLabelMagic, format = kVolumeFormat;
  std::uint32_t names = 0, name_bytes = 0;  // name_bytes: of all names with their lengths
  std::uint64_t labels = 0;
  std::uint64_t checksum = 0;
};
static_assert(sizeof(LabelHeader) == 32);

// Exactly raw_bytes from the compressed rest, or `damaged`.
base::Result<std::vector<std::byte>> unpacked(std::span<const std::byte> packed, std::uint64_t raw_bytes) {
  // A zstd block takes at least 3 bytes and gives at most 128 KiB (RFC 8878 §3.1.1.2): fewer bytes than that cannot
  // hold what the header claims, and nothing is allocated for them.
  if (packed.size() < raw_bytes / (128 * 1024) * 3) return damaged("the stored data are cut short");
  auto raw = base::decompress(packed, static_cast<std::size_t>(raw_bytes));
  if (!raw) return damaged("the stored data are damaged");
  if (raw->size() != raw_bytes) return damaged("the stored data do not fit the stored size");
  return raw;
}

bool sound_geometry(const glm::dvec3& spacing_mm, const glm::dmat4& lps_from_voxel) {
  double volume_mm3 = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (!(spacing_mm[axis] > 0.0 && std::isfinite(spacing_mm[axis]))) return false;
    volume_mm3 *= glm::length(glm::dvec3(lps_from_voxel[axis]));
  }
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 3; ++row)
      if (!std::isfinite(lps_from_voxel[column][row])) return false;
    if (lps_from_voxel[column][3] != (column == 3 ? 1.0 : 0.0)) return false;
  }
  const double determinant = glm::dot(glm::dvec3(lps_from_voxel[0]),
                                      glm::cross(glm::dvec3(lps_from_voxel[1]), glm::dvec3(lps_from_voxel[2])));
  return std::isfinite(volume_mm3) && volume_mm3 > 0.0 && std::abs(determinant) > 1e-6 * volume_mm3;
}

// Zero when the size is not sound.
std::uint64_t voxel_count(const glm::ivec3& size_voxels) {
  std::uint64_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    if (size_voxels[axis] <= 0) return 0;
    count *= static_cast<std::uint64_t>(size_voxels[axis]);  // < 2^30 · 2^31: no overflow
    if (count > kMaxVoxels) return 0;
  }
  return count;
}

bool sound_hu(const std::vector<std::int16_t>& hu) {
  return std::all_of(hu.begin(), hu.end(), [](std::int16_t value) { return value >= kAirHu; });
}

bool sound_labels(const LabelMap& labels) {
  if (labels.names.empty()) return labels.label.empty();
  return labels.names[0] == "none" && std::all_of(labels.label.begin(), labels.label.end(),
                                                  [&](std::uint8_t label) { return label < labels.names.size(); });
}

}  // namespace

std::vector<std::byte> bytes_from_volume(const Volume& volume) {
  // What reading would refuse is never written.
  CHECK(voxel_count(volume.size_voxels) > 0 && voxel_count(volume.size_voxels) == volume.hu.size());
  CHECK(sound_geometry(volume.spacing_mm, volume.lps_from_voxel) && sound_hu(volume.hu));
  VolumeHeader header;
  for (int axis = 0; axis < 3; ++axis) {
    header.size_voxels[axis] = volume.size_voxels[axis];
    header.spacing_mm[axis] = volume.spacing_mm[axis];
  }
  for (int at = 0; at < 16; ++at) header.lps_from_voxel[at] = volume.lps_from_voxel[at / 4][at % 4];
  return joined(header, std::as_bytes(std::span(volume.hu)));
}

base::Result<Volume> volume_from_bytes(std::span<const std::byte> bytes) {
  const auto header = header_at<VolumeHeader>(bytes);
  if (!header) return header.error();
  Volume volume;
  for (int axis = 0; axis < 3; ++axis) {
    volume.size_voxels[axis] = header->size_voxels[axis];
    volume.spacing_mm[axis] = header->spacing_mm[axis];
  }
  for (int at = 0; at < 16; ++at) volume.lps_from_voxel[at / 4][at % 4] = header->lps_from_voxel[at];
  const std::uint64_t voxels = voxel_count(volume.size_voxels);
  if (voxels == 0) return damaged("the stored size is not one of a volume");
  if (!sound_geometry(volume.spacing_mm, volume.lps_from_voxel)) return damaged("the stored geometry is not sound");
  const auto raw = unpacked(bytes.subspan(sizeof(VolumeHeader)), voxels * sizeof(std::int16_t));
  if (!raw) return raw.error();
  volume.hu.resize(static_cast<std::size_t>(voxels));
  std::memcpy(volume.hu.data(), raw->data(), raw->size());
  if (!sound_hu(volume.hu)) return damaged("the stored voxels lie below the HU range");
  return volume;
}

std::vector<std::byte> bytes_from_labels(const LabelMap& labels) {
  CHECK(labels.label.size() <= kMaxVoxels && labels.names.size() <= kMaxNames && sound_labels(labels));
  std::vector<std::byte> raw;
  for (const std::string& name : labels.names) {
    CHECK(name.size() <= kMaxNameBytes);
    const auto length = static_cast<std::uint32_t>(name.size());
    const auto length_bytes = std::as_bytes(std::span(&length, 1));
    raw.insert(raw.end(), length_bytes.begin(), length_bytes.end());
    const auto name_bytes = std::as_bytes(std::span(name));
    raw.insert(raw.end(), name_bytes.begin(), name_bytes.end());
  }
  LabelHeader header;
  header.names = static_cast<std::uint32_t>(labels.names.size());
  header.name_bytes = static_cast<std::uint32_t>(raw.size());
  header.labels = labels.label.size();
  const auto label_bytes = std::as_bytes(std::span(labels.label));
  raw.insert(raw.end(), label_bytes.begin(), label_bytes.end());
  return joined(header, raw);
}

base::Result<LabelMap> labels_from_bytes(std::span<const std::byte> bytes) {
  const auto header = header_at<LabelHeader>(bytes);
  if (!header) return header.error();
  if (header->labels > kMaxVoxels || header->names > kMaxNames ||
      header->name_bytes > kMaxNames * (kMaxNameBytes + sizeof(std::uint32_t)))
    return damaged("the stored sizes are not those of labels");
  const auto raw = unpacked(bytes.subspan(sizeof(LabelHeader)), header->name_bytes + header->labels);
  if (!raw) return raw.error();

  LabelMap labels;
  std::span<const std::byte> rest = std::span(*raw).first(header->name_bytes);
  for (std::uint32_t i = 0; i < header->names; ++i) {
    std::uint32_t length = 0;
    if (rest.size() < sizeof length) return damaged("the stored names do not fit their size");
    std::memcpy(&length, rest.data(), sizeof length);
    rest = rest.subspan(sizeof length);
    if (length > rest.size()) return damaged("the stored names do not fit their size");
    std::string name(length, '\0');
    std::memcpy(name.data(), rest.data(), length);
    labels.names.push_back(std::move(name));
    rest = rest.subspan(length);
  }
  if (!rest.empty()) return damaged("the stored names do not fit their size");
  labels.label.resize(static_cast<std::size_t>(header->labels));
  if (!labels.label.empty())
    std::memcpy(labels.label.data(), raw->data() + header->name_bytes, labels.label.size());
  if (!sound_labels(labels)) return damaged("a stored label has no name");
  return labels;
}

std::uint64_t stored_voxels(std::span<const std::byte> bytes) {
  if (const auto header = header_at<VolumeHeader>(bytes))
    return voxel_count({header->size_voxels[0], header->size_voxels[1], header->size_voxels[2]});
  if (const auto header = header_at<LabelHeader>(bytes)) return header->labels <= kMaxVoxels ? header->labels : 0;
  return 0;
}

}  // namespace seldinger::volume
