// questionnaire template, add, list, show.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/file.h"
#include "app/questionnaires/questionnaire_json.h"
#include "assessment/questionnaire/shipped_forms.h"

namespace seldinger::app {
namespace {

namespace questionnaire = assessment::questionnaire;

constexpr std::size_t kMostFormBytes = 1U << 20U;

int run_questionnaire_template(const Arguments& arguments) {
  const auto out = file_of("--out", arguments.required("--out"), {".json"});
  const questionnaire::ShippedForm* shipped = questionnaire::find_shipped_form(arguments.positional(0));
  if (shipped == nullptr) {
    std::string known;
    for (const questionnaire::ShippedForm& one : questionnaire::shipped_forms())
      known += (known.empty() ? "" : ", ") + one.form.id;
    throw UsageError("FORM is one of " + known);
  }
  write_file(out, std::string(shipped->json));
  return kDone;
}

int run_questionnaire_add(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_questionnaires);
  if (!by) return refuse(by.error());
  const auto text = read_text_of(arguments, "FILE.json", kMostFormBytes);
  if (!text) return refuse(text.error());
  const auto stored = casedb::store_form(*library, *text);
  if (!stored) return refuse(stored.error());
  if (arguments.has("--json"))
    std::fputs(json_of_form(*stored).c_str(), stdout);
  else
    std::printf("%s version %d, %s: %zu items, SHA-256 %s\n", stored->form.id.c_str(), stored->form.version,
                stored->form.language.c_str(), stored->form.items.size(), stored->body_hash.c_str());
  return kDone;
}

int run_questionnaire_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto forms = casedb::list_forms(*library);
  const auto rounds = casedb::list_rounds(*library);
  if (arguments.has("--json")) {
    std::fputs(json_of_questionnaires(forms, rounds).c_str(), stdout);
    return kDone;
  }
  if (forms.empty()) std::puts("There are no questionnaires yet; `seldinger questionnaire template` writes one.");
  for (const casedb::StoredForm& one : forms)
    std::printf("%-24s version %d  %-5s %s\n", one.form.id.c_str(), one.form.version, one.form.language.c_str(),
                one.form.title.c_str());
  for (const casedb::Round& one : rounds)
    std::printf("%s  %-6s %s version %d: %d begun, %d sent  %s\n", one.code.c_str(),
                one.is_open() ? "open" : "closed", one.form_id.c_str(), one.version, one.drafts, one.submitted,
                one.title.c_str());
  return kDone;
}

void print_item(const questionnaire::Form& form, const questionnaire::Item& item) {
  std::printf("%-4s %s%s\n", item.id.c_str(), item.text.c_str(), item.reverse ? "  (reverse)" : "");
  std::string answers;
  if (const questionnaire::Scale* scale = form.find_scale(item.scale))
    for (const questionnaire::ScalePoint& one : scale->points)
      answers += (answers.empty() ? "" : ", ") + std::to_string(one.value) +
                 (one.label.empty() ? "" : " " + one.label) + (one.no_opinion ? " (no opinion)" : "");
  for (const std::string& one : item.choices) answers += (answers.empty() ? "" : ", ") + one;
  if (item.kind == questionnaire::ItemKind::number) answers = item.unit.empty() ? "a number" : item.unit;
  if (item.kind == questionnaire::ItemKind::comment) answers = "a comment";
  if (item.not_applicable) answers += ", n/a";
  std::printf("     %s\n", answers.c_str());
}

int run_questionnaire_show(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto version = static_cast<int>(arguments.whole("--version", 0, 1, 1'000'000));
  const auto forms = casedb::find_forms(*library, arguments.positional(0), version);
  if (!forms) return refuse(forms.error());
  const std::string language = arguments.text("--language", forms->front().form.language);
  for (const casedb::StoredForm& one : *forms) {
    if (one.form.language != language) continue;
    if (arguments.has("--json")) {
      std::fputs(json_of_form(one).c_str(), stdout);
      return kDone;
    }
    std::printf("%s\n%s version %d, %s, SHA-256 %s\n", one.form.title.c_str(), one.form.id.c_str(),
                one.form.version, one.form.language.c_str(), one.body_hash.c_str());
    std::string section;
    for (const questionnaire::Item& item : one.form.items) {
      if (item.section != section) std::printf("\n%s\n", item.section.c_str());
      section = item.section;
      print_item(one.form, item);
    }
    for (const std::string& correction : one.form.corrections) std::printf("\ncorrected: %s\n", correction.c_str());
    return kDone;
  }
  return refuse({"no_form", "the library does not have that questionnaire in that language"});
}

constexpr Option kTemplateFormOptions[] = {{"--out", "FILE.json", "the new file"}};
constexpr Option kShowFormOptions[] = {kLibrary,
                                       {"--version", "N", "this version; default: the newest"},
                                       {"--language", "WORD", "in this language; default: the first"},
                                       kJson};

}  // namespace

Command questionnaire_template_command() {
  return {.name = "questionnaire template",
          .positionals = "FORM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kTemplateFormOptions,
          .summary =
              "Writes a form that comes with the program: workshop-2005, workshop-2006 or workshop-2007 "
              "(docs/questionnaires.md), osats-grs or needle-checklist for raters (docs/ratings.md).",
          .run = &run_questionnaire_template};
}

Command questionnaire_add_command() {
  return {.name = "questionnaire add",
          .positionals = "FILE.json",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Stores a questionnaire for good; different questions need a new version.",
          .run = &run_questionnaire_add};
}

Command questionnaire_list_command() {
  return {.name = "questionnaire list",
          .options = kLibraryJson,
          .summary = "Lists the questionnaires, and the rounds in which they are answered.",
          .run = &run_questionnaire_list};
}

Command questionnaire_show_command() {
  return {.name = "questionnaire show",
          .positionals = "FORM",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kShowFormOptions,
          .summary = "Shows a questionnaire's items and scales.",
          .run = &run_questionnaire_show};
}

}  // namespace seldinger::app
