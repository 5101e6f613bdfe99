// The two databases of a library: migrations/schema.sql shows the sum of all steps, and the constraints hold.
#include <sstream>

#include "casedb/database/migrate.h"
#include "casedb/database/tables.h"
#include "tests/casedb/library_samples.h"
#include "tests/fixtures/places.h"

namespace seldinger::casedb {
namespace {

// What makes the tables, or all else.
std::string objects_of(Sqlite& database, bool tables) {
  std::string made;
  Statement objects = database.prepare(
      "SELECT sql FROM sqlite_schema WHERE sql IS NOT NULL AND (type = 'table') = :tables "
      "ORDER BY CASE type WHEN 'index' THEN 1 WHEN 'view' THEN 2 ELSE 3 END, name");
  objects.bind("tables", tables ? 1 : 0);
  while (objects.step()) made += "\n" + objects.text("sql") + ";\n";
  return made;
}

std::string rows_of(Sqlite& database) {
  std::string made;
  for (const std::string& table : tables_of(database)) {
    if (table == "digest") continue;  // made by whoever stores
    std::string values;
    for (const std::string& column : columns_of(database, table))
      values += (values.empty() ? "quote(" : " || ', ' || quote(") + column + ")";
    Statement rows = database.prepare("SELECT " + values + " AS said FROM " + table);
    while (rows.step()) made += "\nINSERT INTO " + table + " VALUES (" + rows.text("said") + ");\n";
  }
  return made;
}

std::string sum_of(Sqlite& database) {
  return "-- The sum of the numbered steps beside this file: what a new library is made of. Written by "
         "casedb_database_test.\n" +
         objects_of(database, true) + rows_of(database) + objects_of(database, false);
}

// Step by step, as older libraries come there.
std::string walked(const Schema& schema) {
  Sqlite database(":memory:", Sqlite::Mode::create);
  build(database, {schema.application_id, schema.steps}, newest_version(schema));
  return sum_of(database);
}

class SchemaTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder();
  Library library_ = open_library(folder_ / "library");
  Sqlite& database_ = library_.database();

  // The file is what the steps make, and what is made of the file is the same again.
  void expect_written(const Schema& schema, Sqlite& made_by_sum, const std::string& file) {
    const std::string sum = walked(schema);
    const auto put = folder_ / "schema.sql";
    std::ofstream(put, std::ios::binary) << sum;
    EXPECT_EQ(fixtures::whole_file(fixtures::source_dir() / file), sum)
        << file << " is not the sum of the migrations: copy " << put << " over it.";
    EXPECT_EQ(sum_of(made_by_sum), sum) << file;
    EXPECT_EQ(made_by_sum.integer("PRAGMA user_version"), newest_version(schema));
    EXPECT_EQ(made_by_sum.integer("PRAGMA application_id"), schema.application_id);
  }
  void refuse(const std::string& sql) {
    EXPECT_TRUE(refused_by_constraint([&] { database_.run(sql); })) << sql;
  }
};

TEST_F(SchemaTest, SchemaSqlIsTheSumOfTheMigrations) {
  expect_written(library_schema(), library_.database(), "migrations/schema.sql");
}

TEST_F(SchemaTest, SchemaSqlOfIdentitiesIsTheSumOfTheMigrations) {
  expect_written(identities_schema(), library_.identities(), "migrations/identities/schema.sql");
}

// A library as the first schema had it, with cases, attempts, recordings and scores, walks to the newest: nothing
// is lost, references hold, and what could not be changed still cannot.
TEST_F(SchemaTest, ALibraryOfTheFirstSchemaKeepsEverything) {
  const Schema newest = library_schema();
  const auto file = folder_ / "old.sqlite";
  const std::string case_id(36, 'c'), lesion_id(36, 'l');
  constexpr int kAttempts = 300;  // more than a page of each table
  {
    Sqlite old(file, Sqlite::Mode::create);
    ASSERT_TRUE(migrate(old, {newest.application_id, newest.steps.first(1)}).has_value());
    std::string matrix;
    for (int i = 0; i < 12; ++i) matrix += i % 5 == 0 ? ", 1" : ", 0";
    old.run("INSERT INTO training_case VALUES ('" + case_id + "', 'T', 'draft', 'import', 5, 3, 3, 3, 1, 1, 1" +
            matrix + ", -1000, 100, 3, '" + std::string(64, 'v') + "', '" + std::string(64, 's') + "', NULL)");
    old.run("INSERT INTO lesion VALUES ('" + lesion_id + "', '" + case_id + "', 1, 1, 1, 0.5, 20, 6)");
    for (int i = 0; i < kAttempts; ++i) {
      const std::string number = std::to_string(i);
      const std::string attempt_id = std::string(36 - number.size(), 'a') + number;
      old.run(
          "INSERT INTO attempt VALUES ('" + attempt_id + "', '" + case_id + "', '" + lesion_id +
          "', NULL, 'novice', -7, '0.1.0', 1, 'in_plane', 'access', 200, 0.36, 0, 3000, 22, 18, 4, 'mpr', 150.25, "
          "150, 30, " +
          number + ", 4.5, 'complete', 1, NULL)");
      old.run("INSERT INTO recording_chunk VALUES ('" + attempt_id + "', 0, -9, x'00ff')");
      old.run("INSERT INTO metric_value VALUES ('" + attempt_id + "', 'hit', 1, 0, 1.0, 'bool', '')");
    }
  }
  Sqlite database(file);
  // Steps that were stored before it was kept how they were done.
  constexpr std::size_t kBeforeHow = 12;
  ASSERT_TRUE(migrate(database, {newest.application_id, newest.steps.first(kBeforeHow)}).has_value());
  database.run("INSERT INTO attempt_step SELECT attempt_id, 'check_probe', 2, 0, 'done', 1.5, '' FROM attempt");
  const auto migrated = migrate(database, newest);
  ASSERT_TRUE(migrated.has_value()) << migrated.error().text;
  EXPECT_EQ(
      database.integer("SELECT count(*) FROM attempt_step WHERE state = 'done' AND t_s = 1.5 AND how IS NULL"),
      kAttempts)
      << "nobody guesses";
  EXPECT_EQ(
      database.integer("SELECT count(*) FROM attempt_summary WHERE picture_modality = 'mpr' AND seed = -7 AND "
                       "picture_depth_mm = 150.25 AND case_title = 'T'"),
      kAttempts);
  EXPECT_EQ(database.integer("SELECT count(*) FROM recording_chunk JOIN attempt USING (attempt_id)"), kAttempts);
  EXPECT_EQ(database.integer("SELECT count(*) FROM metric_value JOIN attempt USING (attempt_id)"), kAttempts);
  EXPECT_EQ(database.integer("SELECT count(*) FROM training_case WHERE modality = 'mpr' AND "
                             "patient_position = 'supine' AND subject = 'patient' AND classes_sha256 IS NULL"),
            1);
  EXPECT_EQ(database.integer("SELECT count(*) FROM attempt WHERE picture_probe IS NULL"), kAttempts);
  EXPECT_EQ(database.integer("SELECT count(*) FROM pragma_foreign_key_check"), 0);
  EXPECT_EQ(database.text("PRAGMA integrity_check"), "ok");
  for (const bool tables : {true, false})
    EXPECT_EQ(objects_of(database, tables), objects_of(library_.database(), tables)) << "as if made new";
  for (const char* change :
       {"UPDATE attempt SET seed = 1", "DELETE FROM attempt", "UPDATE metric_value SET value = 0",
        "UPDATE attempt SET picture_modality = 'us'", "UPDATE training_case SET modality = 'xray'",
        "UPDATE attempt_step SET how = 'shown'", "UPDATE training_case SET hu_min = 0",
        "UPDATE training_case SET classes_sha256 = volume_sha256", "DELETE FROM training_case"})
    EXPECT_TRUE(refused_by_constraint([&] { database.run(change); })) << change;
  EXPECT_TRUE(refused_by_constraint([&] {
    database.run("INSERT INTO recording_chunk VALUES ('" + std::string(36, 'x') + "', 0, 0, x'00')");
  })) << "references are looked at again";
  EXPECT_TRUE(std::filesystem::exists(file.string() + ".v1-backup"));
}

TEST_F(SchemaTest, EveryTableIsStrict) {
  for (Sqlite* database : {&library_.database(), &library_.identities()}) {
    EXPECT_EQ(database->integer("SELECT count(*) FROM pragma_table_list WHERE type = 'table' AND strict = 0 AND "
                                "name NOT LIKE 'sqlite_%'"),
              0);
    EXPECT_GT(database->integer("SELECT count(*) FROM pragma_table_list WHERE strict = 1"), 0);
  }
}

TEST_F(SchemaTest, NamesHaveNoPlaceInThePerformanceDatabase) {
  EXPECT_EQ(
      database_.integer("SELECT count(*) FROM sqlite_schema s, pragma_table_info(s.name) c WHERE "
                        "c.name IN ('name', 'login_name', 'username', 'email') AND s.name <> 'case_attribute'"),
      0);
}

TEST_F(SchemaTest, ForeignKeysAndChecksRefuse) {
  const std::string case_id = add_case(library_, sample_case());
  const std::string other_case = add_case(library_, sample_case());
  const std::string lesion_id = add_lesion(library_, case_id, sample_lesion()).value();
  const std::string attempt_id = add_attempt(library_, sample_attempt(case_id, lesion_id)).value();
  const std::string nobody(36, '0');
  const std::string lesion =
      "INSERT INTO lesion (lesion_id, case_id, center_x_lps_mm, center_y_lps_mm, center_z_lps_mm, radius_mm, hu, "
      "created_us) VALUES ";
  refuse("INSERT INTO account VALUES ('" + nobody + "', 'trainee', '$argon2id$x', 1, 0, 0)");
  refuse(lesion + "('" + nobody + "', '" + nobody + "', 0, 0, 0, 1, 0, 0)");
  refuse(lesion + "('" + nobody + "', '" + case_id + "', 0, 0, 0, 0, 0, 0)");            // radius 0
  refuse(lesion + "('" + nobody + "', '" + case_id + "', 'here', 0, 0, 1, 0, 0)");       // STRICT
  refuse("INSERT INTO case_attribute VALUES ('" + case_id + "', 9, 'modality', 'MR')");  // twice
  refuse("INSERT INTO recording_chunk VALUES ('" + nobody + "', 0, 0, x'00')");
  refuse("UPDATE training_case SET state = 'lost'");
  refuse("DELETE FROM training_case");
  database_.run("INSERT INTO person (person_id, pseudonym, created_us) VALUES ('" + nobody + "', 'P', 0)");
  refuse("INSERT INTO account VALUES ('" + nobody + "', 'king', '$argon2id$x', 1, 0, 0)");
  refuse("INSERT INTO account VALUES ('" + nobody + "', 'trainee', 'secret', 1, 0, 0)");
  refuse("INSERT INTO account VALUES ('" + nobody + "', 'trainee', '$argon2id$x', 2, 0, 0)");
  refuse("INSERT INTO attempt_step VALUES ('" + attempt_id + "', 'insert', 3, 0, 'done', 1.0, '', 'guessed')");
  const std::string metric = "INSERT INTO metric_value VALUES ('" + attempt_id + "', 'm', 1, 0, ";
  refuse(metric + "NULL, 'mm', '')");        // no value, no reason
  refuse(metric + "0.0, 'mm', 'no plan')");  // both
  refuse(metric + "9e999, 'mm', '')");       // infinite
  database_.run(metric + "NULL, 'mm', 'no plan')");
  EXPECT_EQ(database_.integer("SELECT count(*) FROM pragma_foreign_key_check"), 0);
}

TEST_F(SchemaTest, AnAttemptsLesionIsOneOfItsCase) {
  const std::string case_id = add_case(library_, sample_case());
  const std::string other_case = add_case(library_, sample_case());
  const std::string lesion_id = add_lesion(library_, case_id, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(case_id, lesion_id)).value());
  // The same row with another id and case, written past the store.
  database_.run("CREATE TEMP TABLE copy AS SELECT * FROM attempt; UPDATE copy SET attempt_id = '" +
                std::string(36, '1') + "', case_id = '" + other_case + "'");
  refuse("INSERT INTO attempt SELECT * FROM copy");
  database_.run("UPDATE copy SET case_id = '" + case_id + "'; INSERT INTO attempt SELECT * FROM copy");
}

TEST_F(SchemaTest, WhatHappenedCannotBeChanged) {
  const std::string case_id = add_case(library_, sample_case());
  const std::string lesion_id = add_lesion(library_, case_id, sample_lesion()).value();
  static_cast<void>(add_attempt(library_, sample_attempt(case_id, lesion_id)).value());
  for (const std::string table : {"attempt", "recording_chunk", "metric_value"}) {
    refuse("UPDATE " + table + " SET attempt_id = attempt_id");
    refuse("DELETE FROM " + table);
    refuse("INSERT OR REPLACE INTO " + table + " SELECT * FROM " + table);
  }
  refuse("UPDATE lesion SET radius_mm = radius_mm * 2");
  refuse("UPDATE training_case SET volume_sha256 = skin_sha256");
  refuse("UPDATE training_case SET lps_from_voxel_23 = 0");
  database_.run("UPDATE training_case SET title = 'B', state = 'published'");
  EXPECT_EQ(list_cases(library_).front().title, "B");
}

}  // namespace
}  // namespace seldinger::casedb
