#include "casedb/export/dicom_tree.h"

#include <gdcmDicts.h>
#include <gdcmGlobal.h>

#include <algorithm>
#include <utility>

#include "sim/base/ascii.h"
#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

constexpr std::uint32_t kUndefined = 0xFFFFFFFFU;
constexpr DicomTag kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD, kPixels = 0x7FE00010;
constexpr std::string_view kItemBytes("\xFE\xFF\x00\xE0", 4);  // little endian

const base::Error kTruncated{"truncated", "a file ends in the middle of an element"};
const base::Error kDamaged{"damaged", "a file cannot be followed as DICOM"};

// VRs with a length of two bytes (PS3.5 §7.1.2); those of the future have four.
bool has_short_length(std::array<char, 2> vr) noexcept {
  static constexpr std::string_view kShort = "AEASATCSDADSDTFDFLISLOLTPNSHSLSSSTTMUIULUS";
  for (std::size_t i = 0; i < kShort.size(); i += 2)
    if (vr[0] == kShort[i] && vr[1] == kShort[i + 1]) return true;
  return false;
}

class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  base::Result<DicomDataSet> whole(DicomFormat format) {
    DicomDataSet read;
    while (at_ < bytes_.size()) {
      if (bytes_.find_first_not_of('\0', at_) == std::string_view::npos) break;
      if (const base::Error* error = element(read, format, bytes_.size(), 0)) return *error;
    }
    return read;
  }

 private:
  // Errors are pointers to constants; nullptr: all is well. Recursion through Result would copy whole branches.
  using Problem = const base::Error*;

  std::size_t left(std::size_t end) const noexcept { return end - at_; }
  std::uint32_t byte(std::size_t where) const noexcept { return static_cast<unsigned char>(bytes_[where]); }
  std::uint32_t u16(bool big) const noexcept {
    return big ? byte(at_) << 8 | byte(at_ + 1) : byte(at_ + 1) << 8 | byte(at_);
  }
  std::uint32_t take_u16(bool big) noexcept {
    const std::uint32_t value = u16(big);
    at_ += 2;
    return value;
  }
  std::uint32_t take_u32(bool big) noexcept {
    const std::uint32_t first = take_u16(big), second = take_u16(big);
    return big ? first << 16 | second : second << 16 | first;
  }
  DicomTag take_tag(bool big) noexcept {
    const std::uint32_t group = take_u16(big);
    return group << 16 | take_u16(big);
  }

  Problem element(DicomDataSet& into, DicomFormat format, std::size_t end, int depth) {
    if (left(end) < 8) return &kTruncated;
    DicomElement made;
    made.tag = take_tag(format.big_endian);
    if ((made.tag >> 16) == 0xFFFE) return &kDamaged;
    std::uint32_t length = 0;
    if (!format.explicit_vr) {
      length = take_u32(format.big_endian);
    } else {
      made.file_vr = {bytes_[at_], bytes_[at_ + 1]};
      if (!base::is_capital(made.file_vr[0]) || !base::is_capital(made.file_vr[1])) return &kDamaged;
      at_ += 2;
      if (has_short_length(made.file_vr)) {
        length = take_u16(format.big_endian);
      } else {
        at_ += 2;
        if (left(end) < 4) return &kTruncated;
        length = take_u32(format.big_endian);
      }
    }
    made.vr = made.file_vr;
    if (!format.explicit_vr || made.is("UN")) {
      const std::string known = dictionary_vr(made.tag);
      if (!known.empty()) made.vr = {known[0], known[1]};
    }
    if (length != kUndefined && length > left(end)) return &kTruncated;
    const bool un = format.explicit_vr && made.file_vr == std::array{'U', 'N'};
    const std::string_view value = length == kUndefined ? std::string_view() : bytes_.substr(at_, length);
    // Content that begins as an item is one, whatever the dictionary knows: private sequences, newer ones.
    const bool looks_nested = value.starts_with(kItemBytes) && (un || !format.explicit_vr);
    Problem problem = nullptr;
    if (length == kUndefined && made.tag == kPixels && format.explicit_vr) {
      problem = pixel_items(made, format, end);
    } else if (made.is("SQ") || length == kUndefined || looks_nested) {
      const bool nestable = made.is("SQ") || un || !format.explicit_vr;
      if (!nestable) return &kDamaged;
      made.inside = un ? DicomFormat{false, false} : format;  // PS3.5 §6.2.2 note 4
      problem = sequence(made, length, end, depth + 1);
    } else {
      made.value = value;
      at_ += length;
    }
    if (problem == nullptr) into.push_back(std::move(made));
    return problem;
  }

  Problem sequence(DicomElement& made, std::uint32_t length, std::size_t outer_end, int depth) {
    static const base::Error kTooDeep{"too_deep", "a file nests sequences deeper than 128"};
    if (depth > kDeepestSequence) return &kTooDeep;
    made.is_sequence = true;
    made.vr = {'S', 'Q'};
    const bool open = length == kUndefined, big = made.inside.big_endian;
    const std::size_t end = open ? outer_end : at_ + length;
    while (open || at_ < end) {
      if (left(end) < 8) return &kTruncated;
      const DicomTag tag = take_tag(big);
      const std::uint32_t item_length = take_u32(big);
      if (open && tag == kSequenceEnd) return nullptr;
      if (tag != kItem) return &kDamaged;
      if (item_length != kUndefined && item_length > left(end)) return &kTruncated;
      made.items.emplace_back();
      if (Problem problem = item(made.items.back(), made.inside, item_length, end, depth)) return problem;
    }
    return nullptr;
  }

  Problem item(DicomDataSet& into, DicomFormat format, std::uint32_t length, std::size_t outer_end, int depth) {
    const bool open = length == kUndefined;
    const std::size_t end = open ? outer_end : at_ + length;
    while (open || at_ < end) {
      if (left(end) < 8) return &kTruncated;
      if (open) {
        const std::size_t before = at_;
        if (take_tag(format.big_endian) == kItemEnd) {
          at_ += 4;
          return nullptr;
        }
        at_ = before;
      }
      if (Problem problem = element(into, format, end, depth)) return problem;
    }
    return nullptr;
  }

  Problem pixel_items(DicomElement& made, DicomFormat format, std::size_t end) {
    made.is_encapsulated = true;
    const std::size_t start = at_;
    for (;;) {
      if (left(end) < 8) return &kTruncated;
      const DicomTag tag = take_tag(format.big_endian);
      const std::uint32_t length = take_u32(format.big_endian);
      if (tag == kSequenceEnd) break;
      if (tag != kItem || length == kUndefined) return &kDamaged;
      if (length > left(end)) return &kTruncated;
      at_ += length;
    }
    made.value = bytes_.substr(start, at_ - start);
    return nullptr;
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
};

class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}

  void data_set(const DicomDataSet& elements, DicomFormat format) {
    for (const DicomElement& one : elements) element(one, format);
  }

 private:
  void put_u16(std::uint32_t value, bool big) {
    const char low = static_cast<char>(value & 0xFF), high = static_cast<char>(value >> 8 & 0xFF);
    out_ += big ? high : low;
    out_ += big ? low : high;
  }
  void put_u32(std::uint32_t value, bool big) {
    put_u16(big ? value >> 16 : value & 0xFFFF, big);
    put_u16(big ? value & 0xFFFF : value >> 16, big);
  }
  void put_tag(DicomTag tag, bool big) {
    put_u16(tag >> 16, big);
    put_u16(tag & 0xFFFF, big);
  }

  void head(const DicomElement& one, DicomFormat format, std::uint32_t length) {
    put_tag(one.tag, format.big_endian);
    if (!format.explicit_vr) return put_u32(length, format.big_endian);
    // A sequence within UN stays one: what is in it is implicit.
    const bool un = one.is_sequence && !one.inside.explicit_vr;
    const std::array<char, 2> vr = un ? std::array{'U', 'N'} : one.is_sequence ? one.vr : one.file_vr;
    out_.append(vr.data(), 2);
    if (has_short_length(vr)) {
      CHECK(length <= 0xFFFF);
      return put_u16(length, format.big_endian);
    }
    put_u16(0, false);
    put_u32(length, format.big_endian);
  }

  void element(const DicomElement& one, DicomFormat format) {
    if (!one.is_sequence) {
      head(one, format, one.is_encapsulated ? kUndefined : static_cast<std::uint32_t>(one.value.size()));
      out_ += one.value;
      return;
    }
    if (one.items.empty()) return head(one, format, 0);
    head(one, format, kUndefined);
    const bool big = one.inside.big_endian;
    for (const DicomDataSet& item : one.items) {
      put_tag(kItem, big);
      put_u32(kUndefined, big);
      data_set(item, one.inside);
      put_tag(kItemEnd, big);
      put_u32(0, big);
    }
    put_tag(kSequenceEnd, big);
    put_u32(0, big);
  }

  std::string& out_;
};

}  // namespace

void DicomElement::set(const char* new_vr, std::string new_value) {
  vr = {new_vr[0], new_vr[1]};
  file_vr = vr;
  is_sequence = is_encapsulated = false;
  items.clear();
  if (new_value.size() % 2 != 0) new_value += is("UI") || is("OB") || is("UN") ? '\0' : ' ';
  made = std::move(new_value);
  value = made;
  is_made_ = true;
}

std::string DicomElement::text() const {
  const auto blank = [](char c) { return c == ' ' || c == '\0'; };
  std::string_view rest = value;
  while (!rest.empty() && blank(rest.back())) rest.remove_suffix(1);
  while (!rest.empty() && blank(rest.front())) rest.remove_prefix(1);
  return std::string(rest);
}

DicomElement& DicomElement::operator=(DicomElement&& other) noexcept {
  tag = other.tag;
  vr = other.vr;
  file_vr = other.file_vr;
  is_sequence = other.is_sequence;
  is_encapsulated = other.is_encapsulated;
  is_made_ = other.is_made_;
  made = std::move(other.made);
  value = is_made_ ? std::string_view(made) : other.value;
  items = std::move(other.items);
  inside = other.inside;
  return *this;
}

std::string dictionary_vr(DicomTag tag) {
  const gdcm::DictEntry& entry = gdcm::Global::GetInstance().GetDicts().GetPublicDict().GetDictEntry(
      gdcm::Tag(static_cast<std::uint16_t>(tag >> 16), static_cast<std::uint16_t>(tag & 0xFFFF)));
  const gdcm::VR vr = entry.GetVR();
  switch (static_cast<gdcm::VR::VRType>(vr)) {
    case gdcm::VR::INVALID:
    case gdcm::VR::UN:
      return {};
    case gdcm::VR::US_SS:
    case gdcm::VR::US_SS_OW:
    case gdcm::VR::US_OW:
      return "US";
    case gdcm::VR::OB_OW:
      return "OW";
    default:
      return std::string(gdcm::VR::GetVRString(vr)).substr(0, 2);
  }
}

base::Result<DicomDataSet> read_data_set(std::string_view bytes, DicomFormat format) {
  return Reader(bytes).whole(format);
}

std::string bytes_of(const DicomDataSet& data_set, DicomFormat format) {
  std::string out;
  Writer(out).data_set(data_set, format);
  return out;
}

}  // namespace seldinger::casedb
