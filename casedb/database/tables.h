// What the tables hold, asked of the database itself, so that a column of a later migration is not forgotten: which
// tables leave the library with a case, which never do, and which columns name files of assets/.
#pragma once

#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casedb/database/sqlite.h"

namespace seldinger::casedb {

// A table whose rows travel in a bundle.
struct TravellingTable {
  std::string_view name;
  std::string_view of_case;  // the condition of one case's rows, with :case_id
  // Columns that may change after a case was made: two cases that differ there only are the same.
  std::span<const std::string_view> changing;
};

// Every table of the library's database is in one of the two; a test compares with the schema. What is said of
// people and what people did stays.
std::span<const TravellingTable> travelling_tables();
std::span<const std::string_view> staying_tables();

std::vector<std::string> tables_of(Sqlite& database);
std::vector<std::string> columns_of(Sqlite& database, std::string_view table);  // in the table's order
// Columns that refer to a table that stays: they are empty in a bundle.
std::set<std::string> columns_to_staying_tables(Sqlite& database, std::string_view table);

// A column whose values are keys of another table's rows.
struct Reference {
  std::string table, column;
};
std::vector<Reference> references_to(Sqlite& database, const std::string& table);

struct AssetColumn {
  std::string table, column;
};
// Columns whose name ends in _sha256: by that they name files of assets/, in every table.
std::vector<AssetColumn> asset_columns(Sqlite& database);
std::set<std::string> assets_named(Sqlite& database);
std::set<std::string> assets_of_case(Sqlite& database, const std::string& case_id);

}  // namespace seldinger::casedb
