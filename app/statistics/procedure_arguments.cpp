#include "app/statistics/procedure_arguments.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "app/cli/file.h"
#include "app/cli/words.h"

namespace seldinger::app {

using assessment::statistics::Procedure;
using assessment::statistics::ProcedureOptions;

namespace {

// Tests of several conditions of the same persons take these side by side, too.
bool takes_side_by_side(const Procedure& procedure) {
  return procedure.needs.group && procedure.needs.subject && procedure.needs.most_values == 1;
}

}  // namespace

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

base::Result<ReadTable> read_for(const Procedure& procedure, const TableColumns& columns,
                                 const Arguments& arguments) {
  if (!columns.any() && !arguments.has("--csv")) return ReadTable{};
  const std::string file = arguments.required("--csv");
  const auto text = read_text_of(arguments, "--csv");
  if (!text) return text.error();
  auto read = table_in_csv(*text, columns);
  if (!read) return error_of("--csv", file, read.error());
  if (takes_side_by_side(procedure) && columns.values.size() > 1) read->table = stacked(read->table);
  return read;
}

}  // namespace seldinger::app
