#include "reports/export/sqlite_tables.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "casedb/database/disk.h"
#include "casedb/database/sqlite.h"
#include "reports/export/csv_line.h"
#include "reports/export/raw_tables.h"
#include "sim/base/check.h"

namespace seldinger::reports {
namespace {

namespace fs = std::filesystem;

std::string sql_type(const ColumnInfo& column) {
  if (column.type == "number") return "REAL";
  return column.type == "text" ? "TEXT" : "INTEGER";
}

// Quoted, since `case` is a word of SQL.
std::string create_table(const std::string& name, const std::vector<ColumnInfo>& columns) {
  std::string sql = "CREATE TABLE " + name + " (";
  for (const ColumnInfo& column : columns) {
    sql += (&column == columns.data() ? "" : ", ") + ("\"" + column.name + "\" ") + sql_type(column);
    if (column.missing.empty()) sql += " NOT NULL";
    if (column.type == "flag") sql += " CHECK (\"" + column.name + "\" IN (0, 1))";
    if (column.name != "attempt") continue;
    sql += name == "attempts" ? " PRIMARY KEY" : " REFERENCES attempts (attempt)";
  }
  return sql + ") STRICT";
}

casedb::Statement insertion(casedb::Sqlite& database, const std::string& name,
                            const std::vector<ColumnInfo>& columns) {
  std::string places;
  for (std::size_t i = 0; i < columns.size(); ++i) places += (i == 0 ? ":c" : ", :c") + std::to_string(i);
  return database.prepare("INSERT INTO " + name + " VALUES (" + places + ")");
}

template <typename Number>
Number number_in(const std::string& cell) {
  Number value{};
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  CHECK(error == std::errc() && end == cell.data() + cell.size());
  return value;
}

// A line, and what follows it while a quote is open.
bool next_record(std::istream& stream, std::string& record) {
  record.clear();
  std::string line;
  while (std::getline(stream, line)) {
    record += line + '\n';
    if (std::count(record.begin(), record.end(), '"') % 2 == 0) return true;
  }
  return false;
}

void fill(casedb::Statement& into, const std::vector<ColumnInfo>& columns, const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string line;
  std::vector<std::string> cells;
  CHECK(next_record(stream, line));  // the header
  while (next_record(stream, line)) {
    std::string_view rest = line;
    CHECK(next_csv_line(rest, cells) && cells.size() == columns.size());
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::string name = "c" + std::to_string(i);
      if (cells[i].empty())
        into.bind_null(name);
      else if (columns[i].type == "text")
        into.bind(name, cells[i]);
      else if (columns[i].type == "number")
        into.bind(name, number_in<double>(cells[i]));
      else
        into.bind(name, number_in<std::int64_t>(cells[i]));
    }
    into.run();
  }
}

// A table's one file, or those of its folder, by name.
std::vector<fs::path> files_of(const fs::path& folder, const std::string& file) {
  if (const std::size_t slash = file.find('/'); slash != std::string::npos) {
    std::vector<fs::path> all;
    if (fs::exists(folder / file.substr(0, slash)))
      for (const auto& entry : fs::directory_iterator(folder / file.substr(0, slash))) all.push_back(entry.path());
    std::sort(all.begin(), all.end());
    return all;
  }
  return fs::exists(folder / file) ? std::vector{folder / file} : std::vector<fs::path>{};
}

void write_table(casedb::Sqlite& database, const fs::path& folder, const TableInfo& table) {
  const std::string name = table.file.substr(0, table.file.find_first_of("./"));
  database.run(create_table(name, table.columns));
  casedb::Statement into = insertion(database, name, table.columns);
  for (const fs::path& file : files_of(folder, table.file)) fill(into, table.columns, file);
}

}  // namespace

void write_sqlite_tables(const fs::path& folder) {
  const fs::path file = folder / "export.sqlite";
  casedb::NewFile(file).keep_unsynced();  // its owner's alone, as every file of an export
  casedb::Sqlite database(file);
  database.run("BEGIN");
  for (const TableInfo& table : raw_tables()) write_table(database, folder, table);
  write_table(database, folder, dictionary_table());
  database.run("COMMIT");
}

}  // namespace seldinger::reports
