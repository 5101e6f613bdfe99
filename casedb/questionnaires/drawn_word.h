// Codes and keys that people read aloud and type.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace seldinger::casedb {

// So many letters, each of `letters` (up to 256) as likely as the others; from the system's source of chance.
std::string drawn_word(std::string_view letters, std::size_t length);

// Letters and digits that are not mistaken for each other in small writing.
inline constexpr std::string_view kSmallLetters = "23456789abcdefghjkmnpqrstuvwxyz";

}  // namespace seldinger::casedb
