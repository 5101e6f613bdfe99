#include "casedb/database/uuid.h"

#include <array>
#include <atomic>
#include <chrono>

#include "casedb/database/credentials.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {

std::int64_t now_us() {
  static std::atomic<std::int64_t> last_us{0};
  const std::int64_t clock_us =
      std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::system_clock::now().time_since_epoch())
          .count();
  std::int64_t before_us = last_us.load();
  std::int64_t now;
  do {
    now = clock_us > before_us ? clock_us : before_us + 1;
  } while (!last_us.compare_exchange_weak(before_us, now));
  return now;
}

std::string new_uuid() {
  const auto time_us = static_cast<std::uint64_t>(now_us());
  const std::uint64_t ms = time_us / 1000;
  // RFC 9562 §6.2 method 3: the twelve bits after the version carry the fraction of the millisecond; 4096/1000 > 1
  // keeps microseconds apart.
  const std::uint64_t fraction = time_us % 1000 * 4096 / 1000;
  std::array<std::byte, 16> bytes{};
  fill_random(std::span(bytes).subspan(8));
  for (unsigned i = 0; i < 6; ++i) bytes[i] = static_cast<std::byte>(ms >> (40 - 8 * i));
  bytes[6] = static_cast<std::byte>(0x70 | fraction >> 8);
  bytes[7] = static_cast<std::byte>(fraction);
  bytes[8] = (bytes[8] & std::byte{0x3f}) | std::byte{0x80};

  const std::string hex = base::hex_from_bytes(bytes);
  return hex.substr(0, 8) + '-' + hex.substr(8, 4) + '-' + hex.substr(12, 4) + '-' + hex.substr(16, 4) + '-' +
         hex.substr(20);
}

bool is_uuid(std::string_view text) noexcept {
  return text.size() == 36 && text.find_first_not_of("0123456789abcdef-") == std::string_view::npos;
}

}  // namespace seldinger::casedb
