#include "reports/export/data_package_json.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "reports/export/raw_tables.h"

namespace seldinger::reports {
namespace {

using Json = nlohmann::ordered_json;

Json field_of(const ColumnInfo& column) {
  const bool flag = column.type == "flag";
  Json field = {{"name", column.name},
                {"type", flag                    ? "boolean"
                         : column.type == "text" ? "string"
                                                 : column.type},
                {"description", column.what}};
  if (flag) {
    field["trueValues"] = {"1"};
    field["falseValues"] = {"0"};
  }
  if (!column.unit.empty()) field["unit"] = column.unit;
  if (column.version) field["version"] = *column.version;
  if (column.missing.empty())
    field["constraints"] = {{"required", true}};
  else
    field["emptyWhen"] = column.missing;
  return field;
}

// Rows of an attempt's tables name it; people's answers name a person, who has attempts.
Json resource_of(const TableInfo& table) {
  const std::string name = table.file.substr(0, table.file.find('.'));
  Json schema = {{"fields", Json::array()}, {"missingValues", {""}}};
  bool names_attempt = false;
  for (const ColumnInfo& column : table.columns) {
    schema["fields"].push_back(field_of(column));
    names_attempt = names_attempt || column.name == "attempt";
  }
  if (name == "attempts")
    schema["primaryKey"] = "attempt";
  else if (names_attempt)
    schema["foreignKeys"] = {
        {{"fields", "attempt"}, {"reference", {{"resource", "attempts"}, {"fields", "attempt"}}}}};
  return {{"name", name},
          {"path", table.file},
          {"profile", "tabular-data-resource"},
          {"description", table.what},
          {"format", "csv"},
          {"mediatype", "text/csv"},
          {"encoding", "utf-8"},
          {"dialect",
           {{"delimiter", ","},
            {"lineTerminator", "\n"},
            {"quoteChar", "\""},
            {"doubleQuote", true},
            {"header", true}}},
          {"schema", std::move(schema)}};
}

}  // namespace

std::string data_package(const std::vector<std::string>& files) {
  Json package = {{"profile", "tabular-data-package"},
                  {"name", "seldinger-export"},
                  {"title", "Raw export of Seldinger: attempts at simulated punctures"},
                  {"description", "Training data; README.txt says what it is and is not."},
                  {"resources", Json::array()}};
  for (const TableInfo& table : raw_tables())
    if (std::find(files.begin(), files.end(), table.file) != files.end())
      package["resources"].push_back(resource_of(table));
  return package.dump(2) + "\n";
}

}  // namespace seldinger::reports
