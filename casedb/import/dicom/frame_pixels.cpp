#include "casedb/import/dicom/frame_pixels.h"

#include <algorithm>
#include <cmath>

#include "casedb/import/dicom/codec.h"
#include "casedb/import/files/byte_count.h"
#include "sim/volume/volume.h"

namespace seldinger::casedb {
namespace {

base::Error truncated() {
  return {"truncated", "ends before its pixels do"};
}

constexpr const char* kDeflated = "1.2.840.10008.1.2.1.99";

// The fragments from one entry of the offset table to the next; an entry counts from the first fragment's item.
base::Result<std::vector<PixelPlace>> by_offset_table(const DicomFile& file, std::size_t frames) {
  const std::size_t first_item = file.pixel_pieces.front().first - 8;
  std::vector<PixelPlace> places(frames, {{}, false, true});
  std::size_t frame = 0;
  for (const auto& piece : file.pixel_pieces) {
    const std::size_t at = piece.first - 8 - first_item;
    while (frame + 1 < frames && at >= file.offset_table[frame + 1]) ++frame;
    places[frame].pieces.push_back(piece);
  }
  for (std::size_t i = 0; i < frames; ++i)
    if (places[i].pieces.empty() || places[i].pieces.front().first - 8 - first_item != file.offset_table[i])
      return base::Error{"damaged", "has a table of frames that does not fit its pixels"};
  return places;
}

}  // namespace

base::Result<std::vector<PixelPlace>> frame_pixels(const DicomFile& file, std::size_t frame_bytes) {
  const std::size_t frames = std::max<std::size_t>(file.frames.size(), 1);
  if (!file.has_pixels || file.pixels_cut || file.pixel_pieces.empty()) return truncated();
  std::vector<PixelPlace> places;
  if (!file.encapsulated) {
    const auto [at, size] = file.pixel_pieces.front();
    if (size / frames < frame_bytes) return truncated();
    for (std::size_t i = 0; i < frames; ++i)
      places.push_back({{{at + i * frame_bytes, frame_bytes}}, file.big_endian, false});
    return places;
  }
  if (frames == 1) return std::vector<PixelPlace>{{file.pixel_pieces, false, true}};
  if (file.offset_table.size() == frames) return by_offset_table(file, frames);
  if (file.pixel_pieces.size() != frames)
    return base::Error{"damaged", "has packed frames whose beginnings are not told"};
  for (const auto& piece : file.pixel_pieces) places.push_back({{piece}, false, true});
  return places;
}

base::Result<void> SliceReader::read(const DicomSlice& slice, std::span<std::int16_t> hu) {
  const auto& pieces = slice.pixels.pieces;
  if (pieces.empty()) return truncated();
  // All pieces lie between the first and the last one.
  const std::size_t begin = pieces.front().first, end = pieces.back().first + pieces.back().second;
  std::vector<std::byte> read;
  std::span<const std::byte> range;
  if (slice.transfer_syntax == kDeflated) {
    if (unpacked_path_ != slice.file) {
      unpacked_ = {};
      unpacked_ = read_dicom_file(slice.file).bytes;
      unpacked_path_ = slice.file;
    }
    if (unpacked_.size() < end) return truncated();
    range = std::span<const std::byte>(unpacked_).subspan(begin, end - begin);
  } else {
    auto bytes = read_bytes(slice.file, begin, end - begin);
    if (!bytes || bytes->size() < end - begin) return truncated();
    read = std::move(*bytes);
    range = read;
  }
  std::vector<std::byte> unpacked;
  if (slice.pixels.encapsulated) {
    std::vector<char> frame;
    frame.reserve(slice.pixels.bytes());
    for (const auto& [offset, length] : pieces) {
      const char* from = reinterpret_cast<const char*>(range.data()) + (offset - begin);
      frame.insert(frame.end(), from, from + length);
    }
    auto decoded = decode_frame(frame, slice);
    if (!decoded) return decoded.error();
    unpacked = std::move(*decoded);
    range = unpacked;
  }
  const std::size_t sample = static_cast<std::size_t>(slice.bits_allocated / 8);
  if (range.size() < hu.size() * sample) return truncated();
  const int mask = (1 << slice.bits_stored) - 1, sign_bit = 1 << (slice.bits_stored - 1);
  const auto byte = [&](std::size_t where) { return std::to_integer<int>(range[where]); };
  for (std::size_t i = 0; i < hu.size(); ++i) {
    int stored = byte(i * sample);
    if (sample == 2) {
      const int other = byte(i * 2 + 1);
      stored = slice.pixels.big_endian ? stored << 8 | other : other << 8 | stored;
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
