// consent text, list, give, withdraw; user fact.
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/library/people_json.h"

namespace seldinger::app {
namespace {

int run_consent_text(const Arguments& arguments) {
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto by = acting(*library, arguments, casedb::Action::manage_studies);
  if (!by) return refuse(by.error());
  std::optional<std::string> study_id;
  if (arguments.has("--study")) {
    const auto study = casedb::find_study(*library, arguments.text("--study"));
    if (!study) return refuse(study.error());
    study_id = study->study_id;
  }
  const auto body = read_text_of(arguments, "FILE");
  if (!body) return refuse(body.error());
  const auto version = casedb::add_consent_text(*library, study_id, *body);
  if (!version) return refuse(version.error());
  std::printf("version %d\n", *version);
  return kDone;
}

int run_consent_list(const Arguments& arguments) {
  const std::string user = arguments.required("--user");
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto person = casedb::open_account(*library, user);
  if (!person) return refuse(person.error());
  const auto consents = casedb::list_consents(*library, person->person_id);
  if (arguments.has("--json")) {
    std::fputs(json_of_consents(consents).c_str(), stdout);
    return kDone;
  }
  if (consents.empty()) std::puts("Nobody is asked for consent yet; `seldinger consent text` adds a text.");
  for (const casedb::Consent& one : consents)
    std::printf("%s  version %d  %-12s %s\n", one.text_id.c_str(), one.version,
                one.stands()    ? "given"
                : one.refused() ? "refused"
                : one.given_us  ? "withdrawn"
                                : "not answered",
                one.study_id ? one.study_title.c_str() : "research with this library");
  return kDone;
}

int run_consent_answer(const Arguments& arguments, bool give) {
  const std::string user = arguments.required("--user");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  const auto person = casedb::open_account(*library, user);
  if (!person) return refuse(person.error());
  if (const auto by = acting_on(*library, arguments, casedb::Action::answer_consent, person->person_id); !by)
    return refuse(by.error());
  const auto done = give ? casedb::give_consent(*library, person->person_id, arguments.positional(0))
                         : casedb::withdraw_consent(*library, person->person_id, arguments.positional(0));
  if (!done) return refuse(done.error());
  if (give || !arguments.has("--delete")) return kDone;
  const auto erased = casedb::erase_attempts_of(*library, person->person_id, person->person_id);
  if (!erased) return refuse(erased.error());
  warn_of_what_is_left(*erased);
  std::printf("withdrawn; %zu attempts erased\n", erased->attempts);
  return kDone;
}

int run_user_fact(const Arguments& arguments) {
  auto library = arguments.positionals() == 3 ? open_acting(arguments) : open_library(arguments);
  if (!library) return refuse(library.error());
  const auto person = casedb::open_account(*library, arguments.positional(0));
  if (!person) return refuse(person.error());
  if (arguments.positionals() == 2) throw UsageError("give both a fact and its answer, or neither");
  if (arguments.positionals() == 3) {
    if (const auto by = acting_on(*library, arguments, casedb::Action::answer_consent, person->person_id); !by)
      return refuse(by.error());
    const auto done =
        casedb::give_fact(*library, person->person_id, arguments.positional(1), arguments.positional(2));
    return done ? kDone : refuse(done.error());
  }
  const auto facts = casedb::list_facts(*library, person->person_id);
  if (arguments.has("--json")) {
    std::fputs(json_of_given_facts(facts).c_str(), stdout);
    return kDone;
  }
  const auto newest = casedb::newest_facts(facts);
  for (const casedb::FactInfo& fact : casedb::fact_infos()) {
    const auto found = newest.find(std::string(fact.id));
    std::printf("%-20s %-8s %s\n", std::string(fact.id).c_str(),
                found == newest.end() ? "–" : found->second.answer.c_str(), std::string(fact.words).c_str());
  }
  return kDone;
}

constexpr Option kConsentTextOptions[] = {
    kLibrary, {"--study", "STUDY", "for this study; left out: for research with this library"}};
constexpr Option kConsentListOptions[] = {kLibrary, kWhose, kJson};
constexpr Option kConsentGiveOptions[] = {kLibrary, kWhose};
constexpr Option kConsentWithdrawOptions[] = {
    kLibrary, kWhose, {"--delete", nullptr, "also erase this person's recordings and results"}};

}  // namespace

Command consent_text_command() {
  return {.name = "consent text",
          .positionals = "FILE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kConsentTextOptions,
          .acts = true,
          .summary = "Adds the next version of a text that people are asked to consent to.",
          .run = &run_consent_text};
}

Command consent_list_command() {
  return {.name = "consent list",
          .options = kConsentListOptions,
          .summary = "Lists what somebody is asked to consent to, and the answers.",
          .run = &run_consent_list};
}

Command consent_give_command() {
  return {.name = "consent give",
          .positionals = "TEXT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kConsentGiveOptions,
          .acts = true,
          .summary = "Records consent that somebody gave on paper; on the dashboard people answer for themselves.",
          .run = [](const Arguments& arguments) { return run_consent_answer(arguments, true); }};
}

Command consent_withdraw_command() {
  return {
      .name = "consent withdraw",
      .positionals = "TEXT",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kConsentWithdrawOptions,
      .acts = true,
      .summary =
          "Records that somebody no longer consents, or that their consent to research does not cover this study.",
      .run = [](const Arguments& arguments) { return run_consent_answer(arguments, false); }};
}

Command user_fact_command() {
  return {
      .name = "user fact",
      .positionals = "NAME [FACT ANSWER]",
      .min_positionals = 1,
      .max_positionals = 3,
      .options = kLibraryJson,
      .acts = true,
      .summary = "Lists what somebody said about their experience, or records an answer that is valid from now on.",
      .run = &run_user_fact};
}

}  // namespace seldinger::app
