// workshop open, admit, tick, show, close.
#include <cstdio>

#include "app/studies/acting_in_study.h"
#include "app/studies/workshop_json.h"
#include "casedb/cases/cases.h"
#include "casedb/database/uuid.h"
#include "casedb/studies/plans.h"
#include "reports/words/metric_words.h"

namespace seldinger::app {
namespace {

constexpr long long kMostNumber = 1'000'000;

struct OpenWorkshop {
  casedb::Library library;
  casedb::Workshop workshop;
};

// The workshop of the command's first word, for who may enrol in its study; asked before it is told whether there
// is one.
base::Result<OpenWorkshop> workshop_of(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return library.error();
  auto workshop = casedb::find_workshop(*library, arguments.positional(0));
  casedb::Relation relation;
  const auto& whose = library->actor().person_id;
  relation.own_study = workshop && whose && casedb::is_researcher_of(*library, workshop->study_id, *whose);
  if (const auto by = acting(*library, arguments, casedb::Action::enrol_in_study, relation); !by) return by.error();
  if (!workshop) return workshop.error();
  return OpenWorkshop{std::move(*library), std::move(*workshop)};
}

std::vector<casedb::PersonVisit> visits_of(casedb::Library& library, const casedb::Workshop& workshop) {
  const auto plan = casedb::find_plan(library, workshop.study_id);
  return plan ? casedb::list_visits(library, *plan, casedb::now_us()) : std::vector<casedb::PersonVisit>();
}

// "1 Kidney (done), 2 Liver".
std::string turns_text(const casedb::Workshop& workshop, const casedb::Participant& one) {
  std::string text;
  for (const std::size_t place : one.order)
    text += (text.empty() ? "" : ", ") + workshop.stations[place].title + (one.done[place] ? " (done)" : "");
  return text;
}

std::string day_text(std::int64_t at_us) {
  return reports::utc_text(at_us).substr(0, 10);
}

int run_workshop_open(const Arguments& arguments) {
  casedb::NewWorkshop made;
  made.title = arguments.required("--title");
  if (arguments.has("--group")) made.groups = arguments.all("--group");
  auto open = open_study(arguments, "STUDY", casedb::Action::enrol_in_study);
  if (!open) return refuse(open.error());
  made.study_id = open->study.study_id;
  for (const std::string& case_id : arguments.all("--case")) {
    const auto row = casedb::find_case(open->library, case_id);
    if (!row) return refuse(row.error());
    made.stations.push_back({row->title, row->case_id});
  }
  for (const std::string& title : arguments.all("--station")) made.stations.push_back({.title = title});
  const auto workshop = casedb::open_workshop(open->library, made);
  if (!workshop) return refuse(workshop.error());
  if (arguments.has("--json"))
    std::fputs(json_of_workshop(*workshop).c_str(), stdout);
  else
    std::printf("%s\nIts board, where `seldinger serve` runs: /board?code=%s\n", workshop->code.c_str(),
                workshop->code.c_str());
  return kDone;
}

int run_workshop_admit(const Arguments& arguments) {
  const std::string user = arguments.required("--user");
  auto open = workshop_of(arguments);
  if (!open) return refuse(open.error());
  const auto person = casedb::open_account(open->library, user);
  if (!person) return refuse(person.error());
  const bool consents = arguments.has("--consent");
  if (consents)
    if (const auto by =
            acting_on(open->library, arguments, casedb::Action::answer_consent, std::optional(person->person_id));
        !by)
      return refuse(by.error());
  const auto admitted = casedb::admit_to_workshop(open->library, open->workshop, person->person_id,
                                                  arguments.text("--group"), consents);
  if (!admitted) return refuse(admitted.error());
  if (arguments.has("--json"))
    std::fputs(json_of_participant(open->workshop, *admitted).c_str(), stdout);
  else
    std::printf("Number %d: %s\n", admitted->number, turns_text(open->workshop, *admitted).c_str());
  return kDone;
}

int run_workshop_tick(const Arguments& arguments) {
  const auto number = static_cast<int>(arguments.whole("--number", 0, 1, kMostNumber));
  if (number == 0) throw UsageError("--number is missing");
  const std::string station = arguments.required("--station");
  auto open = workshop_of(arguments);
  if (!open) return refuse(open.error());
  const auto ticked = casedb::tick_in_workshop(open->library, open->workshop, number, station);
  return ticked ? kDone : refuse(ticked.error());
}

int run_workshop_show(const Arguments& arguments) {
  auto open = workshop_of(arguments);
  if (!open) return refuse(open.error());
  const auto participants = casedb::list_participants(open->library, open->workshop);
  const auto visits = visits_of(open->library, open->workshop);
  if (arguments.has("--json")) {
    std::fputs(json_of_day(open->workshop, participants, visits).c_str(), stdout);
    return kDone;
  }
  std::printf("%s%s\n", open->workshop.title.c_str(), open->workshop.is_open() ? "" : " (closed)");
  if (participants.empty()) std::puts("Nobody has come yet.");
  for (const casedb::Participant& one : participants) {
    std::printf("%3d  %-12s %-10s %s\n", one.number, one.pseudonym.c_str(), one.group.c_str(),
                turns_text(open->workshop, one).c_str());
    for (const casedb::PersonVisit& visit : visits)
      if (visit.pseudonym == one.pseudonym)
        std::printf("     %s: %s to %s, %s\n", visit.visit.c_str(), day_text(visit.from_us).c_str(),
                    day_text(visit.to_us).c_str(),
                    std::string(base::name_of(casedb::kVisitStateNames, visit.state)).c_str());
  }
  return kDone;
}

int run_workshop_close(const Arguments& arguments) {
  auto open = workshop_of(arguments);
  if (!open) return refuse(open.error());
  const auto closed = casedb::close_workshop(open->library, open->workshop);
  return closed ? kDone : refuse(closed.error());
}

constexpr Option kWorkshopOpenOptions[] = {
    kLibrary,
    {"--title", "TEXT", "the day's title, as the board shows it"},
    {"--case", "CASE", "a station: done by an attempt at this case; two to twelve stations in all", true},
    {"--station", "NAME", "a station without a case, which is ticked off by hand", true},
    {"--group", "NAME", "a group; orders are balanced within each group; two to six", true},
    kJson};
constexpr Option kWorkshopAdmitOptions[] = {
    kLibrary,
    kWhose,
    {"--group", "NAME", "in this group"},
    {"--consent", nullptr, "they have signed the study's consent at the door; it is stored with them"},
    kJson};
constexpr Option kWorkshopTickOptions[] = {kLibrary,
                                           {"--number", "N", "the person's number on the board"},
                                           {"--station", "NAME", "the station, one without a case"}};

}  // namespace

Command workshop_open_command() {
  return {.name = "workshop open",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kWorkshopOpenOptions,
          .acts = true,
          .summary =
              "Opens a workshop day: stations that everybody goes through, each person in their own order; prints "
              "its code, which opens the board.",
          .run = &run_workshop_open};
}

Command workshop_admit_command() {
  return {
      .name = "workshop admit",
      .positionals = "CODE",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kWorkshopAdmitOptions,
      .acts = true,
      .summary = "At the door: gives somebody who consents to the study a number and the order of their stations.",
      .run = &run_workshop_admit};
}

Command workshop_tick_command() {
  return {.name = "workshop tick",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kWorkshopTickOptions,
          .acts = true,
          .summary = "Records that somebody has done a station without a case.",
          .run = &run_workshop_tick};
}

Command workshop_show_command() {
  return {.name = "workshop show",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Shows who came, by number and pseudonym, what they have done, and when they are due back.",
          .run = &run_workshop_show};
}

Command workshop_close_command() {
  return {.name = "workshop close",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .summary = "Closes a workshop day: nobody is admitted any more.",
          .run = &run_workshop_close};
}

}  // namespace seldinger::app
