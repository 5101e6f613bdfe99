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

// Six capitals and digits that are not mistaken for each other when they are read aloud or copied.
std::string drawn_code();
// As it is kept, however it was typed: in capitals, without blanks and dashes.
std::string code_from(std::string_view typed);

}  // namespace seldinger::casedb
