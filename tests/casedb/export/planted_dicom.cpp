#include "tests/casedb/export/planted_dicom.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <unordered_map>

#include "casedb/import/dicom/dicom_file.h"
#include "casedb/import/privacy/basic_profile.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

template <typename... T>
std::string format(const char* text, T... values) {
  std::array<char, 128> out;
  std::snprintf(out.data(), out.size(), text, values...);
  return out.data();
}

std::string u16(unsigned value) {
  return {static_cast<char>(value & 0xFF), static_cast<char>(value >> 8 & 0xFF)};
}
std::string u32(unsigned value) {
  return u16(value & 0xFFFF) + u16(value >> 16);
}

bool is_one_of(const std::string& vr, std::initializer_list<const char*> list) {
  return std::any_of(list.begin(), list.end(), [&](const char* one) { return vr == one; });
}

std::size_t word_size(const std::string& vr) {
  if (is_one_of(vr, {"US", "SS", "OW", "AT"})) return 2;
  if (is_one_of(vr, {"UL", "SL", "FL", "OF", "OL"})) return 4;
  if (is_one_of(vr, {"FD", "OD", "OV", "SV", "UV"})) return 8;
  return 1;
}

class Writer {
 public:
  Writer(bool explicit_vr, bool big) : explicit_vr_(explicit_vr), big_(big) {}

  std::string set(const PlantedSet& elements) {
    std::string out;
    for (const PlantedElement& one : elements) out += element(one);
    return out;
  }

 private:
  std::string swapped(std::string bytes, std::size_t word) const {
    if (big_)
      for (std::size_t at = 0; at + word <= bytes.size(); at += word)
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
                     bytes.begin() + static_cast<std::ptrdiff_t>(at + word));
    return bytes;
  }
  std::string tag(std::uint32_t t) const { return swapped(u16(t >> 16), 2) + swapped(u16(t & 0xFFFF), 2); }
  std::string number(unsigned n) const { return swapped(u32(n), 4); }

  std::string element(const PlantedElement& one) {
    std::string value = swapped(one.value, word_size(one.vr));
    const bool fragments = one.vr == "!!";  // pixels as items
    bool open = fragments;
    if (one.vr == "SQ") {
      // Half of the sequences and items with lengths, half with delimiters.
      open = one.tag % 2 == 0;
      value.clear();
      for (const PlantedSet& item : one.items) {
        const std::string bytes = set(item);
        const bool open_item = bytes.size() % 4 == 0;
        value += tag(0xFFFEE000) + number(open_item ? 0xFFFFFFFFU : static_cast<unsigned>(bytes.size())) + bytes;
        if (open_item) value += tag(0xFFFEE00D) + number(0);
      }
      if (open) value += tag(0xFFFEE0DD) + number(0);
    }
    const std::string vr = fragments ? "OB" : one.vr;
    const unsigned length = open ? 0xFFFFFFFFU : static_cast<unsigned>(value.size());
    if (!explicit_vr_) return tag(one.tag) + number(length) + value;
    const bool is_long =
        is_one_of(vr, {"OB", "OD", "OF", "OL", "OV", "OW", "SQ", "SV", "UC", "UN", "UR", "UT", "UV"});
    if (is_long) return tag(one.tag) + vr + std::string(2, '\0') + number(length) + value;
    return tag(one.tag) + vr + swapped(u16(length), 2) + value;
  }

  bool explicit_vr_, big_;
};

void add(PlantedSet& set, std::uint32_t tag, const std::string& vr, std::string value) {
  if (value.size() % 2 != 0) value += vr == "UI" ? '\0' : ' ';
  std::erase_if(set, [&](const PlantedElement& one) { return one.tag == tag; });
  set.push_back({tag, vr, std::move(value)});
}

class Planter {
 public:
  explicit Planter(Planted& planted) : planted_(planted) {}

  // Every element of the table, at one level.
  void table(PlantedSet& into) {
    for (const ProfileRow& row : basic_profile()) {
      if (row.mask != kWholeTag || (row.tag >> 16) == 0x0002) continue;
      std::string vr = !row.vr.empty() ? row.vr : row.action == ProfileAction::new_uids ? "UI" : "LO";
      PlantedElement made{row.tag, vr, {}};
      if (vr == "SQ")
        made.items = {{one(0x00081155, "UI"), one(0x00100010, "PN"), one(0x00100020, "LO")},
                      {one(0x00104000, "LT")}};
      else
        made = one(row.tag, vr);
      into.push_back(std::move(made));
    }
  }
  void private_block(PlantedSet& into) {
    into.push_back(one(0x00090010, "LO"));
    into.push_back(one(0x00091001, "PN"));
    into.push_back(one(0x00091002, "UN"));
    into.push_back({0x00091003, "SQ", {}, {{one(0x00100010, "PN")}}});
    into.push_back(one(0x00110010, "LO"));
    into.push_back(one(0x00111010, "DA"));
  }
  void overlays(PlantedSet& into) {
    for (const std::uint32_t group : {0x5000U, 0x5002U}) into.push_back(one(group << 16 | 0x2500, "LO"));
    for (const std::uint32_t group : {0x6000U, 0x6002U, 0x60FEU}) {
      into.push_back(one(group << 16 | 0x0022, "LO"));
      into.push_back(one(group << 16 | 0x1500, "LO"));
      into.push_back(one(group << 16 | 0x3000, "OB"));
      into.push_back(one(group << 16 | 0x4000, "LT"));
    }
  }
  PlantedElement one(std::uint32_t tag, const std::string& vr) {
    std::string identifier;
    PlantedElement made{tag, vr, planted_value(vr, next_++, identifier)};
    if (!identifier.empty()) planted_.identifiers.push_back(identifier);
    return made;
  }

 private:
  Planted& planted_;
  int next_ = 1;
};

std::string rle(const std::string& words) {
  std::array<std::string, 2> segments;  // high bytes, low bytes: PS3.5 Annex G
  for (std::size_t half = 0; half < 2; ++half) {
    std::string plane;
    for (std::size_t i = 1 - half; i < words.size(); i += 2) plane += words[i];
    for (std::size_t at = 0; at < plane.size(); at += 128) {
      const std::string run = plane.substr(at, 128);
      segments[half] += static_cast<char>(run.size() - 1) + run;
    }
    if (segments[half].size() % 2 != 0) segments[half] += '\0';
  }
  std::string header = u32(2) + u32(64) + u32(static_cast<unsigned>(64 + segments[0].size()));
  header.resize(64, '\0');
  return header + segments[0] + segments[1];
}

std::string items(const std::vector<std::string>& fragments) {
  std::string out = u16(0xFFFE) + u16(0xE000) + u32(0);
  for (std::string fragment : fragments) {
    if (fragment.size() % 2 != 0) fragment += '\0';
    out += u16(0xFFFE) + u16(0xE000) + u32(static_cast<unsigned>(fragment.size())) + fragment;
  }
  return out + u16(0xFFFE) + u16(0xE0DD) + u32(0);
}

// A disc of tissue in air, 40 x 40 pixels of 4 mm.
void own_picture(PlantedSet& set, int slice, PlantedSyntax syntax) {
  constexpr int kSide = 40;
  std::string words;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const bool tissue = (x - 20) * (x - 20) + (y - 20) * (y - 20) < 200;
      words += u16(static_cast<unsigned>(tissue ? 1064 + slice : 24));
    }
  add(set, 0x00280010, "US", u16(kSide));
  add(set, 0x00280011, "US", u16(kSide));
  add(set, 0x00280030, "DS", "4\\4");
  add(set, 0x00280100, "US", u16(16));
  add(set, 0x00280101, "US", u16(16));
  add(set, 0x00280102, "US", u16(15));
  add(set, 0x00280103, "US", u16(1));
  if (syntax == PlantedSyntax::rle)
    set.push_back({0x7FE00010, "!!", items({rle(words)})});
  else
    add(set, 0x7FE00010, "OW", words);
}

// The pixels of a real slice in JPEG 2000.
void borrowed_picture(PlantedSet& set) {
  const DicomFile file = read_dicom_file(fixtures::shared_data_dir() / "dicom-samples/chest_j2k_lossless.dcm");
  ASSERT_FALSE(file.pixel_pieces.empty());
  for (const std::uint32_t tag : {0x00280010U, 0x00280011U, 0x00280100U, 0x00280101U, 0x00280102U, 0x00280103U})
    add(set, tag, "US", file.values.at(tag).bytes);
  add(set, 0x00280030, "DS", file.values.at(0x00280030).bytes);
  std::vector<std::string> fragments;
  for (const auto& [offset, length] : file.pixel_pieces)
    fragments.emplace_back(reinterpret_cast<const char*>(file.bytes.data()) + offset, length);
  set.push_back({0x7FE00010, "!!", items(fragments)});
}

}  // namespace

std::string planted_value(const std::string& vr, int n, std::string& identifier) {
  std::string value;
  if (vr == "DA")
    identifier = value = format("18%02d%02d%02d", n / 300 % 100, 1 + n % 300 / 25, 1 + n % 25);
  else if (vr == "TM")
    identifier = value = format("172931.%06d", n);
  else if (vr == "DT")
    identifier = value = format("18350607172931.%06d", n);
  else if (vr == "AS")
    value = "077Y";  // too short to be searched for
  else if (vr == "DS")
    identifier = value = format("75319.%06d", n);
  else if (vr == "IS")
    identifier = value = format("86427%06d", n);
  else if (vr == "UI")
    identifier = value = format("1.2.999.7531.864.%d.1", n);
  else if (vr == "UR")
    identifier = value = format("http://plnt.example/%05d", n);
  else if (vr == "CS" || vr == "AE" || vr == "SH")
    identifier = value = format("PLNT%s%05d", vr.c_str(), n);
  else if (vr == "PN")
    identifier = format("Plantedname%05d", n), value = identifier + "^Given";
  else if (is_one_of(vr, {"LO", "LT", "ST", "UC", "UT", "UN"}))
    identifier = format("Planted text %05d", n), value = identifier + " of a person";
  else if (vr == "OB")
    identifier = value = format("PLNTBYTES%05d", n);
  else if (vr != "SQ")
    value = std::string(word_size(vr) * (vr == "AT" ? 2 : 1), '\x11');  // numbers
  if (value.size() % 2 != 0) value += vr == "UI" || vr == "OB" ? '\0' : ' ';
  return value;
}

Planted planted_slice(int slice, PlantedSyntax syntax) {
  Planted planted;
  Planter plant(planted);
  PlantedSet& top = planted.elements;
  plant.table(top);
  plant.private_block(top);
  plant.overlays(top);
  PlantedSet third;
  plant.table(third);
  plant.private_block(third);
  PlantedSet second;
  plant.table(second);
  second.push_back({0x00209113, "SQ", {}, {third}});  // plane position
  PlantedSet first;
  plant.table(first);
  plant.overlays(first);
  first.push_back({0x00209116, "SQ", {}, {second, {}}});  // plane orientation
  top.push_back({0x52009229, "SQ", {}, {first}});         // shared functional groups
  // A name where the table leaves text alone, in elements of the case's allow-list.
  std::string name;
  for (const PlantedElement& one : top)
    if (one.tag == 0x00100010) name = one.value.substr(0, one.value.find('^'));
  add(top, 0x00181210, "SH", name.substr(0, 16));
  add(top, 0x00080070, "LO", "Maker of " + name);
  add(top, 0x00180022, "CS", "planted " + name);  // and no CS
  planted.identifiers.push_back(name.substr(0, 16));

  add(top, 0x00080008, "CS", "ORIGINAL\\PRIMARY\\AXIAL");
  add(top, 0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.2");
  add(top, 0x00080018, "UI", format("1.2.999.4444.%d", slice));
  add(top, 0x00080060, "CS", "CT");
  add(top, 0x00180050, "DS", "3");
  add(top, 0x00180060, "DS", "120");
  add(top, 0x0020000D, "UI", "1.2.999.2222");
  add(top, 0x0020000E, "UI", "1.2.999.3333");
  add(top, 0x00200011, "IS", "1");
  add(top, 0x00200013, "IS", std::to_string(slice + 1));
  add(top, 0x00200032, "DS", format("-80\\-80\\%d", 3 * slice));
  add(top, 0x00200037, "DS", "1\\0\\0\\0\\1\\0");
  add(top, 0x00280002, "US", u16(1));
  add(top, 0x00280004, "CS", "MONOCHROME2");
  add(top, 0x00281052, "DS", "-1024");
  add(top, 0x00281053, "DS", "1");
  if (syntax == PlantedSyntax::j2k)
    borrowed_picture(top);
  else
    own_picture(top, slice, syntax);
  for (const char* uid : {"1.2.999.4444", "1.2.999.2222", "1.2.999.3333"}) planted.identifiers.emplace_back(uid);
  std::sort(top.begin(), top.end(), [](const PlantedElement& a, const PlantedElement& b) { return a.tag < b.tag; });
  return planted;
}

std::string pixels_of(const PlantedSet& elements) {
  return elements.back().tag == 0x7FE00010 ? elements.back().value
                                           : std::find_if(elements.begin(), elements.end(), [](const auto& one) {
                                               return one.tag == 0x7FE00010;
                                             })->value;
}

std::string planted_bytes(const PlantedSet& elements, PlantedSyntax syntax) {
  static const std::unordered_map<PlantedSyntax, std::string> kUids = {
      {PlantedSyntax::implicit_le, std::string("1.2.840.10008.1.2\0", 18)},
      {PlantedSyntax::explicit_le, std::string("1.2.840.10008.1.2.1\0", 20)},
      {PlantedSyntax::explicit_be, std::string("1.2.840.10008.1.2.2\0", 20)},
      {PlantedSyntax::deflated, "1.2.840.10008.1.2.1.99"},
      {PlantedSyntax::rle, std::string("1.2.840.10008.1.2.5\0", 20)},
      {PlantedSyntax::j2k, "1.2.840.10008.1.2.4.90"}};
  PlantedSet meta;
  add(meta, 0x00020001, "OB", std::string("\0\1", 2));
  add(meta, 0x00020002, "UI", "1.2.840.10008.5.1.4.1.1.2");
  add(meta, 0x00020003, "UI", "1.2.999.4444.77");
  add(meta, 0x00020010, "UI", kUids.at(syntax));
  add(meta, 0x00020016, "AE", "PLNTAE99999");
  const std::string group = Writer(true, false).set(meta);
  const std::string length =
      Writer(true, false).set({{0x00020000, "UL", u32(static_cast<unsigned>(group.size()))}});
  std::string data =
      Writer(syntax != PlantedSyntax::implicit_le, syntax == PlantedSyntax::explicit_be).set(elements);
  if (syntax == PlantedSyntax::deflated) {
    std::string packed(compressBound(data.size()), '\0');
    uLongf size = packed.size();
    EXPECT_EQ(compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(data.data()),
                       data.size()),
              Z_OK);
    data = packed.substr(2, size - 6);  // without zlib's head and check sum: PS3.5 §A.5
  }
  return "PLNTPREAMBLE" + std::string(116, '\0') + "DICM" + length + group + data;
}

std::vector<std::string> plant_series(const std::filesystem::path& folder, PlantedSyntax syntax) {
  std::filesystem::create_directories(folder);
  std::vector<std::string> identifiers;
  for (int slice = 0; slice < 3; ++slice) {
    const Planted planted = planted_slice(slice, syntax);
    if (slice == 0) identifiers = planted.identifiers;
    const std::string bytes = planted_bytes(planted.elements, syntax);
    std::ofstream out(folder / format("PLNTFILE^NAME^%d.dcm", slice), std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  }
  for (const char* more : {"PLNTFILE", "PLNTAE99999", "PLNTPREAMBLE"}) identifiers.emplace_back(more);
  return identifiers;
}

std::vector<std::string> survivors(const std::string& bytes, const std::vector<std::string>& identifiers) {
  const auto lower = [](std::string text) {
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    return text;
  };
  std::string low = lower(bytes), narrow;
  for (const char c : low)
    if (c != '\0') narrow += c;  // what UTF-16 leaves of ASCII
  // One pass: every identifier has a digit or letter window of 8 at its start.
  constexpr std::size_t kWindow = 8;
  std::unordered_multimap<std::string, std::string> by_start;
  for (const std::string& one : identifiers) {
    EXPECT_GE(one.size(), kWindow) << one;
    by_start.emplace(lower(one).substr(0, kWindow), lower(one));
  }
  std::vector<std::string> found;
  for (const std::string& text : {low, narrow})
    for (std::size_t at = 0; at + kWindow <= text.size(); ++at) {
      const auto [first, last] = by_start.equal_range(text.substr(at, kWindow));
      for (auto one = first; one != last; ++one)
        if (text.compare(at, one->second.size(), one->second) == 0) found.push_back(one->second);
    }
  return found;
}

}  // namespace seldinger::casedb
