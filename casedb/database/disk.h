// Files and folders that must survive a power cut, and what a library's folder may lie on. Paths stay out of error
// texts. Whatever the file system refuses throws base::Failure("disk").
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/base/failure.h"

namespace seldinger::casedb {

// std::filesystem's exceptions hold paths.
template <typename Function>
auto without_paths(const Function& function) {
  try {
    return function();
  } catch (const std::filesystem::filesystem_error& error) {
    throw base::Failure("disk", "a folder cannot be used: " + error.code().message());
  }
}

// `type` as statfs(2) tells it. SQLite's WAL needs memory shared by all processes, which these do not give
// (sqlite.org/wal.html). FUSE and 9p are not judged: they are local as often as not.
bool is_network_file_system(long type) noexcept;
// The folder, or its nearest ancestor that exists, lies on one.
bool lies_on_network(const std::filesystem::path& folder);

void sync_file(const std::filesystem::path& file);
void sync_folder(const std::filesystem::path& folder);

// Whom a new file is for: what holds people's doings is its owner's alone, whatever the umask; what somebody asked
// to be written out is as their umask says.
enum class FileAccess { owner, as_umask };

// A file that appears whole under its name, or not at all: temporary name beside it, fsync, rename, fsync of the
// folder. The temporary one is new (O_EXCL: no link is followed), locked (flock) as long as somebody writes it, and
// goes when it is not kept.
class NewFile {
 public:
  explicit NewFile(const std::filesystem::path& file, FileAccess access = FileAccess::owner);
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;
  ~NewFile();
  void write(std::span<const std::byte> bytes);
  void keep();           // takes the place of what had that name
  void keep_unsynced();  // within a NewFolder, which syncs all it holds at once

 private:
  std::filesystem::path file_, temporary_;
  int descriptor_ = -1, lock_ = -1;
};
// Whether the name is one that a NewFile gives its temporary file.
bool is_temporary_name(const std::string& name) noexcept;
// A temporary file whose writer is gone; with `remove`, it goes too.
bool is_abandoned(const std::filesystem::path& temporary, bool remove = false);

void write_durably(const std::filesystem::path& file, std::span<const std::byte> bytes,
                   FileAccess access = FileAccess::owner);
std::vector<std::byte> read_whole(const std::filesystem::path& file);

// What has a name, without opening it: a link, a FIFO or a folder in a file's place is not followed, waited for or
// listed.
enum class Place { nothing, file, something_else };
Place what_is(const std::filesystem::path& path) noexcept;
// Whether this process may make files there: not on a disk that is mounted read-only, nor without the permission.
bool can_write(const std::filesystem::path& folder) noexcept;
// Takes everybody else's rights away from what is the caller's own.
void make_private(const std::filesystem::path& path) noexcept;

// An existing file, read in pieces. Only a regular one is opened: a link is not followed, a FIFO not waited for.
class OpenFile {
 public:
  explicit OpenFile(const std::filesystem::path& file);
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile();
  std::uint64_t size() const noexcept { return size_; }
  int descriptor() const noexcept { return descriptor_; }
  // Fewer bytes where the file ends.
  std::vector<std::byte> read(std::uint64_t from, std::size_t count) const;

 private:
  int descriptor_ = -1;
  std::uint64_t size_ = 0;
};

// Makes the folder, its owner's alone, and its missing parents, and takes back those it made unless kept and as
// long as they are empty.
class NewFolders {
 public:
  explicit NewFolders(const std::filesystem::path& folder);
  NewFolders(const NewFolders&) = delete;
  NewFolders& operator=(const NewFolders&) = delete;
  ~NewFolders();
  void keep() noexcept { made_.clear(); }

 private:
  std::vector<std::filesystem::path> made_;  // outermost first
};

// A folder that appears whole under its name, or not at all: made as `<name>.unfinished` beside it, readable by its
// owner only, synced with all it holds when it is kept, and taken away with it unless. One left by a killed process
// is replaced.
inline constexpr const char* kUnfinished = ".unfinished";
class NewFolder {
 public:
  explicit NewFolder(const std::filesystem::path& folder);
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder();
  const std::filesystem::path& unfinished() const noexcept { return unfinished_; }
  bool keep();  // false when something that is not an empty folder has its name

 private:
  std::filesystem::path folder_, unfinished_;
  int descriptor_ = -1;
};

// Held by one process at a time, given back by the kernel when the process dies.
class FolderLock {
 public:
  explicit FolderLock(const std::filesystem::path& folder);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();
  // The locked folder is still the one under that name: nobody removed it while we waited.
  bool still_there() const noexcept;

 private:
  std::filesystem::path folder_;
  int descriptor_ = -1;
};

}  // namespace seldinger::casedb
