// One DICOM file in memory: a walk over its data set that never trusts a length. Only the wanted elements are kept;
// those that name a person are there to tell two apart (identity.h). PS3.5 §7 (data set) and §A.4 (encapsulated
// pixels), PS3.10 §7.1 (preamble and meta group), PS3.3 §C.7.6.16 (the functional groups in which a multi-frame
// image says where each frame lies).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace seldinger::casedb {

using DicomTag = std::uint32_t;  // group · 65536 + element

// That is read whole: a classic CT slice has 0.5 to 8 MB, an enhanced CT some hundred.
constexpr std::uint64_t kLargestDicomFile = std::uint64_t{1} << 30;

// damaged: cannot be followed. bomb: unpacks to more than twice its size and 64 MB. too_large: above 1 GiB.
enum class DicomState { whole, truncated, damaged, bomb, too_large, not_dicom };

struct DicomValue {
  std::array<char, 2> vr{};  // as written, zeros where implicit
  std::string bytes;
};
using DicomValues = std::map<DicomTag, DicomValue>;

struct DicomFile {
  DicomState state = DicomState::not_dicom;
  std::vector<std::byte> bytes;  // the file; the unpacked data set when the syntax is deflated
  std::string transfer_syntax;
  bool big_endian = false;
  bool wrong_syntax = false;        // explicit where implicit was promised, or the other way round
  DicomValues values;               // of the wanted elements before the pixels
  std::vector<DicomTag> tags;       // of all elements of the data set's top level before the pixels
  DicomValues shared;               // of the functional groups: the same for all frames,
  std::vector<DicomValues> frames;  // and each frame's own
  bool has_pixels = false;
  bool encapsulated = false;
  bool pixels_cut = false;  // the file ends before the pixels do
  // Offset and length within `bytes`: one piece when native, else the fragments behind the offset table.
  std::vector<std::pair<std::size_t, std::size_t>> pixel_pieces;
  std::vector<std::uint32_t> offset_table;  // where each frame's first fragment begins; PS3.5 §A.4

  // What a value says, whatever its VR says of it: a wrong one is believed where it holds the same thing.
  std::string text(DicomTag tag) const;                   // trimmed; empty when absent
  std::vector<double> numbers(DicomTag tag) const;        // empty when absent or not all finite numbers
  std::optional<int> unsigned_short(DicomTag tag) const;  // the bits of US or SS; nothing when it is no such number
};

// Holds no more than twice the file's size and 64 MB, whatever the file says.
DicomFile read_dicom_file(const std::filesystem::path& file);

// The header of one frame: the file's own values below those of its functional groups. Holds no bytes.
DicomFile frame_header(const DicomFile& file, std::size_t frame);

// Whether a file's first bytes (132 at least where it has as many) look like DICOM.
bool looks_like_dicom(const char* bytes, std::size_t size) noexcept;

}  // namespace seldinger::casedb
