// Every column of every table that a bundle holds, with values that no command stores, one at a time: refused with
// a code, or harmless to all that looks at the case afterwards.
#include <gtest/gtest.h>

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <span>

#include "casedb/cases/bundle_rows.h"
#include "casedb/cases/case_rows.h"
#include "casedb/database/migrate.h"
#include "casedb/database/tables.h"
#include "casedb/json/case_json.h"
#include "casedb/keeping/bundle.h"
#include "session/case/case_build.h"
#include "session/case/case_check.h"
#include "sim/imaging/mpr/mpr.h"
#include "tests/casedb/bundle_samples.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/new_ball.h"

namespace seldinger::session {
namespace {

#ifdef __SANITIZE_ADDRESS__  // where each takes ten times as long
constexpr std::size_t kOneOf = 12;
#else
constexpr std::size_t kOneOf = 3;
#endif

namespace fs = std::filesystem;

constexpr double kStandIn = 1234.567890123;  // for a NaN, which SQL cannot say

// What looks at a case: its check, its JSON, the scene of an attempt at each target, a picture of it.
void look_at(casedb::Library& library, const std::string& case_id) {
  static_cast<void>(check_case(library, case_id));
  const casedb::CaseParts parts = casedb::load_parts(library, case_id).value();
  auto json = nlohmann::ordered_json::object();
  casedb::add_authoring(parts, json);
  for (const casedb::LesionRow& lesion : parts.lesions) json["lesions"].push_back(casedb::json_of_lesion(lesion));
  ASSERT_FALSE(json.dump().empty());
  for (const casedb::LesionRow& lesion : std::span(parts.lesions).first(1)) {  // the others are painted with it
    const auto scene = build_case(library, parts.row, lesion.form, {}, Needs::ultrasound);
    if (!scene) continue;
    imaging::MprView view;
    view.center_lps_mm = lesion.form.center_lps_mm;
    view.width_px = view.height_px = 8;
    ASSERT_EQ(imaging::mpr_cpu(scene->volume, view, {std::nullopt, scene->lesions}).size(), 64U);
  }
}

class BundledValues : public testing::Test {
 protected:
  fs::path scratch_ = fixtures::fresh_test_folder("session");
  fs::path file_ = scratch_ / "a.sdbundle";
  casedb::Library home_ = std::move(casedb::Library::open_or_create(scratch_ / "home").value());
  casedb::Library away_ = std::move(casedb::Library::open_or_create(scratch_ / "away").value());
  std::string case_id_;
  casedb::Parts good_;
  casedb::RowsReader reader_{casedb::newest_version(casedb::library_schema())};
  int refused_ = 0, taken_ = 0;

  void SetUp() override {
    fixtures::Ball ball;
    ball.voxels = 20;
    ball.voxel_mm = 6.0;
    ball.skin_levels = 1;
    casedb::NewCase made = fixtures::new_ball(ball);
    made.attributes = {{"modality", "CT"}};
    made.warnings = {{"single_slice", "one slice only"}};
    made.dropped = {{"0010,0010", "PatientName", "not_on_the_list", 3}};
    made.prepared = {{.denoise = 2.0}, made.volume};
    case_id_ = casedb::add_case(home_, made);
    add_authored(ball);
    ASSERT_TRUE(casedb::write_bundle(home_, {case_id_}, file_, "0.1.0").has_value());
    good_ = casedb::parts_of(file_);
    std::vector<std::string> triggers;
    for (auto rows = home_.database().prepare("SELECT name FROM sqlite_schema WHERE type = 'trigger'");
         rows.step();)
      triggers.push_back(rows.text("name"));
    for (const std::string& name : triggers) home_.database().run("DROP TRIGGER " + name);
    home_.database().run("PRAGMA ignore_check_constraints = ON; PRAGMA foreign_keys = OFF");
  }
  void add_authored(const fixtures::Ball& ball) {
    for (const auto kind :
         {cases::LesionOutline::sphere, cases::LesionOutline::ellipsoid, cases::LesionOutline::irregular}) {
      cases::LesionForm form;
      form.outline = kind;
      form.center_lps_mm = {0.0, -20.0, 0.0};
      form.radii_mm = kind == cases::LesionOutline::ellipsoid ? glm::dvec3(6, 7, 8) : glm::dvec3(6);
      form.roughness = kind == cases::LesionOutline::irregular ? 0.1 : 0.0;
      ASSERT_TRUE(casedb::add_lesion(home_, case_id_, form).has_value());
    }
    volume::LabelMap labels{std::vector<std::uint8_t>(20 * 20 * 20, 0), {"none", "kidney"}};
    labels.label[4210] = 1;
    casedb::StructureRow one;
    one.case_id = case_id_;
    one.kind = casedb::StructureKind::label;
    one.labels_sha256 = casedb::add_label_map(home_, case_id_, labels).value();
    one.label = 1;
    one.name = "kidney";
    ASSERT_TRUE(casedb::add_structure(home_, one).has_value());
    one.kind = casedb::StructureKind::tissue_class;
    one.name = "soft";
    one.tissue = casedb::load_classes(home_, casedb::find_case(home_, case_id_).value()).value()[4210];
    ASSERT_TRUE(casedb::add_structure(home_, one).has_value());
    one.kind = casedb::StructureKind::drawn;
    one.name = "vein";
    one.drawn = cases::Tube{{{-0.3 * ball.radius_mm, 10, 0}, {20, 10, 0}}, 3.0};
    one.hu = 43.0;
    ASSERT_TRUE(casedb::add_structure(home_, one).has_value());
  }
  // The case's rows with one value changed; with a NaN where the stand-in was put.
  std::string rows_with(const std::string& update, bool nan) {
    casedb::Sqlite& database = home_.database();
    database.run("SAVEPOINT one");
    database.run(update);
    std::string rows = casedb::text_of(casedb::bytes_from_rows(database, case_id_));
    database.run("ROLLBACK TO one; RELEASE one");
    if (nan) {
      const double from = kStandIn, to = std::nan("");
      std::string was(sizeof from, '\0'), now(sizeof to, '\0');
      std::memcpy(was.data(), &from, sizeof from);
      std::memcpy(now.data(), &to, sizeof to);
      casedb::replace(rows, was, now);
    }
    return rows;
  }
  void try_rows(const std::string& rows, const std::string& what) {
    SCOPED_TRACE(what);
    static const std::set<std::string> known = {"damaged", "bundle_values", "too_large", "case_differs"};
    const auto read = reader_.read(casedb::bytes_of(rows), case_id_);
    if (!read) {
      EXPECT_TRUE(known.contains(read.error().code)) << read.error().code;
      ++refused_;
      return;
    }
    casedb::Parts parts = good_;
    parts.rows[0] = rows;
    casedb::put(file_, parts);
    const auto cases = casedb::import_bundle(away_, file_);
    if (!cases) {
      EXPECT_TRUE(known.contains(cases.error().code)) << cases.error().code;
      ++refused_;
      return;
    }
    ++taken_;
    look_at(away_, case_id_);
    remove_case(away_.database());
  }
  // Texts that are taken are shown and no more: one of a column is looked at.
  bool is_seen_enough(const std::string& type, int taken_before) const {
    return type == "TEXT" && taken_ > taken_before;
  }
  void remove_case(casedb::Sqlite& database) {
    casedb::Transaction transaction(database);
    database.run(
        "PRAGMA defer_foreign_keys = ON; UPDATE training_case SET state = 'retired'; "
        "INSERT INTO erasing (id) SELECT case_id FROM training_case");
    for (const char* table : {"case_attribute", "case_warning", "case_dropped", "lesion", "structure",
                              "case_label_map", "case_preparation", "case_received", "training_case", "erasing"})
      database.run(std::string("DELETE FROM ") + table);
    transaction.commit();
  }
};

std::vector<std::string> values_for(const std::string& type) {
  if (type == "REAL")
    return {"1e308", "-1e308", "1e155", "-1e155", "1e154", "9e999", "-9e999", "-1.0", "0.0", "5e-324", "1e9"};
  if (type == "INTEGER")
    return {"-1",
            "0",
            "2147483647",
            "2147483648",
            "-2147483649",
            "9007199254740993",
            "9223372036854775807",
            "-9223372036854775807 - 1"};
  return {"printf('%.5000c', 'x')",
          "printf('%.200000c', '[')",
          "printf('%.36c', '/')",
          "printf('%.36c', '''')",
          "'../../../../../../../../../etc/passwd'",
          "'two' || char(10) || 'lines'",
          "'{\"kind\":\"sphere\",\"center_mm\":[1e308,0,0],\"radius_mm\":1e308}'",
          "'{\"kind\":\"tube\",\"points_mm\":[[0,0,0],[1e300,0,0]],\"radius_mm\":5}'",
          "'{\"criteria\":[{\"metric\":\"hit\",\"comparison\":\">=\",\"value\":1e308}]}'",
          "''",
          "'x'"};
}

// A lesion's centre of ±1e155 was taken and ended `case check` and the server (SIGSEGV); a position beyond 32 bits
// ended the import itself (a CHECK); an added label map of another size was taken.
TEST_F(BundledValues, EachIsRefusedOrHarmless) {
  casedb::Sqlite& database = home_.database();
  int columns = 0;
  for (const casedb::TravellingTable& table : casedb::travelling_tables()) {
    const std::string name(table.name);
    std::vector<std::int64_t> rows;
    for (auto row = database.prepare("SELECT rowid AS id FROM " + name); row.step();)
      rows.push_back(row.integer("id"));
    ASSERT_FALSE(rows.empty()) << name;
    std::vector<std::pair<std::string, std::string>> types;
    auto about = database.prepare("SELECT name, type FROM pragma_table_info(:name)");
    for (about.bind("name", name); about.step();) types.emplace_back(about.text("name"), about.text("type"));
    for (const auto& [column, type] : types) {
      ++columns;
      for (const std::int64_t row : rows) {
        const auto set = [&](const std::string& value) {
          return "UPDATE " + name + " SET " + column + " = " + value + " WHERE rowid = " + std::to_string(row);
        };
        auto values = values_for(type);
        values.insert(values.begin(), "NULL");
        if (std::getenv("SELDINGER_FUZZ") == nullptr)  // NOLINT: one of kOneOf, another in each column
          for (std::size_t at = values.size(); at-- > 0;)
            if (at % kOneOf != static_cast<std::size_t>(columns) % kOneOf)
              values.erase(values.begin() + static_cast<long>(at));
        const int taken_before = taken_;
        for (const std::string& value : values) {
          if (is_seen_enough(type, taken_before)) break;
          std::string rows_bytes;
          try {
            rows_bytes = rows_with(set(value), false);
          } catch (const base::Failure&) {  // not even SQLite takes it
            database.run("ROLLBACK TO one; RELEASE one");
            continue;
          }
          try_rows(rows_bytes, set(value));
          if (HasFatalFailure()) return;
        }
        if (type == "REAL") try_rows(rows_with(set("1234.567890123"), true), set("NaN"));
      }
    }
  }
  EXPECT_GT(columns, 100);
  EXPECT_GT(refused_, taken_);
  RecordProperty("refused", refused_);
  RecordProperty("taken", taken_);
  try_rows(good_.rows[0], "as it was");
  EXPECT_GT(taken_, 0);
}

// The lesions of the review, each told.
TEST_F(BundledValues, NoLesionOutsideItsBoundsIsTaken) {
  for (const char* column : {"center_x_lps_mm", "center_y_lps_mm", "center_z_lps_mm", "radius_mm", "hu"})
    for (const char* value : {"1e308", "-1e308", "1e155", "-1e155", "9e999", "-9e999"}) {
      const std::string update = std::string("UPDATE lesion SET ") + column + " = " + value;
      const auto read = reader_.read(casedb::bytes_of(rows_with(update, false)), case_id_);
      ASSERT_FALSE(read.has_value()) << update;  // 19 of 20 were taken
      EXPECT_TRUE(read.error().code == "bundle_values" || read.error().code == "damaged") << update;
    }
}

// Files that are sound by themselves and not this case's.
TEST_F(BundledValues, FilesThatDoNotFitAreRefusedOrHarmless) {
  const casedb::CaseRow row = casedb::find_case(home_, case_id_).value();
  const std::string added = casedb::load_label_maps(home_, row).value().at(0).sha256;
  cases::Mesh far = casedb::load_skin(home_, row).value();
  for (glm::vec3& vertex : far.vertices_lps_mm) vertex *= 1e4F;
  volume::LabelMap small{std::vector<std::uint8_t>(7, 0), {"none", "kidney"}},
      unnamed{std::vector<std::uint8_t>(8000, 1), {"none", "a\nb"}};
  unnamed.label[0] = 0;
  for (const auto& [name, bytes] : {std::pair(added, volume::bytes_from_labels(small)),
                                    {added, volume::bytes_from_labels(unnamed)},
                                    {added, std::vector<std::byte>(100)},
                                    {row.skin_sha256, cases::bytes_from_mesh({})},
                                    {row.skin_sha256, cases::bytes_from_mesh(far)}}) {
    casedb::Parts parts = good_;
    casedb::swap_asset(parts, name, bytes);
    casedb::put(file_, parts);
    const auto cases = casedb::import_bundle(away_, file_);
    // An empty skin was taken, and ended `case check` (a CHECK).
    ASSERT_EQ(cases.has_value(), name == row.skin_sha256 && bytes.size() > 100);
    if (cases) look_at(away_, case_id_);
  }
}

}  // namespace
}  // namespace seldinger::session
