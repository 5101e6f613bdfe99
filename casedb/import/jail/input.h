// Files from outside: the readers open them here and nowhere else, so that a reader in a jail can ask for them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace seldinger::casedb {

enum class Links { followed, refused };

// A regular file, read by place. Cannot be opened (missing, not allowed, a folder, a pipe): false, and of no bytes.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& file, Links links = Links::followed);
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();
  explicit operator bool() const noexcept { return descriptor_ >= 0; }
  std::uint64_t size() const noexcept { return size_; }
  // How many bytes came: fewer than asked for where the file ends or cannot be read.
  std::size_t read(std::uint64_t offset, std::span<std::byte> into) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// A descriptor of a regular file, the caller's to close; -1.
int open_regular(const std::filesystem::path& file, Links links);

// From here on InputFile asks this for descriptors. Called once, by a process that becomes a jail.
using InputOpener = int (*)(const std::filesystem::path& file, Links links);
void open_inputs_by(InputOpener opener) noexcept;

}  // namespace seldinger::casedb
