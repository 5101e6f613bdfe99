// case check, case review, case publish, case retire, case version.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cases/case_answers_json.h"
#include "app/cli/command.h"
#include "casedb/cases/versions.h"
#include "session/case/case_check.h"

namespace seldinger::app {
namespace {

int run_case_check(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  const auto checks = session::check_case(*library, case_id);
  if (!checks) return refuse(checks.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_checks(case_id, *checks).c_str(), stdout);
  } else {
    for (const casedb::Check& one : checks->checks)
      std::printf("%s  %-20s %s\n", one.holds ? "holds " : "FAILS ", one.name.c_str(), one.text.c_str());
    std::printf("A rule of this case may name:");
    for (const std::string& id : checks->rule_may_name) std::printf(" %s", id.c_str());
    std::printf("\n");
  }
  return checks->holds() ? kDone : kCheckFailed;
}

int run_case_review(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  const bool approve = arguments.has("--approve"), back = arguments.has("--return");
  if (approve && back) throw UsageError("either --approve or --return");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const std::string note = arguments.text("--note");
  const auto done = approve || back ? casedb::judge_case(*library, arguments.positional(0), by, approve, note)
                                    : casedb::submit_case(*library, arguments.positional(0), by, note);
  if (!done) return refuse(done.error());
  std::puts(approve ? "approved" : back ? "returned to draft" : "in review");
  return kDone;
}

int run_case_publish(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  const auto checks = session::check_case(*library, case_id);
  if (!checks) return refuse(checks.error());
  const auto done =
      casedb::publish_case(*library, case_id, *checks, by, arguments.has("--own-cohort"), arguments.text("--note"));
  if (!done) return refuse(done.error());
  const auto now = casedb::find_case(*library, case_id);
  if (!now) return refuse(now.error());
  std::printf("published, version %d%s\n", now->version,
              now->own_cohort_only ? ", unreviewed: for your own cohort only" : "");
  return kDone;
}

int run_case_retire(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto done = casedb::retire_case(*library, arguments.positional(0), by, arguments.text("--note"));
  if (!done) return refuse(done.error());
  std::puts("retired");
  return kDone;
}

int run_case_version(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto made = casedb::new_version(*library, arguments.positional(0), by);
  if (!made) return refuse(made.error());
  const auto row = casedb::find_case(*library, *made);
  if (!row) return refuse(row.error());
  if (arguments.has("--json"))
    std::fputs(json_of_version(*row).c_str(), stdout);
  else
    std::printf("case %s, version %d, a draft\n", row->case_id.c_str(), row->version);
  return kDone;
}

constexpr Option kNoteOption{"--note", "TEXT", "one line kept with the decision"};

constexpr Option kReviewOptions[] = {kLibrary,
                                     {"--approve", nullptr, "approve it, as the second person"},
                                     {"--return", nullptr, "send it back to draft"},
                                     kNoteOption};

constexpr Option kPublishOptions[] = {
    kLibrary, {"--own-cohort", nullptr, "unreviewed, to the mentor's own cohort only"}, kNoteOption};

constexpr Option kRetireOptions[] = {kLibrary, kNoteOption};

}  // namespace

Command case_check_command() {
  return {
      .name = "case check",
      .positionals = "CASE",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kLibraryJson,
      .summary = "Checks whether a case is ready for attempts, and lists what its rule may name; 1 when it is not.",
      .run = &run_case_check};
}

Command case_review_command() {
  return {.name = "case review",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kReviewOptions,
          .acts = true,
          .named = true,
          .summary = "Submits a draft for review; with --approve or --return records a second person's answer.",
          .run = &run_case_review};
}

Command case_publish_command() {
  return {.name = "case publish",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kPublishOptions,
          .acts = true,
          .named = true,
          .summary = "Publishes a case that passes its check and was approved; it never changes again.",
          .run = &run_case_publish};
}

Command case_retire_command() {
  return {.name = "case retire",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kRetireOptions,
          .acts = true,
          .named = true,
          .summary = "Retires a published case; its attempts stay.",
          .run = &run_case_retire};
}

Command case_version_command() {
  return {.name = "case version",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .named = true,
          .summary = "Makes the next version of a case, as a draft.",
          .run = &run_case_version};
}

}  // namespace seldinger::app
