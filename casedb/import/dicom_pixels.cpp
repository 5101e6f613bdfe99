// Pixels of a DICOM slice: native ones are read here, compressed ones by GDCM's codecs, which see nothing else of
// the file.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <memory>

#include <gdcmDataElement.h>
#include <gdcmFragment.h>
#include <gdcmImage.h>
#include <gdcmJPEG12Codec.h>
#include <gdcmJPEG16Codec.h>
#include <gdcmJPEG8Codec.h>
#include <gdcmSequenceOfFragments.h>
#include <gdcmTrace.h>

#include "casedb/import/dicom_slice.h"
#include "casedb/import/quiet_standard_error.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

base::Error truncated() {
  return {"truncated", "ends before its pixels do"};
}
base::Error damaged() {
  return {"damaged", "has pixels that cannot be decoded"};
}

// JPEG, JPEG-LS and JPEG 2000 all end in the marker FF D9; a decoder fills up what is missing and says nothing.
bool ends_in_marker(std::span<const char> frame) {
  while (!frame.empty() && frame.back() == '\0') frame = frame.first(frame.size() - 1);
  return frame.size() >= 2 && frame[frame.size() - 2] == '\xFF' && frame.back() == '\xD9';
}

// The sample precision a JPEG frame declares (ISO/IEC 10918-1 §B.2.2: start of frame, SOF0 to SOF15); 0 without
// one.
int jpeg_precision(std::span<const char> frame) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(frame[at])); };
  std::size_t at = 2;  // behind SOI
  while (at + 5 <= frame.size() && byte(at) == 0xFF) {
    const unsigned marker = byte(at + 1);
    const bool is_table = marker == 0xC4 || marker == 0xC8 || marker == 0xCC;
    if (marker >= 0xC0 && marker <= 0xCF && !is_table) return static_cast<int>(byte(at + 4));
    at += 2 + (byte(at + 2) << 8 | byte(at + 3));
  }
  return 0;
}

bool is_jpeg(gdcm::TransferSyntax::TSType type) {
  return type == gdcm::TransferSyntax::JPEGBaselineProcess1 ||
         type == gdcm::TransferSyntax::JPEGExtendedProcess2_4 ||
         type == gdcm::TransferSyntax::JPEGLosslessProcess14 ||
         type == gdcm::TransferSyntax::JPEGLosslessProcess14_1;
}

gdcm::PixelFormat pixel_format(const DicomSlice& slice) {
  return gdcm::PixelFormat(1, static_cast<unsigned short>(slice.bits_allocated),
                           static_cast<unsigned short>(slice.bits_stored),
                           static_cast<unsigned short>(slice.high_bit), slice.is_signed ? 1 : 0);
}

// gdcm::Image tries a codec of the wrong precision first, which complains on standard error; so JPEG goes straight
// to the right one.
template <typename Codec>
bool decode_jpeg(const gdcm::DataElement& pixels, const DicomSlice& slice, std::vector<char>& buffer) {
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
  std::copy_n(bytes.GetPointer(), buffer.size(), buffer.begin());
  return true;
}

bool decode_other(const gdcm::DataElement& pixels, const DicomSlice& slice, gdcm::TransferSyntax::TSType type,
                  std::vector<char>& buffer) {
  gdcm::Image image;
  image.SetNumberOfDimensions(2);
  image.SetDimension(0, static_cast<unsigned>(slice.size_px.x));
  image.SetDimension(1, static_cast<unsigned>(slice.size_px.y));
  image.SetPixelFormat(pixel_format(slice));
  image.SetPhotometricInterpretation(gdcm::PhotometricInterpretation::MONOCHROME2);
  image.SetTransferSyntax(gdcm::TransferSyntax(type));
  image.SetDataElement(pixels);
  return image.GetBufferLength() == buffer.size() && image.GetBuffer(buffer.data());
}

base::Result<std::vector<char>> decompress(const DicomFile& file, const DicomSlice& slice) {
  const gdcm::TransferSyntax::TSType type = gdcm::TransferSyntax::GetTSType(slice.transfer_syntax.c_str());
  if (type == gdcm::TransferSyntax::TS_END || !gdcm::TransferSyntax(type).IsEncapsulated())
    return base::Error{"unknown_syntax", "is packed in a way that is not read"};
  if (file.pixel_pieces.empty()) return truncated();
  const auto piece = [&](const std::pair<std::size_t, std::size_t>& at) {
    return std::span<const char>(file.bytes.data() + at.first, at.second);
  };
  if (type != gdcm::TransferSyntax::RLELossless && !ends_in_marker(piece(file.pixel_pieces.back())))
    return truncated();
  const QuietStandardError quiet;
  try {
    gdcm::SmartPointer<gdcm::SequenceOfFragments> fragments = new gdcm::SequenceOfFragments;
    for (const auto& [offset, length] : file.pixel_pieces) {
      gdcm::Fragment fragment;
      fragment.SetByteValue(file.bytes.data() + offset, gdcm::VL(static_cast<std::uint32_t>(length)));
      fragments->AddFragment(fragment);
    }
    gdcm::DataElement pixels(gdcm::Tag(0x7fe0, 0x0010));
    pixels.SetVR(gdcm::VR::OB);
    pixels.SetValue(*fragments);
    std::vector<char> buffer(static_cast<std::size_t>(slice.size_px.x) * static_cast<std::size_t>(slice.size_px.y) *
                             static_cast<std::size_t>(slice.bits_allocated / 8));
    const int precision = is_jpeg(type) ? jpeg_precision(piece(file.pixel_pieces.front())) : 0;
    const bool good = !is_jpeg(type)    ? decode_other(pixels, slice, type, buffer)
                      : precision == 0  ? false
                      : precision <= 8  ? decode_jpeg<gdcm::JPEG8Codec>(pixels, slice, buffer)
                      : precision <= 12 ? decode_jpeg<gdcm::JPEG12Codec>(pixels, slice, buffer)
                                        : decode_jpeg<gdcm::JPEG16Codec>(pixels, slice, buffer);
    if (!good) return damaged();
    return buffer;
  } catch (const std::exception&) {
    return damaged();
  }
}

void silence_gdcm() {
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

}  // namespace

base::Result<void> decode_slice(const DicomFile& file, const DicomSlice& slice, std::span<std::int16_t> hu) {
  silence_gdcm();
  if (!file.has_pixels || file.pixels_cut) return truncated();
  const std::size_t sample = static_cast<std::size_t>(slice.bits_allocated / 8);
  std::vector<char> unpacked;
  std::span<const char> bytes;
  if (file.encapsulated) {
    auto decoded = decompress(file, slice);
    if (!decoded) return decoded.error();
    unpacked = std::move(*decoded);
    bytes = unpacked;
  } else {
    const auto [at, size] = file.pixel_pieces.front();
    bytes = {file.bytes.data() + at, size};
  }
  if (bytes.size() < hu.size() * sample) return truncated();
  const bool big_endian = file.big_endian && !file.encapsulated;
  const int mask = (1 << slice.bits_stored) - 1, sign_bit = 1 << (slice.bits_stored - 1);
  const auto byte = [&](std::size_t where) { return static_cast<int>(static_cast<unsigned char>(bytes[where])); };
  for (std::size_t i = 0; i < hu.size(); ++i) {
    int stored = byte(i * sample);
    if (sample == 2) {
      const int other = byte(i * 2 + 1);
      stored = big_endian ? stored << 8 | other : other << 8 | stored;
    }
    stored &= mask;  // bits above the stored ones may hold overlays
    if (slice.is_signed && (stored & sign_bit) != 0) stored -= mask + 1;
    const bool padded = slice.padding && stored >= slice.padding->first && stored <= slice.padding->second;
    const double value = stored * slice.slope + slice.intercept;
    hu[i] = padded ? volume::kAirHu
                   : static_cast<std::int16_t>(std::lround(std::clamp(value, double{volume::kAirHu}, 32767.0)));
  }
  return {};
}

}  // namespace seldinger::casedb
