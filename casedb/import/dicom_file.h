// One DICOM file in memory: a walk over the top level of its data set that never trusts a length. Only the wanted
// elements are kept, and none of them names a person. PS3.5 §7 (data set) and §A.4 (encapsulated pixels), PS3.10
// §7.1 (preamble and meta group).
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seldinger::casedb {

using DicomTag = std::uint32_t;  // group · 65536 + element

enum class DicomState { whole, truncated, damaged, not_dicom };

struct DicomFile {
  DicomState state = DicomState::not_dicom;
  std::vector<char> bytes;  // the file; the unpacked data set when the syntax is deflated
  std::string transfer_syntax;
  bool big_endian = false;
  std::map<DicomTag, std::string> values;  // raw bytes of the wanted elements before the pixels
  bool has_pixels = false;
  bool encapsulated = false;
  bool pixels_cut = false;  // the file ends before the pixels do
  // Offset and length within `bytes`: one piece when native, else the fragments behind the offset table.
  std::vector<std::pair<std::size_t, std::size_t>> pixel_pieces;

  std::string text(DicomTag tag) const;                   // trimmed; empty when absent
  std::vector<double> numbers(DicomTag tag) const;        // of DS or IS; empty when absent or not all numbers
  std::optional<int> unsigned_short(DicomTag tag) const;  // the bits of US or SS
};

DicomFile read_dicom_file(const std::filesystem::path& file);

// Whether a file's first bytes (132 at least where it has as many) look like DICOM.
bool looks_like_dicom(const char* bytes, std::size_t size) noexcept;

}  // namespace seldinger::casedb
