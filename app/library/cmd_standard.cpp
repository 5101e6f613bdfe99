// standard set, show.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/library/standard_json.h"
#include "assessment/grading/plain_words.h"
#include "reports/words/grade_words.h"

namespace seldinger::app {
namespace {

int run_standard_set(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  std::optional<cases::Modality> modality;
  if (arguments.has("--modality")) {
    modality = casedb::modality_from(arguments.text("--modality"));
    if (!modality) throw UsageError("--modality is " + casedb::modality_names());
  }
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto made =
      casedb::set_standard(*library, arguments.positional(0), arguments.text("--lesion"), modality, by);
  if (!made) return refuse_act(*library, casedb::Act::set_standard, made.error());
  std::fputs(arguments.has("--json") ? json_of_standard_id(*made).c_str() : (*made + "\n").c_str(), stdout);
  return kDone;
}

void print(const casedb::Standard& standard) {
  std::printf("%s  %s, %s, %s%s\n%s\n", standard.set.standard_id.c_str(), standard.modality.c_str(),
              standard.approach.c_str(), standard.instrument.c_str(),
              standard.by_operator ? " (entered by the operator)" : "",
              reports::experts_text(standard.set).c_str());
  for (const assessment::MetricBand& band : standard.set.bands)
    std::printf("  %-34s version %d: %s%s\n", band.id.c_str(), band.version,
                assessment::plain_range(band.low, band.high, band.unit).c_str(),
                band.tolerance ? (", " + reports::tolerance_text(standard.set, band.id, band.version)).c_str()
                               : (", n = " + std::to_string(band.n)).c_str());
}

int run_standard_show(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto standards = casedb::list_standards(*library, row->case_id);
  if (arguments.has("--json")) {
    std::fputs(json_of_standards(standards).c_str(), stdout);
    return kDone;
  }
  if (standards.empty()) std::puts(reports::experts_text({}).c_str());
  for (const casedb::Standard& one : standards) print(one);
  if (!standards.empty()) std::puts(reports::bands_note().c_str());
  return kDone;
}

constexpr Option kStandardSetOptions[] = {
    kLibrary,
    {"--lesion", "LESION", "from attempts on this target; default the case's first"},
    {"--modality", "mpr|xray|ultrasound", "from attempts with this modality; default the case's"},
    kJson};

constexpr Option kStandardShowOptions[] = {kLibrary, kJson};

}  // namespace

Command standard_set_command() {
  return {
      .name = "standard set",
      .positionals = "CASE",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kStandardSetOptions,
      .acts = true,
      .named = true,
      .summary = "Sets the standard of a case: what its consultants have achieved so far, frozen; by a director.",
      .run = &run_standard_set};
}

Command standard_show_command() {
  return {.name = "standard show",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kStandardShowOptions,
          .summary = "Prints the standards of a case, newest first: for each task the newest is in force.",
          .run = &run_standard_show};
}

}  // namespace seldinger::app
