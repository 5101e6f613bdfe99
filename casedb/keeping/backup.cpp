#include "casedb/keeping/backup.h"

#include <algorithm>
#include <map>
#include <set>
#include <sstream>
#include <vector>

#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "casedb/database/leftovers.h"
#include "casedb/database/migrate.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/check.h"
#include "sim/base/failure.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr const char* kListFile = "backup.txt";
constexpr const char* kFirstLine = "seldinger-backup 1";
constexpr std::size_t kPiece = std::size_t{1} << 20;
constexpr std::uint64_t kMostListBytes = std::uint64_t{64} << 20;  // half a million files

struct Listed {
  std::uint64_t bytes = 0;
  std::string sha256;
};
using List = std::map<std::string, Listed>;  // by the name below the folder

// Reads a file piece by piece, however large it is.
template <typename Use>
Listed read_by_pieces(const fs::path& file, const Use& use) {
  const OpenFile in(file);
  Sha256 hash;
  Listed read;
  for (std::uint64_t at = 0; at < in.size(); at += kPiece) {
    const std::vector<std::byte> piece = in.read(at, kPiece);
    hash.add(piece);
    use(piece);
    read.bytes += piece.size();
  }
  read.sha256 = hash.hex();
  return read;
}

// Copies a file into a new folder and tells what was copied.
Listed copied_file(const fs::path& from, const fs::path& to) {
  NewFile out(to);
  const Listed copied = read_by_pieces(from, [&](const auto& piece) { out.write(piece); });
  out.keep_unsynced();
  return copied;
}

std::string text_of(const List& list, const std::string& program_version) {
  std::string text = std::string(kFirstLine) + "\nprogram " + program_version + "\n";
  for (const auto& [name, file] : list)
    text += "file " + name + " " + std::to_string(file.bytes) + " " + file.sha256 + "\n";
  return text + "end " + std::to_string(list.size()) + "\n";
}

base::Result<List> read_list(const fs::path& folder) {
  const base::Error no_backup{"no_backup", "there is no backup in that folder"};
  const base::Error damaged{"damaged", "the backup's list of files is damaged"};
  const fs::path file = folder / kListFile;
  if (what_is(file) != Place::file) return no_backup;
  if (fs::file_size(file) > kMostListBytes) return damaged;
  const std::vector<std::byte> bytes = read_whole(file);
  std::istringstream lines(std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  std::string line, word;
  if (!std::getline(lines, line) || line != kFirstLine) return no_backup;
  List list;
  bool ended = false;
  while (std::getline(lines, line)) {
    if (ended) return damaged;
    std::istringstream words(line);
    words >> word;
    if (word == "file") {
      std::string name;
      Listed listed;
      if (!(words >> name >> listed.bytes >> listed.sha256) || !is_asset_name(listed.sha256)) return damaged;
      // No other name leads anywhere.
      const std::string prefix = std::string(kAssetsFolder) + "/";
      const bool asset = name.starts_with(prefix) && name.substr(prefix.size()) == listed.sha256;
      if (!asset && name != kDatabaseFile && name != kIdentitiesFile) return damaged;
      if (!list.emplace(name, listed).second) return damaged;
    } else if (word == "end") {
      std::size_t count = 0;
      if (!(words >> count) || count != list.size()) return damaged;
      ended = true;
    } else if (word != "program") {
      return damaged;
    }
  }
  if (!ended || !list.contains(kDatabaseFile) || !list.contains(kIdentitiesFile)) return damaged;
  return list;
}

Copied sum_of(const List& list) {
  Copied sum{list.size(), 0};
  for (const auto& [name, file] : list) sum.bytes += file.bytes;
  return sum;
}

// What the databases in the folder are: ours, whole, and with all the assets they name, and no others.
base::Result<void> check_copy(const fs::path& folder, const List& list) {
  std::set<std::string> named;
  for (const auto& [file, schema] :
       {std::pair(kDatabaseFile, library_schema()), {kIdentitiesFile, identities_schema()}}) {
    Sqlite database(folder / file);
    const auto version = schema_version(database, schema);
    if (!version) return version.error();
    if (*version == 0) return base::Error{"damaged", "a database of the backup is empty"};
    if (const auto problems = problems_of(database); !problems.empty())
      return base::Error{"damaged", problems.front().text, problems};
    if (file == kDatabaseFile) named = assets_named(database);
  }
  for (const std::string& name : named)
    if (!list.contains(std::string(kAssetsFolder) + "/" + name))
      return base::Error{"asset_missing", "the file " + name + " of assets/ is missing"};
  if (named.size() + 2 != list.size()) return base::Error{"damaged", "the backup holds files that no row names"};
  return {};
}

// Copies what the copied database names. False: a case went meanwhile, so that another state is to be copied.
base::Result<bool> copy_assets(Library& library, const fs::path& folder, List& list) {
  NewFolders assets(folder / kAssetsFolder);
  assets.keep();
  std::set<std::string> named;
  {
    Sqlite copy(folder / kDatabaseFile);
    named = assets_named(copy);
  }
  for (const std::string& name : named) {
    Listed copied;
    const Place place = what_is(library.folder() / kAssetsFolder / name);
    const bool there = place != Place::nothing;
    if (place == Place::file)
      copied = copied_file(library.folder() / kAssetsFolder / name, folder / kAssetsFolder / name);
    if (copied.sha256 != name) {
      if (!assets_named(library.database()).contains(name)) return false;
      return there ? base::Error{"asset_damaged", "the file " + name + " of assets/ is damaged; see check"}
                   : base::Error{"asset_missing", "the file " + name + " of assets/ is missing; see check"};
    }
    list[std::string(kAssetsFolder) + "/" + name] = copied;
  }
  return true;
}

// What a backup that was killed holds: parts of it, finished or not.
bool is_of_a_backup(const std::string& name) {
  const std::string assets = std::string(kAssetsFolder) + "/";
  if (name.starts_with(assets)) {
    const std::string asset = name.substr(assets.size());
    return is_asset_name(asset) || (is_temporary_name(asset) && is_asset_name(asset.substr(0, 64)));
  }
  return name == kAssetsFolder || name.starts_with(kDatabaseFile) || name.starts_with(kIdentitiesFile) ||
         name.starts_with(kListFile);
}

base::Result<Copied> backed_up(Library& library, const fs::path& out, const std::string& program_version) {
  const base::Error exists{"exists", "something has the backup's name already"};
  if (fs::exists(fs::symlink_status(out))) return exists;
  NewFolders parents(fs::absolute(out).lexically_normal().parent_path());
  NewFolder made(out);
  const fs::path& folder = made.unfinished();
  remove_leftover_folders(folder.parent_path(), &is_of_a_backup);
  List list;
  for (int round = 0; round < 5; ++round) {
    list.clear();
    for (const auto& entry : fs::directory_iterator(folder)) fs::remove_all(entry.path());
    // Names first: whoever has one has been a person before.
    copy_database(library.identities(), folder / kIdentitiesFile);
    copy_database(library.database(), folder / kDatabaseFile);
    const auto copied = copy_assets(library, folder, list);
    if (!copied) return copied.error();
    if (!*copied) continue;
    for (const char* file : {kDatabaseFile, kIdentitiesFile})
      list[file] = read_by_pieces(folder / file, [](const auto&) {});
    if (const auto sound = check_copy(folder, list); !sound) return sound.error();
    const std::string text = text_of(list, program_version);
    write_durably(folder / kListFile, std::as_bytes(std::span(text)));
    if (!made.keep()) return exists;
    parents.keep();
    return sum_of(list);
  }
  throw base::Failure("database", "cases come and go faster than they can be copied");
}

// Those that ended since the backup would open something again.
void end_sessions(const fs::path& file) {
  Sqlite database(file);
  database.run("PRAGMA secure_delete = ON");
  const auto tables = tables_of(database);
  Transaction transaction(database);
  for (const char* sessions : {"login_session", "web_session", "password_link"})
    if (std::ranges::find(tables, sessions) != tables.end()) database.run(std::string("DELETE FROM ") + sessions);
  transaction.commit();
}

base::Result<Copied> restored(const fs::path& in, const fs::path& folder) {
  const base::Error exists{"exists", "there is something where the library is to be; it is not overwritten"};
  if (lies_on_network(folder))
    return base::Error{"network_file_system", "a library cannot lie on a network file system"};
  const auto list = read_list(in);
  if (!list) return list.error();
  std::error_code ignored;
  if (fs::exists(fs::symlink_status(folder)) && !(fs::is_directory(folder) && fs::is_empty(folder, ignored)))
    return exists;
  NewFolders parents(fs::absolute(folder).lexically_normal().parent_path());
  NewFolder made(folder);
  NewFolders assets(made.unfinished() / kAssetsFolder);
  assets.keep();
  for (const auto& [name, file] : *list) {
    const base::Error damaged{"damaged", "the backup's file " + name + " is not what was backed up"};
    if (what_is(in / name) != Place::file || fs::file_size(in / name) != file.bytes) return damaged;
    if (copied_file(in / name, made.unfinished() / name).sha256 != file.sha256) return damaged;
  }
  if (const auto sound = check_copy(made.unfinished(), *list); !sound) return sound.error();
  end_sessions(made.unfinished() / kDatabaseFile);
  if (!made.keep()) return exists;
  parents.keep();
  return sum_of(*list);
}

}  // namespace

base::Result<Copied> back_up(Library& library, const fs::path& out, const std::string& program_version) {
  return without_paths([&] { return backed_up(library, out, program_version); });
}

base::Result<Copied> restore(const fs::path& in, const fs::path& folder) {
  return without_paths([&] { return restored(in, folder); });
}

}  // namespace seldinger::casedb
