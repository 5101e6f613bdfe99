// A library on disk: `seldinger.sqlite`, `identities.sqlite` (names, apart from performance) and `assets/<sha256>`.
// Any process of this machine may open it. Throws base::Failure ("disk", "database"); refuses by Result what is not
// a library of ours (`no_library`, `not_a_library`, `newer_schema`, `schema_mismatch`, `damaged`,
// `network_file_system`). One thread at a time uses a Library; every thread may open its own.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "casedb/database/actor.h"
#include "sim/base/result.h"

namespace seldinger::casedb {

class Sqlite;

// A library's parts, by their names in its folder.
// Of each person the jobs that they asked for on pages (web/jobs/jobs.h), in a folder that is called as their id.
constexpr const char* kJobsFolder = "jobs";
constexpr const char* kDatabaseFile = "seldinger.sqlite";  // appears last: where it is, there is a library
constexpr const char* kIdentitiesFile = "identities.sqlite";
constexpr const char* kAssetsFolder = "assets";

bool is_asset_name(const std::string& text) noexcept;  // 64 digits of lower-case hexadecimal

class Library {
 public:
  // Opens an existing library, migrating it (after a backup beside it) when its schema is older. Where nothing can
  // be written (a disk that Linux mounted read-only, a folder without the permission) it can be read all the same,
  // and every change throws Failure("read_only"): as it lies there, or, where it needs its log or a migration, as a
  // copy of the databases in the folder for temporary files, which is gone when this returns.
  static base::Result<Library> open(const std::filesystem::path& folder);
  // As open; makes folder and library when there is none. When creation fails nothing is left behind.
  static base::Result<Library> open_or_create(const std::filesystem::path& folder);

  Library(Library&&) noexcept;
  Library& operator=(Library&&) noexcept;
  ~Library();

  Sqlite& database() noexcept;    // cases, attempts, accounts
  Sqlite& identities() noexcept;  // names only
  const std::filesystem::path& folder() const noexcept;
  // For whom it acts, as audit log and decisions keep it: the operator, until somebody has proven who they are.
  const Actor& actor() const noexcept;
  void act_for(Actor actor) noexcept;
  // Gives back the pages that SQLite keeps (up to 2 MB a database): for who stays open long and reads seldom.
  void shrink();
  bool read_only() const noexcept;

  // Stores bytes under their SHA-256 (hex, 64 characters): temporary name, fsync, rename, fsync of the folder.
  // `created` tells whether the file is new, so that a failed transaction can take it back with remove_asset.
  struct StoredAsset {
    std::string sha256;
    bool created = false;
  };
  // What is there under that name with other bytes is replaced; it is read for that.
  StoredAsset store_asset(std::span<const std::byte> bytes);
  void remove_asset(const std::string& sha256) noexcept;
  bool has_asset(const std::string& sha256) const noexcept;  // a file; whatever it holds
  // Reads it. Something else in its place (a link, a FIFO, a folder) is not opened; what cannot be read is damaged.
  enum class AssetState { sound, missing, damaged, no_file };
  AssetState asset_state(const std::string& sha256) const;
  // Refused: `asset_missing`, `asset_damaged` (its SHA-256 differs).
  base::Result<std::vector<std::byte>> load_asset(const std::string& sha256) const;

 private:
  struct Parts;
  explicit Library(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace seldinger::casedb
