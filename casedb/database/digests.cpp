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

constexpr int kKeysSince = 21;  // the schema of the library from which told_by_two() holds

// Names beside the library, whose schemas are counted apart, have one table with one key.
bool has_old_keys(Sqlite& database) {
  return database.integer("PRAGMA user_version") < kKeysSince;
}

bool was_told_by_two(std::string_view table) {
  return table == "metric_value" || table == "attempt_step" || table == "attempt_condition";
}

// Whose each row of a table is, with its digest.
template <typename Use>
void for_every_row(Sqlite& database, const std::string& table, const Use& use) {
  const bool old = has_old_keys(database) && table != kSchemaTable;
  const std::vector<std::string> columns = old ? columns_of(database, table) : std::vector<std::string>{};
  for (Statement rows = database.prepare(every_row_of(database, table)); rows.step();) {
    auto [id, digest] = rows.digest(table);
    if (old) {
      id = rows.text(columns.at(0));
      if (was_told_by_two(table)) id += '/' + rows.text(columns.at(1));
    }
    use(id, digest);
  }
}

std::uint64_t short_id(const std::string& id) {
  return base::hash_bytes(std::as_bytes(std::span(id)));
}

// Of one table. Ids by their hash first: there are many of them, and most hold.
void compare(Sqlite& database, const std::string& table, std::map<DigestOf, std::uint64_t>& differences) {
  std::unordered_map<std::uint64_t, std::uint64_t> sums;
  const auto every_row = [&](const auto& use) { for_every_row(database, table, use); };
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
  // Two places hold the table's name: damage to one of them does not hide what the digests tell.
  return database.integer(
             "SELECT (SELECT count(*) FROM sqlite_schema WHERE name = 'digest') + "
             "(SELECT count(*) FROM pragma_table_info('digest'))") > 0;
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
  if (table == kSchemaTable) return "the definition of " + printable(id);
  if (table == "metric_value") return "a value of attempt " + printable(id);
  if (table == "attempt_step") return "a step of attempt " + printable(id);
  if (table == "attempt_condition") return "a condition of attempt " + printable(id);
  // Of two the second: a person or an attempt. The first may be a programme, which somebody typed.
  if (told_by_two(table)) return "what " + table + " holds of " + printable(id.substr(id.rfind('/') + 1));
  return "what " + printable(table) + " holds of " + printable(id);
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
      if (whose.first == table) {
        const bool cut = was_told_by_two(table) && !has_old_keys(database);  // differences of before
        sums[cut ? whose.second.substr(0, whose.second.find('/')) : whose.second] ^= difference;
      }
    for_every_row(database, table, [&](const std::string& id, std::uint64_t digest) { sums[id] ^= digest; });
    for (const auto& [id, sum] : sums)
      if (sum != 0)
        insert.bind("of_table", table).bind("of_id", id).bind("sum", static_cast<std::int64_t>(sum)).run();
  }
  database.forget_changes();
}

void change_digest(Sqlite& database, const DigestOf& whose, std::uint64_t by) {
  CHECK(database.in_transaction());
  Statement change = database.prepare(
      "INSERT INTO digest (of_table, of_id, sum) VALUES (:of_table, :of_id, :sum) "
      "ON CONFLICT DO UPDATE SET sum = (sum | excluded.sum) - (sum & excluded.sum)");
  change.bind("of_table", whose.first).bind("of_id", whose.second);
  change.bind("sum", static_cast<std::int64_t>(by)).run();
  database.prepare("DELETE FROM digest WHERE of_table = :of_table AND of_id = :of_id AND sum = 0")
      .bind("of_table", whose.first)
      .bind("of_id", whose.second)
      .run();
}

void forget_if_gone(Sqlite& database, const DigestOf& whose) {
  CHECK(database.in_transaction());
  const auto& [table, id] = whose;
  Statement left =
      database.prepare("SELECT 1 FROM " + table + " WHERE " + rows_of_digest(database, table) + " LIMIT 1");
  if (left.bind("id", id).step()) return;
  database.prepare("DELETE FROM digest WHERE of_table = :of_table AND of_id = :of_id")
      .bind("of_table", table)
      .bind("of_id", id)
      .run();
}

void forget_digests(Sqlite& database, const std::string& id) {
  CHECK(database.in_transaction());
  database.write_digests();  // first what the rows' going takes away
  for (const std::string& table : tables_with_digests(database)) {
    if (table == kSchemaTable) continue;
    if (!told_by_two(table)) {
      forget_if_gone(database, {table, id});
      continue;
    }
    std::vector<std::string> ids;
    Statement rows = database.prepare(
        "SELECT of_id FROM digest WHERE of_table = :table AND (of_id GLOB :id || '/*' OR of_id GLOB '*/' || :id)");
    for (rows.bind("table", table).bind("id", id); rows.step();) ids.push_back(rows.text("of_id"));
    for (const std::string& both : ids) forget_if_gone(database, {table, both});
  }
}

std::string rows_of_digest(Sqlite& database, const std::string& table) {
  const std::vector<std::string> columns = columns_of(database, table);
  const bool two = has_old_keys(database) ? was_told_by_two(table) : told_by_two(table);
  if (!two) return columns.at(0) + " = :id";
  // Each for itself, so that an index serves. Of the old keys the first is an id, of today's the second: of 36
  // letters.
  const std::string cut = was_told_by_two(table) ? "37" : "length(:id) - 36";
  return columns.at(0) + " = substr(:id, 1, " + cut + " - 1) AND " + columns.at(1) + " = substr(:id, " + cut +
         " + 1)";
}

}  // namespace seldinger::casedb
