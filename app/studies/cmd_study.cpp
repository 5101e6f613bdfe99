// study new, list, researcher.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/library/people_json.h"
#include "app/studies/study_json.h"
#include "casedb/people/consent.h"
#include "reports/words/people_words.h"

namespace seldinger::app {
namespace {

int run_study_new(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_studies);
  if (!by) return refuse(by.error());
  const auto made = casedb::add_study(*library, arguments.positional(0));
  if (!made) return refuse(made.error());
  std::fputs(arguments.has("--json") ? json_of_made("study_id", *made).c_str() : (*made + "\n").c_str(), stdout);
  return kDone;
}

int run_study_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto studies = casedb::list_studies(*library);
  if (arguments.has("--json")) {
    std::fputs(json_of_studies(studies).c_str(), stdout);
    return kDone;
  }
  if (studies.empty()) std::puts("There are no studies yet; `seldinger study new` makes one.");
  for (const casedb::Study& one : studies)
    std::printf("%s  %-32s %s\n", one.study_id.c_str(), one.title.c_str(),
                reports::study_people_text(one.people).c_str());
  return kDone;
}

int run_study_researcher(const Arguments& arguments) {
  const std::string user = arguments.required("--user");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_studies);
  if (!by) return refuse(by.error());
  const auto study = casedb::find_study(*library, arguments.positional(0));
  if (!study) return refuse(study.error());
  const auto person = casedb::open_account(*library, user);
  if (!person) return refuse(person.error());
  const auto done = arguments.has("--end") ? casedb::end_researcher(*library, study->study_id, person->person_id)
                                           : casedb::add_researcher(*library, study->study_id, person->person_id);
  return done ? kDone : refuse(done.error());
}

constexpr Option kStudyResearcherOptions[] = {kLibrary, kWhose, {"--end", nullptr, "end it from now on"}};

}  // namespace

Command study_new_command() {
  return {.name = "study new",
          .positionals = "TITLE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Creates a study that people can consent to.",
          .run = &run_study_new};
}

Command study_list_command() {
  return {.name = "study list", .options = kLibraryJson, .summary = "Lists the studies.", .run = &run_study_list};
}

Command study_researcher_command() {
  return {.name = "study researcher",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kStudyResearcherOptions,
          .acts = true,
          .summary = "Lets a researcher see, under pseudonyms, the people who consent to a study.",
          .run = &run_study_researcher};
}

}  // namespace seldinger::app
