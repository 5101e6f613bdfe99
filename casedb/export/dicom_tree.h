// A DICOM data set as a tree of elements, read from bytes and written back: nothing is decoded, values stay as they
// are in the source. PS3.5 §7; no length of a file is trusted.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sim/base/result.h"

namespace seldinger::casedb {

using DicomTag = std::uint32_t;  // group · 65536 + element
constexpr int kDeepestSequence = 128;

struct DicomFormat {
  bool explicit_vr = true;
  bool big_endian = false;
};

struct DicomElement;
using DicomDataSet = std::vector<DicomElement>;

struct DicomElement {
  DicomTag tag = 0;
  std::array<char, 2>
      vr{};  // of the file; of the standard's dictionary where the file tells none or UN; else zeros
  std::array<char, 2> file_vr{};    // as the file writes it; zeros where implicit
  bool is_sequence = false;         // then `items`, else `value`
  bool is_encapsulated = false;     // `value` is all items of the pixels with the delimiter
  std::string_view value;           // into the source's bytes, or into `made`
  std::string made;                 // what replaces the value
  std::vector<DicomDataSet> items;  // of a sequence
  DicomFormat inside;               // of the sequence's items

  bool is(const char* name) const noexcept { return vr[0] == name[0] && vr[1] == name[1]; }
  void set(const char* new_vr, std::string new_value);  // pads to even length
  std::string text() const;                             // without the padding around it
  // `value` may look into `made`: moving must not part them.
  DicomElement() = default;
  DicomElement(DicomElement&& other) noexcept { *this = std::move(other); }
  DicomElement& operator=(DicomElement&& other) noexcept;

 private:
  bool is_made_ = false;
};

// VR of a tag in the standard's dictionary (that of GDCM), "" when it has none. US of US or SS, OW of OB or OW.
std::string dictionary_vr(DicomTag tag);

// The whole of `bytes`, which must outlive the tree. Zeros behind the last element are dropped. Refused:
// `truncated`, `damaged`, `too_deep`.
base::Result<DicomDataSet> read_data_set(std::string_view bytes, DicomFormat format);

// Sequences of undefined length with delimiters, values as they are.
std::string bytes_of(const DicomDataSet& data_set, DicomFormat format);

}  // namespace seldinger::casedb
