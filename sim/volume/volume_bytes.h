// Volumes and labels as the library stores them (compressed), and back. Refused (`damaged`) when not sound.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::volume {

std::vector<std::byte> bytes_from_volume(const Volume& volume);
base::Result<Volume> volume_from_bytes(std::span<const std::byte> bytes);

std::vector<std::byte> bytes_from_labels(const LabelMap& labels);
base::Result<LabelMap> labels_from_bytes(std::span<const std::byte> bytes);

// How many voxels stored volumes or labels say they hold, before room is made for them; 0 when they say nothing
// sound.
std::uint64_t stored_voxels(std::span<const std::byte> bytes);

}  // namespace seldinger::volume
