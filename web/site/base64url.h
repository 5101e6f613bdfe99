// Bytes in a form's field: RFC 4648, section 5, without padding.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace seldinger::web {

std::optional<std::vector<std::byte>> bytes_from_base64url(std::string_view text);  // none: it is none

}  // namespace seldinger::web
