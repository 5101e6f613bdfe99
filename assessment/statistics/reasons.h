// Why a procedure estimates nothing: codes that stay, with their words.
#pragma once

#include <span>

namespace seldinger::assessment::statistics {

struct Reason {
  const char* code;
  const char* words;
};

// In the order of docs/statistics.md.
std::span<const Reason> reasons();
// nullptr: there is no such reason.
const Reason* find_reason(const char* code);

}  // namespace seldinger::assessment::statistics
