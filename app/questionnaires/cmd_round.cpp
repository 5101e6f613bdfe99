// questionnaire open, close, import, export.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/file.h"
#include "app/questionnaires/acting_in_round.h"
#include "app/questionnaires/paper_csv.h"
#include "app/questionnaires/questionnaire_json.h"
#include "casedb/people/consent.h"
#include "casedb/questionnaires/responses.h"
#include "casedb/studies/looks.h"
#include "casedb/studies/plans.h"
#include "reports/questionnaires/responses_csv.h"

namespace seldinger::app {
namespace {

constexpr std::size_t kMostPaperBytes = 16U << 20U;

int run_questionnaire_open(const Arguments& arguments) {
  casedb::NewRound made;
  made.title = arguments.required("--title");
  made.form_id = arguments.positional(0);
  made.version = static_cast<int>(arguments.whole("--version", 0, 1, 1'000'000));
  if (arguments.has("--group")) made.groups = arguments.all("--group");
  made.at_desk = arguments.has("--at-desk");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_questionnaires);
  if (!by) return refuse(by.error());
  if (arguments.has("--study")) {
    const auto study = casedb::find_study(*library, arguments.text("--study"));
    if (!study) return refuse(study.error());
    made.study_id = study->study_id;
  }
  const auto round = casedb::open_round(*library, made);
  if (!round) return refuse(round.error());
  if (arguments.has("--json"))
    std::fputs(json_of_round(*round).c_str(), stdout);
  else if (round->at_desk)
    std::printf("%s\nIt is answered in the window (`seldinger train`), after an attempt.\n", round->code.c_str());
  else
    std::printf("%s\nIt is answered where `seldinger serve` runs: /answer?code=%s\n", round->code.c_str(),
                round->code.c_str());
  return kDone;
}

// The round of the code that is named, for who may close it or add to it.
base::Result<casedb::Round> managed_round(casedb::Library& library, const Arguments& arguments) {
  const auto by = acting(library, arguments, casedb::Action::manage_questionnaires);
  if (!by) return by.error();
  return casedb::find_round(library, arguments.positional(0));
}

int run_questionnaire_close(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto round = managed_round(*library, arguments);
  if (!round) return refuse(round.error());
  const auto closed = casedb::close_round(*library, round->round_id);
  if (!closed) return refuse(closed.error());
  std::printf("closed: %d sent, %d begun and not sent\n", round->submitted, round->drafts);
  return kDone;
}

int run_questionnaire_import(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto round = managed_round(*library, arguments);
  if (!round) return refuse(round.error());
  const auto forms = casedb::find_forms(*library, round->form_id, round->version);
  if (!forms) return refuse(forms.error());
  std::vector<std::vector<casedb::PaperForm>> entries;
  for (const char* file : {"FIRST.csv", "SECOND.csv"}) {
    const auto text = read_text_of(arguments, file, kMostPaperBytes);
    if (!text) return refuse(text.error());
    auto papers = paper_forms_in_csv(*text, forms->front().form);
    if (!papers) return refuse(papers.error());
    entries.push_back(std::move(*papers));
  }
  const auto differences = entry_differences(entries[0], entries[1], forms->front().form);
  std::size_t stored = 0;
  if (differences.empty()) {
    const auto added = casedb::add_paper_forms(*library, round->code, entries[0]);
    if (!added) return refuse(added.error());
    stored = *added;
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_entry(stored, differences).c_str(), stdout);
  } else if (differences.empty()) {
    std::printf("%zu paper forms, typed identically twice\n", stored);
  } else {
    std::printf("Nothing was stored: the two entries differ in %zu places.\n", differences.size());
    for (const EntryDifference& one : differences)
      std::printf("%s  %s: \"%s\" and \"%s\"\n", one.respondent.c_str(), one.column.c_str(), one.first.c_str(),
                  one.second.c_str());
  }
  return differences.empty() ? kDone : kCheckFailed;
}

int run_questionnaire_export(const Arguments& arguments) {
  const auto out = file_of("--out", arguments.required("--out"), {".csv"});
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto round = round_to_read(*library, arguments);
  if (!round) return refuse(round.error());
  if (round->rated) return refuse({"rated_round", "`rating export` exports what raters said"});
  const auto responses = casedb::list_responses(*library, round->code);
  if (!responses) return refuse(responses.error());
  if (const auto noted = note_export(*library, responses->round, responses->sets.size()); !noted)
    return refuse(noted.error());
  write_file(out, arguments.has("--scores") ? reports::scores_csv(*responses) : reports::responses_csv(*responses));
  std::printf("%zu people's answers to %s version %d\n", responses->sets.size(), round->form_id.c_str(),
              round->version);
  return kDone;
}

constexpr Option kOpenOptions[] = {kLibrary,
                                   {"--title", "TEXT", "what the occasion is called, as respondents read it"},
                                   {"--version", "N", "of this version; default: the newest"},
                                   {"--group", "NAME", "a group that respondents choose from; two to six", true},
                                   {"--study", "STUDY", "answers belong to this study: its researchers read them"},
                                   {"--at-desk", nullptr,
                                    "asked in the window, once, of everybody who has made an attempt since (for a "
                                    "study: of those who consent to it)"},
                                   kJson};
constexpr Option kExportOptionsOfRound[] = {
    kLibrary,
    {"--out", "FILE.csv", "the file"},
    {"--scores", nullptr, "a line for each respondent and a column for each item, as `seldinger stats` takes it"}};

}  // namespace

Command questionnaire_open_command() {
  return {.name = "questionnaire open",
          .positionals = "FORM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kOpenOptions,
          .acts = true,
          .summary = "Opens a round in which a questionnaire is answered, and prints its code.",
          .run = &run_questionnaire_open};
}

Command questionnaire_close_command() {
  return {.name = "questionnaire close",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryOnly,
          .acts = true,
          .summary = "Closes a round: nobody can begin or continue answering.",
          .run = &run_questionnaire_close};
}

Command questionnaire_import_command() {
  return {.name = "questionnaire import",
          .positionals = "CODE FIRST.csv SECOND.csv",
          .min_positionals = 3,
          .max_positionals = 3,
          .options = kLibraryJson,
          .acts = true,
          .summary =
              "Imports paper forms that two people have typed in; if the two differ it lists every difference and "
              "stores nothing.",
          .run = &run_questionnaire_import};
}

Command questionnaire_export_command() {
  return {.name = "questionnaire export",
          .positionals = "CODE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kExportOptionsOfRound,
          .acts = true,
          .summary = "Writes the answers of a round as CSV, a line for each respondent and item.",
          .run = &run_questionnaire_export};
}

}  // namespace seldinger::app
