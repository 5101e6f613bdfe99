// One CT slice of a classic DICOM series: what its header says, and its pixels as HU.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "casedb/import/dicom_file.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

struct DicomSlice {
  std::filesystem::path file;
  std::string series_uid;
  double series_number = 0.0;
  glm::ivec2 size_px{0};       // columns, rows
  glm::dvec2 spacing_mm{0.0};  // along a row (from column to column), along a column
  glm::dvec3 position_lps_mm{0.0};
  glm::dvec3 row{0.0}, column{0.0};  // unit vectors along increasing column and row index
  int bits_allocated = 0, bits_stored = 0, high_bit = 0;
  bool is_signed = false;
  double slope = 1.0, intercept = 0.0;
  std::optional<std::pair<int, int>> padding;  // stored values from–to, sign applied
  std::string transfer_syntax;
  bool lossy = false, no_rescale = false, secondary = false, not_hu = false;
  std::vector<std::pair<std::string, std::string>> attributes;  // allow-list, validated
  std::vector<base::Problem> problems;                          // why this slice cannot be read
};

enum class DicomKind {
  ct_slice,
  ct_localizer,
  other_modality,
  no_image,
  multi_frame,
  truncated,
  damaged,
  not_dicom
};

// What a file is; says of other modalities nothing but that they are other.
DicomKind kind_of(const DicomFile& file);

// The header of a CT slice, with every problem in it. Does not keep the pixels.
DicomSlice slice_from(const DicomFile& file);

// HU of the slice's pixels, row by row, padding and all below −1024 as −1024; `hu` has columns × rows places.
// Refused: `truncated`, `damaged`, `unknown_syntax`.
base::Result<void> decode_slice(const DicomFile& file, const DicomSlice& slice, std::span<std::int16_t> hu);

}  // namespace seldinger::casedb
