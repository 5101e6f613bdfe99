// help.
#include <cstdio>
#include <string>
#include <vector>

#include "app/cli/error_codes.h"
#include "app/cli/words.h"
#include "app/commands.h"
#include "app/statistics/procedures.h"
#include "assessment/grading/worthwhile.h"
#include "assessment/operators/profile.h"
#include "assessment/procedure/steps.h"
#include "assessment/registry.h"
#include "casedb/import/dicom/allow_list.h"
#include "web/routes/routes.h"

namespace seldinger::app {
namespace {

int run_help(const Arguments& arguments) {
  if (arguments.has("--metrics")) {
    std::fputs(assessment::metrics_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--differences")) {
    std::fputs(assessment::worthwhile_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--steps")) {
    std::fputs(assessment::steps_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--operators")) {
    std::fputs(assessment::operators_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--statistics")) {
    std::fputs(procedures_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--commands")) {
    std::fputs(commands_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--routes")) {
    std::fputs(web::routes_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--attributes")) {
    std::fputs(casedb::allow_list_markdown().c_str(), stdout);
    return kDone;
  }
  if (arguments.has("--errors")) {
    std::fputs(errors_markdown().c_str(), stdout);
    return kDone;
  }
  std::string wanted;
  for (std::size_t i = 0; i < arguments.positionals(); ++i)
    wanted += (wanted.empty() ? "" : " ") + arguments.positional(i);
  if (wanted.empty()) {
    std::fputs(help_text().c_str(), stdout);
    return kDone;
  }
  std::vector<std::string> known;
  std::string text;
  for (const Command& command : commands()) {
    known.emplace_back(command.name);
    known.push_back(known.back().substr(0, known.back().find(' ')));
    if (wanted == command.name) text += help_text(command);
  }
  if (text.empty()) text = help_text_of_noun(wanted);  // `case` begins many
  if (text.empty()) throw UsageError("there is no command " + shown(wanted) + did_you_mean(wanted, known));
  std::fputs(text.c_str(), stdout);
  return kDone;
}

constexpr Option kHelpOptions[] = {
    {"--metrics", nullptr, "print the table of metrics (docs/metrics.md)"},
    {"--differences", nullptr, "print the smallest worthwhile differences (docs/differences.md)"},
    {"--steps", nullptr, "print the table of a puncture's steps (docs/steps.md)"},
    {"--operators", nullptr, "print what simulated operators are and can do (docs/operators.md)"},
    {"--statistics", nullptr, "print the statistical tests, their columns and options (docs/statistics.md)"},
    {"--commands", nullptr, "print the table of commands (docs/commands.md)"},
    {"--routes", nullptr, "print the table of web routes (docs/routes.md)"},
    {"--attributes", nullptr, "print what a case takes over from its source (docs/attributes.md)"},
    {"--errors", nullptr, "print the table of error codes (docs/errors.md)"}};

}  // namespace

Command help_command() {
  return {.name = "help",
          .positionals = "[COMMAND]",
          .max_positionals = 2,
          .options = kHelpOptions,
          .summary = "Prints this text, or one command's options.",
          .run = &run_help};
}

}  // namespace seldinger::app
