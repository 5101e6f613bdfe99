#include "casedb/keeping/check.h"

#include <unistd.h>

#include <algorithm>
#include <bit>
#include <set>
#include <string>
#include <tuple>

#include "casedb/database/audit.h"
#include "casedb/database/digests.h"
#include "casedb/database/disk.h"
#include "casedb/database/library.h"
#include "casedb/database/question.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/heal.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

// An id as the audit log takes it; of others, as the hash of a session or the name of a programme, nothing.
std::string id_to_note(const DigestOf& whose) {
  const std::string id = whose.second.substr(whose.second.rfind('/') + 1);
  const bool plain = id.size() <= 36 && id.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz_-") == id.npos;
  return plain ? id : std::string();
}

// Files that no row names and temporary files whose writer is gone.
void check_files_in_assets(Library& library, bool repair, CheckReport& report) {
  const fs::path folder = library.folder() / kAssetsFolder;
  std::vector<std::string> names;
  std::set<std::string> no_files;  // under a name that a file of ours has
  std::size_t unknown = 0;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    const bool file = what_is(entry.path()) == Place::file;
    if (file && is_temporary_name(name) && is_asset_name(name.substr(0, 64))) {
      if (is_abandoned(entry.path(), repair))
        (repair ? report.repaired : report.findings)
            .push_back({"leftover_file", "a temporary file of assets/ was left behind"});
    } else if (is_asset_name(name)) {
      if (file)
        names.push_back(name);
      else
        no_files.insert(name);
    } else {
      ++unknown;
    }
  }
  // Asked after the files were listed: a file whose row came meanwhile is named.
  const std::set<std::string> named = assets_named(library.database());
  for (const std::string& name : no_files) unknown += named.contains(name) ? 0 : 1;  // the others: check_assets
  if (unknown > 0)
    report.findings.push_back({"unknown_file", "assets/ holds " + std::to_string(unknown) +
                                                   (unknown == 1 ? " thing that is" : " things that are") +
                                                   " not the library's"});
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
    using State = Library::AssetState;
    const State state = library.asset_state(name);
    if (state == State::sound) continue;
    bad.push_back(name);
    if (state == State::missing)
      found.push_back({"asset_missing", "the file " + name + " of assets/ is missing"});
    else if (state == State::damaged)
      found.push_back({"asset_damaged", "the file " + name + " of assets/ is damaged"});
    else
      found.push_back({"asset_damaged", "in the place of the file " + name +
                                            " of assets/ lies a link, a folder or another thing that is no file"});
  }
  if (bad.empty()) return;
  const std::set<std::string> still_named = assets_named(library.database());  // a case may have gone meanwhile
  for (std::size_t i = 0; i < bad.size(); ++i)
    if (still_named.contains(bad[i])) report.findings.push_back(std::move(found[i]));
}

// By the two questions: how many pieces each recording has, and all of them.
void check_recordings(Statement sizes, Statement chunks, std::vector<base::Problem>& problems) {
  bool more = chunks.step();
  while (sizes.step()) {
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
      problems.push_back({"incomplete", "a piece of the recording of attempt " + attempt_id + " is missing"});
    if (!sound) problems.push_back({"recording_damaged", "the recording of attempt " + attempt_id + " is damaged"});
  }
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

// What can be said of the values of a library that cannot be opened.
void tell_values(const fs::path& folder, CheckReport& report) {
  for (const char* file : {kDatabaseFile, kIdentitiesFile}) try {
      if (what_is(folder / file) != Place::file) continue;
      Sqlite database(folder / file, Sqlite::Mode::read_only);
      for (base::Problem& problem : damaged_values(database)) report.findings.push_back(std::move(problem));
    } catch (const DatabaseFailure&) {
      // A page that cannot be read; that the database is damaged is told.
    }
}

base::Result<CheckReport> checked(const fs::path& folder, bool repair, const fs::path& from) {
  CheckReport report;
  if (!from.empty()) {
    auto healed = heal_values(folder, from);
    if (!healed) return healed.error();
    report.healed = std::move(*healed);
  }
  auto library = Library::open(folder);
  if (!library) {
    if (library.error().code != "damaged") return library.error();
    report.findings.push_back({"database_damaged", library.error().text});
    tell_values(folder, report);
    return report;
  }
  if (repair && library->read_only())
    throw base::Failure("read_only", "the library can only be read: its disk or its folder is write-protected");
  for (Sqlite* database : {&library->database(), &library->identities()})
    for (base::Problem& problem : problems_of(*database)) report.findings.push_back(std::move(problem));
  // Of a damaged database nothing else can be said, and nothing may be taken away.
  for (const base::Problem& problem : report.findings)
    if (problem.code == "database_damaged") return report;
  for (Statement rows = question(library->database(), "case_ids"); rows.step();) ++report.cases;
  check_files_beside(*library, repair, report);
  if (!from.empty())
    for (base::Problem& problem : heal_assets(*library, from)) report.healed.push_back(std::move(problem));
  check_files_in_assets(*library, repair, report);
  check_assets(*library, report);
  for (Statement rows = question(library->database(), "recording_sizes"); rows.step();) ++report.attempts;
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
    const Snapshot one_state(database);
    for (base::Problem& problem : damaged_values(database)) problems.push_back(std::move(problem));
    const std::vector<std::string> there = tables_of(database);  // fewer in a copy of an older schema
    for (const auto& [table, sizes, chunks] :
         {std::tuple("recording_chunk", "recording_sizes", "every_recording_chunk"),
          std::tuple("open_chunk", "open_recording_sizes", "every_open_chunk")})
      if (std::ranges::find(there, table) != there.end())
        check_recordings(question(database, sizes), question(database, chunks), problems);
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() != DatabaseFailure::Kind::damaged) throw;
    if (problems.empty() || problems.front().code != "database_damaged")
      problems.insert(problems.begin(), {"database_damaged", "a database is damaged; restore a backup"});
  }
  return problems;
}

void accept_damaged_values(Library& library, CheckReport& report) {
  if (std::ranges::any_of(report.findings, [](const auto& one) { return one.code == "database_damaged"; })) return;
  const auto accept = [&](Sqlite& database) {
    const std::vector<std::string> tables = tables_of(database);
    for (const auto& [whose, difference] : digest_differences(database)) {
      if (std::ranges::find(tables, whose.first) == tables.end()) continue;
      change_digest(database, whose, difference);
      audit(library, Act::accept_damaged, {whose.first, id_to_note(whose)});
      report.accepted.push_back({"value_damaged", in_words(whose) + " is kept as it is now"});
    }
  };
  {
    Transaction transaction(library.database());
    Transaction of_names(library.identities());
    accept(library.database());
    accept(library.identities());
    transaction.commit();  // noted first
    of_names.commit();
  }
  std::erase_if(report.findings, [](const auto& one) { return one.code == "value_damaged"; });
  for (Sqlite* database : {&library.database(), &library.identities()})
    for (base::Problem& problem : damaged_values(*database)) report.findings.push_back(std::move(problem));
}

base::Result<CheckReport> check_library(const fs::path& folder, bool repair, const fs::path& from) {
  return without_paths([&] { return checked(folder, repair, from); });
}

}  // namespace seldinger::casedb
