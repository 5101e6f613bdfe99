// stats.
#include <cstdio>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/words.h"
#include "app/statistics/answer_json.h"
#include "app/statistics/answer_text.h"
#include "app/statistics/procedure_arguments.h"
#include "app/statistics/procedures.h"

namespace seldinger::app {
namespace {

using assessment::statistics::Procedure;

const Procedure& procedure_called(const std::string& name) {
  const Procedure* found = find_procedure(name);
  if (found != nullptr) return *found;
  std::vector<std::string> names;
  for (const Procedure& one : procedures()) names.emplace_back(one.name);
  throw UsageError("there is no test " + shown(name) + did_you_mean(name, names));
}

int run_stats(const Arguments& arguments) {
  const Procedure& procedure = procedure_called(arguments.positional(0));
  const auto options = options_for(procedure, arguments.text("--options"));
  const TableColumns columns = columns_for(procedure, arguments);
  const auto read = read_for(procedure, columns, arguments);
  if (!read) return refuse(read.error());
  auto answer = assessment::statistics::settled(procedure.run(read->table, options));
  answer.notes.insert(answer.notes.begin(), read->notes.begin(), read->notes.end());
  std::fputs((arguments.has("--json") ? json_of_answer(answer) : text_of_answer(answer)).c_str(), stdout);
  return kDone;
}

constexpr Option kStatsOptions[] = {kCsv, kValue, kGroup, kSubject, kRater, kX, kProcedureOptions, kJson};

}  // namespace

Command stats_command() {
  return {.name = "stats",
          .positionals = "TEST",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kStatsOptions,
          .summary =
              "Runs one statistical test on a CSV file and gives an estimate with its interval, or why there is "
              "none. `seldinger help --statistics` lists the tests with their columns and options.",
          .run = &run_stats};
}

}  // namespace seldinger::app
