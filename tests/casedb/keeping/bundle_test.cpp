// A case goes from one library to another and is the same there; nothing of people goes with it, and what is not
// whole is not taken.
#include "casedb/keeping/bundle.h"

#include <algorithm>

#include "casedb/cases/authoring.h"
#include "casedb/cases/bundle_rows.h"
#include "casedb/database/migrate.h"
#include "casedb/database/tables.h"
#include "casedb/keeping/check.h"
#include "casedb/people/people.h"
#include "tests/casedb/keeping/bundle_fixture.h"

namespace seldinger::casedb {
namespace {

namespace fs = std::filesystem;

TEST_F(BundleTest, ACaseIsTheSameElsewhere) {
  write();
  const Bundle told = check_bundle(file_).value();
  EXPECT_EQ(told.case_ids, std::vector{case_id_});
  EXPECT_EQ(told.assets, 4U);
  EXPECT_EQ(told.schema, newest_version(library_schema()));
  EXPECT_EQ(told.program_version, "0.1.0");
  EXPECT_EQ(told.bytes, fs::file_size(file_));
  EXPECT_EQ(import_bundle(away_, file_).value().stored, std::vector{case_id_});
  const CaseRow row = find_case(away_, case_id_).value(), original = find_case(home_, case_id_).value();
  EXPECT_EQ(row.title, "Kidney A");
  EXPECT_EQ(row.state, CaseState::draft);
  EXPECT_EQ(row.created_us, original.created_us);
  EXPECT_EQ(row.attributes, original.attributes);
  EXPECT_EQ(row.warnings.size(), 2U);
  EXPECT_EQ(load_volume(away_, row).value().hu, sample_volume().hu);
  EXPECT_EQ(load_skin(away_, row).value().triangles, sample_mesh().triangles);
  EXPECT_EQ(load_labels(away_, row).value().label, sample_labels().label);
  EXPECT_EQ(load_classes(away_, row).value(), load_classes(home_, original).value());
  const LesionRow lesion = list_lesions(away_, case_id_).at(0);
  EXPECT_EQ(lesion.lesion_id, lesion_id_);
  ASSERT_EQ(list_structures(away_, case_id_).size(), 1U);
  EXPECT_EQ(list_structures(away_, case_id_)[0].name, "vein");
  EXPECT_TRUE(same_bits(lesion.lesion.center_lps_mm, sample_lesion().center_lps_mm));
  EXPECT_EQ(bytes_from_rows(away_.database(), case_id_), bytes_from_rows(home_.database(), case_id_));
  EXPECT_TRUE(check_library(away_.folder(), false).value().holds());
}

TEST_F(BundleTest, TheSameLibraryGivesTheSameBytes) {
  write();
  const std::string first = fixtures::whole_file(file_);
  write();
  EXPECT_EQ(fixtures::whole_file(file_), first);
}

TEST_F(BundleTest, ACaseThatIsThereAlreadyIsLeftAlone) {
  write();
  ASSERT_EQ(refusal(), "none");
  // What people here may do with a case does not make it another.
  static_cast<void>(add_lesion(away_, case_id_, sample_lesion()).value());
  away_.database().run("UPDATE training_case SET title = 'Ours', state = 'retired'");
  const auto before = state_of(away_);
  const auto again = import_bundle(away_, file_).value();
  EXPECT_TRUE(again.stored.empty());
  EXPECT_EQ(again.present, std::vector{case_id_});
  EXPECT_EQ(state_of(away_), before);
}

TEST_F(BundleTest, ACaseWithOtherContentIsRefused) {
  write();
  ASSERT_EQ(refusal(), "none");
  static_cast<void>(add_lesion(home_, case_id_, {sample_lesion().center_lps_mm, 0.5, 30.0}).value());
  write();
  const auto before = state_of(away_);
  EXPECT_EQ(refusal(), "case_differs");
  EXPECT_EQ(state_of(away_), before);
}

// No person, account, attempt, recording or score, whatever else is in the library.
TEST_F(BundleTest, NothingOfPeopleIsInIt) {
  const std::string person_id = add_user(home_, "Jane Doe", Role::trainee, "a secret of Jane").value();
  NewAttempt attempt = sample_attempt(case_id_, lesion_id_);
  attempt.person_id = person_id;
  attempt.operator_name = kPersonOperator;
  const std::string attempt_id = add_attempt(home_, attempt).value();
  ASSERT_TRUE(write_bundle(home_, {}, file_, "0.1.0").has_value());
  const std::vector<std::byte> rows = bytes_from_rows(home_.database(), case_id_);
  const std::string pseudonym = home_.database().text("SELECT pseudonym FROM person");
  for (const std::string& text :
       {fixtures::whole_file(file_), std::string(reinterpret_cast<const char*>(rows.data()), rows.size())})
    for (const std::string& secret :
         {std::string("Jane"), std::string("argon2id"), person_id, attempt_id, pseudonym})
      EXPECT_EQ(text.find(secret), std::string::npos) << secret;
  EXPECT_EQ(check_bundle(file_).value().assets, 4U);  // not the attempt's picture
  ASSERT_EQ(refusal(), "none");
  for (const std::string_view table : staying_tables()) {
    if (!has_digest(table) || table.starts_with("audit")) continue;  // digests: those of the case
    EXPECT_EQ(away_.database().integer("SELECT count(*) FROM " + std::string(table)),
              table == "case_received" ? 1 : 0)
        << table;
  }
  // Of the log only that the case came in here.
  EXPECT_EQ(away_.database().integer("SELECT count(*) FROM audit"), 1);
  EXPECT_EQ(away_.database().text("SELECT act || actor FROM audit"), "import_casesoperator");
}

TEST_F(BundleTest, AWholeLibraryGoesWithAllItsCases) {
  for (std::uint64_t i = 0; i < 4; ++i) {
    NewCase sample = sample_case("Case " + std::to_string(i));
    sample.volume = sample_volume({9, 7, 5}, i / 2);  // two cases share a file
    add_case(home_, sample);
  }
  ASSERT_TRUE(write_bundle(home_, {}, file_, "0.1.0").has_value());
  EXPECT_EQ(import_bundle(away_, file_).value().stored.size(), 5U);
  EXPECT_EQ(list_cases(away_).size(), 5U);
  EXPECT_TRUE(check_library(away_.folder(), false).value().holds());
  static_cast<void>(add_case(home_, sample_case("New")));
  ASSERT_TRUE(write_bundle(home_, {}, file_, "0.1.0").has_value());
  const auto cases = import_bundle(away_, file_).value();
  EXPECT_EQ(cases.stored.size(), 1U);
  EXPECT_EQ(cases.present.size(), 5U);
}

TEST_F(BundleTest, WhatIsNotThereCannotBeWritten) {
  EXPECT_EQ(write_bundle(home_, {std::string(36, '0')}, file_, "0.1.0").error().code, "no_case");
  EXPECT_EQ(write_bundle(away_, {}, file_, "0.1.0").error().code, "no_case");
  const std::string name = find_case(home_, case_id_).value().skin_sha256;
  std::ofstream(scratch_ / "home" / "assets" / name, std::ios::app) << "x";
  EXPECT_EQ(write_bundle(home_, {case_id_}, file_, "0.1.0").error().code, "asset_damaged");
  fs::remove(scratch_ / "home" / "assets" / name);
  EXPECT_EQ(write_bundle(home_, {case_id_}, file_, "0.1.0").error().code, "asset_missing");
  EXPECT_EQ(std::distance(fs::directory_iterator(scratch_), {}), 2);  // the two libraries
}

TEST_F(BundleTest, ANewerSchemaOrFormatIsRefused) {
  write();
  const auto before = state_of(away_);
  Parts parts = parts_of(file_);
  replace(parts.list, "schema " + std::to_string(newest_version(library_schema())), "schema 9999");
  put(file_, parts);
  EXPECT_EQ(refusal(), "newer_schema");
  write();
  std::string bytes = fixtures::whole_file(file_);
  bytes[8] = 3;
  std::ofstream(file_, std::ios::binary) << bytes;
  EXPECT_EQ(refusal(), "bundle_version");
  std::ofstream(file_, std::ios::binary)
      << "SDBUNDLX and more of it than a header has, so that it is not only short "
         "but another thing altogether";
  EXPECT_EQ(refusal(), "not_a_bundle");
  EXPECT_EQ(import_bundle(away_, scratch_).error().code, "not_found");
  EXPECT_EQ(state_of(away_), before);
}

TEST_F(BundleTest, AnyTruncationAndTrailingBytesAreRefused) {
  write();
  const auto before = state_of(away_);
  const std::string good = fixtures::whole_file(file_);
  for (std::size_t size = 0; size < good.size(); size += size < 700 ? 1 : 37) {
    std::ofstream(file_, std::ios::binary) << good.substr(0, size);
    const std::string code = refusal();
    ASSERT_TRUE(code == "damaged" || code == "not_a_bundle") << size << " " << code;
  }
  for (const std::string& more : {std::string("x"), std::string(100'000, '\0'), good}) {
    std::ofstream(file_, std::ios::binary) << good << more;
    EXPECT_EQ(refusal(), "damaged");
  }
  EXPECT_EQ(state_of(away_), before);
}

// Lists whose own hash is right.
TEST_F(BundleTest, AListThatPlaysTricksIsRefused) {
  write();
  const auto before = state_of(away_);
  const Parts good = parts_of(file_);
  const std::string asset = good.list.substr(good.list.find("asset "));
  const std::string hash(64, 'a');
  for (const std::string& more :
       {std::string("asset 0 ../../x\n"), std::string("asset 0 /etc/passwd\n"), std::string("asset 0 "),
        "asset 0 " + hash + "\n",                     // a file that nobody needs
        "asset 18446744073709551615 " + hash + "\n",  // sizes that wrap
        "asset -1 " + hash + "\n", "asset 00 " + hash + "\n", asset.substr(0, asset.find('\n') + 1),  // twice
        std::string("schema 4\n"), std::string("case x 1 1 ") + hash + "\n", std::string("\n"),
        std::string("link a b\n")}) {
    Parts parts = good;
    parts.list += more;
    put(file_, parts);
    EXPECT_EQ(refusal(), "damaged") << more;
  }
  EXPECT_EQ(state_of(away_), before);
}

// Whoever can compute a SHA-256 can make a bundle: what is in it is looked at too.
TEST_F(BundleTest, FilesThatAreNotWhatTheCaseSaysAreRefused) {
  write();
  const Parts good = parts_of(file_);
  const CaseRow row = find_case(home_, case_id_).value();
  volume::Volume other = sample_volume();
  other.hu[0] = static_cast<std::int16_t>(other.hu[0] == 100 ? 101 : 100);
  other.spacing_mm.x = 0.71;
  for (const auto& [sha256, bytes] : {std::pair(row.volume_sha256, std::vector<std::byte>(100)),
                                      {row.volume_sha256, {}},
                                      {row.volume_sha256, volume::bytes_from_volume(other)},
                                      {row.volume_sha256, volume::bytes_from_volume(sample_volume({9, 7, 6}))},
                                      {row.skin_sha256, std::vector<std::byte>(100)},
                                      {row.skin_sha256, volume::bytes_from_volume(sample_volume())},
                                      {row.labels_sha256, std::vector<std::byte>(100)},
                                      {row.classes_sha256, std::vector<std::byte>(100)}}) {
    Parts parts = good;
    swap_asset(parts, sha256, bytes);
    put(file_, parts);
    EXPECT_EQ(refusal(), "damaged");
  }
  put(file_, good);
  EXPECT_EQ(refusal(), "none");  // the tools of this test do not break it themselves
}

TEST_F(BundleTest, RowsThatTheSchemaRefusesAreRefused) {
  publish();
  write();
  const auto before = state_of(away_);
  const Parts good = parts_of(file_);
  const std::string rows = good.rows.at(0);
  std::vector<std::string> bad;
  const auto changed = [&](const std::string& from, const std::string& to) {
    std::string text = rows;
    replace(text, from, to);
    bad.push_back(text);
  };
  changed("published", "punished!");          // a CHECK
  changed("training_case", "training_cast");  // no such table
  changed("case_attribute", "metric_value__");
  changed("radius_mm", "radius_cm");
  changed("import", "impor\xff");  // no UTF-8
  changed("import", std::string("impor\0", 6));
  bad.push_back(rows + "x");
  bad.push_back(rows.substr(0, rows.size() - 1));
  bad.push_back("");
  {
    std::string text = rows;  // the lesion belongs to another case
    const std::size_t lesion = text.find(lesion_id_);
    text.replace(text.find(case_id_, lesion), 36, std::string(36, '3'));
    bad.push_back(text);
  }
  for (std::size_t i = 0; i < bad.size(); ++i) {
    Parts parts = good;
    parts.rows[0] = bad[i];
    put(file_, parts);
    EXPECT_EQ(refusal(), i == 3 ? "bundle_values" : "damaged") << i;  // a sphere without its radius
  }
  EXPECT_EQ(state_of(away_), before);
}

// A table of people is not taken, whatever its rows.
TEST_F(BundleTest, RowsOfTablesThatStayAreRefused) {
  write();
  const Parts good = parts_of(file_);
  for (const std::string_view table : staying_tables()) {
    Parts parts = good;
    std::string& rows = parts.rows[0];
    std::uint32_t count = 0;
    std::memcpy(&count, rows.data(), sizeof count);
    ++count;
    std::memcpy(rows.data(), &count, sizeof count);
    const auto number = [](std::uint32_t value) {
      return std::string(reinterpret_cast<const char*>(&value), sizeof value);
    };
    const std::string column = "person_id";
    rows += number(static_cast<std::uint32_t>(table.size())) + std::string(table) + number(1) +
            number(static_cast<std::uint32_t>(column.size())) + column + number(0);
    put(file_, parts);
    EXPECT_EQ(refusal(), "damaged") << table;
  }
}

// Bombs: much from little, and lies about how much.
TEST_F(BundleTest, BombsAreRefused) {
  write();
  const auto before = state_of(away_);
  const Parts good = parts_of(file_);
  {
    Parts parts = good;
    parts.rows[0] = std::string(std::size_t{100} << 20, '\0');
    put(file_, parts);
    EXPECT_EQ(refusal(), "damaged");
  }
  {
    Parts parts = good;  // the rows say less than they are
    put(file_, parts);
    Parts lying = parts_of(file_);
    replace(lying.list, " " + std::to_string(good.rows[0].size()) + " ", " 17 ");
    put_as_listed(file_, lying);
    EXPECT_EQ(refusal(), "damaged");
  }
  {
    // 67 million voxels of nothing, in some 10 KB, and a case that says so.
    NewCase empty = sample_case();
    empty.volume = volume::make_volume({1024, 1024, 64}, {1, 1, 1}, glm::dmat3(1.0), {0, 0, 0});
    std::fill(empty.volume.hu.begin(), empty.volume.hu.end(), std::int16_t{0});
    const std::string id = add_case(home_, empty);
    ASSERT_TRUE(write_bundle(home_, {id}, file_, "0.1.0").has_value());
    EXPECT_EQ(refusal(), "too_large");
  }
  EXPECT_EQ(state_of(away_), before);
}

// Rows of every released schema walk the migrations before they are stored. Beside a sanitizer, where each takes
// many times as long, of every sixth.
#ifdef __SANITIZE_ADDRESS__
constexpr int kSchemaStep = 6;
#else
constexpr int kSchemaStep = 1;
#endif

TEST_F(BundleTest, RowsOfOlderSchemasAreTaken) {
  write();
  // Of laws that they knew.
  home_.database().run("DROP TRIGGER training_case_keeps_its_sight_law");
  home_.database().run("DROP TRIGGER training_case_keeps_its_touch");
  home_.database().run("DROP TRIGGER training_case_keeps_its_motion");
  home_.database().run(
      "UPDATE training_case SET sight_law = 'echo', touch_law = 'steady', breath_law = 'equal_holds'");
  const Parts good = parts_of(file_);
  const Schema newest = library_schema();
  for (int version = 1; version <= newest_version(newest); version += kSchemaStep) {
    Library target = open_library(scratch_ / ("schema" + std::to_string(version)));
    Sqlite old(":memory:", Sqlite::Mode::create);
    build(old, newest, version);
    copy_common_columns(home_.database(), old);
    const std::vector<std::byte> rows = bytes_from_rows(old, case_id_);
    Parts parts = good;
    parts.rows[0] = std::string(reinterpret_cast<const char*>(rows.data()), rows.size());
    replace(parts.list, "schema " + std::to_string(newest_version(newest)), "schema " + std::to_string(version));
    const auto used = assets_of_case(old, case_id_);
    for (const auto& [name, bytes] : good.assets)
      if (!used.contains(name)) drop_asset(parts, name);
    put(file_, parts);
    const auto cases = import_bundle(target, file_);
    ASSERT_TRUE(cases.has_value()) << "schema " << version << ": " << cases.error().text;
    EXPECT_EQ(find_case(target, case_id_).value().title, "Kidney A");
    EXPECT_TRUE(load_classes(target, find_case(target, case_id_).value()).has_value());
    EXPECT_TRUE(check_library(target.folder(), false).value().holds());
  }
}

}  // namespace
}  // namespace seldinger::casedb
