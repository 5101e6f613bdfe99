// Sessions of the command line: a token that its owner keeps in a file, of which the library has only the SHA-256.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "casedb/people/people.h"

namespace seldinger::casedb {

inline constexpr std::int64_t kLoginSessionLife_us = 12LL * 3600 * 1'000'000;  // as web/sessions.h: a working day

// 64 hexadecimal digits, 256 random bits; whoever called wipes it. `account`: what log_in answered.
std::string begin_login_session(Library& library, const Account& account);
// Whose session it is; none when it is over, or the person's password or role changed or the account was closed.
std::optional<Account> account_of_login_session(Library& library, const std::string& token);
bool end_login_session(Library& library, const std::string& token);  // false: there was none

}  // namespace seldinger::casedb
