// What a person may be called when logging in.
#pragma once

#include <string_view>

namespace seldinger::casedb {

// 1–64 printable characters of valid UTF-8, no leading or trailing space. Not printable: control characters, and
// those that change or hide other text (bidirectional and zero-width marks, spaces other than the plain one), since
// two names that look the same must be the same.
bool is_login_name(std::string_view name) noexcept;

}  // namespace seldinger::casedb
