// What of a source enters a case beside voxels and geometry: this table, nothing else. A value enters only when it
// is one of a closed vocabulary, a number in a range, or coarse (a band of years, an age of 90 or more as "90+"),
// and it is written anew from what was understood; text is never passed on.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "casedb/cases/privacy.h"
#include "casedb/import/dicom/dicom_file.h"

namespace seldinger::casedb {

constexpr std::size_t kMostAttributes = 25;

struct AllowedAttribute {
  DicomTag tag;
  const char* name;                                            // in the case
  const char* keyword;                                         // of the DICOM element
  const char* values;                                          // what it may be, in words
  std::string (*accept)(const DicomFile& file, DicomTag tag);  // empty: the value does not enter
};

std::span<const AllowedAttribute> allow_list();
bool is_on_allow_list(DicomTag tag) noexcept;

std::vector<std::pair<std::string, std::string>> allowed_attributes(const DicomFile& file);

// Whether the file says that it shows a head, a part of one, or the whole body. A hint only: often wrong or
// missing.
bool says_head(const DicomFile& file);

// An element that did not enter; small, since a series has thousands of slices with hundreds each.
enum class DropReason : std::uint8_t { not_on_the_list, private_element, value_not_accepted };
struct DroppedElement {
  DicomTag tag;
  DropReason reason;
};

// Elements of the data set before the pixels that did not enter and were not used for geometry or values; a
// sequence counts once, with all that is in it.
std::vector<DroppedElement> dropped_elements(const DicomFile& file);

// Adds up what did not enter, of all slices.
class DroppedCount {
 public:
  void add(const std::vector<DroppedElement>& elements);
  std::vector<Dropped> counts() const;  // sorted by tag

 private:
  std::map<std::pair<DicomTag, DropReason>, std::int64_t> counts_;  // private ones by group
};

// docs/attributes.md.
std::string allow_list_markdown();

}  // namespace seldinger::casedb
