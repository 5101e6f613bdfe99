// cohort add, list, show, enrol, direct.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/library/people_json.h"
#include "reports/words/people_words.h"

namespace seldinger::app {
namespace {

// What the library's actor is to a cohort; none: in nobody's name.
casedb::Subject to_cohort(casedb::Library& library, const std::string& cohort_id, const std::string& programme) {
  const auto& reader = library.actor().person_id;
  return reader ? casedb::relation_to_cohort(library, *reader, cohort_id, programme) : casedb::Relation();
}

int run_cohort_add(const Arguments& arguments) {
  const std::string programme = arguments.required("--programme");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_cohorts, to_cohort(*library, "", programme));
  if (!by) return refuse(by.error());
  const auto made = casedb::add_cohort(*library, arguments.positional(0), programme, arguments.text("--site"));
  if (!made) return refuse(made.error());
  std::fputs(arguments.has("--json") ? json_of_made("cohort_id", *made).c_str() : (*made + "\n").c_str(), stdout);
  return kDone;
}

int run_cohort_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto cohorts = casedb::list_cohorts(*library);
  if (arguments.has("--json")) {
    std::fputs(json_of_cohorts(cohorts).c_str(), stdout);
    return kDone;
  }
  if (cohorts.empty()) std::puts("There are no cohorts yet; `seldinger cohort add` makes one.");
  for (const casedb::Cohort& one : cohorts) {
    const casedb::CohortCells cells = casedb::cells_of(one);
    std::printf("%s  %-24s %-16s %d learner%s%s\n", one.cohort_id.c_str(), one.title.c_str(), one.programme.c_str(),
                cells.learners, cells.learners == 1 ? "" : "s",
                reports::and_simulated_text(cells.simulated).c_str());
  }
  return kDone;
}

int run_cohort_show(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto cohort = casedb::find_cohort(*library, arguments.positional(0));
  if (!cohort) return refuse(cohort.error());
  const auto enrolments = casedb::list_enrolments(*library, cohort->cohort_id);
  std::map<std::string, std::string> names;
  for (const casedb::Account& one : casedb::list_users(*library)) names.emplace(one.person_id, one.login_name);
  if (arguments.has("--json")) {
    std::fputs(json_of_cohort(*cohort, enrolments, names).c_str(), stdout);
    return kDone;
  }
  std::printf("%s, %s%s%s\n", cohort->title.c_str(), cohort->programme.c_str(), cohort->site.empty() ? "" : ", ",
              cohort->site.c_str());
  for (const casedb::Enrolment& one : enrolments) {
    const auto name = names.find(one.person_id);
    std::printf("  %-8s %s%s%s\n", casedb::name_of(one.post).c_str(),
                name == names.end() ? one.pseudonym.c_str() : name->second.c_str(),
                one.simulated ? ", simulated" : "", one.to_us ? " (left)" : "");
  }
  return kDone;
}

int run_cohort_enrol(const Arguments& arguments) {
  const std::string user = arguments.required("--user");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto cohort = casedb::find_cohort(*library, arguments.positional(0));
  const auto person = casedb::open_account(*library, user);
  const auto post = arguments.has("--mentor") ? casedb::Post::mentor : casedb::Post::learner;
  casedb::Subject subject;
  if (cohort) subject = to_cohort(*library, cohort->cohort_id, cohort->programme);
  // Enrolling opens what a learner has done to the cohort's mentors and directors: a director moves only the own.
  if (person && library->actor().person_id && post == casedb::Post::learner && !arguments.has("--end"))
    subject.own_programme &=
        casedb::relation_to(*library, *library->actor().person_id, person->person_id).own_programme;
  const auto by = acting(*library, arguments, casedb::Action::manage_cohorts, subject);
  if (!by) return refuse(by.error());
  if (!cohort) return refuse(cohort.error());
  if (!person) return refuse(person.error());
  const auto done = arguments.has("--end") ? casedb::end_enrolment(*library, cohort->cohort_id, person->person_id)
                                           : casedb::enrol(*library, cohort->cohort_id, person->person_id, post);
  return done ? kDone : refuse(done.error());
}

int run_cohort_direct(const Arguments& arguments) {
  const std::string user = arguments.required("--user");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::appoint_director);
  if (!by) return refuse(by.error());
  const auto person = casedb::open_account(*library, user);
  if (!person) return refuse(person.error());
  const auto done = arguments.has("--end")
                        ? casedb::end_director(*library, arguments.positional(0), person->person_id)
                        : casedb::appoint_director(*library, arguments.positional(0), person->person_id);
  return done ? kDone : refuse(done.error());
}

constexpr Option kCohortAddOptions[] = {kLibrary,
                                        {"--programme", "TEXT", "the programme to which it belongs"},
                                        {"--site", "TEXT", "where it is; optional"},
                                        kJson};
constexpr Option kCohortEnrolOptions[] = {kLibrary,
                                          kWhose,
                                          {"--mentor", nullptr, "as a mentor; else as a learner"},
                                          {"--end", nullptr, "end it from now on, as learner and as mentor"}};
constexpr Option kCohortDirectOptions[] = {kLibrary, kWhose, {"--end", nullptr, "end it from now on"}};

}  // namespace

Command cohort_add_command() {
  return {.name = "cohort add",
          .positionals = "TITLE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCohortAddOptions,
          .acts = true,
          .summary = "Adds a cohort of learners.",
          .run = &run_cohort_add};
}

Command cohort_list_command() {
  return {.name = "cohort list", .options = kLibraryJson, .summary = "Lists the cohorts.", .run = &run_cohort_list};
}

Command cohort_show_command() {
  return {.name = "cohort show",
          .positionals = "COHORT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .summary = "Shows who is and was in a cohort.",
          .run = &run_cohort_show};
}

Command cohort_enrol_command() {
  return {.name = "cohort enrol",
          .positionals = "COHORT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCohortEnrolOptions,
          .acts = true,
          .summary = "Enrols a learner or a mentor from now on; mentors see the learners of their cohorts by name.",
          .run = &run_cohort_enrol};
}

Command cohort_direct_command() {
  return {.name = "cohort direct",
          .positionals = "PROGRAMME",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCohortDirectOptions,
          .acts = true,
          .summary = "Makes somebody director of a programme; a director sees the learners of its cohorts by name.",
          .run = &run_cohort_direct};
}

}  // namespace seldinger::app
