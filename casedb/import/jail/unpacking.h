// How far packed bytes from outside may unpack. What would go further is refused before memory is taken for it.
#pragma once

#include <algorithm>
#include <cstdint>

namespace seldinger::casedb {

struct UnpackingLimit {
  std::uint64_t free_bytes;  // so much is taken whatever it was packed into
  double most_times;         // beyond that: how many times the packed size
  std::uint64_t most_bytes;  // and never more
};

constexpr std::uint64_t kMiB = std::uint64_t{1} << 20, kGiB = std::uint64_t{1} << 30;

// A CT shrinks 2 to 10 times, as its noise does not pack; an empty slice some hundred times. gzip and deflate reach
// 1032 (zlib.net/zlib_tech.html), and so do label maps, which are nearly empty.
constexpr UnpackingLimit kCtFile{64 * kMiB, 100.0, 4 * kGiB};  // NIfTI, NRRD, MetaImage
constexpr UnpackingLimit kLargeCtFile{64 * kMiB, 100.0,
                                      8 * kGiB};               // the most voxels there are (volume.h), in doubles
constexpr UnpackingLimit kDicomDataSet{64 * kMiB, 2.0, kGiB};  // deflated as a whole: headers and pixels
constexpr UnpackingLimit kDicomPixels{64 * kMiB, 100.0, 4 * kGiB};  // JPEG and its kin, RLE
// Volume and skin of a bundle's case. Its labels and classes, which may be nearly empty, have as many voxels as the
// volume, whatever they were packed into.
constexpr UnpackingLimit kBundlePart{24 * kMiB, 1000.0, 4 * kGiB};
// A label map of a case: on the case's own grid in the widest type, or on one that is finer.
constexpr UnpackingLimit label_file_limit(std::uint64_t case_voxels) noexcept {
  return {64 * kMiB, 1032.0, std::max(64 * kMiB, 8 * case_voxels)};
}

constexpr bool unpacks_too_far(const UnpackingLimit& limit, std::uint64_t packed, std::uint64_t unpacked) noexcept {
  return unpacked > limit.most_bytes ||
         (unpacked > limit.free_bytes &&
          static_cast<double>(unpacked) > limit.most_times * static_cast<double>(packed));
}
// What a stream of so many bytes may become, where nothing tells its size.
constexpr std::uint64_t most_unpacked(const UnpackingLimit& limit, std::uint64_t packed) noexcept {
  const double times = limit.most_times * static_cast<double>(packed);
  const std::uint64_t by_ratio =
      times < static_cast<double>(limit.most_bytes) ? static_cast<std::uint64_t>(times) : limit.most_bytes;
  return std::min(limit.most_bytes, std::max(limit.free_bytes, by_ratio));
}

}  // namespace seldinger::casedb
