#include "casedb/import/files/read_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "casedb/import/files/file_layout.h"
#include "casedb/import/jail/input.h"
#include "casedb/import/jail/jail.h"

namespace seldinger::casedb {
namespace {

constexpr std::uint64_t kSpareBytes = 1 << 20;  // behind the voxels
constexpr std::size_t kPieceBytes = 1 << 20;

FileLayout layout_of(const std::filesystem::path& file, FileFormat format, Problems& problems) {
  switch (format) {
    case FileFormat::nifti:
      return nifti_layout(file, problems);
    case FileFormat::nrrd:
      return nrrd_layout(file, problems);
    case FileFormat::metaimage:
      return metaimage_layout(file, problems);
  }
  return {};
}

// Perpendicular axes of a sound length; the library's volumes have no others.
void check_axes(volume::Volume& volume, Problems& problems) {
  std::array<glm::dvec3, 3> axis;
  bool sound = true;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 column(volume.lps_from_voxel[i]);
    volume.spacing_mm[i] = glm::length(column);
    sound = sound && volume.spacing_mm[i] >= volume::kMinSpacingMm &&
            volume.spacing_mm[i] <= volume::kMaxSpacingMm && std::abs(volume.lps_from_voxel[3][i]) < 1e6;
    axis[static_cast<std::size_t>(i)] = column / volume.spacing_mm[i];
  }
  for (std::size_t i = 0; i < 3; ++i) sound = sound && std::abs(glm::dot(axis[i], axis[(i + 1) % 3])) < 2e-3;
  if (!sound) problems.add("no_geometry", "the axes are not perpendicular, or sizes are out of range");
}

ByteState read_raw(const FileLayout& layout, VoxelSink& sink) {
  const InputFile in(layout.data_file);
  std::vector<std::byte> piece(kPieceBytes);
  for (std::uint64_t at = layout.data_offset; !sink.full(); at += kPieceBytes) {
    const std::size_t got = in.read(at, piece);
    sink.take(std::span(piece).first(got));
    if (got < kPieceBytes) break;
  }
  return ByteState::complete;
}

ByteState read_packed(const FileLayout& layout, std::uint64_t need, VoxelSink& sink) {
  std::uint64_t skip = layout.unpacked_skip;
  return unpack({layout.data_file, layout.data_offset, layout.packed_limit, need + kSpareBytes, layout.packing},
                [&](std::span<const std::byte> piece) {
                  const auto skipped = static_cast<std::size_t>(std::min<std::uint64_t>(skip, piece.size()));
                  skip -= skipped;
                  sink.take(piece.subspan(skipped));
                })
      .state;
}

void read_voxels(const FileLayout& layout, volume::Volume& volume, Problems& problems) {
  const std::size_t voxels = static_cast<std::size_t>(volume.size_voxels.x) *
                             static_cast<std::size_t>(volume.size_voxels.y) *
                             static_cast<std::size_t>(volume.size_voxels.z);
  const std::uint64_t bytes = voxels * static_cast<std::uint64_t>(bytes_of(layout.voxels.scalar));
  if (layout.packing == Packing::none && file_size_bytes(layout.data_file) < layout.data_offset + bytes) {
    problems.add("truncated", "the file ends before its voxels do");
    return;
  }
  announce_bytes(voxels * sizeof(std::int16_t));
  volume.hu.resize(voxels);
  VoxelSink sink(layout.voxels, volume.hu);
  const ByteState state = layout.packing == Packing::none ? read_raw(layout, sink)
                                                          : read_packed(layout, layout.unpacked_skip + bytes, sink);
  if (state == ByteState::damaged)
    problems.add("damaged", "the packed voxels cannot be unpacked as the header promises");
  else if (state == ByteState::too_few || !sink.full())
    problems.add("truncated", "the file ends before its voxels do");
  else if (!sink.finite())
    problems.add("not_finite", "voxels hold values that are no numbers");
}

}  // namespace

base::Result<Source> read_volume_file(const std::filesystem::path& file, FileFormat format,
                                      const UnpackingLimit& limit) {
  Problems problems;
  const FileLayout layout = layout_of(file, format, problems);
  check_layout(layout, limit, problems);
  if (!problems.empty()) return problems.error();
  Source source;
  source.warnings = layout.warnings;
  volume::Volume& volume = source.volume;
  for (int axis = 0; axis < 3; ++axis)
    volume.size_voxels[axis] = static_cast<int>(layout.size_voxels[static_cast<std::size_t>(axis)]);
  volume.lps_from_voxel = layout.lps_from_voxel;
  check_axes(volume, problems);
  if (problems.empty()) read_voxels(layout, volume, problems);
  if (!problems.empty()) return problems.error();
  source.slices_used = volume.size_voxels.z;
  if (volume.size_voxels.z == 1) source.warnings.push_back({"single_slice", "the case is one slice"});
  return source;
}

}  // namespace seldinger::casedb
