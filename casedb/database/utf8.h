// Text in UTF-8, as it comes from outside.
#pragma once

#include <optional>
#include <string_view>

namespace seldinger::casedb {

// Takes one character off the front; nothing when the bytes are not UTF-8 (RFC 3629: shortest form, no surrogates).
std::optional<char32_t> next_character(std::string_view& text) noexcept;

// Whole characters, none of them NUL: what can be shown, compared and written as JSON.
bool is_text(std::string_view text) noexcept;

}  // namespace seldinger::casedb
