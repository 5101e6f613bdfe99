// What one connection may send. Everything that is not needed is refused or dropped here: what general parsers fell
// to (chunked and compressed bodies past a limit, any number of headers, a REMOTE_ADDR from outside:
// CVE-2025-46728, -53628, -66570, 2026-22776) is not understood.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <variant>

#include "web/site/http.h"

namespace seldinger::web {

inline constexpr std::size_t kMaxHeadBytes = 16 * 1024;  // request line and headers
inline constexpr std::size_t kMaxHeaders = 64;
inline constexpr std::size_t kMaxTargetBytes = 2048;
inline constexpr std::size_t kMaxBodyBytes = 64 * 1024;

struct Refusal {
  int status = 400;
};

struct Head {
  Request request;  // without body
  std::size_t body_bytes = 0;
};

// Where the head ends (behind its empty line), or nothing yet.
std::optional<std::size_t> head_size(std::string_view received);

// `head` ends with its empty line.
std::variant<Head, Refusal> parse_head(std::string_view head);

}  // namespace seldinger::web
