// attempt list, attempt show.
#include <cstdio>
#include <map>

#include "app/acting/acting.h"
#include "app/attempts/answers_json.h"
#include "app/attempts/attempt_line.h"
#include "app/attempts/grade_text.h"
#include "app/attempts/metrics_text.h"
#include "app/cli/command.h"
#include "app/hands/servo_answer.h"
#include "reports/words/attempt_words.h"
#include "reports/words/condition_words.h"
#include "reports/words/grade_words.h"
#include "reports/words/metric_words.h"
#include "reports/words/step_card.h"
#include "session/attempt/interrupted_attempt.h"

namespace seldinger::app {
namespace {

// Padded, or cut with "…", to so many letters of UTF-8.
std::string in_columns(const std::string& text, std::size_t columns) {
  std::size_t letters = 0, kept = 0;  // kept: bytes of the first columns − 1 letters
  for (std::size_t i = 0; i < text.size(); ++i)
    if ((static_cast<unsigned char>(text[i]) & 0xC0U) != 0x80 && ++letters == columns) kept = i;
  if (letters <= columns) return text + std::string(columns - letters, ' ');
  return text.substr(0, kept) + "…";
}

std::string who(const casedb::AttemptRow& attempt) {
  return attempt.synthetic() ? reports::simulated_operator_text(attempt.operator_name) : attempt.operator_name;
}

void print_course(const Course& course) {
  for (const assessment::StepResult& step : course.steps) {
    if (step.state == assessment::StepState::not_asked) continue;
    char when[16] = "       –";
    if (step.t_s) std::snprintf(when, sizeof when, "%6.1f s", *step.t_s);
    std::printf("  %-8s %s  %s\n", std::string(assessment::name_of(step.state)).c_str(), when,
                reports::step_text(step).c_str());
  }
  for (const cases::Event& event : course.events.value_or(std::vector<cases::Event>{}))
    if (const cases::EventInfo* info = cases::find_event(event.kind))
      std::printf("  event    %6.1f s  %s\n", event.t_s, info->words);
}

int run_attempt_list(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto left_behind = session::close_interrupted_attempts(*library);
  if (!left_behind.empty())
    std::fprintf(stderr, "%zu attempt%s left behind when a program died %s kept as interrupted\n",
                 left_behind.size(), left_behind.size() == 1 ? "" : "s", left_behind.size() == 1 ? "is" : "are");
  const auto attempts = casedb::list_attempts(*library);
  casedb::Grader grader(*library);
  std::vector<assessment::Grade> grades;
  for (const casedb::AttemptRow& attempt : attempts) grades.push_back(grader.grade(attempt));
  if (arguments.has("--json")) {
    std::fputs(json_of_attempts(attempts, grades, casedb::list_open_attempts(*library)).c_str(), stdout);
    return kDone;
  }
  if (attempts.empty()) std::puts("There are no attempts yet; `seldinger simulate` makes some.");
  std::map<std::string, std::string> names;
  for (const casedb::Account& one : casedb::list_users(*library)) names[one.person_id] = one.login_name;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    const casedb::AttemptRow& attempt = attempts[i];
    const std::string name = attempt.person_id ? names[*attempt.person_id] : "";
    std::printf("%s  %s  %s  %s  %s\n", attempt.attempt_id.c_str(), reports::utc_text(attempt.started_us).c_str(),
                in_columns(attempt.case_title, 28).c_str(), in_columns(maker_text(attempt, name), 26).c_str(),
                outcome_text(grades[i].verdict, attempt.metrics).c_str());
  }
  return kDone;
}

int run_attempt_show(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto attempt = casedb::find_attempt(*library, arguments.positional(0));
  if (!attempt) return refuse(attempt.error());
  Course course{casedb::list_steps(*library, attempt->attempt_id)};
  if (auto recording = casedb::load_recording(*library, attempt->attempt_id))
    course.events = std::move(recording->events);
  const casedb::AttemptGrade grade = casedb::Grader(*library).look_at(*attempt);
  if (arguments.has("--json")) {
    const auto servo = casedb::find_servo_record(*library, attempt->attempt_id);
    std::fputs(json_of_attempt(*attempt, grade, servo, course).c_str(), stdout);
    return kDone;
  }
  std::printf("attempt  %s\nwhen     %s\ncase     %s  %s\nlesion   %s\nguidance %s\noperator %s, seed %llu\n",
              attempt->attempt_id.c_str(), reports::utc_text(attempt->started_us).c_str(), attempt->case_id.c_str(),
              attempt->case_title.c_str(), attempt->lesion_id.c_str(),
              casedb::name_of(attempt->picture.modality).c_str(), who(*attempt).c_str(),
              static_cast<unsigned long long>(attempt->seed));
  if (const std::string made = reports::conditions_text(attempt->conditions, attempt->away_s); !made.empty())
    std::printf("made     %s\n", made.c_str());
  if (attempt->end) std::printf("ended    %s\n", casedb::name_of(*attempt->end).c_str());
  if (const std::string away = reports::away_text(*attempt); !away.empty())
    std::printf("         %s\n", away.c_str());
  std::fputs(text_of_grade(grade).c_str(), stdout);
  print_metrics(attempt->metrics);
  std::puts("  (what each one measures: seldinger help --metrics)");
  print_course(course);
  if (const auto servo = casedb::find_servo_record(*library, attempt->attempt_id))
    std::printf("how the servo kept time\n%s", text_of_servo_record(*servo).c_str());
  return kDone;
}

}  // namespace

Command attempt_list_command() {
  return {.name = "attempt list",
          .options = kLibraryJson,
          .summary = "Lists the attempts, newest first: on which case, by whom, and how it went.",
          .run = &run_attempt_list};
}

Command attempt_show_command() {
  return {.name = "attempt show",
          .positionals = "ATTEMPT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kLibraryJson,
          .summary = "Shows one attempt with its metrics.",
          .run = &run_attempt_show};
}

}  // namespace seldinger::app
