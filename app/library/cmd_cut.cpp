// standard propose, freeze, cuts, dependability.
#include <algorithm>
#include <cstdio>

#include "app/acting/acting.h"
#include "app/cli/command.h"
#include "app/cli/words.h"
#include "app/library/standard_json.h"
#include "app/statistics/answer_json.h"
#include "app/statistics/procedure_arguments.h"
#include "casedb/grading/cuts.h"
#include "casedb/grading/dependability.h"
#include "reports/learning/cut_words.h"
#include "reports/words/dependability_words.h"

namespace seldinger::app {
namespace {

using assessment::statistics::Procedure;

const Procedure& method_called(const std::string& name) {
  std::vector<std::string> names;
  for (const Procedure* one : casedb::cut_methods()) {
    if (one->name == name) return *one;
    names.emplace_back(one->name);
  }
  throw UsageError("--method is " + one_of(names) + did_you_mean(name, names));
}

int run_standard_propose(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  const Procedure& method = method_called(arguments.required("--method"));
  const auto options = options_for(method, arguments.text("--options"));
  const TableColumns columns = columns_for(method, arguments);
  arguments.required("--csv");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto may = acting(*library, arguments, casedb::Action::propose_cut); !may) return refuse(may.error());
  const auto read = read_for(method, columns, arguments);
  if (!read) return refuse(read.error());
  const auto made = casedb::propose_cut(
      *library, {arguments.positional(0), arguments.text("--metric"), &method, options, read->table}, by);
  if (!made) return refuse_act(*library, casedb::Act::propose_cut, made.error());
  std::fputs(arguments.has("--json") ? json_of_cut_id(*made).c_str() : (*made + "\n").c_str(), stdout);
  return kDone;
}

int run_standard_freeze(const Arguments& arguments) {
  const std::string by = arguments.required("--by");
  auto library = open_acting(arguments);
  if (!library) return refuse(library.error());
  if (const auto frozen = casedb::freeze_cut(*library, arguments.positional(0), by); !frozen)
    return refuse_act(*library, casedb::Act::freeze_cut, frozen.error());
  return kDone;
}

int run_standard_cuts(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto row = casedb::find_case(*library, arguments.positional(0));
  if (!row) return refuse(row.error());
  const auto cuts = casedb::list_cuts(*library, row->case_id);
  if (arguments.has("--json")) {
    std::fputs(json_of_cuts(cuts).c_str(), stdout);
    return kDone;
  }
  if (cuts.empty()) std::puts("Nobody has proposed a cut for this case.");
  for (const casedb::Cut& one : cuts)
    std::printf("%s  %s\n  %s\n  %s\n", one.cut_id.c_str(), reports::cut_text(one).c_str(), one.words.c_str(),
                reports::cut_standing_text(one).c_str());
  return kDone;
}

int run_standard_dependability(const Arguments& arguments) {
  auto library = open_library(arguments);
  if (!library) return refuse(library.error());
  const auto whose = arguments.has("--simulated") ? casedb::Learners::simulated : casedb::Learners::people;
  const auto answer = casedb::dependability(casedb::learning_attempts(*library, whose));
  if (arguments.has("--json"))
    std::fputs(json_of_answer(answer).c_str(), stdout);
  else
    std::puts(reports::dependability_text(answer, whose).c_str());
  return kDone;
}

constexpr Option kProposeOptions[] = {
    kLibrary,
    {"--method", "METHOD", "contrasting_groups, borderline, angoff or hofstee (`seldinger help --statistics`)"},
    {"--metric", "METRIC",
     "the metric that the values are of; left out: a share of items, as Angoff's judges give"},
    kCsv,
    kValue,
    kGroup,
    kSubject,
    kRater,
    kX,
    kProcedureOptions,
    kJson};
constexpr Option kFreezeOptions[] = {kLibrary};
constexpr Option kCutsOptions[] = {kLibrary, kJson};
constexpr Option kDependabilityOptions[] = {
    kLibrary, {"--simulated", nullptr, "from simulated people's attempts, in place of real people's"}, kJson};

}  // namespace

Command standard_propose_command() {
  return {.name = "standard propose",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kProposeOptions,
          .acts = true,
          .named = true,
          .summary =
              "Proposes a cut for a case, by a method of standard setting, from the data of a meeting; by a "
              "mentor or a director. People and judges are stored as numbers.",
          .run = &run_standard_propose};
}

Command standard_freeze_command() {
  return {.name = "standard freeze",
          .positionals = "CUT",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kFreezeOptions,
          .acts = true,
          .named = true,
          .summary = "Freezes a cut that somebody else proposed; by a director. It cannot be changed afterwards.",
          .run = &run_standard_freeze};
}

Command standard_cuts_command() {
  return {.name = "standard cuts",
          .positionals = "CASE",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kCutsOptions,
          .summary = "Prints the cuts of a case, oldest first: with interval, method, and who froze each.",
          .run = &run_standard_cuts};
}

Command standard_dependability_command() {
  return {.name = "standard dependability",
          .options = kDependabilityOptions,
          .summary =
              "Estimates how far passing a case tells people apart (Φ), from the library's own attempts as persons "
              "by cases by occasions, and how many cases a decision needs for 0.8.",
          .run = &run_standard_dependability};
}

}  // namespace seldinger::app
