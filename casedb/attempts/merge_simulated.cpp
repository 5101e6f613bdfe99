#include "casedb/attempts/merge_simulated.h"

#include <algorithm>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "casedb/attempts/add_unless.h"
#include "casedb/attempts/made_at.h"
#include "casedb/cases/case_checks.h"
#include "casedb/cases/cases.h"
#include "casedb/database/disk.h"
#include "casedb/database/migrate.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/simulated_people.h"

namespace seldinger::casedb {
namespace {

namespace population = assessment::population;

// What tells two attempts of a person apart: a draft's needle, picture or approach may have been another one's.
auto key_of(const AttemptHead& one) {
  return std::tuple(made_at(one.case_id, one.lesion_id, one.instrument, one.picture, one.approach), one.seed);
}

struct Arriving {
  population::Person person;
  SimulatedTruth truth;
  std::vector<AttemptRow> attempts;
};

bool is_same(const SimulatedTruth& a, const SimulatedTruth& b) {
  return a.people_version == b.people_version && a.ability == b.ability && a.strategy == b.strategy;
}

base::Result<void> check_person(const Arriving& one, const std::vector<SimulatedTruth>& here) {
  if (simulated_person_id(one.person) != one.truth.person_id)
    return base::Error{"damaged", "a simulated person of that library is not who their seed and number make"};
  for (const SimulatedTruth& known : here)
    if (known.person_id == one.truth.person_id && !is_same(known, one.truth))
      return base::Error{"person_differs", "a simulated person of that library is here with other abilities"};
  if (one.truth.people_version != population::kPeopleVersion)
    return base::Error{"person_differs",
                       "that library's people come from another model of people than this program's"};
  return {};
}

base::Result<void> check_case(Library& into, Library& from, const std::string& case_id) {
  if (const auto known = find_case(into, case_id); !known) return known.error();
  if (content_mark(into, case_id) != content_mark(from, case_id))
    return base::Error{"case_differs", "a case of that library is here with other content"};
  return {};
}

bool is_there(Library& into, const AttemptRow& row) {
  const std::vector<AttemptRow> there = list_attempts_of_seed(into, *row.person_id, row.seed);
  return std::any_of(there.begin(), there.end(), [&](const AttemptRow& one) { return key_of(one) == key_of(row); });
}

// Whether it was added: somebody else may have been faster.
base::Result<bool> add(Library& into, Library& from, const AttemptRow& row) {
  NewAttempt made;
  static_cast<AttemptHead&>(made) = row;
  made.duration_s = row.duration_s;
  made.end = row.end;
  made.metrics = row.metrics;
  made.steps = list_steps(from, row.attempt_id);
  made.conditions = find_conditions(from, row.attempt_id);
  auto recording = load_recording(from, row.attempt_id);
  if (!recording) return recording.error();
  made.recording = std::move(*recording);
  if (!row.picture_sha256.empty()) {
    auto picture = from.load_asset(row.picture_sha256);
    if (!picture) return picture.error();
    made.picture_png = std::move(*picture);
  }
  const auto added = add_attempt_unless(into, made, [&] { return is_there(into, row); });
  return added ? base::Result<bool>(added->has_value()) : added.error();
}

// Whether a database is of today's schema; of what cannot be read so, opening the library tells.
bool is_older(const std::filesystem::path& file, const Schema& schema) {
  if (what_is(file) != Place::file) return false;
  try {
    // Where nobody writes, not even SQLite's index of the log is left behind.
    const bool in_use = what_is(file.string() + "-wal") != Place::nothing;
    Sqlite database(file, in_use ? Sqlite::Mode::read_only : Sqlite::Mode::immutable);
    const auto version = schema_version(database, schema);
    return version && *version > 0 && *version < newest_version(schema);
  } catch (const DatabaseFailure&) {
    return false;
  }
}

}  // namespace

base::Result<Library> open_to_merge(const std::filesystem::path& folder) {
  if (is_older(folder / kDatabaseFile, library_schema()) || is_older(folder / kIdentitiesFile, identities_schema()))
    return base::Error{"older_schema", "that library was written by an older version of this program"};
  auto library = Library::open(folder);
  if (library)
    for (Sqlite* database : {&library->database(), &library->identities()}) database->refuse_writing();
  return library;
}

base::Result<Merged> merge_simulated(Library& into, Library& from) {
  const std::vector<SimulatedTruth> here = list_simulated_truths(into);
  std::vector<Arriving> all;
  std::set<std::string> case_ids;
  for (SimulatedTruth& truth : list_simulated_truths(from)) {
    Arriving& one = all.emplace_back(Arriving{simulated_person_of(from, truth), truth, {}});
    if (const auto sound = check_person(one, here); !sound) return sound.error();
    one.attempts = list_bare_attempts_of(from, truth.person_id);
    for (const AttemptRow& row : one.attempts) case_ids.insert(row.case_id);
  }
  for (const std::string& case_id : case_ids)
    if (const auto same = check_case(into, from, case_id); !same) return same.error();
  Merged merged;
  std::set<std::string> known;
  for (const SimulatedTruth& one : here) known.insert(one.person_id);
  for (const Arriving& one : all) {
    const std::string& person_id = one.truth.person_id;
    simulated_person(into, one.person, one.truth.seed);
    merged.people += known.contains(person_id) ? 0U : 1U;
    std::set<decltype(key_of({}))> there;
    for (const AttemptRow& row : list_bare_attempts_of(into, person_id)) there.insert(key_of(row));
    for (const AttemptRow& row : list_attempts_of(from, person_id)) {
      const bool known_before = !there.insert(key_of(row)).second;
      const auto added = known_before ? base::Result<bool>(false) : add(into, from, row);
      if (!added) return added.error();
      ++(*added ? merged.attempts : merged.there);
    }
  }
  return merged;
}

}  // namespace seldinger::casedb
