#include "casedb/import/dicom/codec.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <exception>
#include <optional>
#include <string_view>

#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmJPEG12Codec.h>
#include <gdcmJPEG16Codec.h>
#include <gdcmJPEG8Codec.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include "casedb/import/dicom/rle.h"
#include "casedb/import/files/quiet_standard_error.h"

namespace seldinger::casedb {
namespace {

using Syntax = gdcm::TransferSyntax;
enum class Family { jpeg, jpeg_ls, jpeg_2000, rle };

std::optional<Family> family_of(Syntax::TSType type) {
  switch (type) {
    case Syntax::JPEGBaselineProcess1:
    case Syntax::JPEGExtendedProcess2_4:
    case Syntax::JPEGLosslessProcess14:
    case Syntax::JPEGLosslessProcess14_1:
      return Family::jpeg;
    case Syntax::JPEGLSLossless:
    case Syntax::JPEGLSNearLossless:
      return Family::jpeg_ls;
    case Syntax::JPEG2000Lossless:
    case Syntax::JPEG2000:
      return Family::jpeg_2000;
    case Syntax::RLELossless:
      return Family::rle;
    default:
      return std::nullopt;
  }
}

base::Error damaged() {
  return {"damaged", "has pixels that cannot be decoded"};
}

// What a frame says of itself, and whether its end is there: a decoder fills up what is missing and says nothing.
struct FrameHead {
  unsigned columns = 0, rows = 0, components = 0, bits = 0;
  bool lossless = false;
  bool is(const DicomSlice& slice) const {
    return columns == static_cast<unsigned>(slice.size_px.x) && rows == static_cast<unsigned>(slice.size_px.y) &&
           components == 1 && bits >= 1 && bits <= 16 && (bits <= 8) == (slice.bits_allocated == 8);
  }
};

class Bytes {
 public:
  explicit Bytes(std::span<const char> bytes) : bytes_(bytes) {}
  bool has(std::size_t at, std::size_t count) const { return at <= bytes_.size() && count <= bytes_.size() - at; }
  unsigned u8(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
  unsigned u16(std::size_t at) const { return u8(at) << 8 | u8(at + 1); }
  unsigned u32(std::size_t at) const { return u16(at) << 16 | u16(at + 2); }

 private:
  std::span<const char> bytes_;
};

// ISO/IEC 10918-1 §B.2.2 (JPEG: only sequential and lossless frames, SOF0, 1 and 3), 14495-1 §C.2.2 and C.2.3
// (JPEG-LS: SOF55; the scan's NEAR is 0 without loss).
std::optional<FrameHead> jpeg_head(std::span<const char> frame, Family family) {
  const Bytes in(frame);
  std::optional<FrameHead> head;
  for (std::size_t at = 2; in.has(at, 4) && in.u8(at) == 0xFF; at += 2 + in.u16(at + 2)) {  // behind SOI
    const unsigned marker = in.u8(at + 1);
    const bool is_frame =
        family == Family::jpeg ? marker == 0xC0 || marker == 0xC1 || marker == 0xC3 : marker == 0xF7;
    if (is_frame && in.has(at, 10))
      head = FrameHead{in.u16(at + 7), in.u16(at + 5), in.u8(at + 9), in.u8(at + 4), marker == 0xC3};
    if (marker != 0xDA) continue;
    if (head && family == Family::jpeg_ls) head->lossless = in.has(at, 8) && in.u8(at + 7) == 0;
    return head;
  }
  return std::nullopt;
}

// Whether each of `tiles` has a part and the parts reach to the end marker: a decoder fills a missing tile with
// zeros. ISO/IEC 15444-1 §A.4.2; `at` stands on the first marker after SIZ.
bool all_tiles_are_there(const Bytes& in, std::size_t at, std::size_t tiles) {
  std::vector<bool> seen(tiles, false);
  while (in.has(at, 4) && in.u16(at) != 0xFF90) at += 2 + in.u16(at + 2);
  while (in.has(at, 12) && in.u16(at) == 0xFF90) {
    const unsigned tile = in.u16(at + 4), length = in.u32(at + 6);
    if (tile >= tiles || (length != 0 && length < 12)) return false;
    seen[tile] = true;
    if (length == 0) return std::find(seen.begin(), seen.end(), false) == seen.end();  // up to the end
    at += length;
  }
  return in.has(at, 2) && in.u16(at) == 0xFFD9 && std::find(seen.begin(), seen.end(), false) == seen.end();
}

// §A.6.1: the coding style's wavelet is 5-3 (1), not 9-7 (0).
bool is_reversible(const Bytes& in, std::size_t at) {
  for (; in.has(at, 14) && in.u16(at) != 0xFF90; at += 2 + in.u16(at + 2))
    if (in.u16(at) == 0xFF52) return in.u8(at + 13) == 1;
  return false;
}

// ISO/IEC 15444-1 §A.5.1: SOC and SIZ. A file that is wrapped in JP2's boxes has them further in.
std::optional<FrameHead> jpeg_2000_head(std::span<const char> frame) {
  constexpr std::string_view kStart = "\xFF\x4F\xFF\x51";
  constexpr std::uint64_t kMostTiles = 1024;  // a decoder keeps some kB for each
  const std::size_t at = std::string_view(frame.data(), frame.size()).find(kStart);
  const Bytes in(frame);
  if (at == std::string_view::npos || !in.has(at, 45)) return std::nullopt;
  const unsigned columns = in.u32(at + 8), rows = in.u32(at + 12), left = in.u32(at + 16), top = in.u32(at + 20);
  const unsigned tile_columns = in.u32(at + 24), tile_rows = in.u32(at + 28), tile_left = in.u32(at + 32),
                 tile_top = in.u32(at + 36);
  if (left >= columns || top >= rows || tile_left > left || tile_top > top || tile_columns == 0 || tile_rows == 0)
    return std::nullopt;
  if (in.u8(at + 43) != 1 || in.u8(at + 44) != 1) return std::nullopt;  // subsampled
  const auto along = [](unsigned size, unsigned tile) {
    return std::uint64_t{size / tile} + (size % tile != 0 ? 1 : 0);
  };
  const std::uint64_t tiles = along(columns - tile_left, tile_columns) * along(rows - tile_top, tile_rows);
  if (tiles > kMostTiles || !all_tiles_are_there(in, at + 4 + in.u16(at + 4), tiles)) return std::nullopt;
  return FrameHead{columns - left, rows - top, in.u16(at + 40), (in.u8(at + 42) & 0x7FU) + 1,
                   is_reversible(in, at + 4 + in.u16(at + 4))};
}

bool claims_no_loss(Syntax::TSType type) {
  return type == Syntax::JPEGLosslessProcess14 || type == Syntax::JPEGLosslessProcess14_1 ||
         type == Syntax::JPEGLSLossless || type == Syntax::JPEG2000Lossless;
}

// What stands behind the end is padding: zeros by PS3.5 §A.4, and FF, a fill byte of JPEG's, by some writers.
std::span<const char> without_padding(std::span<const char> frame) {
  while (!frame.empty() && (frame.back() == '\0' || frame.back() == '\xFF')) frame = frame.first(frame.size() - 1);
  return frame;
}

// JPEG, JPEG-LS and JPEG 2000 all end in the marker FF D9.
bool ends_in_marker(std::span<const char> frame) {
  return frame.size() >= 2 && frame[frame.size() - 2] == '\xFF' && frame.back() == '\xD9';
}

gdcm::PixelFormat pixel_format(const DicomSlice& slice) {
  return gdcm::PixelFormat(1, static_cast<unsigned short>(slice.bits_allocated),
                           static_cast<unsigned short>(slice.bits_stored),
                           static_cast<unsigned short>(slice.high_bit), slice.is_signed ? 1 : 0);
}

// gdcm::Image tries a codec of the wrong precision first, which complains on standard error; so JPEG goes straight
// to the right one.
template <typename Codec>
bool decode_jpeg(const gdcm::DataElement& pixels, const DicomSlice& slice, std::vector<std::byte>& buffer) {
  const std::array<unsigned, 3> size = {static_cast<unsigned>(slice.size_px.x),
                                        static_cast<unsigned>(slice.size_px.y), 1};
  Codec codec;
  codec.SetNumberOfDimensions(2);
  codec.SetDimensions(size.data());
  codec.SetPlanarConfiguration(0);
  codec.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  codec.SetPixelFormat(pixel_format(slice));
  gdcm::DataElement decoded;
  if (!codec.Decode(pixels, decoded) || decoded.GetByteValue() == nullptr) return false;
  const gdcm::ByteValue& bytes = *decoded.GetByteValue();
  if (static_cast<std::size_t>(bytes.GetLength()) < buffer.size()) return false;
  std::memcpy(buffer.data(), bytes.GetPointer(), buffer.size());
  return true;
}

bool decode_other(const gdcm::DataElement& pixels, const DicomSlice& slice, Syntax::TSType type,
                  std::vector<std::byte>& buffer) {
  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned>(slice.size_px.x));
  image.SetDimension(1, static_cast<unsigned>(slice.size_px.y));
  image.SetPixelFormat(pixel_format(slice));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(Syntax(type));
  image.SetDataElement(pixels);
  return image.GetBufferLength() == buffer.size() && image.GetBuffer(reinterpret_cast<char*>(buffer.data()));
}

}  // namespace

base::Result<std::vector<std::byte>> decode_frame(std::span<const char> frame, const DicomSlice& slice) {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
  const Syntax::TSType type = Syntax::GetTSType(slice.transfer_syntax.c_str());
  const auto family = family_of(type);
  if (!family) return base::Error{"unknown_syntax", "is packed in a way that is not read"};
  const auto pixels_count = static_cast<std::size_t>(slice.size_px.x) * static_cast<std::size_t>(slice.size_px.y);
  const auto sample_bytes = static_cast<std::size_t>(slice.bits_allocated / 8);
  if (*family == Family::rle) {
    auto unpacked = unpack_rle(frame, pixels_count, sample_bytes);
    return unpacked ? base::Result<std::vector<std::byte>>(std::move(*unpacked)) : damaged();
  }
  frame = without_padding(frame);
  if (!ends_in_marker(frame)) return base::Error{"truncated", "ends before its pixels do"};
  const auto head = *family == Family::jpeg_2000 ? jpeg_2000_head(frame) : jpeg_head(frame, *family);
  if (!head || !head->is(slice)) return damaged();
  if (!head->lossless && claims_no_loss(type))
    return base::Error{"lossy", "was packed with loss under the name of a way without: nobody says how much"};
  const QuietStandardError quiet;
  try {
    gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
    gdcm::Fragment fragment;
    std::vector<char> even(frame.begin(), frame.end());
    even.resize(even.size() + even.size() % 2, '\0');
    fragment.SetByteValue(even.data(), gdcm::VL(static_cast<std::uint32_t>(even.size())));
    fragments->AddFragment(fragment);
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
    pixels.SetVR(gdcm::VR::OB);
    pixels.SetValue(*fragments);
    std::vector<std::byte> buffer(pixels_count * sample_bytes);
    const bool good = *family != Family::jpeg ? decode_other(pixels, slice, type, buffer)
                      : head->bits <= 8       ? decode_jpeg<gdcm::JPEG8Codec>(pixels, slice, buffer)
                      : head->bits <= 12      ? decode_jpeg<gdcm::JPEG12Codec>(pixels, slice, buffer)
                                              : decode_jpeg<gdcm::JPEG16Codec>(pixels, slice, buffer);
    if (!good) return damaged();
    return buffer;
  } catch (const std::exception&) {
    return damaged();
  }
}

}  // namespace seldinger::casedb
