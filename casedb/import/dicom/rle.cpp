#include "casedb/import/dicom/rle.h"

#include <algorithm>
#include <cstdint>

namespace seldinger::casedb {
namespace {

constexpr std::size_t kHeaderBytes = 64;

std::uint32_t number_at(std::span<const char> frame, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(frame[at + i]);
  return number;
}

// Puts one segment's bytes into every `stride`-th place from `to` on; whether it holds `count` of them.
bool unpack_segment(std::span<const char> segment, std::byte* to, std::size_t stride, std::size_t count) {
  std::size_t at = 0, done = 0;
  while (done < count) {
    if (at >= segment.size()) return false;
    const int control = static_cast<signed char>(segment[at++]);
    if (control == -128) continue;
    const std::size_t run = static_cast<std::size_t>(control >= 0 ? control + 1 : 1 - control);
    const std::size_t held = control >= 0 ? run : 1;  // bytes as they are, or one again and again
    if (run > count - done || held > segment.size() - at) return false;
    for (std::size_t i = 0; i < run; ++i)
      to[(done + i) * stride] = static_cast<std::byte>(segment[at + (control >= 0 ? i : 0)]);
    at += held;
    done += run;
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::byte>> unpack_rle(std::span<const char> frame, std::size_t pixels,
                                                 std::size_t sample_bytes) {
  if (frame.size() < kHeaderBytes || number_at(frame, 0) != sample_bytes) return std::nullopt;
  std::vector<std::byte> bytes(pixels * sample_bytes);
  for (std::size_t i = 0; i < sample_bytes; ++i) {  // the most significant bytes come first
    const std::size_t from = number_at(frame, 4 + 4 * i);
    const std::size_t to = i + 1 < sample_bytes ? number_at(frame, 8 + 4 * i) : frame.size();
    if (from < kHeaderBytes || to < from || to > frame.size()) return std::nullopt;
    if (!unpack_segment(frame.subspan(from, to - from), bytes.data() + (sample_bytes - 1 - i), sample_bytes,
                        pixels))
      return std::nullopt;
  }
  return bytes;
}

}  // namespace seldinger::casedb
