// stats.
#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "app/cli/command.h"
#include "app/cli/file.h"
#include "app/cli/words.h"
#include "app/statistics/answer_json.h"
#include "app/statistics/answer_text.h"
#include "app/statistics/procedures.h"
#include "app/statistics/table_csv.h"

namespace seldinger::app {
namespace {

using assessment::statistics::Procedure;
using assessment::statistics::ProcedureOptions;

const Procedure& procedure_called(const std::string& name) {
  const Procedure* found = find_procedure(name);
  if (found != nullptr) return *found;
  std::vector<std::string> names;
  for (const Procedure& one : procedures()) names.emplace_back(one.name);
  throw UsageError("there is no test " + shown(name) + did_you_mean(name, names));
}

// "k=v,k=v" in words that the procedure knows.
ProcedureOptions options_for(const Procedure& procedure, const std::string& typed) {
  std::vector<std::string> known;
  for (const auto& option : procedure.options) known.emplace_back(option.name);
  std::map<std::string, std::string> values;
  for (std::size_t from = 0; from < typed.size();) {
    const std::size_t comma = std::min(typed.find(',', from), typed.size());
    const std::string pair = typed.substr(from, comma - from);
    const std::size_t equals = pair.find('=');
    const std::string name = pair.substr(0, equals);
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw UsageError(std::string(procedure.name) + " has no option " + shown(name) +
                       (known.empty() ? ", nor any other" : did_you_mean(name, known)));
    if (equals == std::string::npos) throw UsageError("--options is k=v,…: " + name + " needs a value");
    if (!values.emplace(name, pair.substr(equals + 1)).second) throw UsageError(name + " was given twice");
    from = comma + 1;
  }
  return ProcedureOptions(std::move(values));
}

// Tests of several conditions of the same persons take these side by side, too.
bool takes_side_by_side(const Procedure& procedure) {
  return procedure.needs.group && procedure.needs.subject && procedure.needs.most_values == 1;
}

TableColumns columns_for(const Procedure& procedure, const Arguments& arguments) {
  const auto& needs = procedure.needs;
  TableColumns columns{
      {}, arguments.text("--group"), arguments.text("--subject"), arguments.text("--rater"), arguments.text("--x")};
  if (arguments.has("--value")) {
    columns.values = column_names(arguments.text("--value"));
    if (columns.values.empty())
      throw UsageError("--value is COL or COL,COL…, not " + shown(arguments.text("--value")));
  }
  const std::string takes = std::string(" (") + procedure.columns + ")";
  const auto need = [&](bool needed, const char* option, bool given) {
    if (needed && !given) throw UsageError(std::string(procedure.name) + " needs " + option + takes);
  };
  need(needs.least_values > 0, "--value", !columns.values.empty());
  if (takes_side_by_side(procedure) && columns.values.size() > 1 && columns.group.empty()) return columns;
  need(needs.group, "--group", !columns.group.empty());
  need(needs.subject, "--subject", !columns.subject.empty());
  need(needs.rater, "--rater", !columns.rater.empty());
  need(needs.x, "--x", !columns.x.empty());
  const std::size_t given = columns.values.size();
  if (given < needs.least_values)
    throw UsageError(std::string(procedure.name) + " needs " + std::to_string(needs.least_values) +
                     " or more columns in --value" + takes);
  if (given > needs.most_values)
    throw UsageError(std::string(procedure.name) + " takes " + std::to_string(needs.most_values) +
                     (needs.most_values == 1 ? " column" : " columns") + " in --value, not " +
                     std::to_string(given) + takes);
  return columns;
}

int run_stats(const Arguments& arguments) {
  const Procedure& procedure = procedure_called(arguments.positional(0));
  const ProcedureOptions options = options_for(procedure, arguments.text("--options"));
  const TableColumns columns = columns_for(procedure, arguments);
  ReadTable read;
  if (columns.any() || arguments.has("--csv")) {
    const std::string file = arguments.required("--csv");
    const auto text = read_text_of(arguments, "--csv");
    if (!text) return refuse(text.error());
    auto table = table_in_csv(*text, columns);
    if (!table) return refuse(error_of("--csv", file, table.error()));
    read = std::move(*table);
    if (takes_side_by_side(procedure) && columns.values.size() > 1) read.table = stacked(read.table);
  }
  auto answer = assessment::statistics::settled(procedure.run(read.table, options));
  answer.notes.insert(answer.notes.begin(), read.notes.begin(), read.notes.end());
  std::fputs((arguments.has("--json") ? json_of_answer(answer) : text_of_answer(answer)).c_str(), stdout);
  return kDone;
}

constexpr Option kStatsOptions[] = {
    {"--csv", "FILE", "the data, a header and then one observation a line: UTF-8; empty, NA or NaN is missing"},
    {"--value", "COL", "the column of numbers; where a test takes several, their names with commas between them"},
    {"--group", "COL", "to which group a line belongs"},
    {"--subject", "COL", "whose it is: the person is the unit"},
    {"--rater", "COL", "who gave the value: a rater, a case, a judge"},
    {"--x", "COL", "a second column of numbers, as the test has it: occasion, dose, event, predictor"},
    {"--options", "k=v,…", "what the test leaves to be chosen; a list of several words is a:b:c"},
    kJson};

}  // namespace

Command stats_command() {
  return {.name = "stats",
          .positionals = "TEST",
          .min_positionals = 1,
          .max_positionals = 1,
          .options = kStatsOptions,
          .summary =
              "Answers one statistical test from a CSV file: an estimate with its interval, or why there is "
              "none. `seldinger help --statistics` lists the tests with their columns and options.",
          .run = &run_stats};
}

}  // namespace seldinger::app
