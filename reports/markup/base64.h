// How a page carries a picture in itself.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace seldinger::reports {

std::string base64(const std::vector<std::byte>& bytes);  // RFC 4648, with padding

}  // namespace seldinger::reports
