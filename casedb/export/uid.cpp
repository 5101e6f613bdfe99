#include "casedb/export/uid.h"

#include <algorithm>

namespace seldinger::casedb {

__extension__ using Uint128 = unsigned __int128;

std::string uid_of(const std::array<std::byte, 16>& bits) {
  Uint128 uuid = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    std::byte byte = bits[i];
    if (i == 6) byte = (byte & std::byte{0x0f}) | std::byte{0x80};
    if (i == 8) byte = (byte & std::byte{0x3f}) | std::byte{0x80};
    uuid = uuid << 8 | std::to_integer<unsigned>(byte);
  }
  std::string uid;
  for (; uuid != 0; uuid /= 10) uid.push_back(static_cast<char>('0' + static_cast<int>(uuid % 10)));
  uid += ".52.2";  // all backwards
  std::reverse(uid.begin(), uid.end());
  return uid;
}

}  // namespace seldinger::casedb
