// What the header of a NIfTI, NRRD or MetaImage file promises, read apart from ITK: sizes before anything is
// allocated, bytes before anything is believed, geometry that ITK would straighten without a word.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "casedb/import/files/byte_count.h"
#include "casedb/import/files/problems.h"

namespace seldinger::casedb {

struct FileLayout {
  std::array<std::int64_t, 3> size_voxels{1, 1, 1};
  int bytes_per_voxel = 0;
  std::filesystem::path data_file;  // the file itself or the one it names
  std::uint64_t data_offset = 0;    // of the (packed) data in data_file
  std::uint64_t packed_limit = UINT64_MAX;
  std::uint64_t unpacked_skip = 0;  // bytes before the voxels once unpacked (a packed NIfTI's header)
  Packing packing = Packing::none;
  // Where the reader would turn NaN and infinity into 0 unseen (NIfTI): bytes of a stored float, 0 for integers.
  int float_bytes = 0;
  bool swapped = false;  // big-endian
  std::vector<base::Problem> warnings;
  std::optional<glm::dmat4> lps_from_voxel;  // where ITK's is not used
};

// Each adds what speaks against the file to `problems`; the layout counts only when there is nothing.
FileLayout nifti_layout(const std::filesystem::path& file, Problems& problems);
FileLayout nrrd_layout(const std::filesystem::path& file, Problems& problems);
FileLayout metaimage_layout(const std::filesystem::path& file, Problems& problems);

// Sizes in range (`bad_size`), bytes there are (`truncated`, `damaged`), floats that are numbers (`not_finite`).
void check_layout(const FileLayout& layout, Problems& problems);

// The file beside `header` that it names: a plain name, no link, not elsewhere. `bad_data_file`, `no_data_file`.
std::filesystem::path data_file_beside(const std::filesystem::path& header, const std::string& name,
                                       Problems& problems);

// Lines of a text header and where the data begins; a header ends after `last_key` (MetaImage) or an empty line.
struct TextHeader {
  std::vector<std::string> lines;
  std::size_t data_offset = 0;
  bool ended = false;
};
TextHeader read_text_header(const std::filesystem::path& file, const std::string& last_key);
std::vector<std::string> words_of(const std::string& text);
std::vector<double> numbers_of(const std::string& text);  // empty when a word is no finite number

}  // namespace seldinger::casedb
