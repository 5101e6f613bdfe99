#include "casedb/import/jail/input.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

namespace seldinger::casedb {
namespace {

InputOpener opener_of_inputs = &open_regular;

}  // namespace

void open_inputs_by(InputOpener opener) noexcept {
  opener_of_inputs = opener;
}

int open_regular(const std::filesystem::path& file, Links links) {
  // Without O_NONBLOCK a pipe would be waited for.
  const int flags = O_RDONLY | O_CLOEXEC | O_NONBLOCK | (links == Links::refused ? O_NOFOLLOW : 0);
  const int descriptor = ::open(file.c_str(), flags);
  if (descriptor < 0) return -1;
  struct stat status {};
  if (::fstat(descriptor, &status) == 0 && S_ISREG(status.st_mode)) return descriptor;
  ::close(descriptor);
  return -1;
}

InputFile::InputFile(const std::filesystem::path& file, Links links) : descriptor_(opener_of_inputs(file, links)) {
  struct stat status {};
  if (descriptor_ >= 0 && ::fstat(descriptor_, &status) == 0) size_ = static_cast<std::uint64_t>(status.st_size);
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::size_t InputFile::read(std::uint64_t offset, std::span<std::byte> into) const {
  std::size_t done = 0;
  while (descriptor_ >= 0 && done < into.size()) {
    const ssize_t got =
        ::pread(descriptor_, into.data() + done, into.size() - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace seldinger::casedb
