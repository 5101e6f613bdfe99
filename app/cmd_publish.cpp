// case check, case review, case publish, case retire, case version.
#include <cstdio>

#include "app/case_answers_json.h"
#include "app/case_check.h"
#include "app/command.h"
#include "casedb/versions.h"

namespace seldinger::app {

int run_case_check(const Arguments& arguments) {
  auto library = casedb::Library::open(arguments.required("--library"));
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  const auto checks = check_case(*library, case_id);
  if (!checks) return refuse(checks.error());
  if (arguments.has("--json")) {
    std::fputs(json_of_checks(case_id, *checks).c_str(), stdout);
  } else {
    for (const Check& one : checks->checks)
      std::printf("%s  %-20s %s\n", one.holds ? "holds " : "FAILS ", one.name.c_str(), one.text.c_str());
    std::printf("A rule of this case may name:");
    for (const std::string& id : checks->rule_may_name) std::printf(" %s", id.c_str());
    std::printf("\n");
  }
  return checks->holds() ? kDone : kCheckFailed;
}

int run_case_review(const Arguments& arguments) {
  const std::string folder = arguments.required("--library"), by = arguments.required("--by");
  const bool approve = arguments.has("--approve"), back = arguments.has("--return");
  if (approve && back) throw UsageError("either --approve or --return");
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  const std::string note = arguments.text("--note");
  const auto done = approve || back ? casedb::judge_case(*library, arguments.positional(0), by, approve, note)
                                    : casedb::submit_case(*library, arguments.positional(0), by, note);
  if (!done) return refuse(done.error());
  std::puts(approve ? "approved" : back ? "returned to draft" : "in review");
  return kDone;
}

int run_case_publish(const Arguments& arguments) {
  const std::string folder = arguments.required("--library"), by = arguments.required("--by");
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  const std::string& case_id = arguments.positional(0);
  const auto checks = check_case(*library, case_id);
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
  const std::string folder = arguments.required("--library"), by = arguments.required("--by");
  auto library = casedb::Library::open(folder);
  if (!library) return refuse(library.error());
  const auto done = casedb::retire_case(*library, arguments.positional(0), by, arguments.text("--note"));
  if (!done) return refuse(done.error());
  std::puts("retired");
  return kDone;
}

int run_case_version(const Arguments& arguments) {
  const std::string folder = arguments.required("--library"), by = arguments.required("--by");
  auto library = casedb::Library::open(folder);
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

}  // namespace seldinger::app
