// backup, restore, check.
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/library_place.h"
#include "app/cli/version.h"
#include "app/cli/words.h"
#include "app/library/keep_json.h"

namespace seldinger::app {
namespace {

void print_copied(const Arguments& arguments, const char* done, const casedb::Copied& copied) {
  if (arguments.has("--json"))
    std::fputs(json_of_copied(copied).c_str(), stdout);
  else
    std::printf("%s: %zu files, %.1f MB, all checked\n", done, copied.files,
                static_cast<double>(copied.bytes) * 1e-6);
}

int run_backup(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::keep_library); !by) return refuse(by.error());
  const auto copied = casedb::back_up(*library, arguments.positional(0), kVersion);
  try {
    casedb::audit_alone(*library, casedb::Act::back_up, {},
                        copied ? casedb::Outcome::done : casedb::Outcome::refused);
  } catch (...) {
    if (copied) std::filesystem::remove_all(arguments.positional(0));  // nothing leaves unnoted
    throw;
  }
  if (!copied) return refuse(error_of("OUT", arguments.positional(0), copied.error()));
  print_copied(arguments, "backed up", *copied);
  return kDone;
}

int run_restore(const Arguments& arguments) {
  const std::filesystem::path folder = library_folder(arguments);
  const auto copied = casedb::restore(arguments.positional(0), folder);
  if (!copied) {
    const bool of_library = copied.error().code == "exists" || copied.error().code == "network_file_system";
    return refuse(of_library ? error_of("--library", folder.string(), copied.error())
                             : error_of("IN", arguments.positional(0), copied.error()));
  }
  try {
    auto library = casedb::Library::open(library_folder(arguments));
    if (!library) throw base::Failure("database", "the restored library cannot be opened");
    casedb::audit_alone(*library, casedb::Act::restore);
  } catch (...) {
    std::filesystem::remove_all(library_folder(arguments));  // it was made just now; nothing comes back unnoted
    throw;
  }
  print_copied(arguments, "restored", *copied);
  return kDone;
}

// "1042:HASH", as `seldinger audit` prints count and hash.
std::optional<casedb::AuditHead> noted_head(const Arguments& arguments) {
  if (!arguments.has("--audit-head")) return std::nullopt;
  const std::string text = arguments.text("--audit-head");
  const std::size_t colon = text.find(':');
  const auto count = parse_number(text.substr(0, colon));
  if (colon == text.npos || !count || *count < 0.0 || *count > 1e15 || *count != std::floor(*count) ||
      text.size() - colon - 1 != 64)
    throw UsageError("--audit-head is COUNT:HASH, as `seldinger audit` prints them");
  return casedb::AuditHead{static_cast<std::int64_t>(*count), text.substr(colon + 1)};
}

int run_check(const Arguments& arguments) {
  const auto noted = noted_head(arguments);
  const std::filesystem::path folder = library_folder(arguments);
  const bool repair = arguments.has("--repair");
  const std::string from = arguments.text("--from");
  const bool accept = arguments.has("--accept-damaged");
  if (!from.empty() && !repair) throw UsageError("--from goes with --repair");
  if (accept && !repair) throw UsageError("--accept-damaged goes with --repair");
  std::optional<casedb::Actor> repairs;
  if (repair) {
    auto library = open_acting(arguments);
    // Of a damaged one nobody can be asked, and nothing is taken away.
    if (!library && library.error().code != "damaged") return refuse(library.error());
    if (library) {
      if (const auto by = acting(*library, arguments, casedb::Action::keep_library); !by) return refuse(by.error());
      repairs = library->actor();
    }
  }
  auto report = casedb::check_library(folder, repair, from);
  if (repairs)
    if (auto library = casedb::Library::open(folder))
      casedb::audit_alone(*library, *repairs, casedb::Act::repair, {},
                          report ? casedb::Outcome::done : casedb::Outcome::refused);
  if (!report) return refuse(error_of_library(arguments, report.error()));
  if (accept && repairs)
    if (auto library = casedb::Library::open(folder)) {
      library->act_for(*repairs);  // who was asked once already: a password on standard input is gone
      casedb::accept_damaged_values(*library, *report);
    }
  if (noted)
    if (auto library = casedb::Library::open(folder); library && !casedb::still_stands(*library, *noted))
      report->findings.push_back({"audit_cut", "the audit log does not hold the row that was noted as its last"});
  if (arguments.has("--json")) {
    std::fputs(json_of_check(*report).c_str(), stdout);
  } else {
    for (const base::Problem& problem : report->repaired)
      std::printf("removed: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    for (const base::Problem& problem : report->healed)
      std::printf("healed: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    for (const base::Problem& problem : report->accepted)
      std::printf("accepted: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    for (const base::Problem& problem : report->findings)
      std::printf("finding: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    std::printf("%zu cases, %zu attempts, %zu files: %s\n", report->cases, report->attempts, report->assets,
                report->holds() ? "all holds" : "not all holds");
  }
  return report->holds() ? kDone : kCheckFailed;
}

constexpr Option kCheckOptions[] = {
    kLibrary,
    {"--repair", nullptr, "remove leftovers: files that no row names, temporary files without a writer"},
    {"--audit-head", "COUNT:HASH",
     "tells whether the row that `seldinger audit` once printed as the last still stands"},
    {"--from", "BACKUP", "with --repair: files and values that are hurt come back from this backup of the library"},
    {"--accept-damaged", nullptr,
     "with --repair: values that are hurt and in no backup count from now on as they are; the audit log says so"},
    kJson};

}  // namespace

Command backup_command() {
  return {.name = "backup",
          .positionals = "OUT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary =
              "Copies a library, also one in use, into a new folder and checks the copy. It holds names: keep it "
              "as safe.",
          .run = &run_backup};
}

Command restore_command() {
  return {.name = "restore",
          .positionals = "IN",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .summary = "Makes a library from a backup, checked before it is there; never over another.",
          .run = &run_restore};
}

Command check_command() {
  return {.name = "check",
          .options = kCheckOptions,
          .acts = true,
          .summary =
              "Checks a library: pages, references, files, values, recordings, leftovers, names; 1 when something "
              "does not hold.",
          .run = &run_check};
}

}  // namespace seldinger::app
