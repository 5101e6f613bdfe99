#include "casedb/keeping/check.h"

#include <unistd.h>

#include <bit>
#include <set>
#include <string>

#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/disk.h"
#include "casedb/database/library.h"
#include "casedb/database/question.h"
#include "casedb/database/tables.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kCheckedPiece = std::size_t{1} << 20;

std::string sha256_of(const fs::path& file) {
  const OpenFile in(file);
  Sha256 hash;
  for (std::uint64_t at = 0; at < in.size(); at += kCheckedPiece) hash.add(in.read(at, kCheckedPiece));
  return hash.hex();
}

// Files that no row names and temporary files whose writer is gone.
void check_files_in_assets(Library& library, bool repair, CheckReport& report) {
  const fs::path folder = library.folder() / kAssetsFolder;
  std::vector<std::string> names;
  std::size_t unknown = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (is_temporary_name(name) && is_asset_name(name.substr(0, 64))) {
      if (is_abandoned(entry.path(), repair))
        (repair ? report.repaired : report.findings)
            .push_back({"leftover_file", "a temporary file of assets/ was left behind"});
    } else if (is_asset_name(name) && entry.is_regular_file()) {
      names.push_back(name);
    } else {
      ++unknown;
    }
  }
  if (unknown > 0)
    report.findings.push_back({"unknown_file", "assets/ holds " + std::to_string(unknown) +
                                                   (unknown == 1 ? " thing that is" : " things that are") +
                                                   " not the library's"});
  // Asked after the files were listed: a file whose row came meanwhile is named.
  const std::set<std::string> named = assets_named(library.database());
  for (const std::string& name : names) {
    if (named.contains(name)) continue;
    if (repair) {
      // Nobody stores a row without this lock, and whoever is about to stores the file again under it.
      const Transaction lock(library.database());
      if (assets_named(library.database()).contains(name)) continue;
      library.remove_asset(name);
      report.repaired.push_back({"asset_orphaned", "no row named the file " + name + " of assets/"});
    } else {
      report.findings.push_back(
          {"asset_orphaned", "no row names the file " + name + " of assets/ (yet: an import may be under way)"});
    }
  }
}

void check_assets(Library& library, CheckReport& report) {
  std::vector<base::Problem> found;
  std::vector<std::string> bad;
  for (const std::string& name : assets_named(library.database())) {
    ++report.assets;
    if (!library.has_asset(name)) {
      found.push_back({"asset_missing", "the file " + name + " of assets/ is missing"});
      bad.push_back(name);
    } else if (sha256_of(library.folder() / kAssetsFolder / name) != name) {
      found.push_back({"asset_damaged", "the file " + name + " of assets/ is damaged"});
      bad.push_back(name);
    }
  }
  if (bad.empty()) return;
  const std::set<std::string> still_named = assets_named(library.database());  // a case may have gone meanwhile
  for (std::size_t i = 0; i < bad.size(); ++i)
    if (still_named.contains(bad[i])) report.findings.push_back(std::move(found[i]));
}

// By the two questions: how many pieces each recording has, and all of them. How many recordings there are.
std::size_t check_recordings(Statement sizes, Statement chunks, CheckReport& report) {
  std::size_t recordings = 0;
  bool more = chunks.step();
  for (; sizes.step(); ++recordings) {
    const std::string attempt_id = sizes.text("attempt_id");
    std::int64_t count = 0;
    bool in_order = true, sound = true;
    for (; more && chunks.view("attempt_id") <= attempt_id; more = chunks.step()) {
      if (chunks.view("attempt_id") < attempt_id) continue;  // its attempt is missing: a broken reference
      in_order = in_order && chunks.integer("sequence") == count++;
      sound = sound &&
              std::bit_cast<std::uint64_t>(chunks.integer("checksum")) == base::hash_bytes(chunks.bytes("data"));
    }
    if (!in_order || count != sizes.integer("recording_chunks"))
      report.findings.push_back(
          {"incomplete", "a piece of the recording of attempt " + attempt_id + " is missing"});
    if (!sound)
      report.findings.push_back({"recording_damaged", "the recording of attempt " + attempt_id + " is damaged"});
  }
  return recordings;
}

void check_people(Library& library, CheckReport& report) {
  // Names first: whoever gets one meanwhile has been a person before.
  std::vector<std::string> named;
  for (Statement rows = question(library.identities(), "identities"); rows.step();)
    named.push_back(rows.text("person_id"));
  std::set<std::string> persons;
  for (Statement rows = question(library.database(), "person_ids"); rows.step();)
    persons.insert(rows.text("person_id"));
  for (const std::string& person_id : named)
    if (!persons.contains(person_id))
      report.findings.push_back(
          {"name_without_person", "a name belongs to person " + person_id + ", who is not there"});
}

// What killed makings of databases and copies leave; whoever makes one holds the folder's lock.
void check_files_beside(const Library& library, bool repair, CheckReport& report) {
  const FolderLock lock(library.folder());
  for (const auto& entry : fs::directory_iterator(library.folder())) {
    const std::string name = entry.path().filename().string();
    const bool ours = name.starts_with(kDatabaseFile) || name.starts_with(kIdentitiesFile);
    if (!ours || !entry.is_regular_file() ||
        (name.find(".new") == std::string::npos && name.find(".tmp-") == std::string::npos))
      continue;
    if (repair) ::unlink(entry.path().c_str());
    (repair ? report.repaired : report.findings)
        .push_back({"leftover_file", "an unfinished database was left behind"});
  }
}

base::Result<CheckReport> checked(const fs::path& folder, bool repair) {
  CheckReport report;
  auto library = Library::open(folder);
  if (!library) {
    if (library.error().code != "damaged") return library.error();
    report.findings.push_back({"database_damaged", library.error().text});
    return report;
  }
  for (Sqlite* database : {&library->database(), &library->identities()})
    for (base::Problem& problem : problems_of(*database)) report.findings.push_back(std::move(problem));
  // Of a damaged database nothing else can be said, and nothing may be taken away.
  for (const base::Problem& problem : report.findings)
    if (problem.code == "database_damaged") return report;
  for (Statement rows = question(library->database(), "case_ids"); rows.step();) ++report.cases;
  check_files_beside(*library, repair, report);
  check_files_in_assets(*library, repair, report);
  check_assets(*library, report);
  {
    Sqlite& database = library->database();
    const Snapshot snapshot(database);
    report.attempts = check_recordings(question(database, "recording_sizes"),
                                       question(database, "every_recording_chunk"), report);
    check_recordings(question(database, "open_recording_sizes"), question(database, "every_open_chunk"), report);
  }
  check_people(*library, report);
  for (base::Problem& problem : problems_of_audit(*library)) report.findings.push_back(std::move(problem));
  return report;
}

}  // namespace

std::vector<base::Problem> problems_of(Sqlite& database) {
  std::vector<base::Problem> problems;
  try {
    // SQLite's own words name tables and pages; the first is enough to know.
    if (const std::string answer = database.text("PRAGMA integrity_check(1)"); answer != "ok")
      problems.push_back({"database_damaged", "a database is damaged; restore a backup"});
    std::set<std::string> tables;
    for (Statement rows = database.prepare("SELECT \"table\" AS name FROM pragma_foreign_key_check"); rows.step();)
      tables.insert(rows.text("name"));
    for (const std::string& table : tables)
      problems.push_back({"reference_broken", "a row of " + table + " refers to one that is not there"});
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() != DatabaseFailure::Kind::damaged) throw;
    problems.push_back({"database_damaged", "a database is damaged; restore a backup"});
  }
  return problems;
}

base::Result<CheckReport> check_library(const fs::path& folder, bool repair) {
  return without_paths([&] { return checked(folder, repair); });
}

}  // namespace seldinger::casedb
