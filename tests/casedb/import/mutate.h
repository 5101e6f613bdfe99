// Damages bytes in the ways files are damaged and attacked: a mutation driver without coverage feedback (libFuzzer
// needs clang, which the build does not ask for). The same random numbers give the same damage.
#pragma once

#include <random>
#include <string>
#include <vector>

namespace seldinger::casedb {

// One to eight mutations of `seed`; `others` give pieces to splice in. At most `most_bytes` long.
std::string mutated(const std::string& seed, const std::vector<std::string>& others, std::size_t most_bytes,
                    std::mt19937_64& random);

}  // namespace seldinger::casedb
