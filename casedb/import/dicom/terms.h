// Whether a value is one of DICOM's defined terms.
#pragma once

#include <algorithm>
#include <span>
#include <string>

namespace seldinger::casedb {

using Terms = std::span<const char* const>;

inline bool is_term(const std::string& value, Terms terms) {
  return std::any_of(terms.begin(), terms.end(), [&](const char* term) { return value == term; });
}

}  // namespace seldinger::casedb
