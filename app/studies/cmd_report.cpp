// report.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "app/cli/file.h"
#include "app/cli/version.h"
#include "app/cli/words.h"
#include "app/studies/acting_in_study.h"
#include "app/studies/learning_reports.h"
#include "casedb/database/audit.h"
#include "reports/questionnaires/workshops_page.h"
#include "reports/studies/report_data.h"
#include "reports/studies/validity_report.h"

namespace seldinger::app {
namespace {

base::Result<std::string> validity_report(const Arguments& arguments) {
  arguments.required("--study");
  const bool with_data = arguments.has("--data");  // values by person leave the library
  auto open =
      open_study(arguments, "--study", with_data ? casedb::Action::export_study : casedb::Action::plan_study);
  if (!open) return open.error();
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return plan.error();
  const std::filesystem::path folder = arguments.text("--data");
  if (with_data && !plan->frozen())
    return base::Error{"plan_not_frozen", "until the plan is frozen there are no outcomes by person"};
  if (std::error_code failed; with_data && std::filesystem::exists(folder, failed))
    return base::Error{"exists", "--data: there is already something of that name"};
  if (with_data) casedb::audit_alone(open->library, casedb::Act::export_attempts, {"study", open->study.study_id});
  const auto report =
      reports::validity_report_of(open->library, open->study, *plan,
                                  with_data ? "report validity, with its data" : "report validity", kVersion);
  if (with_data) {
    std::filesystem::create_directories(folder);
    for (const reports::DataFile& one : reports::report_data(report)) write_file(folder / one.name, one.content);
  }
  return reports::validity_page(report);
}

base::Result<std::string> workshops_report(const Arguments&) {
  return reports::workshops_page();
}

struct Kind {
  const char* name;
  base::Result<std::string> (*page)(const Arguments&);
};
constexpr Kind kKinds[] = {{"validity", &validity_report},
                           {"learner", &learner_report},
                           {"case", &case_report},
                           {"standard", &standard_report},
                           {"workshops", &workshops_report}};

int run_report(const Arguments& arguments) {
  const auto kind = std::find_if(std::begin(kKinds), std::end(kKinds),
                                 [&](const Kind& one) { return one.name == arguments.positional(0); });
  if (kind == std::end(kKinds)) {
    std::vector<std::string> names;
    for (const Kind& one : kKinds) names.emplace_back(one.name);
    throw UsageError("KIND is " + one_of(names) + did_you_mean(arguments.positional(0), names));
  }
  const auto out = file_of("--out", arguments.required("--out"), {".html"});
  const auto page = kind->page(arguments);
  if (!page) return refuse(page.error());
  write_file(out, *page);
  return kDone;
}

constexpr Option kReportOptions[] = {
    kLibrary,
    {"--study", "STUDY", "the study, for validity"},
    {"--data", "DIR",
     "also write a new folder with the values behind the validity report, by person, and redo.R, which recomputes "
     "its numbers in R"},
    {"--user", "NAME", "the person, for learner"},
    {"--case", "CASE", "the case, for standard"},
    {"--simulated", nullptr, "about simulated people, for learner and case; they are never mixed with real people"},
    {"--person", "GROUP-NUMBER", "which simulated person, for learner: novice-3"},
    {"--out", "FILE.html", "the file"}};

}  // namespace

Command report_command() {
  return {.name = "report",
          .positionals = "KIND",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kReportOptions,
          .acts = true,
          .summary =
              "Writes a report as one file that opens offline and prints well. KIND: validity, of a study "
              "(docs/studies.md), which is a look and recorded as one; learner, how somebody has learnt; case, how "
              "hard the cases are, how well they discriminate and how many a decision needs; standard, the cuts of "
              "a case (all three docs/grading.md); or workshops, the thesis' own three (docs/questionnaires.md).",
          .run = &run_report};
}

}  // namespace seldinger::app
