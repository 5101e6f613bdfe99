// Files and folders that must survive a power cut, and what a library's folder may lie on. Paths stay out of error
// texts. Whatever the file system refuses throws base::Failure("disk").
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace seldinger::casedb {

// `type` as statfs(2) tells it. SQLite's WAL needs memory shared by all processes, which these do not give
// (sqlite.org/wal.html). FUSE and 9p are not judged: they are local as often as not.
bool is_network_file_system(long type) noexcept;
// The folder, or its nearest ancestor that exists, lies on one.
bool lies_on_network(const std::filesystem::path& folder);

void sync_file(const std::filesystem::path& file);
void sync_folder(const std::filesystem::path& folder);

// The file appears whole under its name, or not at all: temporary name beside it, fsync, rename, fsync of the
// folder.
void write_durably(const std::filesystem::path& file, std::span<const std::byte> bytes);
std::vector<std::byte> read_whole(const std::filesystem::path& file);

// Makes the folder and its missing parents, and takes back those it made unless kept and as long as they are empty.
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
