// Voxels as a file holds them, one plain number behind the other, made into HU.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace seldinger::casedb {

enum class Scalar { none, int8, uint8, int16, uint16, int32, uint32, int64, uint64, float32, float64 };

constexpr int bytes_of(Scalar scalar) noexcept {
  switch (scalar) {
    case Scalar::none:
      return 0;
    case Scalar::int8:
    case Scalar::uint8:
      return 1;
    case Scalar::int16:
    case Scalar::uint16:
      return 2;
    case Scalar::int32:
    case Scalar::uint32:
    case Scalar::float32:
      return 4;
    case Scalar::int64:
    case Scalar::uint64:
    case Scalar::float64:
      return 8;
  }
  return 0;
}

struct VoxelFormat {
  Scalar scalar = Scalar::none;
  bool big_endian = false;
  // value = stored · slope + intercept, rounded to the type's precision: float, or double where that is stored.
  double slope = 1.0, intercept = 0.0;
};

// Takes the bytes piece by piece, wherever the pieces are cut. What is below −1024 HU becomes that, what is above
// 32767 that. Bytes behind the last voxel are not looked at.
class VoxelSink {
 public:
  VoxelSink(const VoxelFormat& format, std::span<std::int16_t> hu) : format_(format), hu_(hu) {}
  void take(std::span<const std::byte> bytes);
  bool full() const noexcept { return done_ == hu_.size(); }
  bool finite() const noexcept { return finite_; }  // all were numbers

 private:
  void convert(std::span<const std::byte> whole);
  template <typename T>
  void convert_as(std::span<const std::byte> whole);

  VoxelFormat format_;
  std::span<std::int16_t> hu_;
  std::size_t done_ = 0;
  std::array<std::byte, 8> cut_{};  // the beginning of a voxel whose end comes with the next piece
  std::size_t cut_bytes_ = 0;
  bool finite_ = true;
};

}  // namespace seldinger::casedb
