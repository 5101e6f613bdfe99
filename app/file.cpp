#include "app/file.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>

#include "sim/base/failure.h"

namespace seldinger::app {

base::Result<std::string> read_text(const std::filesystem::path& path, std::size_t max_bytes) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return base::Error{"not_found", "there is no such file"};
  const auto size = std::filesystem::file_size(path, error);
  if (error) return base::Error{"unreadable", "the file cannot be read"};
  if (size > max_bytes) return base::Error{"too_large", "the file is too large"};
  std::ifstream stream(path, std::ios::binary);
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  if (!stream) return base::Error{"unreadable", "the file cannot be read"};
  return text;
}

void write_file(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::path beside = path;
  beside += ".part";
  std::FILE* file = std::fopen(beside.c_str(), "wb");
  bool good = file != nullptr;
  if (good) {
    good = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
    good = std::fflush(file) == 0 && good;
    good = ::fsync(::fileno(file)) == 0 && good;
    good = std::fclose(file) == 0 && good;
  }
  if (good) good = std::rename(beside.c_str(), path.c_str()) == 0;
  if (good) return;
  std::remove(beside.c_str());
  throw base::Failure("disk", "the output file cannot be written");
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  write_file(path, std::as_bytes(std::span(text)));
}

}  // namespace seldinger::app
