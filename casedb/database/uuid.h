// Names and times of rows: UUID version 7 (RFC 9562) as lower-case text, so that ids sort by the time they were
// made.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace seldinger::casedb {

// Microseconds since 1970 UTC. Strictly increasing within the process, also when the clock is set back.
std::int64_t now_us();

// Strictly increasing within the process.
std::string new_uuid();
bool is_uuid(std::string_view text) noexcept;  // of its form: 36 lower-case hexadecimal digits and dashes

}  // namespace seldinger::casedb
