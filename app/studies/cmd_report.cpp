// report.
#include <cstdio>

#include "app/cli/file.h"
#include "app/cli/version.h"
#include "app/studies/acting_in_study.h"
#include "reports/questionnaires/workshops_page.h"
#include "reports/studies/validity_report.h"

namespace seldinger::app {
namespace {

int run_report(const Arguments& arguments) {
  const std::string kind = arguments.positional(0);
  if (kind != "validity" && kind != "workshops") throw UsageError("KIND is validity or workshops");
  const auto out = file_of("--out", arguments.required("--out"), {".html"});
  if (kind == "workshops") {
    write_file(out, reports::workshops_page());
    return kDone;
  }
  arguments.required("--study");
  auto open = open_study(arguments, "--study", casedb::Action::plan_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return refuse(plan.error());
  write_file(out, reports::validity_page(
                      reports::validity_report_of(open->library, open->study, *plan, "report validity", kVersion)));
  return kDone;
}

constexpr Option kReportOptions[] = {
    kLibrary, {"--study", "STUDY", "of this study, for validity"}, {"--out", "FILE.html", "the file"}};

}  // namespace

Command report_command() {
  return {.name = "report",
          .positionals = "KIND",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kReportOptions,
          .acts = true,
          .summary =
              "Writes a report as one file that opens offline and prints. KIND: validity, of a study "
              "(docs/studies.md), which is a look, and noted; or workshops, the thesis' own three "
              "(docs/questionnaires.md).",
          .run = &run_report};
}

}  // namespace seldinger::app
