#include "casedb/import/dicom/dicom_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "casedb/import/dicom/allow_list.h"
#include "casedb/import/files/byte_count.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/jail/unpacking.h"
#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

constexpr std::uint64_t kHeaderOfLarge = 1 << 24;  // of a larger file, to tell what it is
constexpr std::size_t kLongestValue = 1024;
constexpr std::size_t kMostFrames = 8192, kMostFragments = 1 << 20;
constexpr std::uint32_t kUndefined = 0xFFFFFFFFU;
constexpr int kDeepest = 128;  // nested sequences
constexpr DicomTag kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD, kPixels = 0x7FE00010,
                   kSharedGroups = 0x52009229, kFrameGroups = 0x52009230;

constexpr std::array<DicomTag, 41> kWanted = {
    0x00020002, 0x00020010,                          // SOP class of the file (a DICOMDIR has no other), syntax
    0x00080008, 0x00080016, 0x00080060, 0x00089007,  // image type, SOP class, modality, frame type
    0x0008103E,                                      // series description: searched for words (image_kind.h)
    0x00089206, 0x00089207,                          // volumetric properties, volume based calculation
    0x00100010, 0x00100020, 0x00100030, 0x0020000D,  // name, patient ID, birth date, study: all of one?
    0x00180015, 0x00180050, 0x00180060, 0x00185100,  // body part, slice thickness, kVp, patient position
    0x0020000E, 0x00200011, 0x00200032, 0x00200037,  // series UID and number, position, orientation
    0x00280002, 0x00280004, 0x00280008, 0x00280010,
    0x00280011, 0x00280030,                          // samples, photometric, frames, size, spacing
    0x00280100, 0x00280101, 0x00280102, 0x00280103,  // bits allocated, stored, high, sign
    0x00280120, 0x00280121,                          // padding
    0x00280301, 0x00281052, 0x00281053, 0x00281054,  // burned in; intercept, slope, type
    0x00282110, 0x00282112, 0x00283000, 0x00420011,  // lossy, its ratio; modality LUT; encapsulated document
};
// The macros of PS3.3 §C.7.6.16.2 and §C.8.15.3 that hold wanted elements: frame content type, measures, plane
// position, plane orientation, pixel value transformation.
constexpr std::array<DicomTag, 5> kMacros = {0x00189329, 0x00289110, 0x00209113, 0x00209116, 0x00289145};

template <std::size_t N>
bool is_among(DicomTag tag, const std::array<DicomTag, N>& tags) {
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

bool is_wanted(DicomTag tag) {
  return is_among(tag, kWanted) || is_on_allow_list(tag);
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

// Where the walk stands, and where wanted values go.
enum class Place { data_set, groups, macro, elsewhere };
struct Scope {
  Place place = Place::elsewhere;
  DicomValues* into = nullptr;
};

class Walk {
 public:
  Walk(DicomFile& file, std::size_t at, Format format) : file_(file), at_(at), format_(format) {}

  std::size_t at() const noexcept { return at_; }

  void meta_group() {
    const std::size_t end = file_.bytes.size();
    Element element;
    while (end - at_ >= 8 && u16(at_) == 0x0002)
      if (!head(element, end) || !value(element, {Place::data_set, &file_.values}, 0, end)) return;
    if (end - at_ < 8) file_.state = DicomState::truncated;
  }

  void data_set() { content({Place::data_set, &file_.values}, 0, file_.bytes.size(), false); }

 private:
  unsigned byte(std::size_t where) const noexcept { return std::to_integer<unsigned>(file_.bytes[where]); }
  char letter(std::size_t where) const noexcept { return static_cast<char>(file_.bytes[where]); }
  std::uint32_t u16(std::size_t where) const noexcept {
    return format_.big_endian ? byte(where) << 8 | byte(where + 1) : byte(where + 1) << 8 | byte(where);
  }
  std::uint32_t u32(std::size_t where) const noexcept {
    return format_.big_endian ? u16(where) << 16 | u16(where + 2) : u16(where + 2) << 16 | u16(where);
  }

  bool stop(DicomState state) {
    file_.state = state;
    return false;
  }
  // Something does not fit before `end`: the file is cut, or a length within it lies.
  bool too_short(std::size_t end) {
    return stop(end == file_.bytes.size() ? DicomState::truncated : DicomState::damaged);
  }

  // Reads tag, VR and length, and stands on the value afterwards.
  bool head(Element& element, std::size_t end) {
    if (end - at_ < 8) return too_short(end);
    element = {};
    element.tag = u16(at_) << 16 | u16(at_ + 2);
    const bool has_vr = format_.explicit_vr && (element.tag >> 16) != 0xFFFE && base::is_capital(letter(at_ + 4)) &&
                        base::is_capital(letter(at_ + 5));
    if (!has_vr) {  // also where a writer forgot one: a length that does not fit ends the walk
      element.length = u32(at_ + 4);
      at_ += 8;
      return true;
    }
    element.vr = {letter(at_ + 4), letter(at_ + 5)};
    static constexpr std::array<const char*, 13> kLong = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                          "SV", "UC", "UN", "UR", "UT", "UV"};
    if (std::none_of(kLong.begin(), kLong.end(), [&](const char* vr) { return element.is(vr); })) {
      element.length = u16(at_ + 6);
      at_ += 8;
      return true;
    }
    if (end - at_ < 12) return too_short(end);
    element.length = u32(at_ + 8);
    at_ += 12;
    return true;
  }

  // Elements up to `end`, or up to an item's end when its length is undefined.
  bool content(Scope scope, int depth, std::size_t end, bool undefined) {
    while (undefined || at_ < end) {
      Element element;
      if (!head(element, end)) return false;
      if (undefined && element.tag == kItemEnd) return true;
      if ((element.tag >> 16) == 0xFFFE) return stop(DicomState::damaged);
      if (scope.place == Place::data_set && element.tag == kPixels) return pixels(element);
      if (scope.place == Place::data_set && (element.tag & 0xFFFF) != 0)  // group lengths say nothing
        file_.tags.push_back(element.tag);
      if (!value(element, scope, depth, end)) return false;
    }
    return true;
  }

  static bool leads_on(DicomTag tag, Place place) {
    return place == Place::data_set ? tag == kSharedGroups || tag == kFrameGroups
                                    : place == Place::groups && is_among(tag, kMacros);
  }

  bool value(const Element& element, Scope scope, int depth, std::size_t end) {
    const bool undefined = element.length == kUndefined;
    if (!undefined && element.length > end - at_) return too_short(end);
    if (undefined || leads_on(element.tag, scope.place)) return items(element, scope, depth, end);
    if (scope.into != nullptr && scope.place != Place::groups && is_wanted(element.tag))
      (*scope.into)[element.tag] = {
          element.vr, element.length <= kLongestValue
                          ? std::string(reinterpret_cast<const char*>(file_.bytes.data()) + at_, element.length)
                          : std::string()};
    at_ += element.length;
    return true;
  }

  // The items of a sequence; PS3.5 §7.5.
  bool items(const Element& sequence, Scope scope, int depth, std::size_t end) {
    const bool undefined = sequence.length == kUndefined;
    const bool may_nest = sequence.vr[0] == 0 || sequence.is("SQ") || sequence.is("UN");
    if (depth > kDeepest || !may_nest) return stop(DicomState::damaged);
    const Format outer = format_;
    if (sequence.is("UN")) format_ = {false, false};  // PS3.5 §6.2.2 note: implicit little endian inside
    if (scope.place == Place::data_set && is_wanted(sequence.tag)) file_.values[sequence.tag] = {};
    const std::size_t stop_at = undefined ? end : at_ + sequence.length;
    bool good = true;
    while (good && (undefined || at_ < stop_at)) {
      Element item;
      good = head(item, stop_at);
      if (!good || (undefined && item.tag == kSequenceEnd)) break;
      const bool open = item.length == kUndefined;
      if (item.tag != kItem)
        good = stop(DicomState::damaged);
      else if (!open && item.length > stop_at - at_)
        good = too_short(stop_at);
      else if (const auto inner = scope_of_item(sequence.tag, scope); !inner)
        good = stop(DicomState::damaged);
      else if (!open && inner->place == Place::elsewhere)
        at_ += item.length;
      else
        good = content(*inner, depth + 1, open ? stop_at : at_ + item.length, open);
    }
    format_ = outer;
    return good;
  }

  std::optional<Scope> scope_of_item(DicomTag sequence, Scope outer) {
    if (!leads_on(sequence, outer.place)) return Scope{};
    if (outer.place == Place::groups) return Scope{Place::macro, outer.into};
    if (sequence == kSharedGroups) return Scope{Place::groups, &file_.shared};
    if (file_.frames.size() == kMostFrames) return std::nullopt;
    return Scope{Place::groups, &file_.frames.emplace_back()};
  }

  bool pixels(const Element& element) {
    file_.has_pixels = true;
    const std::size_t end = file_.bytes.size();
    if (element.length != kUndefined) {
      const std::size_t length = std::min<std::size_t>(element.length, end - at_);
      file_.pixels_cut = length < element.length;
      file_.pixel_pieces.emplace_back(at_, length);
      at_ += length;
      return true;
    }
    file_.encapsulated = true;
    bool offset_table = true;
    for (;;) {
      Element item;
      if (end - at_ < 8) {
        file_.pixels_cut = true;
        return true;
      }
      if (!head(item, end)) return false;
      if (item.tag == kSequenceEnd) return true;
      if (item.tag != kItem || item.length == kUndefined) return stop(DicomState::damaged);
      if (item.length > end - at_) {
        file_.pixels_cut = true;
        return true;
      }
      if (offset_table) {
        if (item.length / 4 > kMostFrames) return stop(DicomState::damaged);
        for (std::size_t i = 0; i + 4 <= item.length; i += 4) file_.offset_table.push_back(u32(at_ + i));
      } else {
        if (file_.pixel_pieces.size() == kMostFragments) return stop(DicomState::damaged);
        file_.pixel_pieces.emplace_back(at_, item.length);
      }
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

// A file without preamble, as old tools wrote it: it begins with the meta group,
bool is_bare_meta_group(const char* bytes, std::size_t size) noexcept {
  return size >= 16 && bytes[0] == 2 && bytes[1] == 0 && bytes[3] == 0 && base::is_capital(bytes[4]) &&
         base::is_capital(bytes[5]);
}

// or at once with the data set, little endian, in group 8.
bool is_bare_data_set(const char* bytes, std::size_t size) noexcept {
  if (size < 16 || bytes[0] != 8 || bytes[1] != 0) return false;
  if (base::is_capital(bytes[4]) && base::is_capital(bytes[5])) return true;
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

// Replaces the packed file by its data set. Counted before it is kept, so that a bomb never lies in memory.
DicomState unpack_data_set(const std::filesystem::path& path, std::size_t at, DicomFile& file) {
  const std::uint64_t limit = most_unpacked(kDicomDataSet, file.bytes.size());
  file.bytes = {};
  const PackedBytes packed{path, at, UINT64_MAX, limit, Packing::deflate};
  const Unpacked counted = unpack(packed);
  if (counted.size > limit) return DicomState::bomb;
  if (counted.state != ByteState::complete)
    return counted.state == ByteState::too_few ? DicomState::truncated : DicomState::damaged;
  announce_largest(counted.size);
  file.bytes.reserve(counted.size);
  const Unpacked done = unpack(packed, [&](std::span<const std::byte> piece) {
    file.bytes.insert(file.bytes.end(), piece.begin(), piece.end());
  });
  return done.state == ByteState::complete ? DicomState::whole : DicomState::damaged;
}

// The 8 bytes of a floating point value of VR FD or OD, 4 of FL or OF; whole numbers of 2 and 4 bytes.
std::optional<double> binary_number(const DicomValue& value, bool big_endian) {
  const auto is = [&](const char* vr) { return value.vr[0] == vr[0] && value.vr[1] == vr[1]; };
  std::array<char, 8> bytes{};
  const std::size_t size = is("FD") ? 8 : is("FL") || is("UL") || is("SL") ? 4 : is("US") || is("SS") ? 2 : 0;
  if (size == 0 || value.bytes.size() != size) return std::nullopt;
  std::copy_n(value.bytes.begin(), size, bytes.begin());
  if (big_endian) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  const auto as = [&](auto number) {
    std::memcpy(&number, bytes.data(), sizeof(number));
    return static_cast<double>(number);
  };
  return is("FD")   ? as(double{})
         : is("FL") ? as(float{})
         : is("UL") ? as(std::uint32_t{})
         : is("SL") ? as(std::int32_t{})
         : is("US") ? as(std::uint16_t{})
                    : as(std::int16_t{});
}

bool is_text_of_numbers(const DicomValue& value) {
  const std::string vr(value.vr.data(), 2);
  return vr == "IS" || vr == "DS" || vr == "LO" || vr == "SH" || vr == "CS" || vr == "ST" || vr == "LT";
}

std::vector<double> numbers_in(const std::string& all) {
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

}  // namespace

bool looks_like_dicom(const char* bytes, std::size_t size) noexcept {
  return has_preamble(bytes, size) || is_bare_meta_group(bytes, size) || is_bare_data_set(bytes, size);
}

DicomFile read_dicom_file(const std::filesystem::path& path) {
  DicomFile file;
  if (const auto start = read_bytes(path, 0, 132);
      !start || !looks_like_dicom(reinterpret_cast<const char*>(start->data()), start->size()))
    return file;
  const bool too_large = file_size_bytes(path) > kLargestDicomFile;
  auto whole = read_bytes(path, 0, too_large ? kHeaderOfLarge : kLargestDicomFile);
  file.state = whole ? DicomState::whole : DicomState::damaged;
  if (!whole) return file;
  file.bytes = std::move(*whole);
  const auto letter = [&](std::size_t at) { return static_cast<char>(file.bytes[at]); };
  std::size_t at = 0;
  const char* begin = reinterpret_cast<const char*>(file.bytes.data());
  const bool preamble = has_preamble(begin, file.bytes.size());
  if (preamble || is_bare_meta_group(begin, file.bytes.size())) {
    Walk meta(file, preamble ? 132 : 0, {true, false});
    meta.meta_group();
    if (file.state != DicomState::whole) return file;
    at = meta.at();
    file.transfer_syntax = file.text(0x00020010);
    if (file.transfer_syntax.empty()) file.transfer_syntax = "1.2.840.10008.1.2";  // PS3.10: the default
  } else {
    file.transfer_syntax =
        base::is_capital(letter(4)) && base::is_capital(letter(5)) ? "1.2.840.10008.1.2.1" : "1.2.840.10008.1.2";
  }
  if (file.transfer_syntax == "1.2.840.10008.1.2.1.99") {
    file.state = unpack_data_set(path, at, file);
    if (file.state != DicomState::whole) return file;
    at = 0;
  }
  file.big_endian = file.transfer_syntax == "1.2.840.10008.1.2.2";
  // Two capitals where an implicit length stands would promise 16 kB at least for the first, short element; so what
  // stands there decides, not the promise.
  const bool explicit_vr =
      file.bytes.size() - at < 6 ? true : base::is_capital(letter(at + 4)) && base::is_capital(letter(at + 5));
  file.wrong_syntax = file.bytes.size() - at >= 6 && explicit_vr == (file.transfer_syntax == "1.2.840.10008.1.2");
  Walk(file, at, {explicit_vr, file.big_endian}).data_set();
  if (too_large) file.state = DicomState::too_large;
  return file;
}

DicomFile frame_header(const DicomFile& file, std::size_t frame) {
  DicomFile header;
  header.state = file.state;
  header.transfer_syntax = file.transfer_syntax;
  header.big_endian = file.big_endian;
  header.wrong_syntax = file.wrong_syntax;
  header.values = file.frames[frame];
  header.values.insert(file.shared.begin(), file.shared.end());  // insert keeps what is there
  header.values.insert(file.values.begin(), file.values.end());
  return header;
}

std::string DicomFile::text(DicomTag tag) const {
  const auto found = values.find(tag);
  return found == values.end() ? std::string() : trimmed(found->second.bytes);
}

std::vector<double> DicomFile::numbers(DicomTag tag) const {
  const auto found = values.find(tag);
  if (found == values.end()) return {};
  if (const auto number = binary_number(found->second, big_endian))
    return std::isfinite(*number) ? std::vector<double>{*number} : std::vector<double>{};
  return numbers_in(trimmed(found->second.bytes));
}

std::optional<int> DicomFile::unsigned_short(DicomTag tag) const {
  const auto found = values.find(tag);
  if (found == values.end() || found->second.bytes.size() < 2) return std::nullopt;
  const DicomValue& value = found->second;
  std::optional<double> number = binary_number(value, big_endian);
  if (!number && is_text_of_numbers(value)) {
    const auto numbers = numbers_in(trimmed(value.bytes));
    if (numbers.size() != 1) return std::nullopt;
    number = numbers.front();
  }
  if (number) {
    if (!(*number >= -32768.0 && *number <= 65535.0) || *number != std::floor(*number)) return std::nullopt;
    return static_cast<int>(*number) & 0xFFFF;
  }
  const int first = static_cast<unsigned char>(value.bytes[0]), second = static_cast<unsigned char>(value.bytes[1]);
  return big_endian ? first << 8 | second : second << 8 | first;
}

}  // namespace seldinger::casedb
