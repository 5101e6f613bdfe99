// What the header of a NIfTI, NRRD or MetaImage file promises: sizes before anything is allocated, bytes before
// anything is believed.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "casedb/import/files/byte_count.h"
#include "casedb/import/files/problems.h"
#include "casedb/import/files/voxels.h"
#include "casedb/import/jail/unpacking.h"

namespace seldinger::casedb {

struct FileLayout {
  std::array<std::int64_t, 3> size_voxels{1, 1, 1};
  VoxelFormat voxels;
  std::filesystem::path data_file;  // the file itself or the one it names
  std::uint64_t data_offset = 0;    // of the (packed) data in data_file
  std::uint64_t packed_limit = UINT64_MAX;
  std::uint64_t unpacked_skip = 0;  // bytes before the voxels once unpacked (a packed NIfTI's header)
  Packing packing = Packing::none;
  glm::dmat4 lps_from_voxel{1.0};
  std::vector<base::Problem> warnings;
};

// Each adds what speaks against the file to `problems`; the layout counts only when there is nothing.
FileLayout nifti_layout(const std::filesystem::path& file, Problems& problems);
FileLayout nrrd_layout(const std::filesystem::path& file, Problems& problems);
FileLayout metaimage_layout(const std::filesystem::path& file, Problems& problems);

// Sizes in range (`bad_size`), no more than the packed bytes can be (`too_large`).
void check_layout(const FileLayout& layout, const UnpackingLimit& limit, Problems& problems);

// The file beside `header` that it names: a plain name, no link, not elsewhere. `bad_data_file`, `no_data_file`.
std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name,
                                       Problems& problems);

// Lines of a text header, 1 MiB and 20,000 at most, and where the data begins; a header ends after `last_key`
// (MetaImage) or an empty line.
struct TextHeader {
  std::vector<std::string> lines;
  std::size_t data_offset = 0;
  bool ended = false;
};
TextHeader read_text_header(const std::filesystem::path& file, const std::string& last_key);
std::vector<std::string> words_of(const std::string& text);
std::vector<double> numbers_of(const std::string& text);  // empty when a word is no finite number

}  // namespace seldinger::casedb
