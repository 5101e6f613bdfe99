#include "app/cli/file.h"

#include <fstream>

#include "casedb/database/disk.h"

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

void write_file(const std::filesystem::path& path, const std::string& text) {
  casedb::write_durably(path, std::as_bytes(std::span(text)), casedb::FileAccess::as_umask);
}

}  // namespace seldinger::app
