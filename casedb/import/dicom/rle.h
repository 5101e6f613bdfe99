// DICOM's run-length encoding (PS3.5 §G), read here: GDCM 3.0.21 believes the number of segments that a frame
// promises.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace seldinger::casedb {

// `pixels` samples of `sample_bytes` (1 or 2) as they would lie natively in little endian; nothing when the frame
// does not hold them.
std::optional<std::vector<std::byte>> unpack_rle(std::span<const char> frame, std::size_t pixels,
                                                 std::size_t sample_bytes);

}  // namespace seldinger::casedb
