// backup, restore, check; case bundle, bundle export, bundle import, bundle check.
#include <cstdio>

#include "app/cli/command.h"
#include "app/cli/version.h"
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

int print_bundle(const Arguments& arguments, const base::Result<casedb::Bundle>& bundle) {
  if (!bundle) return refuse(bundle.error());
  if (arguments.has("--json"))
    std::fputs(json_of_bundle(*bundle).c_str(), stdout);
  else
    std::printf("%zu case%s, %zu files, %.1f MB, schema %d, written by version %s\n", bundle->case_ids.size(),
                bundle->case_ids.size() == 1 ? "" : "s", bundle->assets, static_cast<double>(bundle->bytes) * 1e-6,
                bundle->schema, bundle->program_version.c_str());
  return kDone;
}

int write_bundle_of(const Arguments& arguments, const std::vector<std::string>& case_ids) {
  const std::string folder = arguments.required("--library"), out = arguments.required("--out");
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  return print_bundle(arguments, casedb::write_bundle(*library, case_ids, out, kVersion));
}

int run_backup(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto copied = casedb::back_up(*library, arguments.positional(0), kVersion);
  if (!copied) return refuse(copied.error());
  print_copied(arguments, "backed up", *copied);
  return kDone;
}

int run_restore(const Arguments& arguments) {
  const auto copied = casedb::restore(arguments.positional(0), arguments.required("--library"));
  if (!copied) return refuse(copied.error());
  print_copied(arguments, "restored", *copied);
  return kDone;
}

int run_check(const Arguments& arguments) {
  const bool repair = arguments.has("--repair");
  const std::string from = arguments.text("--from");
  if (!from.empty() && !repair) throw UsageError("--from goes with --repair");
  const auto report = casedb::check_library(arguments.required("--library"), repair, from);
  if (!report) return refuse(report.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_check(*report).c_str(), stdout);
  } else {
    for (const base::Problem& problem : report->repaired)
      std::printf("removed: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    for (const base::Problem& problem : report->healed)
      std::printf("healed: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    for (const base::Problem& problem : report->findings)
      std::printf("finding: %s: %s\n", problem.code.c_str(), problem.text.c_str());
    std::printf("%zu cases, %zu attempts, %zu files: %s\n", report->cases, report->attempts, report->assets,
                report->holds() ? "all holds" : "not all holds");
  }
  return report->holds() ? kDone : kCheckFailed;
}

int run_case_bundle(const Arguments& arguments) {
  return write_bundle_of(arguments, {arguments.positional(0)});
}

int run_bundle_export(const Arguments& arguments) {
  return write_bundle_of(arguments, {});
}

int run_bundle_check(const Arguments& arguments) {
  return print_bundle(arguments, casedb::check_bundle(arguments.positional(0)));
}

int run_bundle_import(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const auto cases = casedb::import_bundle(*library, arguments.positional(0));
  if (!cases) return refuse(cases.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_unbundled(*cases).c_str(), stdout);
    return kDone;
  }
  for (const std::string& case_id : cases->stored) std::printf("case %s stored\n", case_id.c_str());
  if (cases->healed > 0) std::printf("%zu damaged files of cases here are whole again\n", cases->healed);
  for (const std::string& case_id : cases->present)
    std::printf("case %s is here already; nothing was done\n", case_id.c_str());
  return kDone;
}

constexpr Option kBundleOptions[] = {
    kLibrary, {"--out", "FILE.sdbundle", "the file; replaced when it is there"}, kJson};

constexpr Option kCheckOptions[] = {
    kLibrary,
    {"--repair", nullptr, "remove what is nobody's: files that no row names, temporary files without a writer"},
    {"--from", "BACKUP", "with --repair: files and values that are hurt come back from this backup of the library"},
    kJson};

}  // namespace

Command case_bundle_command() {
  return {.name = "case bundle",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kBundleOptions,
          .summary = "Writes a case as one checked file for another library; attempts and people stay.",
          .run = &run_case_bundle};
}

Command bundle_export_command() {
  return {.name = "bundle export",
          .options = kBundleOptions,
          .summary = "Writes every case of a library as one such file.",
          .run = &run_bundle_export};
}

Command bundle_import_command() {
  return {.name = "bundle import",
          .positionals = "FILE.sdbundle",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .summary =
              "Checks such a file and takes its cases into the library, all or none; a case that is there already "
              "stays.",
          .run = &run_bundle_import};
}

Command bundle_check_command() {
  return {.name = "bundle check",
          .positionals = "FILE.sdbundle",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kJsonOnly,
          .summary = "Checks such a file, every byte of it.",
          .run = &run_bundle_check};
}

Command backup_command() {
  return {.name = "backup",
          .positionals = "OUT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
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
          .summary =
              "Checks a library: pages, references, files, values, recordings, leftovers, names; 1 when something "
              "does not hold.",
          .run = &run_check};
}

}  // namespace seldinger::app
