#include "casedb/keeping/health.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <utility>

#include "casedb/database/library.h"

namespace seldinger::casedb {
namespace {

// A file without a name where the file system has them, else one that is removed again. 0: written; else errno.
int write_probe(const std::filesystem::path& folder) noexcept {
  int file = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (file < 0 && (errno == EOPNOTSUPP || errno == EISDIR || errno == ENOENT)) {
    std::string name = (folder / ".probe-XXXXXX").string();
    file = ::mkostemp(name.data(), O_CLOEXEC);
    if (file >= 0) ::unlink(name.c_str());
  }
  if (file < 0) return errno;
  const std::array<char, 4096> page{};
  const bool written =
      ::write(file, page.data(), page.size()) == static_cast<ssize_t>(page.size()) && ::fsync(file) == 0;
  const int error = written ? 0 : errno == 0 ? ENOSPC : errno;
  ::close(file);
  return error;
}

}  // namespace

std::string_view name_of(Health health) noexcept {
  switch (health) {
    case Health::ok:
      return "ok";
    case Health::moved:
      return "moved";
    case Health::full:
      return "full";
    case Health::read_only:
      return "read_only";
  }
  return "";
}

HealthWatch::HealthWatch(const std::filesystem::path& folder, std::uint64_t least_free_bytes)
    : folder_(std::filesystem::absolute(folder)), least_free_bytes_(least_free_bytes) {
  struct stat now {};
  if (::lstat((folder_ / kDatabaseFile).c_str(), &now) == 0) {
    device_ = now.st_dev;
    inode_ = now.st_ino;
  }
}

Health HealthWatch::look() const noexcept {
  struct stat now {};
  if (::lstat((folder_ / kDatabaseFile).c_str(), &now) != 0 || now.st_dev != device_ || now.st_ino != inode_)
    return Health::moved;
  struct statvfs room {};
  if (::statvfs(folder_.c_str(), &room) != 0) return Health::moved;
  if ((room.f_flag & ST_RDONLY) != 0) return Health::read_only;
  if (std::uint64_t{room.f_bavail} * room.f_frsize < least_free_bytes_) return Health::full;
  errno = 0;
  const int error = write_probe(folder_);
  if (error == ENOSPC || error == EDQUOT) return Health::full;
  return error == 0 ? Health::ok : Health::read_only;
}

}  // namespace seldinger::casedb
