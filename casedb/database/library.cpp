#include "casedb/database/library.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>
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
  // A file system without any capacity, as /proc, tells nothing of room.
  if ((!error && space.capacity > 0 && space.available < kRoom) || (limited && limit.rlim_cur < kRoomOfOneFile))
    throw base::Failure("disk", "the disk is full");
}

void remove_database(const fs::path& file) noexcept {
  for (const char* part : {"", "-wal", "-shm", "-journal"}) ::unlink((file.string() + part).c_str());
}

// Makes a database under a temporary name; it is whole, closed and on disk when this returns.
void make_database(const fs::path& file, const Schema& schema) {
  remove_database(file);  // of a process that was killed
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
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
    make_database(new_database, library_schema());
    make_database(new_identities, identities_schema());
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
  bool read_only = false;
  Actor actor{};

  static std::unique_ptr<Parts> make(const fs::path& folder, const fs::path& databases, Sqlite::Mode mode) {
    return std::make_unique<Parts>(Parts{fs::absolute(folder), Sqlite(databases / kDatabaseFile, mode),
                                         Sqlite(databases / kIdentitiesFile, mode)});
  }
  // Refused as Library::open. False: there is something to migrate.
  base::Result<bool> is_newest() {
    bool newest = true;
    for (const auto& [file, schema] :
         {std::pair(&database, library_schema()), std::pair(&identities, identities_schema())}) {
      const auto version = schema_version(*file, schema);
      if (!version) return version.error();
      // Databases appear under their names only when whole, so an empty one is not ours.
      if (*version == 0) return base::Error{"not_a_library", "the database there is empty"};
      newest = newest && *version == newest_version(schema);
    }
    return newest;
  }
  base::Result<void> migrated() {
    for (const auto& [file, schema] :
         {std::pair(&database, library_schema()), std::pair(&identities, identities_schema())})
      if (const auto walked = migrate(*file, schema); !walked) return walked.error();
    return {};
  }
  void refuse_writing() {
    read_only = true;
    for (Sqlite* file : {&database, &identities}) {
      file->run("PRAGMA query_only = ON");
      file->refuse_writing();
    }
  }

  static base::Result<std::unique_ptr<Parts>> open_for_writing(const fs::path& folder);
  static base::Result<std::unique_ptr<Parts>> open_for_reading(const fs::path& folder);
  static base::Result<std::unique_ptr<Parts>> open_copy(const fs::path& folder);
};

namespace {

// SQLite follows links and waits for a FIFO.
base::Result<void> check_places(const fs::path& folder) {
  for (const char* file : {kDatabaseFile, kIdentitiesFile}) {
    if (what_is(folder / file) == Place::nothing)
      return base::Error{"damaged", "the library's database of names is missing; restore a backup"};
    for (const char* part : {"", "-wal", "-shm", "-journal"})
      if (what_is(folder / (std::string(file) + part)) == Place::something_else)
        return base::Error{"damaged", "in the place of the library's file " + std::string(file) + part +
                                          " lies something else; it was not opened"};
  }
  if (what_is(folder / kAssetsFolder) == Place::file)
    return base::Error{"damaged", "in the place of the library's folder assets lies a file"};
  return {};
}

bool has_log(const fs::path& folder) {
  std::error_code none;
  for (const char* file : {kDatabaseFile, kIdentitiesFile})
    for (const char* part : {"-wal", "-journal"})
      if (const auto size = fs::file_size(folder / (std::string(file) + part), none); !none && size > 0)
        return true;
  return false;
}

// Private, and gone with all it holds.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "seldinger-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw base::Failure("disk", "a temporary folder cannot be made");
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  const fs::path& path() const noexcept { return path_; }

 private:
  fs::path path_;
};

}  // namespace

base::Result<std::unique_ptr<Library::Parts>> Library::Parts::open_for_writing(const fs::path& folder) {
  require_room(folder);
  for (const char* part : {"", kAssetsFolder, kDatabaseFile, kIdentitiesFile}) make_private(folder / part);
  for (const char* file : {kDatabaseFile, kIdentitiesFile})
    for (const char* part : {"-wal", "-shm"}) make_private(folder / (std::string(file) + part));
  auto parts = make(folder, folder, Sqlite::Mode::existing);
  if (const auto newest = parts->is_newest(); !newest) return newest.error();
  // What is deleted is overwritten: an erased name, the chunks of an attempt that was open.
  for (Sqlite* database : {&parts->database, &parts->identities}) database->run("PRAGMA secure_delete = ON");
  const FolderLock lock(folder);  // one process backs up and migrates
  if (const auto migrated = parts->migrated(); !migrated) return migrated.error();
  if (::mkdir((folder / kAssetsFolder).c_str(), 0700) != 0 && errno != EEXIST)
    throw base::Failure("disk", "the library's folder cannot be written");
  return parts;
}

base::Result<std::unique_ptr<Library::Parts>> Library::Parts::open_for_reading(const fs::path& folder) {
  struct statvfs about {};
  const bool nobody_writes = ::statvfs(folder.c_str(), &about) == 0 && (about.f_flag & ST_RDONLY) != 0;
  try {
    auto parts =
        make(folder, folder, nobody_writes && !has_log(folder) ? Sqlite::Mode::immutable : Sqlite::Mode::read_only);
    const auto newest = parts->is_newest();
    if (!newest) return newest.error();
    if (*newest) {
      parts->refuse_writing();
      return parts;
    }
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() != DatabaseFailure::Kind::disk) throw;  // SQLite wants to write an index of the log
  }
  return open_copy(folder);
}

base::Result<std::unique_ptr<Library::Parts>> Library::Parts::open_copy(const fs::path& folder) {
  const TemporaryFolder copy;
  for (const char* file : {kDatabaseFile, kIdentitiesFile})
    for (const char* part : {"", "-wal", "-journal"}) {
      const std::string name = std::string(file) + part;
      if (what_is(folder / name) == Place::nothing) continue;
      constexpr std::size_t kPiece = std::size_t{1} << 20;
      const OpenFile in(folder / name);
      NewFile out(copy.path() / name);
      for (std::uint64_t at = 0; at < in.size(); at += kPiece) out.write(in.read(at, kPiece));
      out.keep_unsynced();
    }
  auto parts = make(folder, copy.path(), Sqlite::Mode::existing);
  if (const auto newest = parts->is_newest(); !newest) return newest.error();
  if (const auto migrated = parts->migrated(); !migrated) return migrated.error();
  parts->refuse_writing();
  return parts;
}

base::Result<Library> Library::open(const fs::path& folder) {
  return without_paths([&]() -> base::Result<Library> {
    if (!fs::is_directory(folder) || what_is(folder / kDatabaseFile) == Place::nothing) return kNoLibrary;
    if (lies_on_network(folder)) return kNetwork;
    if (const auto places = check_places(folder); !places) return places.error();
    const bool writable =
        can_write(folder) && can_write(folder / kDatabaseFile) && can_write(folder / kIdentitiesFile);
    auto parts = writable ? Parts::open_for_writing(folder) : Parts::open_for_reading(folder);
    if (!parts) return parts.error();
    return Library(std::move(parts.value()));
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
bool Library::read_only() const noexcept {
  return parts_->read_only;
}

Library::StoredAsset Library::store_asset(std::span<const std::byte> bytes) {
  if (parts_->read_only)
    throw base::Failure("read_only", "the library can only be read: its disk or its folder is write-protected");
  StoredAsset stored{sha256_hex(bytes), false};
  const fs::path file = parts_->folder / kAssetsFolder / stored.sha256;
  const AssetState state = asset_state(stored.sha256);
  if (state == AssetState::sound) {
    sync_folder(file.parent_path());  // another process may just have named it
    return stored;
  }
  stored.created = state == AssetState::missing;            // what was there is replaced; cases may refer to it
  if (state == AssetState::no_file) ::rmdir(file.c_str());  // an empty folder; what is in a full one is somebody's
  write_durably(file, bytes);
  return stored;
}

void Library::remove_asset(const std::string& sha256) noexcept {
  if (is_asset_name(sha256)) ::unlink((parts_->folder / kAssetsFolder / sha256).c_str());
}

bool Library::has_asset(const std::string& sha256) const noexcept {
  return is_asset_name(sha256) && what_is(parts_->folder / kAssetsFolder / sha256) == Place::file;
}

Library::AssetState Library::asset_state(const std::string& sha256) const {
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  const fs::path file = parts_->folder / kAssetsFolder / sha256;
  const Place place = what_is(file);
  if (place == Place::nothing) return AssetState::missing;
  if (place == Place::something_else) return AssetState::no_file;
  try {
    const OpenFile in(file);
    Sha256 hash;
    for (std::uint64_t at = 0; at < in.size(); at += kPiece) hash.add(in.read(at, kPiece));
    return hash.hex() == sha256 ? AssetState::sound : AssetState::damaged;
  } catch (const base::Failure&) {
    return AssetState::damaged;  // the disk cannot read it
  }
}

base::Result<std::vector<std::byte>> Library::load_asset(const std::string& sha256) const {
  if (is_asset_name(sha256) && what_is(parts_->folder / kAssetsFolder / sha256) == Place::something_else)
    return base::Error{"asset_damaged", "in the place of a file of the library lies something else"};
  if (!has_asset(sha256)) return base::Error{"asset_missing", "a file of the library is missing"};
  std::vector<std::byte> bytes = read_whole(parts_->folder / kAssetsFolder / sha256);
  if (sha256_hex(bytes) != sha256) return base::Error{"asset_damaged", "a file of the library is damaged"};
  return bytes;
}

}  // namespace seldinger::casedb
