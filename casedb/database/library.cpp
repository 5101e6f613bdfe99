#include "casedb/database/library.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <system_error>

#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "casedb/database/migrate.h"
#include "casedb/database/sqlite.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kUnfinished = ".new";  // a database that is being made

const base::Error kNoLibrary{"no_library", "there is no library in that folder"};
const base::Error kNetwork{"network_file_system",
                           "a library cannot lie on a network file system; use a disk of this machine"};

// SQLite's side files need room even to read, and stay behind where it ends. What cannot be opened is not touched.
void require_room(fs::path folder) {
  // 32 KiB of shared index a database, and the first pages of its log.
  constexpr std::uint64_t kRoom = 128 * 1024, kRoomOfOneFile = 64 * 1024;
  std::error_code error;
  for (folder = fs::absolute(folder); !fs::exists(folder) && folder.has_relative_path();)
    folder = folder.parent_path();
  const fs::space_info space = fs::space(folder, error);
  rlimit limit{};
  const bool limited = ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  if ((!error && space.available < kRoom) || (limited && limit.rlim_cur < kRoomOfOneFile))
    throw base::Failure("disk", "the disk is full");
}

void remove_database(const fs::path& file) noexcept {
  for (const char* part : {"", "-wal", "-shm", "-journal"}) ::unlink((file.string() + part).c_str());
}

// Makes a database under a temporary name; it is whole, closed and on disk when this returns.
void make_database(const fs::path& file, const Schema& schema, mode_t mode) {
  remove_database(file);  // of a process that was killed
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
  if (descriptor < 0) throw base::Failure("disk", "the library's folder cannot be written");
  ::close(descriptor);
  {
    Sqlite database(file);
    const auto made = migrate(database, schema);
    CHECK(made.has_value());
  }
  sync_file(file);
}

// Whether a folder without a library may become one: it is empty, or holds only what a killed creation leaves.
bool may_become_library(const fs::path& folder) {
  bool unfinished = false, identities = false, other = false;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(std::string(kDatabaseFile) + kUnfinished))
      unfinished = true;
    else if (name == kIdentitiesFile)
      identities = true;
    else if ((name == kAssetsFolder && entry.is_directory() && !entry.is_symlink() && fs::is_empty(entry.path())) ||
             name == "lost+found")  // the folder is a disk of its own
      continue;
    else if (!name.starts_with(std::string(kIdentitiesFile) + kUnfinished))
      other = true;
  }
  return !other && (unfinished || !identities);
}

// Under the folder's lock.
void create_in(const fs::path& folder) {
  const fs::path database = folder / kDatabaseFile, identities = folder / kIdentitiesFile;
  const fs::path new_database = database.string() + kUnfinished, new_identities = identities.string() + kUnfinished;
  try {
    // Until the last rename, names lie under their own name only beside the other's temporary one, so that
    // may_become_library() knows them as ours.
    remove_database(identities);
    make_database(new_database, library_schema(), 0660);
    make_database(new_identities, identities_schema(), 0600);
    NewFolders assets(folder / kAssetsFolder);
    fs::rename(new_identities, identities);
    sync_folder(folder);
    fs::rename(new_database, database);
    sync_folder(folder);
    assets.keep();
  } catch (...) {
    for (const auto& file : {new_database, new_identities, database, identities}) remove_database(file);
    throw;
  }
}

}  // namespace

bool is_asset_name(const std::string& text) noexcept {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

struct Library::Parts {
  fs::path folder;
  Sqlite database;
  Sqlite identities;
  Actor actor{};
};

base::Result<Library> Library::open(const fs::path& folder) {
  return without_paths([&]() -> base::Result<Library> {
    if (!fs::is_directory(folder) || !fs::exists(folder / kDatabaseFile)) return kNoLibrary;
    if (lies_on_network(folder)) return kNetwork;
    require_room(folder);
    if (!fs::exists(folder / kIdentitiesFile))
      return base::Error{"damaged", "the library's database of names is missing; restore a backup"};
    auto parts = std::make_unique<Parts>(
        Parts{fs::absolute(folder), Sqlite(folder / kDatabaseFile), Sqlite(folder / kIdentitiesFile), {}});
    const auto version = schema_version(parts->database, library_schema());
    if (!version) return version.error();
    const auto identities_version = schema_version(parts->identities, identities_schema());
    if (!identities_version) return identities_version.error();
    // Databases appear under their names only when whole, so an empty one is not ours.
    if (*version == 0 || *identities_version == 0)
      return base::Error{"not_a_library", "the database there is empty"};
    // What is deleted is overwritten: an erased name, the chunks of an attempt that was open.
    for (Sqlite* database : {&parts->database, &parts->identities}) database->run("PRAGMA secure_delete = ON");
    const FolderLock lock(folder);  // one process backs up and migrates
    for (auto [database, schema] :
         {std::pair(&parts->database, library_schema()), std::pair(&parts->identities, identities_schema())})
      if (const auto migrated = migrate(*database, schema); !migrated) return migrated.error();
    fs::create_directory(folder / kAssetsFolder);
    return Library(std::move(parts));
  });
}

base::Result<Library> Library::open_or_create(const fs::path& folder) {
  return without_paths([&]() -> base::Result<Library> {
    // Another process may make or take back the folder between two steps: then from the start.
    for (int round = 0; round < 100; ++round) {
      if (lies_on_network(folder)) return kNetwork;
      if (fs::exists(folder) && !fs::is_directory(folder))
        return base::Error{"not_a_library", "there is a file where the library's folder should be"};
      if (fs::exists(folder / kDatabaseFile)) return open(folder);
      require_room(folder);
      NewFolders made(folder);
      {
        const FolderLock lock(folder);
        if (!lock.still_there()) continue;
        if (!fs::exists(folder / kDatabaseFile)) {
          if (!may_become_library(folder))
            return base::Error{"not_a_library", "the folder is not empty and holds no library"};
          create_in(folder);
        }
      }
      made.keep();
      sync_folder(fs::absolute(folder).parent_path());
    }
    throw base::Failure("disk", "the library's folder appears and disappears");
  });
}

Library::Library(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
Library::Library(Library&&) noexcept = default;
Library& Library::operator=(Library&&) noexcept = default;
Library::~Library() = default;

void Library::shrink() {
  parts_->database.run("PRAGMA shrink_memory");
  parts_->identities.run("PRAGMA shrink_memory");
}

Sqlite& Library::database() noexcept {
  return parts_->database;
}
Sqlite& Library::identities() noexcept {
  return parts_->identities;
}
const Actor& Library::actor() const noexcept {
  return parts_->actor;
}
void Library::act_for(Actor actor) noexcept {
  parts_->actor = std::move(actor);
}
const fs::path& Library::folder() const noexcept {
  return parts_->folder;
}

Library::StoredAsset Library::store_asset(std::span<const std::byte> bytes) {
  StoredAsset stored{sha256_hex(bytes), false};
  const fs::path file = parts_->folder / kAssetsFolder / stored.sha256;
  std::error_code missing;
  const auto size = fs::file_size(file, missing);
  if (!missing && size == bytes.size()) {
    sync_folder(file.parent_path());  // another process may just have named it
    return stored;
  }
  stored.created = static_cast<bool>(missing);  // one of a wrong size is replaced; cases may refer to it
  write_durably(file, bytes);
  return stored;
}

void Library::remove_asset(const std::string& sha256) noexcept {
  if (is_asset_name(sha256)) ::unlink((parts_->folder / kAssetsFolder / sha256).c_str());
}

bool Library::has_asset(const std::string& sha256) const noexcept {
  return is_asset_name(sha256) && ::access((parts_->folder / kAssetsFolder / sha256).c_str(), F_OK) == 0;
}

base::Result<std::vector<std::byte>> Library::load_asset(const std::string& sha256) const {
  if (!has_asset(sha256)) return base::Error{"asset_missing", "a file of the library is missing"};
  std::vector<std::byte> bytes = read_whole(parts_->folder / kAssetsFolder / sha256);
  if (sha256_hex(bytes) != sha256) return base::Error{"asset_damaged", "a file of the library is damaged"};
  return bytes;
}

}  // namespace seldinger::casedb
