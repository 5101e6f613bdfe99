#include "casedb/database/disk.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <iterator>
#include <string_view>
#include <system_error>

#include "sim/base/check.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTemporary = ".tmp-";  // then the process and a number

[[noreturn]] void fail(const std::string& doing, int error) {
  if (error == ENOSPC || error == EDQUOT || error == EFBIG) throw base::Failure("disk", "the disk is full");
  throw base::Failure("disk", doing + ": " + std::generic_category().message(error));
}

class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags, mode_t mode = 0)
      : value_(::open(path.c_str(), flags | O_CLOEXEC, mode)) {
    if (value_ < 0) fail("a file cannot be opened", errno);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (value_ >= 0) ::close(value_);
  }
  int get() const noexcept { return value_; }

 private:
  int value_;
};

void write_all(int descriptor, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail("a file cannot be written", errno);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void sync_descriptor(int descriptor) {
  if (::fsync(descriptor) != 0) fail("a file cannot be written", errno);
}

}  // namespace

bool is_network_file_system(long type) noexcept {
  // statfs(2) and linux/magic.h; the cluster file systems are not all in that header.
  constexpr unsigned kCifs = 0xff534d42, kSmb2 = 0xfe534d42, kCeph = 0x00c36400, kLustre = 0x0bd00bd0,
                     kGpfs = 0x47504653, kKernelAfs = 0x6b414653;
  switch (static_cast<unsigned>(type)) {  // f_type is sign-extended on some machines
    case NFS_SUPER_MAGIC:
    case SMB_SUPER_MAGIC:
    case NCP_SUPER_MAGIC:
    case CODA_SUPER_MAGIC:
    case AFS_SUPER_MAGIC:
    case kCifs:
    case kSmb2:
    case kCeph:
    case kLustre:
    case kGpfs:
    case kKernelAfs:
      return true;
    default:
      return false;
  }
}

bool lies_on_network(const fs::path& folder) {
  fs::path existing = fs::absolute(folder);
  std::error_code ignored;
  while (!fs::exists(existing, ignored) && existing.has_relative_path()) existing = existing.parent_path();
  struct statfs about {};
  if (::statfs(existing.c_str(), &about) != 0) fail("the file system cannot be asked", errno);
  return is_network_file_system(static_cast<long>(about.f_type));
}

void sync_file(const fs::path& file) {
  sync_descriptor(Descriptor(file, O_RDONLY).get());
}

void sync_folder(const fs::path& folder) {
  sync_descriptor(Descriptor(folder, O_RDONLY | O_DIRECTORY).get());
}

NewFile::NewFile(const fs::path& file, FileAccess access) : file_(file) {
  static std::atomic<unsigned> next{0};
  // Another round when somebody took our file for an abandoned one before it was locked, or has its name.
  for (int round = 0; round < 100; ++round) {
    temporary_ = file;
    temporary_ += kTemporary + std::to_string(::getpid()) + "-" + std::to_string(next++);
    descriptor_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                         access == FileAccess::owner ? 0600 : 0660);
    if (descriptor_ < 0 && errno == EEXIST) continue;  // of a process that was killed, or planted
    if (descriptor_ < 0) fail("a file cannot be opened", errno);
    struct stat about {};
    lock_ = ::dup(descriptor_);  // shares the lock and outlives the closing, until the file has its name
    if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0 && ::fstat(lock_, &about) == 0 && about.st_nlink > 0)
      return;
    ::unlink(temporary_.c_str());
    ::close(descriptor_);
    if (lock_ >= 0) ::close(lock_);
    descriptor_ = lock_ = -1;
  }
  temporary_.clear();  // not ours
  throw base::Failure("disk", "a file cannot be written");
}

NewFile::~NewFile() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
  if (lock_ >= 0) ::close(lock_);
}

void NewFile::write(std::span<const std::byte> bytes) {
  write_all(descriptor_, bytes);
}

void NewFile::keep() {
  sync_descriptor(descriptor_);
  keep_unsynced();
  sync_folder(file_.has_parent_path() ? file_.parent_path() : fs::path("."));
}

void NewFile::keep_unsynced() {
  const int closed = ::close(descriptor_);  // some file systems tell of a full disk only here
  descriptor_ = -1;
  if (closed != 0) fail("a file cannot be written", errno);
  if (::rename(temporary_.c_str(), file_.c_str()) != 0) fail("a file cannot be renamed", errno);
  temporary_.clear();
}

bool is_temporary_name(const std::string& name) noexcept {
  const std::size_t at = name.find(kTemporary);
  return at != std::string::npos &&
         name.find_first_not_of("0123456789-", at + std::string_view(kTemporary).size()) == std::string::npos;
}

bool is_abandoned(const fs::path& temporary, bool remove) {
  if (what_is(temporary) != Place::file) return false;
  const int descriptor = ::open(temporary.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (descriptor < 0) return false;
  const bool free = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (free && remove) ::unlink(temporary.c_str());  // still locked: nobody begins to write it meanwhile
  ::close(descriptor);
  return free;
}

void write_durably(const fs::path& file, std::span<const std::byte> bytes, FileAccess access) {
  NewFile made(file, access);
  made.write(bytes);
  made.keep();
}

Place what_is(const fs::path& path) noexcept {
  struct stat about {};
  if (::lstat(path.c_str(), &about) != 0) return errno == ENOENT ? Place::nothing : Place::something_else;
  return S_ISREG(about.st_mode) ? Place::file : Place::something_else;
}

bool can_write(const fs::path& folder) noexcept {
  return ::access(folder.c_str(), W_OK) == 0;  // also for root, EROFS on a read-only disk
}

void make_private(const fs::path& path) noexcept {
  struct stat about {};
  if (::lstat(path.c_str(), &about) != 0 || about.st_uid != ::geteuid() || (about.st_mode & 077U) == 0) return;
  if (S_ISREG(about.st_mode) || S_ISDIR(about.st_mode)) ::chmod(path.c_str(), about.st_mode & 0700U);
}

OpenFile::OpenFile(const fs::path& file)
    : descriptor_(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK)) {
  if (descriptor_ < 0) fail("a file cannot be opened", errno);
  struct stat about {};
  if (::fstat(descriptor_, &about) != 0 || !S_ISREG(about.st_mode)) {
    ::close(descriptor_);
    throw base::Failure("disk", "a file cannot be read");
  }
  size_ = static_cast<std::uint64_t>(about.st_size);
}

OpenFile::~OpenFile() {
  ::close(descriptor_);
}

std::vector<std::byte> OpenFile::read(std::uint64_t from, std::size_t count) const {
  std::vector<std::byte> bytes(
      from >= size_ ? 0 : static_cast<std::size_t>(std::min<std::uint64_t>(count, size_ - from)));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + done, bytes.size() - done, static_cast<off_t>(from + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("a file cannot be read", errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

std::vector<std::byte> read_whole(const fs::path& file) {
  const OpenFile in(file);
  return in.read(0, static_cast<std::size_t>(in.size()));
}

NewFolders::NewFolders(const fs::path& folder) {
  std::vector<fs::path> missing;  // innermost first
  std::error_code ignored;
  fs::path path = fs::absolute(folder).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();  // "a/"
  for (; !fs::exists(path, ignored); path = path.parent_path()) missing.push_back(path);
  for (auto next = missing.rbegin(); next != missing.rend(); ++next) {
    if (::mkdir(next->c_str(), std::next(next) == missing.rend() ? 0700 : 0777) == 0)
      made_.push_back(*next);
    else if (errno != EEXIST) {  // another process may have made it
      const int error = errno;
      for (auto made = made_.rbegin(); made != made_.rend(); ++made) ::rmdir(made->c_str());
      fail("a folder cannot be made", error);
    }
  }
}

NewFolders::~NewFolders() {
  for (auto made = made_.rbegin(); made != made_.rend(); ++made) ::rmdir(made->c_str());
}

NewFolder::NewFolder(const fs::path& folder) : folder_(fs::absolute(folder).lexically_normal()) {
  if (!folder_.has_filename()) folder_ = folder_.parent_path();  // "a/"
  unfinished_ = folder_;
  unfinished_ += kUnfinished;
  for (int round = 0; round < 10; ++round) {
    if (::mkdir(unfinished_.c_str(), 0700) != 0 && errno != EEXIST) fail("a folder cannot be made", errno);
    descriptor_ = ::open(unfinished_.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor_ < 0) fail("a folder cannot be opened", errno);
    if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
      ::close(descriptor_);
      descriptor_ = -1;
      throw base::Failure("disk", "another program is writing there");
    }
    std::error_code error;
    if (fs::is_empty(unfinished_, error) && !error) return;
    fs::remove_all(unfinished_, error);
    ::close(descriptor_);
    descriptor_ = -1;
  }
  throw base::Failure("disk", "a folder cannot be made");
}

NewFolder::~NewFolder() {
  std::error_code ignored;
  if (!unfinished_.empty()) fs::remove_all(unfinished_, ignored);
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool NewFolder::keep() {
  // One by one, thousands of files would take minutes.
  if (::syncfs(descriptor_) != 0) fail("a folder cannot be written", errno);
  if (::rename(unfinished_.c_str(), folder_.c_str()) != 0) {
    if (errno == ENOTEMPTY || errno == EEXIST || errno == ENOTDIR) return false;
    fail("a folder cannot be renamed", errno);
  }
  unfinished_.clear();
  sync_folder(folder_.parent_path());
  return true;
}

FolderLock::FolderLock(const fs::path& folder)
    : folder_(folder), descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (descriptor_ < 0) {
    if (errno == ENOENT) return;  // still_there() tells
    fail("the library's folder cannot be opened", errno);
  }
  while (::flock(descriptor_, LOCK_EX) != 0)
    if (errno != EINTR) {
      const int error = errno;
      ::close(descriptor_);
      fail("the library's folder cannot be locked", error);
    }
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool FolderLock::still_there() const noexcept {
  struct stat held {
  }, named{};
  return descriptor_ >= 0 && ::fstat(descriptor_, &held) == 0 && ::stat(folder_.c_str(), &named) == 0 &&
         held.st_dev == named.st_dev && held.st_ino == named.st_ino;
}

}  // namespace seldinger::casedb
