#include "casedb/database/digests.h"

#include <algorithm>
#include <unordered_map>

#include "casedb/database/tables.h"
#include "sim/base/check.h"
#include "sim/base/hash.h"

namespace seldinger::casedb {
namespace {

constexpr const char* kSchemaTable = "sqlite_schema";

// Every column in the table's order, but not the bytes that have a checksum: they would be read for nothing.
std::string every_row_of(Sqlite& database, const std::string& table) {
  if (table == kSchemaTable) return "SELECT name, type, tbl_name, sql FROM sqlite_schema WHERE sql IS NOT NULL";
  std::string columns;
  for (const std::string& column : columns_of(database, table)) {
    const bool elsewhere = table.ends_with("_chunk") && column == "data";
    columns += (columns.empty() ? "" : ", ") + (elsewhere ? "NULL AS " + column : column);
  }
  return "SELECT " + columns + " FROM " + table;
}

std::vector<std::string> tables_with_digests(Sqlite& database) {
  std::vector<std::string> tables = tables_of(database);
  std::erase_if(tables, [](const std::string& table) { return !has_digest(table); });
  tables.emplace_back(kSchemaTable);
  return tables;
}

std::uint64_t short_id(const std::string& id) {
  return base::hash_bytes(std::as_bytes(std::span(id)));
}

// Of one table. Ids by their hash first: an attempt has a hundred of them.
void compare(Sqlite& database, const std::string& table, std::map<DigestOf, std::uint64_t>& differences) {
  std::unordered_map<std::uint64_t, std::uint64_t> sums;
  const auto every_row = [&](const auto& use) {
    for (Statement rows = database.prepare(every_row_of(database, table)); rows.step();) {
      const auto [id, digest] = rows.digest(table);
      use(id, digest);
    }
  };
  const auto every_digest = [&](const auto& use) {
    Statement rows = database.prepare("SELECT of_id, sum FROM digest WHERE of_table = :table");
    for (rows.bind("table", table); rows.step();)
      use(rows.text("of_id"), static_cast<std::uint64_t>(rows.integer("sum")));
  };
  const auto add = [&](const std::string& id, std::uint64_t sum) { sums[short_id(id)] ^= sum; };
  every_row(add);
  every_digest(add);
  std::erase_if(sums, [](const auto& one) { return one.second == 0; });
  if (sums.empty()) return;
  const auto name = [&](const std::string& id, std::uint64_t) {
    if (const auto found = sums.find(short_id(id)); found != sums.end()) differences[{table, id}] = found->second;
  };
  every_row(name);
  every_digest(name);
}

// A column that was added with a default is left out of the rows that were there, and SQLite's hook tells of such a
// row as if it were null. Written anew, it is in them.
void complete_rows(Sqlite& database) {
  const Sqlite::Unguarded rows_that_do_not_change(database);
  for (const std::string& table : tables_of(database)) {
    Statement added = database.prepare(
        "SELECT name FROM pragma_table_info(:name) WHERE dflt_value IS NOT NULL ORDER BY cid DESC LIMIT 1");
    if (!added.bind("name", table).step()) continue;
    const std::string column = added.text("name");
    database.run("UPDATE " + table + " SET " + column + " = " + column);
  }
}

// What is printed of an id: ids, names of metrics and numbers, nothing that a person typed.
std::string printable(const std::string& id) {
  const bool plain =
      id.size() <= 120 && id.find_first_not_of("0123456789abcdefghijklmnopqrstuvwxyz_-/") == std::string::npos;
  return plain ? id : std::string("another");
}

}  // namespace

bool has_digests(Sqlite& database) {
  return database.integer("SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name = 'digest'") > 0;
}

std::map<DigestOf, std::uint64_t> digest_differences(Sqlite& database) {
  std::map<DigestOf, std::uint64_t> differences;
  if (!has_digests(database)) return differences;
  std::vector<std::string> tables = tables_with_digests(database);
  for (Statement rows = database.prepare("SELECT DISTINCT of_table AS name FROM digest"); rows.step();) {
    const std::string table = rows.text("name");
    if (std::ranges::find(tables, table) == tables.end()) differences[{table, ""}] = 1;  // there is no such table
  }
  for (const std::string& table : tables) compare(database, table, differences);
  return differences;
}

std::string in_words(const DigestOf& whose) {
  const auto& [table, id] = whose;
  const std::size_t slash = id.find('/');
  const std::string attempt = printable(id.substr(0, slash));
  if (slash != std::string::npos) {
    const std::string of = printable(id.substr(slash + 1));
    if (table == "metric_value") return "the value of " + of + " of attempt " + attempt;
    if (table == "attempt_step") return "the step " + of + " of attempt " + attempt;
    if (table == "attempt_condition") return "the condition " + of + " of attempt " + attempt;
  }
  if (table == kSchemaTable) return "the definition of " + printable(id);
  return "what " + printable(table) + " holds of " +
         (table == "programme_director" ? "a programme" : printable(id));
}

std::vector<base::Problem> damaged_values(Sqlite& database) {
  std::vector<base::Problem> problems;
  for (const auto& [whose, sum] : digest_differences(database))
    problems.push_back({"value_damaged", in_words(whose) + " is not what was stored"});
  return problems;
}

void renew_digests(Sqlite& database, const std::map<DigestOf, std::uint64_t>& differences) {
  CHECK(database.in_transaction());
  complete_rows(database);
  database.run("DELETE FROM digest");
  Statement insert = database.prepare("INSERT INTO digest (of_table, of_id, sum) VALUES (:of_table, :of_id, :sum)");
  for (const std::string& table : tables_with_digests(database)) {
    std::map<std::string, std::uint64_t> sums;
    for (const auto& [whose, difference] : differences)
      if (whose.first == table) sums[whose.second] = difference;
    for (Statement rows = database.prepare(every_row_of(database, table)); rows.step();) {
      const auto [id, digest] = rows.digest(table);
      sums[id] ^= digest;
    }
    for (const auto& [id, sum] : sums)
      insert.bind("of_table", table).bind("of_id", id).bind("sum", static_cast<std::int64_t>(sum)).run();
  }
  database.forget_changes();
}

void forget_digests(Sqlite& database, const std::string& id) {
  CHECK(database.in_transaction());
  database.write_digests();  // first what the rows' going takes away
  database.prepare("DELETE FROM digest WHERE of_id = :id OR of_id GLOB :id || '/*'").bind("id", id).run();
}

std::string rows_of_digest(Sqlite& database, const std::string& table) {
  const std::vector<std::string> columns = columns_of(database, table);
  return told_by_two(table) ? columns.at(0) + " || '/' || " + columns.at(1) + " = :id" : columns.at(0) + " = :id";
}

}  // namespace seldinger::casedb
