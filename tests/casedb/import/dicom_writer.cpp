#include "tests/casedb/import/dicom_writer.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "tests/casedb/import/import_case.h"

namespace seldinger::casedb {
namespace {

std::string u16_bytes(unsigned value, bool big_endian) {
  const char low = static_cast<char>(value & 0xFF), high = static_cast<char>(value >> 8 & 0xFF);
  return big_endian ? std::string{high, low} : std::string{low, high};
}

std::string u32_bytes(unsigned value, bool big_endian) {
  return big_endian ? u16_bytes(value >> 16, true) + u16_bytes(value & 0xFFFF, true)
                    : u16_bytes(value & 0xFFFF, false) + u16_bytes(value >> 16, false);
}

std::string element_bytes(std::uint32_t tag, const std::string& vr, const std::string& value, bool explicit_vr,
                          bool big_endian) {
  const std::string head = u16_bytes(tag >> 16, big_endian) + u16_bytes(tag & 0xFFFF, big_endian);
  const auto length = static_cast<unsigned>(value.size());
  if (!explicit_vr || vr.empty()) return head + u32_bytes(length, big_endian) + value;
  if (vr == "OB" || vr == "OW" || vr == "SQ" || vr == "UN" || vr == "UT")
    return head + vr + std::string(2, '\0') + u32_bytes(length, big_endian) + value;
  return head + vr + u16_bytes(length, big_endian) + value;
}

std::string number_text(double value) {
  std::array<char, 32> text;
  std::snprintf(text.data(), text.size(), "%.10g", value);
  return text.data();
}

std::string deflated(const std::string& bytes) {
  // zlib's stream without its 2 bytes of head and 4 of check sum is the bare deflate stream of PS3.5 §A.5.
  const std::string stream = zlib_stream(bytes);
  return stream.substr(2, stream.size() - 6);
}

}  // namespace

TestDicom TestDicom::ct_slice(glm::ivec2 size, int first_value) {
  TestDicom file;
  const std::string planted = kPlanted;
  file.text(0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL").text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  file.text(0x00080060, "CS", "CT").text(0x00080080, "LO", planted + " hospital").text(0x00081030, "LO", planted);
  file.text(0x00100010, "PN", planted + "^NAME").text(0x00100020, "LO", planted);
  file.text(0x00180015, "CS", planted).text(0x00180050, "DS", "2.5").text(0x00180060, "DS", "120");
  file.text(0x00185100, "CS", "HFS").text(0x0020000E, "UI", "1.2.3.4").text(0x00200011, "IS", "7");
  file.at({0.0, 0.0, 0.0}).lying({1.0, 0.0, 0.0}, {0.0, 1.0, 0.0});
  file.u16(0x00280002, "US", 1).text(0x00280004, "CS", "MONOCHROME2");
  file.u16(0x00280010, "US", size.y).u16(0x00280011, "US", size.x).text(0x00280030, "DS", "0.5\\0.25");
  file.u16(0x00280100, "US", 16).u16(0x00280101, "US", 16).u16(0x00280102, "US", 15).u16(0x00280103, "US", 1);
  file.text(0x00281052, "DS", "0").text(0x00281053, "DS", "1").text(0x00281054, "LO", "HU");
  std::vector<int> stored;
  for (int i = 0; i < size.x * size.y; ++i) stored.push_back(first_value + i);
  return file.pixels(stored);
}

TestDicom& TestDicom::text(std::uint32_t tag, const char* vr, const std::string& value) {
  const char pad = std::string(vr) == "UI" ? '\0' : ' ';
  elements_[tag] = {vr, value.size() % 2 == 0 ? value : value + pad};
  return *this;
}

TestDicom& TestDicom::u16(std::uint32_t tag, const char* vr, int value) {
  elements_[tag] = {vr, u16_bytes(static_cast<unsigned>(value) & 0xFFFF, false), true};
  return *this;
}

TestDicom& TestDicom::raw(std::uint32_t tag, const char* vr, const std::string& little_endian_bytes) {
  elements_[tag] = {vr, little_endian_bytes};
  return *this;
}

TestDicom& TestDicom::sequence(std::uint32_t tag, const std::vector<TestDicom>& items, bool undefined_length) {
  elements_[tag] = {"SQ", "", false, items, undefined_length};
  return *this;
}

TestDicom& TestDicom::fragments(const std::string& syntax_uid, const std::vector<std::string>& pieces,
                                const std::vector<std::size_t>& frame_starts) {
  const auto item = [](const std::string& value) {
    return std::string("\xFE\xFF\x00\xE0", 4) + u32_bytes(static_cast<unsigned>(value.size()), false) + value;
  };
  std::string table, all;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (std::find(frame_starts.begin(), frame_starts.end(), i) != frame_starts.end())
      table += u32_bytes(static_cast<unsigned>(all.size()), false);
    all += item(pieces[i]);
  }
  elements_[0x7FE00010] = {"OB", item(table) + all, false, {}, true};
  syntax_uid_ = syntax_uid;
  return *this;
}

TestDicom& TestDicom::remove(std::uint32_t tag) {
  elements_.erase(tag);
  return *this;
}

TestDicom& TestDicom::at(const glm::dvec3& p) {
  return text(0x00200032, "DS", number_text(p.x) + "\\" + number_text(p.y) + "\\" + number_text(p.z));
}

TestDicom& TestDicom::lying(const glm::dvec3& row, const glm::dvec3& column) {
  std::string all;
  for (const double cosine : {row.x, row.y, row.z, column.x, column.y, column.z}) {
    if (!all.empty()) all += '\\';
    all += number_text(cosine);
  }
  return text(0x00200037, "DS", all);
}

TestDicom& TestDicom::pixels(const std::vector<int>& stored) {
  std::string bytes;
  for (const int value : stored) bytes += u16_bytes(static_cast<unsigned>(value) & 0xFFFF, false);
  elements_[0x7FE00010] = {"OW", bytes, true};
  return *this;
}

std::string TestDicom::data_set(bool explicit_vr, bool big_endian, const std::string& before_pixels) const {
  const std::string end_of_items =
      u16_bytes(0xFFFE, big_endian) + u16_bytes(0xE0DD, big_endian) + std::string(4, '\0');
  std::string data;
  for (const auto& [tag, element] : elements_) {
    if (tag == 0x7FE00010) data += before_pixels;
    std::string value = element.value;
    if (element.words && big_endian)
      for (std::size_t i = 0; i + 1 < value.size(); i += 2) std::swap(value[i], value[i + 1]);
    for (const TestDicom& item : element.items) {
      const std::string inner = item.data_set(explicit_vr, big_endian);
      value += u16_bytes(0xFFFE, big_endian) + u16_bytes(0xE000, big_endian);
      value += element.undefined_length
                   ? u32_bytes(0xFFFFFFFFU, big_endian) + inner + u16_bytes(0xFFFE, big_endian) +
                         u16_bytes(0xE00D, big_endian) + std::string(4, '\0')
                   : u32_bytes(static_cast<unsigned>(inner.size()), big_endian) + inner;
    }
    std::string bytes = element_bytes(tag, element.vr, value, explicit_vr, big_endian);
    if (element.undefined_length) {
      const std::size_t length_at = bytes.size() - value.size() - 4;
      bytes.replace(length_at, 4, u32_bytes(0xFFFFFFFFU, big_endian));
      bytes += end_of_items;
    }
    data += bytes;
  }
  return data;
}

std::string dicom_head(const std::string& syntax_uid, bool with_length) {
  const std::string uid = syntax_uid + (syntax_uid.size() % 2 == 0 ? "" : std::string(1, '\0'));
  const std::string meta = element_bytes(0x00020010, "UI", uid, true, false);
  const std::string length =
      element_bytes(0x00020000, "UL", u32_bytes(static_cast<unsigned>(meta.size()), false), true, false);
  return std::string(128, '\0') + "DICM" + (with_length ? length : "") + meta;
}

std::string TestDicom::bytes(TestSyntax syntax, const std::string& before_pixels) const {
  static const std::map<TestSyntax, std::string> kUids = {{TestSyntax::implicit_le, "1.2.840.10008.1.2"},
                                                          {TestSyntax::explicit_le, "1.2.840.10008.1.2.1"},
                                                          {TestSyntax::explicit_be, "1.2.840.10008.1.2.2"},
                                                          {TestSyntax::deflated, "1.2.840.10008.1.2.1.99"}};
  const std::string data =
      data_set(syntax != TestSyntax::implicit_le, syntax == TestSyntax::explicit_be, before_pixels);
  return dicom_head(syntax_uid_.empty() ? kUids.at(syntax) : syntax_uid_) +
         (syntax == TestSyntax::deflated ? deflated(data) : data);
}

TestDicom enhanced_ct(glm::ivec2 size, const std::vector<glm::dvec3>& places_lps_mm) {
  TestDicom file = TestDicom::ct_slice(size);
  file.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2.1");
  for (const std::uint32_t tag :
       {0x00200032U, 0x00200037U, 0x00280030U, 0x00281052U, 0x00281053U, 0x00281054U, 0x00180050U})
    file.remove(tag);
  file.text(0x00280008, "IS", std::to_string(places_lps_mm.size()));
  TestDicom shared;
  shared.sequence(0x00209116, {TestDicom().lying({1, 0, 0}, {0, 1, 0})});
  shared.sequence(0x00289110, {TestDicom().text(0x00280030, "DS", "0.5\\0.25").text(0x00180050, "DS", "2.5")});
  shared.sequence(
      0x00289145,
      {TestDicom().text(0x00281052, "DS", "0").text(0x00281053, "DS", "1").text(0x00281054, "LO", "HU")});
  file.sequence(0x52009229, {shared});
  std::vector<TestDicom> frames;
  std::vector<int> stored;
  for (std::size_t k = 0; k < places_lps_mm.size(); ++k) {
    frames.push_back(TestDicom().sequence(0x00209113, {TestDicom().at(places_lps_mm[k])}));
    for (int i = 0; i < size.x * size.y; ++i) stored.push_back(100 * static_cast<int>(k) + i);
  }
  return file.sequence(0x52009230, frames).pixels(stored);
}

std::string rle_frame(const std::vector<int>& stored) {
  std::array<std::string, 2> segments;  // the high bytes, the low bytes
  for (std::size_t at = 0; at < stored.size(); at += 128) {
    const std::size_t run = std::min<std::size_t>(128, stored.size() - at);
    for (std::string& segment : segments) segment.push_back(static_cast<char>(run - 1));
    for (std::size_t i = at; i < at + run; ++i) {
      segments[0].push_back(static_cast<char>(stored[i] >> 8 & 0xFF));
      segments[1].push_back(static_cast<char>(stored[i] & 0xFF));
    }
  }
  for (std::string& segment : segments)
    if (segment.size() % 2 != 0) segment.push_back('\x80');  // no operation
  std::string head =
      u32_bytes(2, false) + u32_bytes(64, false) + u32_bytes(static_cast<unsigned>(64 + segments[0].size()), false);
  head.resize(64, '\0');
  return head + segments[0] + segments[1];
}

}  // namespace seldinger::casedb
