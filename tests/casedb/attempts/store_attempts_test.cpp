// Attempts: recordings bit for bit, null scores that stay null, newest first, and nothing of a refused one.
#include <limits>

#include "casedb/attempts/add_unless.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class StoreAttemptsTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();

  NewAttempt sample() const { return sample_attempt(case_id_, lesion_id_); }
  std::string add(const NewAttempt& attempt) { return add_attempt(library_, attempt).value(); }
  std::string refusal(const NewAttempt& attempt) {
    const auto added = add_attempt(library_, attempt);
    return added ? "none" : added.error().code;
  }
};

TEST_F(StoreAttemptsTest, AnAttemptComesBackAsItWentIn) {
  NewAttempt attempt = sample();
  attempt.person_id = add_user(library_, "ann", Role::trainee, "a password").value();
  const std::string attempt_id = add(attempt);
  Library again = open_library(folder_);
  const AttemptRow row = find_attempt(again, attempt_id).value();
  EXPECT_EQ(row.attempt_id, attempt_id);
  EXPECT_EQ(row.case_id, case_id_);
  EXPECT_EQ(row.case_title, "Kidney A");
  EXPECT_EQ(row.lesion_id, lesion_id_);
  EXPECT_EQ(row.person_id, attempt.person_id);
  EXPECT_EQ(row.operator_name, "novice");
  EXPECT_EQ(row.seed, 0xfedcba9876543210ULL);
  EXPECT_EQ(row.program_version, "0.1.0");
  EXPECT_EQ(row.step_version, 3U);
  EXPECT_EQ(row.instrument.kind, cases::InstrumentKind::core);
  EXPECT_TRUE(same_bits(row.instrument.length_mm, attempt.instrument.length_mm));
  EXPECT_TRUE(same_bits(row.instrument.radius_mm, attempt.instrument.radius_mm));
  EXPECT_TRUE(same_bits(row.instrument.inner_radius_mm, attempt.instrument.inner_radius_mm));
  EXPECT_TRUE(same_bits(row.instrument.hu, attempt.instrument.hu));
  EXPECT_TRUE(same_bits(row.instrument.throw_mm, attempt.instrument.throw_mm));
  EXPECT_TRUE(same_bits(row.instrument.notch_mm, attempt.instrument.notch_mm));
  EXPECT_TRUE(same_bits(row.instrument.dead_tip_mm, attempt.instrument.dead_tip_mm));
  EXPECT_TRUE(same_bits(row.picture.depth_mm, attempt.picture.depth_mm));
  EXPECT_TRUE(same_bits(row.picture.width_mm, attempt.picture.width_mm));
  EXPECT_TRUE(same_bits(row.picture.rate_hz, attempt.picture.rate_hz));
  EXPECT_EQ(row.approach, cases::Approach::out_of_plane);
  EXPECT_TRUE(same_bits(row.lesion.center_lps_mm, sample_lesion().center_lps_mm));
  EXPECT_TRUE(same_bits(row.lesion.radius_mm, sample_lesion().radius_mm));
  EXPECT_TRUE(same_bits(row.lesion.hu, sample_lesion().hu));
  EXPECT_EQ(row.started_us, attempt.started_us);
  EXPECT_TRUE(same_bits(row.duration_s, attempt.duration_s));
  EXPECT_EQ(again.load_asset(row.picture_sha256).value(), attempt.picture_png);
}

TEST_F(StoreAttemptsTest, StepsComeBackInTheirOrder) {
  using assessment::StepHow;
  using assessment::StepState;
  NewAttempt attempt = sample();
  attempt.steps = {{"sign_in", 1, StepState::done, 1.25, "", StepHow::said},
                   {"check_probe", 1, StepState::done, 1.5, "", StepHow::shown},
                   {"decide", 1, StepState::skipped, std::nullopt, ""},
                   {"insert", 1, StepState::violated, 0.1 + 0.2, ""},
                   {"a_step_of_old", 1, StepState::not_asked, std::nullopt, "not_xray"}};
  const std::string attempt_id = add(attempt);
  EXPECT_EQ(list_steps(library_, attempt_id), attempt.steps);
  EXPECT_TRUE(list_steps(library_, add(sample())).empty());

  // Another version is added beside it and is what is told; the same one again is not.
  auto again = attempt.steps;
  again[2] = {"decide", 1, StepState::done, 3.0, "", StepHow::said};
  EXPECT_EQ(add_steps(library_, attempt_id, again).value(), 0U);
  EXPECT_EQ(list_steps(library_, attempt_id), attempt.steps);
  again.pop_back();
  for (auto& step : again) step.version = 2;
  EXPECT_EQ(add_steps(library_, attempt_id, again).value(), 4U);
  again.push_back(attempt.steps.back());
  EXPECT_EQ(list_steps(library_, attempt_id), again);
  EXPECT_EQ(add_steps(library_, "nobody", again).error().code, "no_attempt");
}

TEST_F(StoreAttemptsTest, ASimulationIsNobodysAndNeedsNoPicture) {
  NewAttempt attempt = sample();
  attempt.instrument.kind = cases::InstrumentKind::access;
  attempt.approach = cases::Approach::in_plane;
  attempt.picture_png.clear();
  attempt.metrics.clear();
  const AttemptRow row = find_attempt(library_, add(attempt)).value();
  EXPECT_FALSE(row.person_id.has_value());
  EXPECT_TRUE(row.picture_sha256.empty());
  EXPECT_TRUE(row.metrics.empty());
  EXPECT_EQ(row.instrument.kind, cases::InstrumentKind::access);
  EXPECT_EQ(row.approach, cases::Approach::in_plane);
}

TEST_F(StoreAttemptsTest, RecordingsComeBackBitForBit) {
  for (const std::size_t ticks : {std::size_t{0}, std::size_t{1}, std::size_t{2000}, std::size_t{4321}}) {
    NewAttempt attempt = sample();
    attempt.recording = sample_recording(ticks, ticks);
    const auto loaded = load_recording(library_, add(attempt));
    ASSERT_TRUE(loaded.has_value()) << ticks;
    EXPECT_EQ(difference(attempt.recording, *loaded), "") << ticks;
  }
}

TEST_F(StoreAttemptsTest, AnAttemptUnderXrayComesBackBitForBit) {
  NewAttempt attempt = sample();
  attempt.picture = {cases::Modality::xray, 0.0, 0.0, 0.0};
  attempt.recording.inputs[7].fluoroscope.pedal = true;
  attempt.recording.inputs[8].exposure = {1, 0.1, 2.0, {70.5, 30.5, 7.5}, true};
  attempt.recording.frames[3].beam = cases::BeamTruth{-12.5, 3.5, 81.0, 40.0, 0.03, 4.5, 0.25, 0.2, true, true};
  const std::string attempt_id = add(attempt);
  EXPECT_EQ(find_attempt(library_, attempt_id).value().picture.modality, cases::Modality::xray);
  const auto loaded = load_recording(library_, attempt_id);
  ASSERT_TRUE(loaded.has_value());
  EXPECT_EQ(difference(attempt.recording, *loaded), "");
  EXPECT_TRUE(loaded->inputs[7].fluoroscope.pedal);
}

TEST_F(StoreAttemptsTest, AnAttemptUnderUltrasoundKeepsItsProbe) {
  NewAttempt attempt = sample();
  attempt.picture = {cases::Modality::ultrasound, 85.0, 0.0, 60.0, "C5-2v"};
  attempt.recording.frames[3].near_plane = cases::NearPlane{true, false, true, true};
  const std::string attempt_id = add(attempt);
  const cases::Picture picture = find_attempt(library_, attempt_id).value().picture;
  EXPECT_EQ(picture.modality, cases::Modality::ultrasound);
  EXPECT_EQ(picture.probe, "C5-2v");
  EXPECT_EQ(picture.depth_mm, 85.0);
  EXPECT_EQ(find_attempt(library_, add(sample())).value().picture.probe, "");
  const auto loaded = load_recording(library_, attempt_id);
  ASSERT_TRUE(loaded.has_value());
  EXPECT_EQ(difference(attempt.recording, *loaded), "");
}

TEST_F(StoreAttemptsTest, AScoreOfNothingIsNotZero) {
  const AttemptRow row = find_attempt(library_, add(sample())).value();
  ASSERT_EQ(row.metrics.size(), 4U);  // in the order given
  EXPECT_EQ(row.metrics[1].id, "hit");
  EXPECT_EQ(row.metrics[1].version, 2);
  ASSERT_TRUE(row.metrics[1].value.has_value());
  EXPECT_TRUE(same_bits(*row.metrics[1].value, 0.0));
  EXPECT_EQ(row.metrics[1].reason, "");
  EXPECT_EQ(row.metrics[2].id, "entry_angle_error");
  EXPECT_FALSE(row.metrics[2].value.has_value());
  EXPECT_EQ(row.metrics[2].reason, "no plan");
  EXPECT_EQ(row.metrics[2].unit, "deg");
  EXPECT_TRUE(same_bits(*row.metrics[3].value, 0.1 + 0.2));
}

TEST_F(StoreAttemptsTest, OfAMetricTheNewestVersionIsShown) {
  NewAttempt attempt = sample();
  attempt.metrics = {{"b", 10, 3.0, "mm", ""},
                     {"a", 2, std::nullopt, "s", "why"},
                     {"b", 9, 2.0, "mm", ""},
                     {"a", 1, 1.0, "s", ""}};
  const std::string attempt_id = add(attempt);
  for (const AttemptRow& row : {find_attempt(library_, attempt_id).value(), list_attempts(library_).front()}) {
    ASSERT_EQ(row.metrics.size(), 2U);
    EXPECT_EQ(row.metrics[0].id, "b");
    EXPECT_EQ(row.metrics[0].version, 10);
    EXPECT_EQ(row.metrics[1].id, "a");
    EXPECT_EQ(row.metrics[1].version, 2);
    EXPECT_FALSE(row.metrics[1].value.has_value());
  }
}

TEST_F(StoreAttemptsTest, AttemptsAreListedNewestFirstEachWithItsOwnScores) {
  const std::string ann = add_user(library_, "ann", Role::trainee, "a password").value();
  const std::string bob = add_user(library_, "bob", Role::trainee, "a password").value();
  NewAttempt attempt = sample();
  attempt.recording = sample_recording(20);
  std::vector<std::string> ids, of_ann;
  for (int i = 0; i < 30; ++i) {
    attempt.started_us = 1000 + i / 3;  // three at the same time: the order of storing decides
    attempt.person_id = i % 2 == 0 ? ann : bob;
    attempt.metrics = {{"number", 1, static_cast<double>(i), "count", ""}};
    ids.insert(ids.begin(), add(attempt));
    if (i % 2 == 0) of_ann.insert(of_ann.begin(), ids.front());
  }
  attempt.started_us = 1;  // stored last, made first
  ids.push_back(add(attempt));
  EXPECT_EQ(count_attempts(library_), ids.size());
  for (std::size_t first = 0; first <= ids.size() + 1; ++first) {  // a page is that part of the list
    const auto page = list_attempts(library_, first, 2);
    ASSERT_EQ(page.size(), first >= ids.size() ? 0 : std::min<std::size_t>(2, ids.size() - first));
    for (std::size_t i = 0; i < page.size(); ++i) {
      EXPECT_EQ(page[i].attempt_id, ids[first + i]);
      EXPECT_EQ(page[i].metrics.size(), find_attempt(library_, page[i].attempt_id).value().metrics.size());
    }
  }
  const auto rows = list_attempts(library_);
  ASSERT_EQ(rows.size(), ids.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].attempt_id, ids[i]);
    ASSERT_EQ(rows[i].metrics.size(), 1U);
    EXPECT_EQ(*rows[i].metrics[0].value, i < 30 ? 29.0 - static_cast<double>(i) : 29.0);
  }
  const auto rows_of_ann = list_attempts_of(library_, ann);
  ASSERT_EQ(rows_of_ann.size(), of_ann.size());
  for (std::size_t i = 0; i < of_ann.size(); ++i) {
    EXPECT_EQ(rows_of_ann[i].attempt_id, of_ann[i]);
    EXPECT_EQ(rows_of_ann[i].person_id, ann);
    EXPECT_EQ(rows_of_ann[i].metrics.size(), 1U);
  }
  EXPECT_TRUE(list_attempts_of(library_, "nobody").empty());
}

// Asked of each simulated attempt that is stored: it must not look at all the others of the person.
TEST_F(StoreAttemptsTest, APersonsAttemptsOfASeedAreFoundByIt) {
  NewAttempt attempt = sample();
  const std::string ann = add_user(library_, "ann", Role::trainee, "a password").value();
  const std::string bob = add_user(library_, "bob", Role::trainee, "a password").value();
  std::vector<std::string> of_seed;
  for (const std::string& person_id : {ann, bob})
    for (const std::uint64_t seed : {0xfedcba9876543210ULL, 7ULL, 7ULL}) {
      attempt.person_id = person_id;
      attempt.seed = seed;
      attempt.started_us += 1;
      const std::string attempt_id = add(attempt);
      if (person_id == ann && seed == 7) of_seed.insert(of_seed.begin(), attempt_id);
    }
  std::vector<std::string> found;
  for (const AttemptRow& row : list_attempts_of_seed(library_, ann, 7)) found.push_back(row.attempt_id);
  EXPECT_EQ(found, of_seed);
  EXPECT_EQ(list_attempts_of_seed(library_, bob, 0xfedcba9876543210ULL).size(), 1U);
  EXPECT_TRUE(list_attempts_of_seed(library_, ann, 8).empty());
  Statement plan = library_.database().prepare(
      "EXPLAIN QUERY PLAN SELECT * FROM attempt_summary WHERE person_id = 'a' AND seed = 7 "
      "ORDER BY started_us DESC, attempt_id DESC");
  bool by_index = false;
  while (plan.step()) by_index = by_index || plan.text("detail").find("attempt_by_seed") != std::string::npos;
  EXPECT_TRUE(by_index);
}

TEST_F(StoreAttemptsTest, WhatAnAttemptRefersToMustExist) {
  const std::string other_case = add_case(library_, sample_case());
  NewAttempt attempt = sample();
  attempt.case_id = "nowhere";
  EXPECT_EQ(refusal(attempt), "no_case");
  attempt = sample();
  attempt.lesion_id = "nowhere";
  EXPECT_EQ(refusal(attempt), "no_lesion");
  attempt = sample();
  attempt.case_id = other_case;  // the lesion is of another case
  EXPECT_EQ(refusal(attempt), "no_lesion");
  attempt = sample();
  attempt.person_id = "nobody";
  EXPECT_EQ(refusal(attempt), "no_person");
  EXPECT_TRUE(list_attempts(library_).empty());
  // volume, skin and classes; no picture is left
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "assets"), {}), 3);
}

TEST_F(StoreAttemptsTest, NothingStaysOfAnAttemptTheDatabaseRefuses) {
  NewAttempt attempt = sample();
  attempt.metrics = {{"a", 1, 1.0, "mm", ""}, {"b", 1, std::nullopt, "mm", ""}};  // no value and no reason
  EXPECT_TRUE(refused_by_constraint([&] { static_cast<void>(add_attempt(library_, attempt)); }));
  attempt.metrics = {{"a", 1, std::numeric_limits<double>::quiet_NaN(), "mm", ""}};
  EXPECT_TRUE(refused_by_constraint([&] { static_cast<void>(add_attempt(library_, attempt)); }));
  attempt.metrics = {{"a", 1, std::numeric_limits<double>::infinity(), "mm", ""}};
  EXPECT_TRUE(refused_by_constraint([&] { static_cast<void>(add_attempt(library_, attempt)); }));
  EXPECT_TRUE(list_attempts(library_).empty());
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM recording_chunk"), 0);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_ / "assets"), {}), 3);
  static_cast<void>(add(sample()));  // and the library goes on
}

TEST_F(StoreAttemptsTest, AnUnknownAttemptIsRefused) {
  EXPECT_EQ(find_attempt(library_, "nowhere").error().code, "no_attempt");
  EXPECT_EQ(load_recording(library_, "nowhere").error().code, "no_attempt");
}

TEST_F(StoreAttemptsTest, AMissingPieceOfARecordingIsNoticed) {
  const std::string attempt_id = add(sample());
  Sqlite& database = library_.database();
  EXPECT_EQ(database.integer("SELECT count(*) FROM recording_chunk"), 3);  // 4.321 s in pieces of 2 s
  database.run("DROP TRIGGER recording_chunk_is_kept; DELETE FROM recording_chunk WHERE sequence = 2");
  EXPECT_EQ(load_recording(library_, attempt_id).error().code, "incomplete");
}

TEST_F(StoreAttemptsTest, ADamagedPieceOfARecordingIsNoticed) {
  const std::string attempt_id = add(sample());
  library_.database().run(
      "DROP TRIGGER recording_chunk_is_immutable;"
      "UPDATE recording_chunk SET data = zeroblob(length(data)) WHERE sequence = 1");
  EXPECT_EQ(load_recording(library_, attempt_id).error().code, "damaged");
}

}  // namespace
}  // namespace seldinger::casedb
