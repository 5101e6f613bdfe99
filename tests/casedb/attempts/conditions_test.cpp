// Under which conditions an attempt was made: each row of the table goes into the library and comes back, what is
// not known stays so, and what the recording says is put in.
#include <cmath>
#include <set>

#include "casedb/attempts/attempt_columns.h"
#include "casedb/attempts/condition_table.h"
#include "casedb/database/migrate.h"
#include "casedb/database/question.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

using cases::EventKind;
using cases::HandKind;

// Another one for each row, and for each `seed`.
ConditionValue sample_value(const ConditionRow& row, int seed) {
  const std::string id = row.id;
  if (id.ends_with("_hand")) return std::string(seed % 2 == 0 ? "arm" : "space_mouse");
  if (id == "handedness") return std::string(seed % 2 == 0 ? "left" : "right");
  switch (row.kind) {
    case ConditionKind::flag:
      return seed % 2 == 0;
    case ConditionKind::whole:
      return static_cast<double>(seed);
    case ConditionKind::number:
      return 0.1 + seed;
    case ConditionKind::text:
      return "words " + std::to_string(seed);
  }
  return std::monostate{};
}

Conditions sample_conditions() {
  Conditions conditions;
  int seed = 1;
  for (const ConditionRow& row : condition_rows())
    EXPECT_TRUE(row.write(conditions, sample_value(row, ++seed))) << row.id;
  return conditions;
}

std::size_t known(const Conditions& conditions) {
  std::size_t count = 0;
  for (const ConditionRow& row : condition_rows())
    count += std::holds_alternative<std::monostate>(row.read(conditions)) ? 0 : 1;
  return count;
}

// By how many rows two differ, the first of them for the message.
std::string difference_of(const Conditions& a, const Conditions& b) {
  for (const ConditionRow& row : condition_rows())
    if (row.read(a) != row.read(b)) return row.id;
  return "";
}

TEST(ConditionTable, ARowIsAFieldOfItsOwn) {
  std::set<std::string> ids;
  const Conditions all = sample_conditions();
  EXPECT_EQ(known(all), condition_rows().size());
  for (const ConditionRow& row : condition_rows()) {
    EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    EXPECT_EQ(find_condition(row.id), &row);
    Conditions without = all;
    ASSERT_TRUE(row.write(without, std::monostate{}));
    EXPECT_EQ(known(without), condition_rows().size() - 1) << row.id << " shares a field";
    EXPECT_NE(std::string(row.about), "");
    EXPECT_NE(std::string(row.missing), "");
  }
  EXPECT_EQ(find_condition("colour"), nullptr);
}

TEST(ConditionTable, WhatIsNoSuchValueChangesNothing) {
  const Conditions all = sample_conditions();
  for (const ConditionRow& row : condition_rows()) {
    Conditions changed = all;
    const bool words = row.kind == ConditionKind::text;
    EXPECT_FALSE(row.write(changed, words ? ConditionValue(1.0) : ConditionValue(std::string("many")))) << row.id;
    EXPECT_FALSE(row.kind == ConditionKind::whole && row.write(changed, 1.5)) << row.id;
    EXPECT_FALSE(row.kind == ConditionKind::number && row.write(changed, std::nan(""))) << row.id;
    EXPECT_EQ(difference_of(changed, all), "");
  }
  Conditions changed = all;
  EXPECT_FALSE(find_condition("needle_hand")->write(changed, std::string("foot")));
  EXPECT_FALSE(find_condition("handedness")->write(changed, std::string("mouse")));
}

TEST(Conditions, TheNewerReplaceTheOlderWhereTheyAreKnown) {
  Conditions older, newer;
  older.pauses = 1;
  older.sound = true;
  newer.pauses = 2;
  newer.stereo = false;
  const Conditions both = joined(older, newer);
  EXPECT_EQ(both.pauses, 2);
  EXPECT_EQ(both.sound, true);
  EXPECT_EQ(both.stereo, false);
  EXPECT_EQ(known(both), 3U);
}

TEST(Conditions, APlannedWayIsWholeOrNone) {
  Conditions conditions;
  EXPECT_FALSE(planned_path(conditions));
  const assessment::PlannedPath path{{1.5, -2.0, 3.25}, {10.0, 20.0, -30.0}};
  put_planned_path(path, conditions);
  EXPECT_EQ(planned_path(conditions), path);
  conditions.planned_tip.y_mm.reset();
  EXPECT_FALSE(planned_path(conditions)) << "a place of two numbers is none";
  put_planned_path(assessment::PlannedPath{{1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}}, conditions);
  EXPECT_FALSE(planned_path(conditions)) << "a way without a length";
  put_planned_path(std::nullopt, conditions);
  EXPECT_EQ(known(conditions), 0U);
}

// Ten seconds; what led the tools, the guide and two pauses were noted.
cases::Recording noted_recording() {
  cases::Recording recording = sample_recording(10000, 3);
  recording.dt_s = 0.001;
  recording.events = {{0.001, EventKind::needle_by_mouse}, {0.002, EventKind::probe_by_mouse},
                      {1.0, EventKind::guide_on},          {1.5, EventKind::guide_reached},
                      {2.0, EventKind::paused, 30.5},      {3.0, EventKind::guide_off},
                      {4.0, EventKind::needle_by_arm},     {5.0, EventKind::needle_by_mouse},
                      {6.0, EventKind::paused, 10.5},      {8.5, EventKind::guide_on}};
  return recording;
}

TEST(Conditions, TheRecordingSaysWhatLedAndWhatHelped) {
  Conditions conditions;
  add_recorded(noted_recording(), conditions);
  EXPECT_EQ(conditions.needle_hand, HandKind::mouse);
  EXPECT_EQ(conditions.probe_hand, HandKind::mouse);
  EXPECT_EQ(conditions.hand_changes, 2);
  EXPECT_EQ(conditions.guide_used, true);
  ASSERT_TRUE(conditions.guide_share);
  EXPECT_NEAR(*conditions.guide_share, 0.35, 1e-12) << "2 s, and from 8.5 s to the end";
  EXPECT_EQ(conditions.pauses, 2);
  EXPECT_EQ(conditions.paused_s, 41.0);
}

TEST(Conditions, OfARecordingWithoutSuchNotesNothingIsGuessed) {
  cases::Recording old = noted_recording();
  old.events = {{1.0, EventKind::sign_in}};
  Conditions conditions;
  add_recorded(old, conditions);
  EXPECT_EQ(known(conditions), 0U) << "its recorder noted no guide: it may have been on";
  old.events = {{4.0, EventKind::resumed}, {4.001, EventKind::needle_by_mouse}, {4.002, EventKind::probe_by_mouse}};
  add_recorded(old, conditions);
  EXPECT_EQ(known(conditions), 0U) << "of its first four seconds nothing is known";
  old.events.reset();
  add_recorded(old, conditions);
  EXPECT_EQ(known(conditions), 0U);
  cases::Recording unguided = noted_recording();
  unguided.events->resize(2);
  add_recorded(unguided, conditions);
  EXPECT_EQ(conditions.guide_used, false) << "this one would have said so";
  EXPECT_EQ(conditions.guide_share, 0.0);
  EXPECT_EQ(conditions.pauses, 0);
}

class ConditionsTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  NewAttempt sample_ = [&] {
    NewAttempt sample = sample_attempt(case_id_, lesion_id_);
    sample.operator_name = kPersonOperator;
    sample.recording.events.emplace();
    return sample;
  }();
};

TEST_F(ConditionsTest, EachGoesIntoTheLibraryAndComesBack) {
  sample_.conditions = sample_conditions();
  const std::string id = add_attempt(library_, sample_).value();
  EXPECT_EQ(difference_of(find_conditions(library_, id), sample_.conditions), "");
  sample_.conditions = {};
  const std::string unknown = add_attempt(library_, sample_).value();
  EXPECT_EQ(known(find_conditions(library_, unknown)), 0U);
  EXPECT_EQ(known(find_conditions(library_, std::string(36, 'x'))), 0U);
}

TEST_F(ConditionsTest, ASimulatedOperatorsHandsAreSimulated) {
  sample_.operator_name = "novice";
  const Conditions conditions = find_conditions(library_, add_attempt(library_, sample_).value());
  EXPECT_EQ(conditions.needle_hand, HandKind::simulated);
  EXPECT_EQ(conditions.probe_hand, HandKind::simulated);
  EXPECT_EQ(conditions.guide_used, false);
  EXPECT_EQ(conditions.pauses, 0);
  EXPECT_FALSE(conditions.window_width_px) << "there was no window";
}

// What is known is stored with the pieces, so that a program that dies leaves it.
TEST_F(ConditionsTest, OfAnAttemptThatIsCutOffStaysWhatWasKnown) {
  const std::string id = open_attempt(library_, sample_).value();
  Conditions early, later;
  early.handedness = Handedness::left;
  early.help_level = 2;
  early.picture_method = "scatterers, CPU";
  ASSERT_TRUE(note_conditions(library_, id, early));
  const auto chunks = cases::chunks_from_recording(noted_recording());
  for (std::size_t i = 0; i < 2; ++i) ASSERT_TRUE(add_chunk(library_, id, chunks[i]));
  later.picture_method = "lattice, CPU";
  later.speckle_fallback = true;
  ASSERT_TRUE(note_conditions(library_, id, later));
  EXPECT_EQ(note_conditions(library_, std::string(36, 'x'), later).error().code, "no_attempt");

  ASSERT_TRUE(close_attempt(library_, id, {.end = AttemptEnd::interrupted, .metrics = {}, .picture_png = {}}));
  const Conditions kept = find_conditions(library_, id);
  EXPECT_EQ(kept.handedness, Handedness::left);
  EXPECT_EQ(kept.help_level, 2);
  EXPECT_EQ(kept.picture_method, "lattice, CPU") << "the newest";
  EXPECT_EQ(kept.speckle_fallback, true);
  EXPECT_FALSE(kept.begun_again) << "nobody can say";
  EXPECT_EQ(kept.pauses, 1) << "of the four seconds that were stored";
  ASSERT_TRUE(kept.guide_share);
  EXPECT_NEAR(*kept.guide_share, 0.5, 1e-12);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM open_attempt_condition"), 0);
  EXPECT_EQ(note_conditions(library_, id, later).error().code, "no_attempt") << "it is closed";
}

TEST_F(ConditionsTest, WhatWasCannotBeChanged) {
  sample_.conditions = sample_conditions();
  static_cast<void>(add_attempt(library_, sample_).value());
  for (const char* change :
       {"UPDATE attempt_condition SET number = 0, words = NULL", "DELETE FROM attempt_condition",
        "INSERT OR REPLACE INTO attempt_condition SELECT * FROM attempt_condition",
        "INSERT INTO attempt_condition SELECT attempt_id, 'both', 1, 'a' FROM attempt"})
    EXPECT_TRUE(refused_by_constraint([&] { library_.database().run(change); })) << change;
}

// A library as the schema before had it.
TEST(ConditionsOfOldAttempts, AreNotKnown) {
  const Schema newest = library_schema();
  const auto file = fresh_folder() / "old.sqlite";
  const auto copy_row = [](Library& from, const std::string& table, const std::filesystem::path& to) {
    from.database().run("ATTACH '" + to.string() + "' AS old");
    std::string columns;  // of then
    for (Statement row = from.database().prepare("SELECT name FROM pragma_table_info('" + table + "', 'old')");
         row.step();)
      columns += (columns.empty() ? "" : ", ") + row.text("name");
    from.database().run("INSERT INTO old." + table + " (" + columns + ") SELECT " + columns + " FROM main." +
                        table + "; DETACH old");
  };
  const auto folder = fresh_folder() / "library";
  std::string id;
  {
    Library library = open_library(folder);
    const std::string its_case = add_case(library, sample_case());
    NewAttempt sample = sample_attempt(its_case, add_lesion(library, its_case, sample_lesion()).value());
    sample.operator_name = kPersonOperator;
    id = add_attempt(library, sample).value();
    {
      Sqlite old(file, Sqlite::Mode::create);
      ASSERT_TRUE(migrate(old, {newest.application_id, newest.steps.first(12)}));
    }
    for (const char* table : {"training_case", "lesion", "attempt"}) copy_row(library, table, file);
  }
  Sqlite database(file);
  ASSERT_TRUE(migrate(database, newest));
  EXPECT_EQ(database.integer("SELECT count(*) FROM attempt"), 1);
  EXPECT_EQ(database.integer("SELECT count(*) FROM attempt_condition"), 0);
  EXPECT_EQ(known(read_conditions(question(database, "conditions_of_attempt"), id)), 0U);
}

TEST_F(ConditionsTest, ReplaysAreCountedByPersonAndCase) {
  const std::string tina = add_user(library_, "tina", Role::trainee, "a long password").value();
  const std::string mona = add_user(library_, "mona", Role::mentor, "a long password").value();
  sample_.person_id = tina;
  const std::string own = add_attempt(library_, sample_).value();
  sample_.person_id = mona;
  const std::string experts = add_attempt(library_, sample_).value();
  const std::string other_case = add_case(library_, sample_case());
  EXPECT_EQ(count_replays_watched(library_, tina, case_id_).own, 0);
  for (int i = 0; i < 2; ++i) ASSERT_TRUE(note_replay_watched(library_, tina, own));
  ASSERT_TRUE(note_replay_watched(library_, tina, experts));
  ASSERT_TRUE(note_replay_watched(library_, mona, experts));
  EXPECT_EQ(count_replays_watched(library_, tina, case_id_).own, 2);
  EXPECT_EQ(count_replays_watched(library_, tina, case_id_).others, 1);
  EXPECT_EQ(count_replays_watched(library_, mona, case_id_).own, 1);
  EXPECT_EQ(count_replays_watched(library_, mona, case_id_).others, 0);
  EXPECT_EQ(count_replays_watched(library_, tina, other_case).own, 0);
  EXPECT_EQ(note_replay_watched(library_, tina, std::string(36, 'x')).error().code, "no_attempt");
  EXPECT_EQ(note_replay_watched(library_, std::string(36, 'x'), own).error().code, "no_person");
}

}  // namespace
}  // namespace seldinger::casedb
