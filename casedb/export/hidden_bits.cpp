#include "casedb/export/hidden_bits.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>

#include "casedb/import/dicom/rle.h"

namespace seldinger::casedb {
namespace {

const base::Error kHiddenBits{"hidden_bits",
                              "a packed picture whose cells hold, or may hold, bits that are not its pixels'"};

std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t count, bool big_endian) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const auto byte = static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[at + i]));
    value |= byte << 8 * (big_endian ? count - 1 - i : i);
  }
  return value;
}

// The first value of an unsigned short.
std::optional<unsigned> short_of(const DicomDataSet& data_set, DicomTag tag, DicomFormat format) {
  for (const DicomElement& one : data_set)
    if (one.tag == tag && one.value.size() >= 2) return number_at(one.value, 0, 2, format.big_endian);
  return std::nullopt;
}

struct Cells {
  unsigned allocated = 0, stored = 0, high = 0;  // bits
  bool is_signed = false;
  std::optional<std::pair<int, int>> padding;  // PS3.3 §C.7.5.1.1.2: one value or a range, of whole cells
  int value_of(std::uint32_t cell) const {
    return is_signed && cell >= 0x8000 ? static_cast<int>(cell) - 0x10000 : static_cast<int>(cell);
  }
  bool is_padding(std::uint32_t cell) const {
    return allocated == 16 && padding && value_of(cell) >= padding->first && value_of(cell) <= padding->second;
  }
  std::uint32_t mask() const {
    const std::uint32_t pixel = stored >= 32 ? ~0U : (1U << stored) - 1;
    return pixel << (high + 1 - stored);
  }
  std::uint32_t cleared(std::uint32_t cell) const {
    if (is_padding(cell)) return cell;
    const bool negative = is_signed && (cell >> high & 1U) != 0;
    const std::uint32_t above = high >= 31 ? 0 : ~((1U << (high + 1)) - 1);
    const std::uint32_t whole = allocated >= 32 ? ~0U : (1U << allocated) - 1;
    return ((cell & mask()) | (negative ? above : 0)) & whole;
  }
};

// True when a native picture was changed.
bool clear_native(DicomElement& pixels, const Cells& cells, bool big_endian) {
  const std::size_t count = cells.allocated / 8;
  std::string bytes(pixels.value);
  bool changed = false;
  for (std::size_t at = 0; at + count <= bytes.size(); at += count) {
    const std::uint32_t cell = number_at(bytes, at, count, big_endian), now = cells.cleared(cell);
    if (now == cell) continue;
    changed = true;
    for (std::size_t i = 0; i < count; ++i)
      bytes[at + i] = static_cast<char>(now >> 8 * (big_endian ? count - 1 - i : i) & 0xFFU);
  }
  if (changed) pixels.set(std::string(pixels.vr.data(), 2).c_str(), std::move(bytes));
  return changed;
}

// Bits of a sample as a JPEG, JPEG-LS (ISO 10918-1 §B.2.2, 14495-1 §C.2.2) or JPEG 2000 codestream (15444-1 §A.5.1)
// tells.
std::optional<unsigned> precision_of(std::string_view frame) {
  const auto byte = [&](std::size_t at) { return static_cast<unsigned>(static_cast<unsigned char>(frame[at])); };
  if (frame.starts_with("\xFF\x4F\xFF\x51"))
    return frame.size() > 42 ? std::optional((byte(42) & 0x7FU) + 1) : std::nullopt;
  if (!frame.starts_with("\xFF\xD8")) return std::nullopt;
  for (std::size_t at = 2; at + 5 <= frame.size() && byte(at) == 0xFF;) {
    const unsigned marker = byte(at + 1);
    if (marker == 0xFF) {
      ++at;
      continue;
    }
    const bool frame_head =
        (marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC) || marker == 0xF7;
    if (frame_head) return byte(at + 4);
    at += 2 + number_at(frame, at + 2, 2, true);
  }
  return std::nullopt;
}

bool is_clean_rle(std::string_view frame, std::size_t pixels, const Cells& cells) {
  const std::size_t count = cells.allocated / 8;
  const auto unpacked = unpack_rle({frame.data(), frame.size()}, pixels, count);
  if (!unpacked) return false;
  const std::string_view bytes(reinterpret_cast<const char*>(unpacked->data()), unpacked->size());
  for (std::size_t at = 0; at + count <= bytes.size(); at += count) {
    const std::uint32_t cell = number_at(bytes, at, count, false);
    if (cells.cleared(cell) != cell) return false;
  }
  return true;
}

// All fragments behind the offset table (PS3.5 §A.4).
bool is_clean_packed(std::string_view items, const DicomDataSet& data_set, const Cells& cells, DicomFormat format) {
  const std::size_t pixels = std::size_t{short_of(data_set, 0x00280010, format).value_or(0)} *
                             short_of(data_set, 0x00280011, format).value_or(0);
  const bool one_sample = short_of(data_set, 0x00280002, format).value_or(1) == 1;
  bool table = true, any = false, continued = false;
  for (std::size_t at = 0; at + 8 <= items.size();) {
    const std::size_t length = number_at(items, at + 4, 4, false);
    const bool item = number_at(items, at, 4, false) == 0xE000FFFEU;
    if (!item || length > items.size() - at - 8) break;
    const std::string_view fragment = items.substr(at + 8, length);
    at += 8 + length;
    if (table) {
      table = false;
      continue;
    }
    const bool jpeg = fragment.starts_with("\xFF\xD8") || fragment.starts_with("\xFF\x4F\xFF\x51");
    if (jpeg) {
      const auto precision = precision_of(fragment);
      if (!precision || *precision > cells.stored || cells.high + 1 != cells.stored) return false;
      continued = true;
    } else if (!continued && !(one_sample && is_clean_rle(fragment, pixels, cells))) {
      return false;
    }
    any = true;
  }
  return any;
}

}  // namespace

base::Result<int> clear_hidden_bits(DicomDataSet& data_set, DicomFormat format) {
  int pictures = 0;
  Cells cells;
  cells.allocated = short_of(data_set, 0x00280100, format).value_or(0);
  cells.stored = short_of(data_set, 0x00280101, format).value_or(cells.allocated);
  cells.high = short_of(data_set, 0x00280102, format).value_or(cells.stored - 1);
  cells.is_signed = short_of(data_set, 0x00280103, format).value_or(0) == 1;
  if (const auto first = short_of(data_set, 0x00280120, format))
    cells.padding = std::minmax(cells.value_of(*first),
                                cells.value_of(short_of(data_set, 0x00280121, format).value_or(*first)));
  for (DicomElement& element : data_set) {
    for (DicomDataSet& item : element.items) {
      const auto inside = clear_hidden_bits(item, element.inside);
      if (!inside) return inside.error();
      pictures += *inside;
    }
    if (element.tag != 0x7FE00010 || cells.stored == cells.allocated) continue;
    const bool known = (cells.allocated == 8 || cells.allocated == 16 || cells.allocated == 32) &&
                       cells.stored >= 1 && cells.high < cells.allocated && cells.high + 1 >= cells.stored;
    if (!known) return kHiddenBits;
    if (element.is_encapsulated) {
      if (!is_clean_packed(element.value, data_set, cells, format)) return kHiddenBits;
    } else if (clear_native(element, cells, format.big_endian)) {
      ++pictures;
    }
  }
  return pictures;
}

}  // namespace seldinger::casedb
