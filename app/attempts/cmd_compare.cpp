// attempt compare.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/attempts/compare_json.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "reports/pages/compare_page.h"
#include "reports/pages/style_sheet.h"
#include "reports/words/dependability_words.h"
#include "reports/words/grade_words.h"

namespace seldinger::app {
namespace {

void print_comparison(const casedb::Comparison& comparison) {
  std::printf("%s, %s\n%s\n", comparison.row.title.c_str(), casedb::name_of(comparison.manner.modality).c_str(),
              reports::experts_text(comparison.experts).c_str());
  if (comparison.dependability)
    std::printf("%s: %s\n", std::string(reports::kWhatPassingShows).c_str(),
                reports::dependability_text(*comparison.dependability, casedb::Learners::people).c_str());
  for (const casedb::ComparedGroup& group : comparison.groups) {
    std::printf("\n%s: passed %zu of %zu, with a critical error %zu\n", reports::group_label(group).c_str(),
                group.passed, group.gradable, group.with_critical_errors);
    if (group.not_performed > 0)
      std::printf("  left out, the procedure was not performed: %zu\n", group.not_performed);
    for (std::size_t i = 0; i < comparison.criteria.size(); ++i) {
      const assessment::CriterionResult& one = comparison.criteria[i];
      std::printf("  %-34s%s met %zu of %zu, %s\n", assessment::text_of(one.criterion).c_str(),
                  one.criterion.critical ? " critical" : "", group.met[i], group.gradable,
                  reports::compared_text(group.of_criteria[i], one.unit).c_str());
    }
    for (const casedb::ComparedAttempt& attempt : group.attempts) {
      std::printf("  %s  %s\n", attempt.row.attempt_id.c_str(), reports::verdict_text(attempt.grade.grade).c_str());
      for (const assessment::Sentence& sentence : attempt.grade.debrief)
        std::printf("    %s\n", sentence.text.c_str());
    }
  }
}

int run_attempt_compare(const Arguments& arguments) {
  arguments.required("--case");
  std::optional<cases::Modality> modality;
  if (arguments.has("--modality")) {
    modality = casedb::modality_from(arguments.text("--modality"));
    if (!modality) throw UsageError("--modality is " + casedb::modality_names());
  }
  std::filesystem::path out;
  if (arguments.has("--out")) out = file_of("--out", arguments.text("--out"), {".html"});
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto comparison =
      casedb::compare_attempts(*library, arguments.text("--case"), arguments.text("--lesion"), modality);
  if (!comparison) return refuse(comparison.error());
  if (arguments.has("--out")) write_file(out, reports::compare_page(*comparison, reports::style_sheet()));
  if (arguments.has("--json"))
    std::fputs(json_of_comparison(*comparison).c_str(), stdout);
  else if (!arguments.has("--out"))
    print_comparison(*comparison);
  return kDone;
}

constexpr Option kCompareOptions[] = {
    kLibrary,
    {"--case", "CASE", "the case"},
    {"--lesion", "LESION", "only attempts on this target; default that of the newest attempt"},
    {"--modality", "mpr|xray|ultrasound", "only attempts with this modality; default that of the newest attempt"},
    {"--out", "FILE.html", "write a page, instead of printing text"},
    kJson};

}  // namespace

Command attempt_compare_command() {
  return {.name = "attempt compare",
          .options = kCompareOptions,
          .summary =
              "Compares the attempts on a case side by side, a group for each person and each simulated operator.",
          .run = &run_attempt_compare};
}

}  // namespace seldinger::app
