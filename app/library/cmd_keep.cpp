// backup, restore, check; case bundle, bundle export, bundle import, bundle check.
#include <cmath>
#include <cstdio>

#include "app/acting/acting.h"
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
  arguments.required("--library");
  const std::string out = arguments.required("--out");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::hand_out_case); !by) return refuse(by.error());
  // Before anything leaves.
  if (case_ids.empty()) casedb::audit_alone(*library, casedb::Act::export_cases);
  for (const std::string& case_id : case_ids)
    if (const auto row = casedb::find_case(*library, case_id))
      casedb::audit_alone(*library, casedb::Act::export_cases, {"case", row->case_id});
  return print_bundle(arguments, casedb::write_bundle(*library, case_ids, out, kVersion));
}

int run_backup(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::keep_library); !by) return refuse(by.error());
  casedb::audit_alone(*library, casedb::Act::back_up);
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
  if (arguments.has("--repair")) {
    auto library = open_acting(arguments);
    // Of a damaged one nobody can be asked, and nothing is taken away.
    if (!library && library.error().code != "damaged") return refuse(library.error());
    if (library) {
      if (const auto by = acting(*library, arguments, casedb::Action::keep_library); !by) return refuse(by.error());
      casedb::audit_alone(*library, casedb::Act::repair);
    }
  }
  auto report = casedb::check_library(arguments.required("--library"), arguments.has("--repair"));
  if (!report) return refuse(report.error());
  if (noted)
    if (auto library = casedb::Library::open(arguments.text("--library"));
        library && !casedb::still_stands(*library, *noted))
      report->findings.push_back({"audit_cut", "the audit log does not hold the row that was noted as its last"});
  if (arguments.has("--json")) {
    std::fputs(json_of_check(*report).c_str(), stdout);
  } else {
    for (const base::Problem& problem : report->repaired)
      std::printf("removed: %s: %s\n", problem.code.c_str(), problem.text.c_str());
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
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto by = acting(*library, arguments, casedb::Action::add_case); !by) return refuse(by.error());
  const auto cases = casedb::import_bundle(*library, arguments.positional(0));
  if (!cases) return refuse(cases.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_unbundled(*cases).c_str(), stdout);
    return kDone;
  }
  for (const std::string& case_id : cases->stored) std::printf("case %s stored\n", case_id.c_str());
  for (const std::string& case_id : cases->present)
    std::printf("case %s is here already; nothing was done\n", case_id.c_str());
  return kDone;
}

constexpr Option kBundleOptions[] = {
    kLibrary, {"--out", "FILE.sdbundle", "the file; replaced when it is there"}, kJson};

constexpr Option kCheckOptions[] = {
    kLibrary,
    {"--repair", nullptr, "remove what is nobody's: files that no row names, temporary files without a writer"},
    {"--audit-head", "COUNT:HASH",
     "tells whether the row that `seldinger audit` once printed as the last still stands"},
    kJson};

}  // namespace

Command case_bundle_command() {
  return {.name = "case bundle",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kBundleOptions,
          .acts = true,
          .summary = "Writes a case as one checked file for another library; attempts and people stay.",
          .run = &run_case_bundle};
}

Command bundle_export_command() {
  return {.name = "bundle export",
          .options = kBundleOptions,
          .acts = true,
          .summary = "Writes every case of a library as one such file.",
          .run = &run_bundle_export};
}

Command bundle_import_command() {
  return {.name = "bundle import",
          .positionals = "FILE.sdbundle",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
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
              "Checks a library: pages, references, files, recordings, leftovers, names; 1 when something does not "
              "hold.",
          .run = &run_check};
}

}  // namespace seldinger::app
