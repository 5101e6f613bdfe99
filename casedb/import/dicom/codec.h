// Unpacks one frame of JPEG, JPEG-LS or JPEG 2000 by GDCM's codecs, and RLE by our own, which see nothing else of
// the file.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "casedb/import/dicom/dicom_slice.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

// columns × rows samples as they would lie natively in little endian. The frame's own size is compared with the
// header's before a codec sees it, since codecs allocate what it says. Refused: `unknown_syntax`, `truncated`,
// `damaged`, `lossy` (under a name without loss).
base::Result<std::vector<std::byte>> decode_frame(std::span<const char> frame, const DicomSlice& slice);

}  // namespace seldinger::casedb
