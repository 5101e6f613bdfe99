// UIDs of our own: "2.25." and a UUID as one decimal number (PS3.5 §B.2), at most 44 characters.
#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace seldinger::casedb {

// 122 of the 128 bits go into a UUID of version 8 (RFC 9562: bits of one's own).
std::string uid_of(const std::array<std::byte, 16>& bits);

}  // namespace seldinger::casedb
