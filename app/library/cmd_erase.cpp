// user erase, attempt delete, case delete.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/library/people_json.h"
#include "casedb/attempts/attempts.h"

namespace seldinger::app {
namespace {

int told(const Arguments& arguments, const base::Result<casedb::Erased>& erased) {
  if (!erased) return refuse(erased.error());
  warn_of_what_is_left(*erased);
  if (arguments.has("--json")) {
    std::fputs(json_of_erased(*erased).c_str(), stdout);
    return kDone;
  }
  std::printf(
      "erased: %zu attempts, %zu files, %zu copies of older schemas. Earlier backups and exports still hold what "
      "was erased.\n",
      erased->attempts, erased->assets, erased->old_copies);
  return kDone;
}

int run_user_erase(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::erase_person);
  if (!by) return refuse(by.error());
  return told(arguments, casedb::erase_person(*library, arguments.positional(0), *by));
}

int run_attempt_delete(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto attempt = casedb::find_attempt(*library, arguments.positional(0));
  if (!attempt) return refuse(attempt.error());
  const auto by = acting_on(*library, arguments, casedb::Action::erase_attempts, attempt->person_id);
  if (!by) return refuse(by.error());
  return told(arguments, casedb::erase_attempt(*library, attempt->attempt_id, *by));
}

int run_case_delete(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto by = acting(*library, arguments, casedb::Action::erase_case, row->state);
  if (!by) return refuse(by.error());
  return told(arguments, casedb::erase_case(*library, row->case_id, *by));
}

}  // namespace

Command user_erase_command() {
  return {.name = "user erase",
          .positionals = "NAME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Erases a person: name, account, recordings, results and facts. Only an empty row remains.",
          .run = &run_user_erase};
}

Command attempt_delete_command() {
  return {.name = "attempt delete",
          .positionals = "ATTEMPT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Erases one attempt with its recording and results; only an empty row remains.",
          .run = &run_attempt_delete};
}

Command case_delete_command() {
  return {.name = "case delete",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Deletes a draft or a retired case on which nobody has made an attempt.",
          .run = &run_case_delete};
}

}  // namespace seldinger::app
