#include "app/cli/key_file.h"

#include <algorithm>
#include <filesystem>
#include <span>
#include <string_view>

#include "app/cli/file.h"
#include "casedb/database/disk.h"
#include "sim/base/hex.h"

namespace seldinger::app {

base::Result<casedb::HashKey> key_from_file(const std::string& path) {
  if (!path.empty() && std::filesystem::exists(path)) return existing_key(path);
  casedb::HashKey key{};
  casedb::fill_random(key);
  if (path.empty()) return key;
  std::string text = base::hex_from_bytes(key) + "\n";
  casedb::NewFile made(path);
  made.write(std::as_bytes(std::span(text)));
  made.keep();
  casedb::wipe(text);
  return key;
}

base::Result<casedb::HashKey> existing_key(const std::string& path) {
  auto text = read_text(path, 4096);
  if (!text) return text.error();
  casedb::HashKey key{};
  const auto bytes = base::bytes_from_hex(std::string_view(*text).substr(0, 2 * key.size()));
  casedb::wipe(*text);
  if (!bytes || bytes->size() != key.size())
    return base::Error{"bad_key", "the key file does not hold 64 hexadecimal digits"};
  std::copy(bytes->begin(), bytes->end(), key.begin());
  return key;
}

}  // namespace seldinger::app
