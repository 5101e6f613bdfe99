#include "casedb/keeping/erase.h"

#include <unistd.h>

#include <array>
#include <set>
#include <vector>

#include "casedb/cases/cases.h"
#include "casedb/database/audit.h"
#include "casedb/database/credentials.h"
#include "casedb/database/digests.h"
#include "casedb/database/disk.h"
#include "casedb/database/question.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/tables.h"
#include "casedb/database/uuid.h"
#include "casedb/people/people.h"
#include "sim/base/check.h"
#include "sim/base/hex.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

constexpr PersonColumn kRemoved[] = {
    {"account", "person_id"},         {"attempt", "person_id"},         {"attempt_comment", "person_id"},
    {"enrolment", "person_id"},       {"login_session", "person_id"},   {"open_attempt", "person_id"},
    {"person_fact", "person_id"},     {"person_level", "person_id"},    {"programme_director", "person_id"},
    {"replay_watched", "person_id"},  {"study_enrolment", "person_id"}, {"study_researcher", "person_id"},
    {"simulated_truth", "person_id"}, {"desk_response", "person_id"},   {"workshop_participant", "person_id"},
    {"web_session", "person_id"},     {"password_link", "person_id"},
};
constexpr PersonColumn kKept[] = {
    {"audit", "person_id"},
    {"case_decision", "person_id"},
    {"consent", "person_id"},
    {"curriculum", "made_by"},
    {"curriculum", "published_by"},
    {"standard", "set_by"},
    {"erasure", "by_person_id"},
    {"training_case", "burned_in_checked_by"},
    {"study_plan", "frozen_by"},
    {"study_look", "person_id"},
    {"study_deviation", "person_id"},
    {"study_lock", "person_id"},
    {"questionnaire_round", "opened_by"},
    {"workshop", "opened_by"},
    {"cut", "proposed_by"},
    {"cut", "frozen_by"},
};

void run_with_id(Sqlite& database, const std::string& sql, const std::string& id) {
  database.prepare(sql).bind("id", id).run();
}

// Everything that refers to a row goes before it.
void remove_with_what_refers(Sqlite& database, const std::string& table, const std::string& key,
                             const std::string& id) {
  for (const Reference& from : references_to(database, table))
    run_with_id(database, "DELETE FROM " + from.table + " WHERE " + from.column + " = :id", id);
  run_with_id(database, "DELETE FROM " + table + " WHERE " + key + " = :id", id);
}

// One transaction of erasing; what may be gone from assets/ is looked at when it is committed.
class Erasing {
 public:
  Erasing(Library& library, Act act, const char* what, const std::optional<std::string>& by)
      : library_(library), database_(library.database()) {
    database_.run("PRAGMA secure_delete = ON");  // also of pages that are freed
    transaction_.emplace(database_);
    // Tables are emptied in the order of their names, not in that of their references; until the transaction ends.
    database_.run("PRAGMA defer_foreign_keys = ON");
    question(database_, "add_erasure")
        .bind("erasure_id", erasure_id_)
        .bind("what", what)
        .bind("erased_us", now_us())
        .bind("by_person_id", by)
        .run();
    audit(library_, act, {"erasure", erasure_id_});
  }
  Sqlite& database() noexcept { return database_; }

  void mark(const std::string& id) {
    run_with_id(database_, "INSERT INTO erasing VALUES (:id) ON CONFLICT DO NOTHING", id);
  }
  void attempt(const std::string& attempt_id, const std::string& case_id) {
    mark(attempt_id);
    note_assets("attempt", "attempt_id", attempt_id);
    for (const Reference& from : references_to(database_, "attempt"))
      note_assets(from.table, from.column, attempt_id);
    remove_with_what_refers(database_, "attempt", "attempt_id", attempt_id);
    forget_digests(database_, attempt_id);  // also of what was damaged
    leave_empty_row(case_id);
  }
  void attempts_of(const std::string& person_id) {
    std::vector<std::pair<std::string, std::string>> attempts, open;
    const auto read = [&](const char* table, auto& into) {
      Statement rows = database_.prepare(std::string("SELECT attempt_id, case_id FROM ") + table +
                                         " WHERE person_id = :id ORDER BY attempt_id");
      for (rows.bind("id", person_id); rows.step();)
        into.emplace_back(rows.text("attempt_id"), rows.text("case_id"));
    };
    read("attempt", attempts);
    read("open_attempt", open);
    for (const auto& [attempt_id, case_id] : attempts) attempt(attempt_id, case_id);
    for (const auto& [attempt_id, case_id] : open) {
      mark(attempt_id);
      remove_with_what_refers(database_, "open_attempt", "attempt_id", attempt_id);
      forget_digests(database_, attempt_id);
      leave_empty_row(case_id);
    }
  }
  void assets(const std::set<std::string>& names) { assets_.insert(names.begin(), names.end()); }
  void commit() {
    database_.run("DELETE FROM erasing");
    transaction_->commit();
    transaction_.reset();
    // Nobody stores a row without this lock, and whoever is about to stores the file again under it.
    const Transaction lock(database_);
    const std::set<std::string> named = assets_named(database_);
    for (const std::string& name : assets_)
      if (!named.contains(name) && library_.has_asset(name)) {
        library_.remove_asset(name);
        ++sum.assets;
      }
  }
  Erased sum{};

 private:
  // What its rows name, to be looked at when they are gone.
  void note_assets(const std::string& table, const std::string& key, const std::string& id) {
    for (const std::string& column : columns_of(database_, table)) {
      if (!column.ends_with("_sha256")) continue;
      Statement rows = database_.prepare("SELECT " + column + " AS name FROM " + table + " WHERE " + key +
                                         " = :id AND " + column + " IS NOT NULL");
      for (rows.bind("id", id); rows.step();) assets_.insert(rows.text("name"));
    }
  }
  void leave_empty_row(const std::string& case_id) {
    question(database_, "add_erased_attempt")
        .bind("erasure_id", erasure_id_)
        .bind("position", static_cast<std::int64_t>(sum.attempts++))
        .bind("case_id", case_id)
        .run();
  }
  Library& library_;
  Sqlite& database_;
  std::string erasure_id_ = new_uuid();
  std::optional<Transaction> transaction_;
  std::set<std::string> assets_;
};

// "seldinger.sqlite.v12-backup", "…-backup-2": what migrate() puts beside a database.
bool is_old_copy(const std::string& name, const std::string& database) {
  const std::string begin = database + ".v";
  return name.starts_with(begin) && name.find("-backup", begin.size()) != name.npos;
}

// Leaves no byte of what is no longer in a row: every page is written anew and the log emptied.
bool overwrite(Sqlite& database) {
  try {
    database.run("PRAGMA secure_delete = ON; VACUUM;");
    return database.integer("PRAGMA wal_checkpoint(TRUNCATE)") == 0;
  } catch (const DatabaseFailure& failure) {
    if (failure.kind() != DatabaseFailure::Kind::busy) throw;
    return false;
  }
}

std::vector<fs::path> old_copies_of(Library& library) {
  return without_paths([&] {
    std::vector<fs::path> old_copies;
    for (const auto& entry : fs::directory_iterator(library.folder())) {
      const std::string name = entry.path().filename().string();
      if (is_old_copy(name, kDatabaseFile) || is_old_copy(name, kIdentitiesFile))
        old_copies.push_back(entry.path());
    }
    return old_copies;
  });
}

void clean(Library& library, Erased& sum) {
  for (const fs::path& file : old_copies_of(library))
    ++(::unlink(file.c_str()) == 0 ? sum.old_copies : sum.kept_copies);
  without_paths([&] { sync_folder(library.folder()); });
  for (Sqlite* database : {&library.database(), &library.identities()})
    if (!overwrite(*database)) sum.overwritten = false;
}

void empty_person(Erasing& erasing, const std::string& person_id) {
  Sqlite& database = erasing.database();
  erasing.mark(person_id);
  erasing.attempts_of(person_id);
  for (const PersonColumn& one : kRemoved)
    run_with_id(database, "DELETE FROM " + std::string(one.table) + " WHERE " + std::string(one.column) + " = :id",
                person_id);
  forget_digests(database, person_id);
  question(database, "empty_notes_of").bind("person_id", person_id).run();
  question(database, "withdraw_every_consent").bind("person_id", person_id).bind("withdrawn_us", now_us()).run();
  std::array<std::byte, 5> random{};
  fill_random(random);
  question(database, "empty_person")
      .bind("person_id", person_id)
      .bind("pseudonym", "E-" + base::hex_from_bytes(random))
      .bind("erased_us", now_us())
      .run();
}

}  // namespace

std::span<const PersonColumn> removed_with_a_person() {
  return kRemoved;
}
std::span<const PersonColumn> kept_of_a_person() {
  return kKept;
}

base::Result<Erased> erase_person(Library& library, const std::string& name, const std::optional<std::string>& by) {
  std::string person_id;
  {
    Statement identity = question(library.identities(), "identity_by_name");
    if (!identity.bind("name", name).step()) return base::Error{"no_user", "there is no such user"};
    person_id = identity.text("person_id");
  }
  Erasing erasing(library, Act::erase_person, "person", by);
  empty_person(erasing, person_id);
  erasing.commit();
  clean(library, erasing.sum);
  std::error_code kept;
  fs::remove_all(library.folder() / kJobsFolder / person_id, kept);
  if (kept) throw base::Failure("disk", "the files of a person's jobs cannot be deleted");
  {
    // Last: as long as the name is there, the erasure can be asked for again.
    Transaction transaction(library.identities());
    question(library.identities(), "remove_identity").bind("person_id", person_id).run();
    transaction.commit();
  }
  if (!overwrite(library.identities())) erasing.sum.overwritten = false;
  return erasing.sum;
}

base::Result<Erased> erase_attempts_of(Library& library, const std::string& person_id,
                                       const std::optional<std::string>& by) {
  if (const auto known = check_person(library, person_id); !known) return known.error();
  {
    Statement attempts = question(library.database(), "person_has_attempts");
    CHECK(attempts.bind("person_id", person_id).step());
    if (attempts.integer("found") == 0 && old_copies_of(library).empty()) return Erased{};
  }
  Erasing erasing(library, Act::erase_attempts, "attempts", by);
  erasing.attempts_of(person_id);
  erasing.commit();
  clean(library, erasing.sum);
  return erasing.sum;
}

base::Result<Erased> erase_attempt(Library& library, const std::string& attempt_id,
                                   const std::optional<std::string>& by) {
  Erasing erasing(library, Act::erase_attempts, "attempts", by);
  std::string case_id;
  {
    Statement row = question(library.database(), "case_of_attempt");
    if (!row.bind("attempt_id", attempt_id).step()) return base::Error{"no_attempt", "there is no such attempt"};
    case_id = row.text("case_id");
  }
  erasing.attempt(attempt_id, case_id);
  erasing.commit();
  clean(library, erasing.sum);
  return erasing.sum;
}

base::Result<Erased> erase_case(Library& library, const std::string& case_id,
                                const std::optional<std::string>& by) {
  Erasing erasing(library, Act::erase_case, "case", by);
  Sqlite& database = erasing.database();
  const auto row = find_case(library, case_id);
  if (!row) return row.error();
  if (row->state != CaseState::draft && row->state != CaseState::retired)
    return base::Error{"bad_state", "only a draft or a retired case is deleted"};
  {
    Statement attempts = question(database, "case_has_attempts");
    CHECK(attempts.bind("case_id", case_id).step());
    if (attempts.integer("found") != 0)
      return base::Error{"has_attempts", "attempts were made on this case; delete them first"};
  }
  erasing.mark(case_id);
  erasing.assets(assets_of_case(database, case_id));
  remove_with_what_refers(database, "training_case", "case_id", case_id);
  forget_digests(database, case_id);
  erasing.commit();
  clean(library, erasing.sum);
  return erasing.sum;
}

}  // namespace seldinger::casedb
