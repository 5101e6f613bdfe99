#include "app/cli/key_file.h"

#include <sys/stat.h>

#include <filesystem>
#include <string_view>

#include "app/cli/file.h"
#include "sim/base/hex.h"

namespace seldinger::app {

base::Result<casedb::HashKey> key_from_file(const std::string& path) {
  casedb::HashKey key{};
  if (path.empty() || !std::filesystem::exists(path)) {
    casedb::fill_random(key);
    if (!path.empty()) {
      write_file(path, base::hex_from_bytes(key) + "\n");
      ::chmod(path.c_str(), S_IRUSR | S_IWUSR);
    }
    return key;
  }
  const auto text = read_text(path, 4096);
  if (!text) return text.error();
  const auto digit = [](char c) { return std::string_view("0123456789abcdef").find(c); };
  for (std::size_t i = 0; i < key.size(); ++i) {
    const bool there = text->size() >= 2 * key.size();
    const std::size_t high = there ? digit((*text)[2 * i]) : std::string::npos;
    const std::size_t low = there ? digit((*text)[2 * i + 1]) : std::string::npos;
    if (high == std::string::npos || low == std::string::npos)
      return base::Error{"bad_key", "the key file does not hold 64 hexadecimal digits"};
    key[i] = static_cast<std::byte>(high << 4 | low);
  }
  return key;
}

}  // namespace seldinger::app
