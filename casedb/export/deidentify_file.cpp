#include <algorithm>
#include <cstring>
#include <optional>
#include <span>
#include <vector>

#include "casedb/export/clean_data_set.h"
#include "casedb/export/deidentify.h"
#include "casedb/export/dicom_tree.h"
#include "casedb/export/hidden_bits.h"
#include "casedb/import/dicom/dicom_file.h"
#include "casedb/import/files/byte_count.h"
#include "casedb/import/jail/jail.h"
#include "casedb/import/jail/unpacking.h"
#include "sim/base/ascii.h"

namespace seldinger::casedb {
namespace {

constexpr const char* kImplicitLittle = "1.2.840.10008.1.2";
constexpr const char* kExplicitLittle = "1.2.840.10008.1.2.1";
constexpr const char* kExplicitBig = "1.2.840.10008.1.2.2";
constexpr const char* kDeflated = "1.2.840.10008.1.2.1.99";
constexpr const char* kImplementation = "2.25.186426187302214861398342108473216748173";  // of this program

DicomElement* find(DicomDataSet& data_set, DicomTag tag) {
  const auto found =
      std::find_if(data_set.begin(), data_set.end(), [&](const DicomElement& one) { return one.tag == tag; });
  return found == data_set.end() ? nullptr : &*found;
}

std::string text_of(DicomDataSet& data_set, DicomTag tag) {
  const DicomElement* found = find(data_set, tag);
  return found == nullptr ? std::string() : found->text();
}

struct Parsed {
  std::vector<char> bytes;  // what `data_set` looks into, also when this is moved
  std::string sop_class, sop_instance, syntax;
  DicomFormat format;
  DicomDataSet data_set;
};

// The meta group at the file's start; returns where the data set begins.
base::Result<std::size_t> read_meta(std::string_view bytes, Parsed& parsed) {
  const std::size_t begin = bytes.size() >= 132 && std::memcmp(bytes.data() + 128, "DICM", 4) == 0 ? 132 : 0;
  if (begin == 0 && bytes[0] != 2) {  // old tools wrote neither preamble nor meta group
    parsed.syntax = base::is_capital(bytes[4]) && base::is_capital(bytes[5]) ? kExplicitLittle : kImplicitLittle;
    return std::size_t{0};
  }
  // Up to the first element of another group; its length element may be missing or wrong.
  std::size_t end = begin;
  const auto u16 = [&](std::size_t at) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[at])) |
           static_cast<unsigned>(static_cast<unsigned char>(bytes[at + 1])) << 8;
  };
  while (bytes.size() - end >= 8 && u16(end) == 0x0002) {
    const std::string_view vr = bytes.substr(end + 4, 2);
    const bool is_long = vr == "OB" || vr == "UN" || vr == "UT" || vr == "OW";
    if (is_long && bytes.size() - end < 12) break;
    const std::size_t head = is_long ? 12 : 8;
    const std::size_t length =
        is_long ? u16(end + 8) | static_cast<std::size_t>(u16(end + 10)) << 16 : u16(end + 6);
    if (length > bytes.size() - end - head)
      return base::Error{"truncated", "a file ends in the middle of an element"};
    end += head + length;
  }
  auto meta = read_data_set(bytes.substr(begin, end - begin), {true, false});
  if (!meta) return meta.error();
  parsed.sop_class = text_of(*meta, 0x00020002);
  parsed.sop_instance = text_of(*meta, 0x00020003);
  parsed.syntax = text_of(*meta, 0x00020010);
  if (parsed.syntax.empty()) parsed.syntax = kImplicitLittle;  // PS3.10: the default
  return end;
}

base::Result<Parsed> parse(const std::filesystem::path& file) {
  const auto start = read_bytes(file, 0, 132);
  if (!start) return base::Error{"not_readable", "a file cannot be read"};
  if (!looks_like_dicom(reinterpret_cast<const char*>(start->data()), start->size()))
    return base::Error{"not_dicom", "a file is not DICOM"};
  if (file_size_bytes(file) > kLargestDicomFile) return base::Error{"too_large", "a file is larger than 1 GiB"};
  const auto whole = read_bytes(file, 0, kLargestDicomFile);
  if (!whole) return base::Error{"not_readable", "a file cannot be read"};
  Parsed parsed;
  const char* first = reinterpret_cast<const char*>(whole->data());
  parsed.bytes.assign(first, first + whole->size());
  const auto data = read_meta({parsed.bytes.data(), parsed.bytes.size()}, parsed);
  if (!data) return data.error();
  std::size_t begin = *data;
  if (!parsed.syntax.starts_with(kImplicitLittle))
    return base::Error{"unknown_syntax", "a file is packed in a way that is not the standard's"};
  if (parsed.syntax == kDeflated) {
    std::vector<std::byte> unpacked;
    const std::uint64_t limit = most_unpacked(kDicomDataSet, file_size_bytes(file));
    const PackedBytes packed{file, begin, UINT64_MAX, limit, Packing::deflate};
    const Unpacked counted = unpack(packed);
    if (counted.size > limit)
      return base::Error{"too_large", "a file would unpack to more than twice its size and 64 MB"};
    announce_largest(3 * counted.size);
    unpacked.reserve(counted.size);
    const Unpacked done = unpack(packed, [&](std::span<const std::byte> piece) {
      unpacked.insert(unpacked.end(), piece.begin(), piece.end());
    });
    if (done.state != ByteState::complete)
      return base::Error{done.state == ByteState::too_few ? "truncated" : "damaged",
                         "a file's packed data set is not whole"};
    const char* unpacked_first = reinterpret_cast<const char*>(unpacked.data());
    parsed.bytes.assign(unpacked_first, unpacked_first + unpacked.size());
    parsed.syntax = kExplicitLittle;
    begin = 0;
  }
  parsed.format = {parsed.syntax != kImplicitLittle, parsed.syntax == kExplicitBig};
  auto data_set =
      read_data_set(std::string_view(parsed.bytes.data(), parsed.bytes.size()).substr(begin), parsed.format);
  if (!data_set) return data_set.error();
  parsed.data_set = std::move(*data_set);
  if (const std::string uid = text_of(parsed.data_set, 0x00080016); !uid.empty()) parsed.sop_class = uid;
  if (const std::string uid = text_of(parsed.data_set, 0x00080018); !uid.empty()) parsed.sop_instance = uid;
  return parsed;
}

bool has_part(const std::string& values, const char* part) {
  return ("\\" + values + "\\").find(std::string("\\") + part + "\\") != std::string::npos;
}

// Storage classes by the number behind 1.2.840.10008.5.1.4.1.1. (PS3.4 Annex B.5).
std::optional<base::Error> why_not(Parsed& parsed) {
  constexpr std::string_view kStorage = "1.2.840.10008.5.1.4.1.1.";
  const std::string_view uid = parsed.sop_class;
  if (uid == "1.2.840.10008.1.3.10") return base::Error{"dicomdir", "a DICOMDIR, which names the old files"};
  // Plans, doses of ions and enhanced images lie under other roots of the standard.
  if (!uid.starts_with("1.2.840.10008.5.1.4."))
    return base::Error{"unknown_object", "an object whose kind the standard does not name"};
  const std::string kind = std::string(uid.starts_with(kStorage) ? uid.substr(kStorage.size()) : "") + ".";
  const auto is = [&](std::initializer_list<const char*> kinds) {
    return std::any_of(kinds.begin(), kinds.end(),
                       [&](const char* one) { return kind.starts_with(std::string(one) + "."); });
  };
  if (is({"66"}) && kind == "66.") return base::Error{"unknown_object", "raw data of a vendor"};
  if (is({"88", "104", "11"}))
    return base::Error{"report", "a report, document or annotation, whose text would have to be read"};
  if (text_of(parsed.data_set, 0x00280301) == "YES")
    return base::Error{"burned_in", "a picture that says that text is burned into it"};
  if (has_part(text_of(parsed.data_set, 0x00080008), "SCREEN SAVE"))
    return base::Error{"burned_in", "a screen picture"};
  if (is({"7"}) || text_of(parsed.data_set, 0x00080060) == "SC")
    return base::Error{"secondary_capture", "a secondary capture, which may show anything"};
  const bool says_no = text_of(parsed.data_set, 0x00280301) == "NO";
  if (is({"3", "6", "77"}) && !says_no)
    return base::Error{"may_have_text", "ultrasound or a photograph that does not say it is free of text"};
  return std::nullopt;
}

void put(DicomDataSet& data_set, DicomTag tag, const char* vr, const std::string& value) {
  std::erase_if(data_set, [&](const DicomElement& one) { return one.tag == tag; });
  DicomElement made;
  made.tag = tag;
  made.set(vr, value);
  const auto before =
      std::find_if(data_set.begin(), data_set.end(), [&](const DicomElement& one) { return one.tag > tag; });
  data_set.insert(before, std::move(made));
}

// PS3.15 §E.1.1: what says that it was done, and how (code of PS3.16 CID 7050).
void say_so(DicomDataSet& data_set, DicomFormat format) {
  put(data_set, 0x00120062, "CS", "YES");
  put(data_set, 0x00120063, "LO", kDeidentificationMethod);
  put(data_set, 0x00120064, "SQ", "");
  put(data_set, 0x00280303, "CS", "REMOVED");
  DicomElement& codes = *find(data_set, 0x00120064);
  codes.is_sequence = true;
  codes.inside = format;
  DicomDataSet& code = codes.items.emplace_back();
  put(code, 0x00080100, "SH", "113100");
  put(code, 0x00080102, "SH", "DCM");
  put(code, 0x00080104, "LO", "Basic Application Confidentiality Profile");
}

std::string meta_bytes(const Parsed& parsed, const std::string& sop_instance) {
  DicomDataSet meta;
  put(meta, 0x00020001, "OB", std::string("\0\1", 2));
  put(meta, 0x00020002, "UI", parsed.sop_class);
  put(meta, 0x00020003, "UI", sop_instance);
  put(meta, 0x00020010, "UI", parsed.syntax);
  put(meta, 0x00020012, "UI", kImplementation);
  put(meta, 0x00020013, "SH", "SELDINGER");
  const std::string group = bytes_of(meta, {true, false});
  std::string length(4, '\0');
  for (std::size_t i = 0; i < 4; ++i) length[i] = static_cast<char>(group.size() >> (8 * i) & 0xFF);
  DicomDataSet head;
  put(head, 0x00020000, "UL", length);
  return std::string(128, '\0') + "DICM" + bytes_of(head, {true, false}) + group;
}

}  // namespace

base::Result<CleanFile> deidentify_file(const std::filesystem::path& file, const HashKey& key) {
  auto parsed = parse(file);
  if (!parsed) return parsed.error();
  if (auto error = why_not(*parsed)) return *error;
  if (parsed->sop_instance.empty()) return base::Error{"no_instance", "a file without the UID of what it holds"};
  const auto hidden_bits = clear_hidden_bits(parsed->data_set, parsed->format);
  if (!hidden_bits) return hidden_bits.error();
  DataSetCleaner cleaner(key);
  cleaner.clean(parsed->data_set);
  CleanFile clean;
  clean.sop_instance_uid = cleaner.new_uid(parsed->sop_instance);
  put(parsed->data_set, 0x00080018, "UI", clean.sop_instance_uid);
  say_so(parsed->data_set, parsed->format);
  clean.bytes = meta_bytes(*parsed, clean.sop_instance_uid) + bytes_of(parsed->data_set, parsed->format);
  clean.counts = cleaner.counts();
  if (*hidden_bits > 0) clean.counts["hidden_bits"] = *hidden_bits;
  return clean;
}

}  // namespace seldinger::casedb
