#include "app/cli/file.h"

#include <fstream>

#include "app/cli/words.h"
#include "casedb/database/disk.h"
#include "sim/base/failure.h"

namespace seldinger::app {

base::Result<std::string> read_text(const std::filesystem::path& path, std::size_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return base::Error{"not_found", "there is no such file"};
  const auto size = std::filesystem::file_size(path, error);
  if (error) return base::Error{"not_readable", "the file cannot be read"};
  if (size > max_bytes) return base::Error{"too_large", "the file is too large"};
  std::ifstream stream(path, std::ios::binary);
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream) return base::Error{"not_readable", "the file cannot be read"};
  return text;
}

base::Result<std::string> read_text_of(const Arguments& arguments, const std::string& what, std::size_t max_bytes) {
  auto read = read_text(arguments.typed(what), max_bytes);
  return read ? std::move(read) : error_of(what, arguments.typed(what), read.error());
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  write_file(path, std::as_bytes(std::span(text)));
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  try {
    casedb::write_durably(path, bytes, casedb::FileAccess::as_umask);
  } catch (const base::Failure& failure) {
    throw base::Failure(failure.code(), shown(path.string()) + ": " + failure.what());
  }
}

}  // namespace seldinger::app
