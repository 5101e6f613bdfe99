#include "casedb/import/dicom_file.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>

#include "casedb/import/byte_count.h"

namespace seldinger::casedb {
namespace {

constexpr std::uint64_t kLargestFile = 1ULL << 30;  // a classic CT slice has 0.5 to 8 MB
constexpr std::uint32_t kUndefined = 0xFFFFFFFFU;
constexpr int kDeepest = 128;  // nested sequences of undefined length
constexpr DicomTag kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD, kPixels = 0x7FE00010;

constexpr std::array<DicomTag, 27> kWanted = {
    0x00020010,                                      // transfer syntax
    0x00080008, 0x00080016, 0x00080060,              // image type, SOP class, modality
    0x00180015, 0x00180050, 0x00180060, 0x00185100,  // body part, slice thickness, kVp, patient position
    0x0020000E, 0x00200011, 0x00200032, 0x00200037,  // series UID and number, position, orientation
    0x00280002, 0x00280004, 0x00280008, 0x00280010,
    0x00280011, 0x00280030,                          // samples, photometric, frames, size, spacing
    0x00280100, 0x00280101, 0x00280102, 0x00280103,  // bits allocated, stored, high, sign
    0x00280120, 0x00280121,                          // padding
    0x00281052, 0x00281053, 0x00281054,              // intercept, slope, type
};
constexpr std::array<DicomTag, 3> kWantedToo = {0x00280301, 0x00282110,
                                                0x00283000};  // burned in, lossy, modality LUT

bool is_wanted(DicomTag tag) {
  return std::find(kWanted.begin(), kWanted.end(), tag) != kWanted.end() ||
         std::find(kWantedToo.begin(), kWantedToo.end(), tag) != kWantedToo.end();
}

bool is_upper(char c) noexcept {
  return c >= 'A' && c <= 'Z';
}

struct Element {
  DicomTag tag = 0;
  std::array<char, 2> vr{};  // zeros where implicit
  std::uint32_t length = 0;
  bool is(const char* name) const noexcept { return vr[0] == name[0] && vr[1] == name[1]; }
};

struct Format {
  bool explicit_vr = true;
  bool big_endian = false;
};

class Walk {
 public:
  Walk(DicomFile& file, std::size_t at, Format format) : file_(file), at_(at), format_(format) {}

  std::size_t at() const noexcept { return at_; }

  void meta_group() {
    while (left() >= 8 && group_at(at_) == 0x0002)
      if (!element_of_data_set()) return;
    if (left() < 8) file_.state = DicomState::truncated;
  }

  void data_set() {
    while (left() > 0 && !file_.has_pixels)
      if (!element_of_data_set()) return;
  }

 private:
  std::size_t left() const noexcept { return file_.bytes.size() - at_; }
  unsigned byte(std::size_t where) const noexcept { return static_cast<unsigned char>(file_.bytes[where]); }
  std::uint32_t u16(std::size_t where) const noexcept {
    return format_.big_endian ? byte(where) << 8 | byte(where + 1) : byte(where + 1) << 8 | byte(where);
  }
  std::uint32_t u32(std::size_t where) const noexcept {
    return format_.big_endian ? u16(where) << 16 | u16(where + 2) : u16(where + 2) << 16 | u16(where);
  }
  std::uint32_t group_at(std::size_t where) const noexcept { return u16(where); }

  bool stop(DicomState state) {
    file_.state = state;
    return false;
  }

  // Reads tag, VR and length, and stands on the value afterwards.
  bool element_head(Element& element) {
    if (left() < 8) return stop(DicomState::truncated);
    element = {};
    element.tag = u16(at_) << 16 | u16(at_ + 2);
    const bool has_vr = format_.explicit_vr && (element.tag >> 16) != 0xFFFE;
    if (!has_vr) {
      element.length = u32(at_ + 4);
      at_ += 8;
      return true;
    }
    element.vr = {file_.bytes[at_ + 4], file_.bytes[at_ + 5]};
    if (!is_upper(element.vr[0]) || !is_upper(element.vr[1])) return stop(DicomState::damaged);
    static constexpr std::array<const char*, 13> kLong = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                          "SV", "UC", "UN", "UR", "UT", "UV"};
    if (std::none_of(kLong.begin(), kLong.end(), [&](const char* vr) { return element.is(vr); })) {
      element.length = u16(at_ + 6);
      at_ += 8;
      return true;
    }
    if (left() < 12) return stop(DicomState::truncated);
    element.length = u32(at_ + 8);
    at_ += 12;
    return true;
  }

  bool element_of_data_set() {
    Element element;
    if (!element_head(element)) return false;
    if ((element.tag >> 16) == 0xFFFE) return stop(DicomState::damaged);
    if (element.tag == kPixels) return pixels(element);
    if (element.length == kUndefined) return sequence(element, 0);
    if (element.length > left()) return stop(DicomState::truncated);
    if (is_wanted(element.tag) && element.length <= 1024)
      file_.values[element.tag] = std::string(file_.bytes.data() + at_, element.length);
    else if (is_wanted(element.tag))
      file_.values[element.tag] = std::string();
    at_ += element.length;
    return true;
  }

  // Passes over items until the sequence's end; PS3.5 §7.5.
  bool sequence(const Element& element, int depth) {
    if (depth > kDeepest) return stop(DicomState::damaged);
    const bool may_nest = !format_.explicit_vr || element.is("SQ") || element.is("UN");
    if (!may_nest) return stop(DicomState::damaged);
    const Format outer = format_;
    if (element.is("UN")) format_ = {false, false};  // PS3.5 §6.2.2 note: implicit little endian inside
    if (is_wanted(element.tag)) file_.values[element.tag] = std::string();
    bool good = true, open = true;
    while (good && open) {
      Element item;
      good = element_head(item);
      if (!good) break;
      if (item.tag == kSequenceEnd)
        open = false;
      else if (item.tag != kItem)
        good = stop(DicomState::damaged);
      else if (item.length == kUndefined)
        good = open_item(depth);
      else if (item.length > left())
        good = stop(DicomState::truncated);
      else
        at_ += item.length;
    }
    format_ = outer;
    return good;
  }

  bool open_item(int depth) {
    for (;;) {
      Element element;
      if (!element_head(element)) return false;
      if (element.tag == kItemEnd) return true;
      if (element.length == kUndefined) {
        if (!sequence(element, depth + 1)) return false;
      } else if (element.length > left()) {
        return stop(DicomState::truncated);
      } else {
        at_ += element.length;
      }
    }
  }

  bool pixels(const Element& element) {
    file_.has_pixels = true;
    if (element.length != kUndefined) {
      const std::size_t length = std::min<std::size_t>(element.length, left());
      file_.pixels_cut = length < element.length;
      file_.pixel_pieces.emplace_back(at_, length);
      at_ += length;
      return true;
    }
    file_.encapsulated = true;
    bool offset_table = true;
    for (;;) {
      Element item;
      if (left() < 8) {
        file_.pixels_cut = true;
        return true;
      }
      if (!element_head(item)) return false;
      if (item.tag == kSequenceEnd) return true;
      if (item.tag != kItem || item.length == kUndefined) return stop(DicomState::damaged);
      if (item.length > left()) {
        file_.pixels_cut = true;
        return true;
      }
      if (!offset_table) file_.pixel_pieces.emplace_back(at_, item.length);
      offset_table = false;
      at_ += item.length;
    }
  }

  DicomFile& file_;
  std::size_t at_;
  Format format_;
};

bool has_preamble(const char* bytes, std::size_t size) noexcept {
  return size >= 132 && std::memcmp(bytes + 128, "DICM", 4) == 0;
}

// A data set without preamble, as old tools wrote it: little endian, beginning in group 8.
bool is_bare_data_set(const char* bytes, std::size_t size) noexcept {
  if (size < 16 || bytes[0] != 8 || bytes[1] != 0) return false;
  if (is_upper(bytes[4]) && is_upper(bytes[5])) return true;
  std::uint32_t length = 0;
  for (int i = 3; i >= 0; --i) length = length << 8 | static_cast<unsigned char>(bytes[4 + i]);
  return length <= 1024;
}

std::string trimmed(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\0'; };
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return std::string(text);
}

}  // namespace

bool looks_like_dicom(const char* bytes, std::size_t size) noexcept {
  return has_preamble(bytes, size) || is_bare_data_set(bytes, size);
}

DicomFile read_dicom_file(const std::filesystem::path& path) {
  DicomFile file;
  if (const auto start = read_bytes(path, 0, 132);
      !start || !looks_like_dicom(reinterpret_cast<const char*>(start->data()), start->size()))
    return file;
  if (file_size_bytes(path) > kLargestFile) {
    file.state = DicomState::damaged;
    return file;
  }
  const auto whole = read_bytes(path, 0, kLargestFile);
  if (!whole) {
    file.state = DicomState::damaged;
    return file;
  }
  file.bytes.assign(reinterpret_cast<const char*>(whole->data()),
                    reinterpret_cast<const char*>(whole->data()) + whole->size());
  file.state = DicomState::whole;
  std::size_t at = 0;
  if (has_preamble(file.bytes.data(), file.bytes.size())) {
    Walk meta(file, 132, {true, false});
    meta.meta_group();
    if (file.state != DicomState::whole) return file;
    at = meta.at();
    file.transfer_syntax = file.text(0x00020010);
    if (file.transfer_syntax.empty()) file.transfer_syntax = "1.2.840.10008.1.2";  // PS3.10: the default
  } else {
    file.transfer_syntax =
        is_upper(file.bytes[4]) && is_upper(file.bytes[5]) ? "1.2.840.10008.1.2.1" : "1.2.840.10008.1.2";
  }
  if (file.transfer_syntax == "1.2.840.10008.1.2.1.99") {
    std::vector<std::byte> data_set;
    const Unpacked unpacked = unpack({path, at, UINT64_MAX, kLargestFile, Packing::deflate}, &data_set);
    if (unpacked.state != ByteState::complete) {
      file.state = unpacked.state == ByteState::too_few ? DicomState::truncated : DicomState::damaged;
      return file;
    }
    file.bytes.assign(reinterpret_cast<const char*>(data_set.data()),
                      reinterpret_cast<const char*>(data_set.data()) + data_set.size());
    at = 0;
  }
  file.big_endian = file.transfer_syntax == "1.2.840.10008.1.2.2";
  Walk(file, at, {file.transfer_syntax != "1.2.840.10008.1.2", file.big_endian}).data_set();
  return file;
}

std::string DicomFile::text(DicomTag tag) const {
  const auto found = values.find(tag);
  return found == values.end() ? std::string() : trimmed(found->second);
}

std::vector<double> DicomFile::numbers(DicomTag tag) const {
  const std::string all = text(tag);
  std::vector<double> numbers;
  std::size_t begin = 0;
  while (begin <= all.size() && !all.empty()) {
    const std::size_t end = std::min(all.find('\\', begin), all.size());
    std::string part = trimmed(std::string_view(all).substr(begin, end - begin));
    if (!part.empty() && part.front() == '+') part.erase(0, 1);
    double value = 0.0;
    const auto [stop, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc() || stop != part.data() + part.size() || !std::isfinite(value)) return {};
    numbers.push_back(value);
    begin = end + 1;
  }
  return numbers;
}

std::optional<int> DicomFile::unsigned_short(DicomTag tag) const {
  const auto found = values.find(tag);
  if (found == values.end() || found->second.size() < 2) return std::nullopt;
  const int first = static_cast<unsigned char>(found->second[0]);
  const int second = static_cast<unsigned char>(found->second[1]);
  return big_endian ? first << 8 | second : second << 8 | first;
}

}  // namespace seldinger::casedb
