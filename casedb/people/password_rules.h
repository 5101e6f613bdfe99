// Which new passwords are refused. Those that stand go on working.
#pragma once

#include <string_view>

#include "sim/base/result.h"

namespace seldinger::casedb {

// NIST SP 800-63B, 5.1.1.2: at least 8 characters, longer ones taken, no rule of what has to be mixed, and none
// that is guessed first. The bound above keeps a hash's cost.
inline constexpr std::size_t kLeastPasswordCharacters = 8, kMostPasswordBytes = 128;

// `weak_password`: its length, or that no more than three guessable pieces make it up (a common word, also with 0
// for o and the like, the user's name or the program's, a run or a repeat of keys, up to four digits; signs between
// them count nothing). The text says which rule it was and never quotes.
base::Result<void> check_password(std::string_view password, std::string_view login_name);

}  // namespace seldinger::casedb
