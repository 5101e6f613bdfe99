// The conditions of an attempt and its pauses, as `attempt show --json` has them.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/attempts/answers_json.h"
#include "app/attempts/course_json.h"
#include "casedb/attempts/condition_table.h"

namespace seldinger::app {
namespace {

using nlohmann::ordered_json;

TEST(ConditionsJson, EachHasItsKeyAndNullWhereItIsNotKnown) {
  const ordered_json unknown = json_of_conditions({});
  EXPECT_EQ(unknown.size(), casedb::condition_rows().size());
  for (const casedb::ConditionRow& row : casedb::condition_rows()) {
    ASSERT_TRUE(unknown.contains(row.id)) << row.id;
    EXPECT_TRUE(unknown[row.id].is_null()) << row.id;
  }
}

TEST(ConditionsJson, EachComesBackOfItsType) {
  for (const casedb::ConditionRow& row : casedb::condition_rows()) {
    const std::string id = row.id;
    casedb::ConditionValue value = 0.25;
    if (row.kind == casedb::ConditionKind::flag) value = true;
    if (row.kind == casedb::ConditionKind::whole) value = 7.0;
    if (row.kind == casedb::ConditionKind::text)
      value = std::string(id.ends_with("_hand") ? "arm" : id == "handedness" ? "right" : "words");
    casedb::Conditions conditions;
    ASSERT_TRUE(row.write(conditions, value)) << id;
    const ordered_json cell = json_of_conditions(conditions).at(id);
    casedb::ConditionValue back;
    if (cell.is_boolean()) back = cell.get<bool>();
    if (cell.is_number()) back = cell.get<double>();
    if (cell.is_string()) back = cell.get<std::string>();
    EXPECT_EQ(back, value) << id;
    EXPECT_EQ(cell.is_number_integer(), row.kind == casedb::ConditionKind::whole) << id;
  }
}

TEST(ConditionsJson, AnAttemptsDocumentHasThemAndHowLongItLay) {
  casedb::AttemptRow row;
  row.operator_name = std::string(casedb::kPersonOperator);
  row.away_s = 12.5;
  row.conditions.needle_hand = cases::HandKind::mouse;
  row.conditions.pauses = 2;
  Course course;
  course.events = {{1.0, cases::EventKind::guide_on}, {2.0, cases::EventKind::paused, 41.5}};
  const auto shown = ordered_json::parse(json_of_attempt(row, {}, std::nullopt, course));
  EXPECT_EQ(shown.at("away_s"), 12.5);
  EXPECT_EQ(shown.at("conditions").at("needle_hand"), "mouse");
  EXPECT_EQ(shown.at("conditions").at("pauses"), 2);
  EXPECT_TRUE(shown.at("conditions").at("guide_used").is_null());
  EXPECT_FALSE(shown.at("events")[0].contains("wall_s"));
  EXPECT_EQ(shown.at("events")[0].at("kind"), "guide_on");
  EXPECT_EQ(shown.at("events")[1].at("wall_s"), 41.5);
}

}  // namespace
}  // namespace seldinger::app
