// Where the pixels of each frame lie in a DICOM file, and how they become HU.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "casedb/import/dicom/dicom_slice.h"

namespace seldinger::casedb {

// One place a frame of `frame_bytes` (native ones lie one behind the other; packed ones by the offset table, or one
// fragment a frame). Refused: `truncated`, `damaged`.
base::Result<std::vector<PixelPlace>> frame_pixels(const DicomFile& file, std::size_t frame_bytes);

// Reads the pixels of one slice after the other from disk.
class SliceReader {
 public:
  // HU of the slice, row by row, padding and all below −1024 as −1024; `hu` has columns × rows places. Refused:
  // `truncated`, `damaged`, `unknown_syntax`.
  base::Result<void> read(const DicomSlice& slice, std::span<std::int16_t> hu);

 private:
  std::filesystem::path unpacked_path_;  // a deflated file is kept until another one is asked for
  std::vector<std::byte> unpacked_;
};

}  // namespace seldinger::casedb
