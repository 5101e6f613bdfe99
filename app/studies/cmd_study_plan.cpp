// study template, plan, show, freeze, enrol, look, deviate, lock.
#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "app/cli/file.h"
#include "app/cli/version.h"
#include "app/cli/words.h"
#include "app/studies/acting_in_study.h"
#include "app/studies/plan_template_json.h"
#include "app/studies/study_json.h"
#include "casedb/cases/cases.h"
#include "reports/studies/study_words.h"
#include "reports/words/metric_words.h"
#include "reports/words/people_words.h"

namespace seldinger::app {
namespace {

using casedb::Action;

constexpr std::size_t kMostPlanBytes = 1U << 20U;

std::string state_of(const casedb::StoredPlan& plan) {
  return plan.frozen() ? "frozen " + reports::utc_text(*plan.frozen_us) : std::string("a draft");
}

int answer_plan(const Arguments& arguments, const casedb::StoredPlan& plan) {
  if (arguments.has("--json"))
    std::fputs(json_of_plan(plan).c_str(), stdout);
  else
    std::printf("plan %s, %s\n", plan.body_hash.c_str(), state_of(plan).c_str());
  return kDone;
}

int run_study_template(const Arguments& arguments) {
  const auto out = file_of("--out", arguments.required("--out"), {".json"});
  arguments.required("--case");
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.text("--case"));
  if (!row) return refuse(row.error());
  write_file(out, plan_template(row->case_id));
  return kDone;
}

int run_study_plan(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", Action::plan_study);
  if (!open) return refuse(open.error());
  const auto text = read_text_of(arguments, "FILE.json", kMostPlanBytes);
  if (!text) return refuse(text.error());
  const auto plan = casedb::store_plan(open->library, open->study.study_id, *text);
  return plan ? answer_plan(arguments, *plan) : refuse(plan.error());
}

int run_study_freeze(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", Action::plan_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::freeze_plan(open->library, open->study.study_id);
  return plan ? answer_plan(arguments, *plan) : refuse(plan.error());
}

int run_study_show(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", Action::plan_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return refuse(plan.error());
  const auto enrolments = casedb::list_study_enrolments(open->library, plan->study_id);
  const auto lock = casedb::find_lock(open->library, plan->study_id);
  const auto looks = casedb::list_looks(open->library, plan->study_id);
  const auto deviations = casedb::list_deviations(open->library, plan->study_id);
  if (arguments.has("--json")) {
    std::fputs(json_of_study(open->study, *plan, lock, enrolments, looks, deviations).c_str(), stdout);
    return kDone;
  }
  std::printf("%s\nplan %s, %s\n", plan->plan.title.c_str(), plan->body_hash.c_str(), state_of(*plan).c_str());
  if (lock)
    std::printf("data %s, locked %s\n", lock->data_hash.c_str(), reports::utc_text(lock->locked_us).c_str());
  std::printf("%s, %zu are enrolled\n", reports::study_people_text(open->study.people).c_str(), enrolments.size());
  for (const auto& group : plan->plan.groups)
    std::printf("  %-24s %td\n", group.name.c_str(),
                std::count_if(enrolments.begin(), enrolments.end(),
                              [&](const auto& one) { return one.group == group.name; }));
  const bool simulated = plan->plan.people == assessment::study::People::simulated;
  for (const casedb::StudyNote& one : looks)
    std::printf("look %d  %s  %s, %s\n", one.number, reports::utc_text(one.at_us).c_str(), one.text.c_str(),
                reports::with_outcome_text(one.people, simulated).c_str());
  for (const casedb::StudyNote& one : deviations)
    std::printf("deviation %d  %s  %s\n", one.number, reports::utc_text(one.at_us).c_str(), one.text.c_str());
  return kDone;
}

// Everybody who may and takes no part yet; of those who cannot a count for each reason.
Enrolled enrol_all(casedb::Library& library, const casedb::StoredPlan& plan) {
  Enrolled enrolled;
  std::map<std::pair<std::string, std::string>, int> refused;  // by code and words
  for (const std::string& person_id : casedb::people_asked(library, plan)) {
    auto one = casedb::enrol_in_study(library, plan.study_id, person_id);
    if (one)
      enrolled.enrolments.push_back(std::move(*one));
    else if (one.error().code != "already_enrolled")
      ++refused[{one.error().code, one.error().text}];
  }
  for (const auto& [why, people] : refused)
    enrolled.refused.push_back(
        {why.first, std::to_string(people) + (people == 1 ? " person: " : " people: ") + why.second});
  return enrolled;
}

int run_study_enrol(const Arguments& arguments) {
  if (arguments.has("--user") == arguments.has("--all")) throw UsageError("give either --user or --all");
  auto open = open_study(arguments, "STUDY", Action::enrol_in_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return refuse(plan.error());
  Enrolled enrolled;
  if (arguments.has("--all")) {
    if (plan->plan.randomised)
      throw UsageError("people assigned to an arm are enrolled one by one, as they come: --user");
    if (!plan->frozen())
      return refuse(
          {"plan_not_frozen", "people can be enrolled once the plan is frozen (`seldinger study freeze`)"});
    enrolled = enrol_all(open->library, *plan);
  } else {
    const auto person = casedb::open_account(open->library, arguments.text("--user"));
    if (!person) return refuse(person.error());
    auto one = casedb::enrol_in_study(open->library, plan->study_id, person->person_id);
    if (!one) return refuse(one.error());
    enrolled.enrolments.push_back(std::move(*one));
  }
  if (arguments.has("--json")) {
    std::fputs(json_of_enrolled(enrolled).c_str(), stdout);
    return kDone;
  }
  for (const casedb::StudyEnrolment& one : enrolled.enrolments)
    std::printf("%s  %s\n", one.pseudonym.c_str(), one.group.c_str());
  for (const base::Problem& one : enrolled.refused) std::printf("not enrolled: %s\n", one.text.c_str());
  return kDone;
}

void print_outcomes(const std::vector<assessment::study::Compared>& outcomes, double alpha, bool primary) {
  for (const assessment::study::Compared& one : outcomes) {
    std::printf("\n%s%s%s\n", one.outcome.name.c_str(), one.hand.empty() ? "" : ", hand: ", one.hand.c_str());
    for (const assessment::study::GroupSum* sum : {&one.first, &one.second})
      std::printf("  %-20s %s\n", sum->name.c_str(), reports::group_text(*sum, "").c_str());
    if (one.refused.empty() && one.answer.estimate)
      std::printf("  %s = %s, 95 %% %s\n", one.answer.estimate_name.c_str(),
                  reports::digits_text(*one.answer.estimate).c_str(),
                  reports::interval_text(one.answer.ci95).c_str());
    if (primary)
      std::printf("  p (Holm) %s. %s\n", reports::p_text(one.p_adjusted).c_str(),
                  reports::verdict_text(one, alpha).c_str());
    else
      std::puts("  exploratory: no p value and no conclusion");
  }
}

int run_study_look(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", Action::plan_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return refuse(plan.error());
  if (!plan->frozen()) {
    const casedb::BlindedCounts counts = casedb::blinded_counts(open->library, *plan);
    if (arguments.has("--json"))
      std::fputs(json_of_blinded(*plan, counts).c_str(), stdout);
    else
      std::printf("The plan is a draft, so nothing is shown by group: %s, %zu of them made %zu attempts.\n",
                  reports::study_people_text(counts.people).c_str(), counts.with_attempts, counts.attempts);
    return kDone;
  }
  casedb::StudyData data = casedb::study_data(open->library, *plan);
  const auto result = assessment::study::analyse(plan->plan, data.people);
  casedb::add_analysed(result, data.flow);
  casedb::note_look(open->library, plan->study_id, "study look", casedb::people_with_outcome(result));
  if (arguments.has("--json")) {
    std::fputs(json_of_result(*plan, result, data.flow, casedb::data_hash(result)).c_str(), stdout);
    return kDone;
  }
  if (plan->plan.people == assessment::study::People::simulated)
    std::puts("SIMULATED: every attempt was made by a simulated operator; nothing here is about people.");
  if (!result.stopped) std::printf("An interim look: the plan stops at %d in each group.\n", plan->plan.per_group);
  print_outcomes(result.primary, plan->plan.alpha, true);
  print_outcomes(result.secondary, plan->plan.alpha, false);
  std::puts("\nThis look is recorded, and every report of the study prints it.");
  return kDone;
}

int run_study_lock(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", Action::plan_study);
  if (!open) return refuse(open.error());
  const auto plan = casedb::find_plan(open->library, open->study.study_id);
  if (!plan) return refuse(plan.error());
  const auto lock = casedb::lock_data(open->library, *plan);
  if (!lock) return refuse(lock.error());
  if (arguments.has("--json"))
    std::fputs(json_of_lock(*plan, *lock).c_str(), stdout);
  else
    std::printf("data locked %s, SHA-256 %s, %s\n", reports::utc_text(lock->locked_us).c_str(),
                lock->data_hash.c_str(),
                reports::with_outcome_text(lock->people, plan->plan.people == assessment::study::People::simulated)
                    .c_str());
  return kDone;
}

int run_study_deviate(const Arguments& arguments) {
  auto open = open_study(arguments, "STUDY", Action::plan_study);
  if (!open) return refuse(open.error());
  const auto done = casedb::add_deviation(open->library, open->study.study_id, arguments.positional(1));
  return done ? kDone : refuse(done.error());
}

constexpr Option kTemplateOptions[] = {kLibrary,
                                       {"--case", "CASE", "the case on which outcomes are measured"},
                                       {"--out", "FILE.json", "the new file"}};
constexpr Option kEnrolOptions[] = {kLibrary,
                                    {"--user", "NAME", "the person to enrol"},
                                    {"--all", nullptr, "everybody who consents, where facts decide the group"},
                                    kJson};

}  // namespace

Command study_template_command() {
  return {.name = "study template",
          .options = kTemplateOptions,
          .summary =
              "Writes a plan to start from: a valid draft; replace the words that begin with REPLACE before it is "
              "frozen (docs/studies.md).",
          .run = &run_study_template};
}

Command study_plan_command() {
  return {.name = "study plan",
          .positionals = "STUDY FILE.json",
          .min_positionals = 2,
          .max_positionals = 2,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Stores the draft of a study's plan, replacing an older draft.",
          .run = &run_study_plan};
}

Command study_show_command() {
  return {.name = "study show",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary = "Shows a study's plan, who is enrolled, and every look and deviation.",
          .run = &run_study_show};
}

Command study_freeze_command() {
  return {
      .name = "study freeze",
      .positionals = "STUDY",
      .min_positionals = 1,
      .max_positionals = 1,
      .options = kLibraryJson,
      .acts = true,
      .summary =
          "Freezes a study's plan for good; from then on people can be enrolled and outcomes are shown by group.",
      .run = &run_study_freeze};
}

Command study_enrol_command() {
  return {.name = "study enrol",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kEnrolOptions,
          .acts = true,
          .summary =
              "Enrols people who consent: in a group by their facts, or in a random arm that nobody knew before.",
          .run = &run_study_enrol};
}

Command study_look_command() {
  return {.name = "study look",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary =
              "Runs the analysis of a frozen plan and records the look; of a draft it shows only counts for "
              "everybody together.",
          .run = &run_study_look};
}

Command study_lock_command() {
  return {.name = "study lock",
          .positionals = "STUDY",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .acts = true,
          .summary =
              "Locks a study's data for good: attempts begun later are not analysed, and every report says whether "
              "it analyses exactly what was locked.",
          .run = &run_study_lock};
}

Command study_deviate_command() {
  return {
      .name = "study deviate",
      .positionals = "STUDY TEXT",
      .min_positionals = 2,
      .max_positionals = 2,
      .options = kLibraryOnly,
      .acts = true,
      .summary = "Records what was done differently from the plan; it is printed in every report and never edited.",
      .run = &run_study_deviate};
}

}  // namespace seldinger::app
