// deidentify.
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>

#include "app/command.h"
#include "app/deidentify_json.h"
#include "app/file.h"
#include "casedb/export/deidentify.h"
#include "sim/base/hex.h"

namespace seldinger::app {
namespace {

// 64 hexadecimal digits; made when there is no such file.
base::Result<casedb::HashKey> key_from(const std::string& path) {
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

}  // namespace

int run_deidentify(const Arguments& arguments) {
  auto key = key_from(arguments.text("--key"));
  if (!key) return refuse(key.error());
  if (::isatty(STDERR_FILENO) != 0) std::fputs("taking out what identifies …\n", stderr);
  const auto done = casedb::deidentify(arguments.positional(0), arguments.positional(1), *key);
  key->fill(std::byte{0});
  if (!done) return refuse(done.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_deidentified(*done).c_str(), stdout);
    return kDone;
  }
  std::printf("%d file%s written\n", done->files, done->files == 1 ? "" : "s");
  for (const auto& [what, count] : done->counts)
    std::printf("%-10s %lld elements\n", what.c_str(), static_cast<long long>(count));
  for (const auto& [code, count] : done->left_out) std::printf("left out: %s: %d files\n", code.c_str(), count);
  std::puts("Pixels are as they were: look through them for text and faces before you pass them on.");
  return kDone;
}

}  // namespace seldinger::app
