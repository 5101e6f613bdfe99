#include "casedb/database/leftovers.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <vector>

#include "casedb/database/disk.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

// Links are never followed: what they lead to is not ours.
bool is_own(const fs::path& path, mode_t type) {
  struct stat about {};
  return ::lstat(path.c_str(), &about) == 0 && (about.st_mode & S_IFMT) == type && about.st_uid == ::geteuid();
}

bool begins_with(const fs::path& file, std::string_view magic) {
  const std::vector<std::byte> start = OpenFile(file).read(0, magic.size());
  return std::string_view(reinterpret_cast<const char*>(start.data()), start.size()) ==
         magic.substr(0, start.size());
}

bool holds_only(const fs::path& folder, const std::function<bool(const std::string&)>& is_ours) {
  bool any = false;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!is_own(entry.path(), S_IFREG) && !is_own(entry.path(), S_IFDIR)) return false;
    if (!is_ours(fs::relative(entry.path(), folder).string())) return false;
    any = true;
  }
  return any;
}

// Calls for each entry, whatever befalls one of them.
void for_each_in(const fs::path& folder, const std::function<void(const fs::path&)>& look) {
  std::error_code error;
  std::vector<fs::path> paths;
  for (fs::directory_iterator at(folder.empty() ? fs::path(".") : folder, error), end; !error && at != end;
       at.increment(error))
    paths.push_back(at->path());
  for (const fs::path& path : paths) try {
      look(path);
    } catch (const fs::filesystem_error&) {
    } catch (const base::Failure&) {
    }
}

}  // namespace

void remove_leftover_files(const fs::path& folder, std::string_view magic) {
  for_each_in(folder, [&](const fs::path& path) {
    if (is_temporary_name(path.filename().string()) && is_own(path, S_IFREG) && begins_with(path, magic))
      is_abandoned(path, true);
  });
}

void remove_leftover_folders(const fs::path& folder, const std::function<bool(const std::string&)>& is_ours) {
  for_each_in(folder, [&](const fs::path& path) {
    if (path.extension() != kUnfinished || !is_own(path, S_IFDIR)) return;
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return;
    std::error_code ignored;
    if (::flock(descriptor, LOCK_EX | LOCK_NB) == 0 && holds_only(path, is_ours))
      fs::remove_all(path, ignored);  // still locked: nobody begins to write there meanwhile
    ::close(descriptor);
  });
}

}  // namespace seldinger::casedb
