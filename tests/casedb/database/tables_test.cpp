// What travels with a case and what stays: every table of the schema is in one of the two lists.
#include "casedb/database/tables.h"

#include <algorithm>

#include "tests/casedb/library_samples.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

class TablesTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  Sqlite& database_ = library_.database();
};

TEST_F(TablesTest, EveryTableTravelsOrStays) {
  std::vector<std::string> listed;
  for (const TravellingTable& table : travelling_tables()) listed.emplace_back(table.name);
  for (const std::string_view table : staying_tables()) listed.emplace_back(table);
  std::ranges::sort(listed);
  EXPECT_EQ(tables_of(database_), listed) << "a new table is to be named in casedb/tables.cpp: does it leave the "
                                             "library with a case, or is it about people and what they did?";
}

TEST_F(TablesTest, WhatTravelsIsFoundByItsCase) {
  const std::string case_id = add_case(library_, sample_case());
  add_case(library_, sample_case());
  static_cast<void>(add_lesion(library_, case_id, sample_lesion()).value());
  for (const TravellingTable& table : travelling_tables()) {
    Statement rows = database_.prepare("SELECT count(*) AS n FROM " + std::string(table.name) + " WHERE " +
                                       std::string(table.of_case));
    ASSERT_TRUE(rows.bind("case_id", case_id).step()) << table.name;
    const std::map<std::string_view, int> known = {{"training_case", 1}, {"case_attribute", 3}, {"lesion", 1}};
    if (const auto expected = known.find(table.name); expected != known.end()) {
      EXPECT_EQ(rows.integer("n"), expected->second) << table.name;
    }
  }
}

// A column that refers to a person or an attempt is empty in a bundle, so it must be one that may be.
TEST_F(TablesTest, WhatTravelsNeedsNothingThatStays) {
  for (const TravellingTable& table : travelling_tables())
    for (const std::string& column : columns_to_staying_tables(database_, table.name)) {
      Statement about = database_.prepare(
          "SELECT \"notnull\" OR pk > 0 AS needed FROM pragma_table_info(:name) "
          "WHERE name = :column");
      ASSERT_TRUE(about.bind("name", table.name).bind("column", column).step());
      EXPECT_EQ(about.integer("needed"), 0) << table.name << "." << column;
    }
}

TEST_F(TablesTest, ChangingColumnsAreThere) {
  for (const TravellingTable& table : travelling_tables())
    for (const std::string_view column : table.changing)
      EXPECT_TRUE(std::ranges::count(columns_of(database_, table.name), column) == 1) << column;
}

// A file that a column names and the question does not ask for would be taken away as nobody's.
TEST_F(TablesTest, AssetIsUsedAsksEveryColumnThatNamesOne) {
  const std::string question =
      fixtures::whole_file(fixtures::source_dir() / "casedb" / "database" / "sql" / "asset_is_used.sql");
  ASSERT_GE(asset_columns(database_).size(), 5U);
  for (const AssetColumn& at : asset_columns(database_)) {
    EXPECT_NE(question.find(at.table), std::string::npos) << at.table;
    EXPECT_NE(question.find(at.column), std::string::npos) << at.table << "." << at.column;
  }
}

TEST_F(TablesTest, AssetsOfACaseAreItsFourFiles) {
  NewCase labelled = sample_case();
  labelled.labels = volume::LabelMap{std::vector<std::uint8_t>(9 * 7 * 5, 0), {"none"}};
  const std::string case_id = add_case(library_, labelled);
  EXPECT_EQ(assets_of_case(database_, case_id).size(), 4U);
  EXPECT_EQ(assets_named(database_), assets_of_case(database_, case_id));
  EXPECT_TRUE(assets_of_case(database_, std::string(36, '0')).empty());
}

}  // namespace
}  // namespace seldinger::casedb
