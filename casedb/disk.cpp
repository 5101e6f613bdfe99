#include "casedb/disk.h"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <system_error>

#include "sim/base/check.h"
#include "sim/base/failure.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

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
  void close() {  // some file systems tell of a full disk only here
    const int result = ::close(value_);
    value_ = -1;
    if (result != 0) fail("a file cannot be written", errno);
  }

 private:
  int value_;
};

// Removes the temporary file unless it was renamed.
class TemporaryFile {
 public:
  explicit TemporaryFile(fs::path path) : path_(std::move(path)) {}
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  const fs::path& path() const noexcept { return path_; }
  void rename_to(const fs::path& file) {
    if (::rename(path_.c_str(), file.c_str()) != 0) fail("a file cannot be renamed", errno);
    path_.clear();
  }

 private:
  fs::path path_;
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

void write_durably(const fs::path& file, std::span<const std::byte> bytes) {
  static std::atomic<unsigned> next{0};
  fs::path name = file;
  name += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(next++);
  TemporaryFile temporary(name);
  Descriptor out(temporary.path(), O_WRONLY | O_CREAT | O_TRUNC, 0660);
  write_all(out.get(), bytes);
  sync_descriptor(out.get());
  out.close();
  temporary.rename_to(file);
  sync_folder(file.has_parent_path() ? file.parent_path() : fs::path("."));
}

std::vector<std::byte> read_whole(const fs::path& file) {
  const Descriptor in(file, O_RDONLY);
  struct stat about {};
  if (::fstat(in.get(), &about) != 0) fail("a file cannot be read", errno);
  std::vector<std::byte> bytes(static_cast<std::size_t>(about.st_size));
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t got = ::read(in.get(), bytes.data() + done, bytes.size() - done);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) fail("a file cannot be read", errno);
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  bytes.resize(done);
  return bytes;
}

NewFolders::NewFolders(const fs::path& folder) {
  std::vector<fs::path> missing;  // innermost first
  std::error_code ignored;
  for (fs::path path = fs::absolute(folder).lexically_normal(); !fs::exists(path, ignored);
       path = path.parent_path())
    missing.push_back(path);
  for (auto path = missing.rbegin(); path != missing.rend(); ++path) {
    if (::mkdir(path->c_str(), 0777) == 0)
      made_.push_back(*path);
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
