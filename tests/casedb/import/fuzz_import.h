// Reads mutated files again and again: none may crash, talk, hang, throw, or hold more memory than allowed.
#pragma once

#include <cstdint>
#include <filesystem>

namespace seldinger::casedb {

struct FuzzLimits {
  int rounds = 0;          // or less, when
  double seconds = 1e300;  // have gone
};

// `folder` is written into. The same `seed` gives the same files. Fails the test where something is wrong, leaving
// the file that did it as "failed" in the folder.
void fuzz_import(const std::filesystem::path& folder, std::uint64_t seed, const FuzzLimits& limits);

}  // namespace seldinger::casedb
