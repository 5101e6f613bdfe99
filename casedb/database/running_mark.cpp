#include "casedb/database/running_mark.h"

#include <fcntl.h>
#include <unistd.h>

#include <span>

#include "sim/base/failure.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

// One byte of one file for each attempt, far apart by hash: an open-file-description lock (fcntl(2)) belongs to the
// descriptor, so it is seen within the same process too.
struct flock lock_of(const std::string& attempt_id, short type) {
  struct flock lock {};
  lock.l_type = type;
  lock.l_whence = SEEK_SET;
  lock.l_start = static_cast<off_t>(base::hash_bytes(std::as_bytes(std::span(attempt_id))) >> 2U);
  lock.l_len = 1;
  return lock;
}

std::filesystem::path file_in(const std::filesystem::path& folder) {
  return folder / "running";
}

}  // namespace

RunningMark::RunningMark(const std::filesystem::path& folder, const std::string& attempt_id)
    : descriptor_(::open(file_in(folder).c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600)) {
  struct flock lock = lock_of(attempt_id, F_WRLCK);
  if (descriptor_ >= 0 && ::fcntl(descriptor_, F_OFD_SETLK, &lock) == 0) return;
  if (descriptor_ >= 0) ::close(descriptor_);
  throw base::Failure("disk", "a running attempt cannot be marked as such");
}

RunningMark::~RunningMark() {
  ::close(descriptor_);
}

bool is_running(const std::filesystem::path& folder, const std::string& attempt_id) {
  const int descriptor = ::open(file_in(folder).c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  struct flock lock = lock_of(attempt_id, F_WRLCK);
  const bool asked = ::fcntl(descriptor, F_OFD_GETLK, &lock) == 0;
  ::close(descriptor);
  return asked && lock.l_type != F_UNLCK;
}

}  // namespace seldinger::casedb
