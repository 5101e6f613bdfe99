// One CT slice (a classic file, or a frame of an enhanced one): what its header says, and where its pixels lie.
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

#include "casedb/import/dicom/allow_list.h"
#include "casedb/import/dicom/dicom_file.h"
#include "casedb/import/dicom/identity.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// A slice's pixels within the file (within the unpacked data set when deflated): one piece when native, else the
// fragments of its frame, in order.
struct PixelPlace {
  std::vector<std::pair<std::size_t, std::size_t>> pieces;  // offset and length
  bool big_endian = false, encapsulated = false;
  std::size_t bytes() const noexcept;
};

struct DicomSlice {
  std::filesystem::path file;
  PixelPlace pixels;
  std::string series_uid;
  double series_number = 0.0;
  SliceIdentity identity;
  glm::ivec2 size_px{0};       // columns, rows
  glm::dvec2 spacing_mm{0.0};  // along a row (from column to column), along a column
  glm::dvec3 position_lps_mm{0.0};
  glm::dvec3 row{0.0}, column{0.0};  // unit vectors along increasing column and row index
  int bits_allocated = 0, bits_stored = 0, high_bit = 0;
  bool is_signed = false;
  double slope = 1.0, intercept = 0.0;
  std::optional<std::pair<int, int>> padding;  // stored values from–to, sign applied
  std::string transfer_syntax;
  bool lossy = false, no_rescale = false, secondary = false, not_hu = false, monochrome1 = false,
       wrong_syntax = false, is_virtual = false, described = false;
  double lossy_ratio = 0.0;                                     // as declared; 0 when it is not
  double thickness_mm = 0.0;                                    // 0 when it is not said
  std::vector<std::pair<std::string, std::string>> attributes;  // allow-list, validated
  std::vector<DroppedElement> dropped;                          // a file's first slice tells of all its frames
  bool says_head = false;
  std::vector<base::Problem> problems;  // why this slice cannot be read
};

enum class DicomKind {
  ct,  // classic: one slice; or frames, each of which says where it lies
  localizer,
  secondary_capture,
  parametric_map,
  encapsulated_document,
  other_object,
  directory,  // a DICOMDIR: never followed, the folder is looked through instead
  no_image,
  frames_without_place,
  too_large,
  bomb,
  truncated,
  damaged,
  not_dicom
};

// What a file is; says of other objects nothing but their kind.
DicomKind kind_of(const DicomFile& file);

// How many slices a CT file holds: 1, or its frames.
std::size_t frame_count(const DicomFile& file);

// The header of a CT slice, with every problem in it. Does not know the pixels.
DicomSlice slice_from(const DicomFile& header);

// Every slice of a CT file with the place of its pixels; localizer frames are left out and counted.
std::vector<DicomSlice> slices_of(const DicomFile& file, const std::filesystem::path& path, int& localizers);

}  // namespace seldinger::casedb
