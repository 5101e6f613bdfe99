// Attempts that are stored while they run: chunk by chunk, to an attempt like any other, or left behind by a
// program that died.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "casedb/database/running_mark.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class OpenAttemptsTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string case_id_ = add_case(library_, sample_case());
  std::string lesion_id_ = add_lesion(library_, case_id_, sample_lesion()).value();
  NewAttempt sample_ = sample_attempt(case_id_, lesion_id_);
};

TEST_F(OpenAttemptsTest, PieceByPieceItIsTheSameAttempt) {
  sample_.recording = sample_recording(5000, 3);
  const std::string id = open_attempt(library_, sample_).value();
  ASSERT_EQ(list_open_attempts(library_).size(), 1U);
  EXPECT_EQ(list_open_attempts(library_)[0].attempt_id, id);
  EXPECT_EQ(list_open_attempts(library_)[0].seed, sample_.seed);
  EXPECT_TRUE(list_attempts(library_).empty()) << "not yet one to be shown or graded";
  EXPECT_TRUE(load_open_recording(library_, id)->inputs.empty());
  for (const cases::RecordingChunk& chunk : cases::chunks_from_recording(sample_.recording)) {
    Library another = open_library(folder_);  // as the recorder's thread has
    ASSERT_TRUE(add_chunk(another, id, chunk).has_value());
    EXPECT_EQ(load_open_recording(library_, id)->inputs.size(),
              std::min<std::size_t>(5000, 2000 * (chunk.sequence + 1)));
    EXPECT_EQ(list_open_attempts(library_)[0].chunks, static_cast<int>(chunk.sequence) + 1);
  }
  sample_.end = AttemptEnd::stopped;
  ASSERT_TRUE(close_attempt(library_, id, sample_).has_value());
  EXPECT_TRUE(list_open_attempts(library_).empty());
  const AttemptRow row = find_attempt(library_, id).value();
  EXPECT_EQ(row.end, AttemptEnd::stopped);
  EXPECT_EQ(row.duration_s, 5.0);
  EXPECT_EQ(row.step_version, sample_.recording.step_version);
  EXPECT_EQ(row.instrument.throw_mm, sample_.instrument.throw_mm);
  EXPECT_EQ(row.picture.rate_hz, sample_.picture.rate_hz);
  EXPECT_EQ(row.metrics.size(), sample_.metrics.size());
  EXPECT_EQ(difference(sample_.recording, load_recording(library_, id).value()), "");
  EXPECT_EQ(close_attempt(library_, id, sample_).error().code, "no_attempt") << "once";
}

TEST_F(OpenAttemptsTest, WhatDoesNotFitIsRefused) {
  NewAttempt stranger = sample_;
  stranger.lesion_id = std::string(36, 'x');
  EXPECT_EQ(open_attempt(library_, stranger).error().code, "no_lesion");
  const auto chunks = cases::chunks_from_recording(sample_recording(5000, 3));
  EXPECT_EQ(add_chunk(library_, std::string(36, 'x'), chunks[0]).error().code, "no_attempt");
  const std::string id = open_attempt(library_, sample_).value();
  EXPECT_EQ(add_chunk(library_, id, chunks[1]).error().code, "incomplete");
  ASSERT_TRUE(add_chunk(library_, id, chunks[0]).has_value());
  EXPECT_EQ(add_chunk(library_, id, chunks[0]).error().code, "incomplete") << "twice";
}

TEST_F(OpenAttemptsTest, OneThatDiedAtOnceIsAnAttemptWithoutTicks) {
  const std::string id = open_attempt(library_, sample_).value();
  ASSERT_TRUE(close_attempt(library_, id, {.end = AttemptEnd::interrupted, .metrics = {}, .picture_png = {}}));
  EXPECT_EQ(find_attempt(library_, id)->end, AttemptEnd::interrupted);
  EXPECT_TRUE(load_recording(library_, id)->inputs.empty());
}

// For how long nobody was at it is told by when its pieces were stored, and stays with the attempt.
TEST_F(OpenAttemptsTest, WhoGoesOnWithOneLeavesHowLongItLay) {
  const std::string id = open_attempt(library_, sample_).value();
  const auto chunks = cases::chunks_from_recording(sample_.recording);
  ASSERT_GE(chunks.size(), 2U);
  ASSERT_TRUE(add_chunk(library_, id, chunks[0]));
  const auto stored = [&](const std::string& earlier_us) {
    library_.database().run("UPDATE open_chunk SET stored_us = " + earlier_us);
  };
  const auto away_s = [&] { return list_open_attempts(library_).at(0).away_s; };
  EXPECT_FALSE(away_s());
  stored("NULL");  // by a program that did not say
  ASSERT_TRUE(note_resumption(library_, id));
  EXPECT_FALSE(away_s()) << "not known";
  stored("stored_us");
  ASSERT_TRUE(add_chunk(library_, id, chunks[1]));
  stored("stored_us - 100000000");
  ASSERT_TRUE(note_resumption(library_, id));
  ASSERT_TRUE(away_s());
  EXPECT_NEAR(*away_s(), 100.0, 5.0);
  ASSERT_TRUE(note_resumption(library_, id));
  EXPECT_NEAR(*away_s(), 200.0, 10.0) << "all interruptions together";
  stored("stored_us + 1000000000");
  ASSERT_TRUE(note_resumption(library_, id));
  EXPECT_NEAR(*away_s(), 200.0, 10.0) << "a clock that was set back tells nothing";
  for (std::size_t i = 2; i < chunks.size(); ++i) ASSERT_TRUE(add_chunk(library_, id, chunks[i]));
  ASSERT_TRUE(close_attempt(library_, id, sample_));
  ASSERT_TRUE(find_attempt(library_, id)->away_s);
  EXPECT_NEAR(*find_attempt(library_, id)->away_s, 200.0, 10.0);
  EXPECT_EQ(note_resumption(library_, id).error().code, "no_attempt") << "it is closed";
  const std::string other = add_attempt(library_, sample_).value();
  EXPECT_FALSE(find_attempt(library_, other)->away_s);
}

TEST_F(OpenAttemptsTest, TheServosRecordStaysWithTheAttempt) {
  cases::ServoRecord servo;
  servo.scheduler = cases::ServoScheduler::fifo;
  servo.memory_locked = true;
  servo.ticks = 4000;
  servo.missed = 3;
  base::Rng rng(5);
  for (int i = 0; i < 4000; ++i) {
    servo.period.add(900'000 + rng.bits() % 200'000);
    servo.latency.add(rng.bits() % 70'000);
    servo.compute.add(rng.bits() % 9'000);
  }
  sample_.servo = servo;
  const std::string id = add_attempt(library_, sample_).value();
  const auto back = find_servo_record(library_, id);
  ASSERT_TRUE(back.has_value());
  EXPECT_EQ(back->scheduler, servo.scheduler);
  EXPECT_TRUE(back->memory_locked);
  EXPECT_EQ(back->ticks, 4000U);
  EXPECT_EQ(back->missed, 3U);
  EXPECT_EQ(back->period, servo.period);
  EXPECT_EQ(back->latency, servo.latency);
  EXPECT_EQ(back->compute, servo.compute);
  sample_.servo.reset();
  EXPECT_FALSE(find_servo_record(library_, add_attempt(library_, sample_).value()).has_value());
}

TEST_F(OpenAttemptsTest, ScoresOfANewVersionStandBesideTheOld) {
  const std::string id = add_attempt(library_, sample_).value();
  const std::size_t before = find_attempt(library_, id)->metrics.size();
  ASSERT_GT(before, 0U);
  std::vector<MetricValue> again = sample_.metrics;
  EXPECT_EQ(add_metrics(library_, id, again).value(), 0U) << "nothing is new";
  again[0].version += 1;
  again[0].value = 77.0;
  again[0].reason.clear();
  EXPECT_EQ(add_metrics(library_, id, again).value(), 1U);
  const AttemptRow row = find_attempt(library_, id).value();
  EXPECT_EQ(row.metrics.size(), before) << "the newest of each";
  const auto found = std::find_if(row.metrics.begin(), row.metrics.end(),
                                  [&](const MetricValue& metric) { return metric.id == again[0].id; });
  EXPECT_EQ(found->value, 77.0);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM metric_value"), std::int64_t(before) + 1);
  EXPECT_EQ(add_metrics(library_, std::string(36, 'x'), again).error().code, "no_attempt");
}

// kill -9 in the middle: what was acknowledged is there, and everybody can see that nobody is at it any more.
TEST_F(OpenAttemptsTest, AProgramThatDiesLeavesAReadableAttempt) {
  sample_.recording = sample_recording(6500, 9);
  const auto chunks = cases::chunks_from_recording(sample_.recording);
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Library mine = open_library(folder_);
    const std::string id = open_attempt(mine, sample_).value();
    const RunningMark mark(folder_, id);
    for (int i = 0; i < 2; ++i)
      if (!add_chunk(mine, id, chunks[static_cast<std::size_t>(i)])) ::_exit(2);
    if (::write(ends[1], id.data(), 36) != 36) ::_exit(3);
    ::pause();
    ::_exit(0);
  }
  std::string id(36, ' ');
  ASSERT_EQ(::read(ends[0], id.data(), 36), 36);
  EXPECT_TRUE(is_running(folder_, id));
  ASSERT_EQ(::kill(child, SIGKILL), 0);
  ASSERT_EQ(::waitpid(child, nullptr, 0), child);
  ::close(ends[0]);
  ::close(ends[1]);
  EXPECT_FALSE(is_running(folder_, id));
  ASSERT_EQ(list_open_attempts(library_).size(), 1U);
  EXPECT_EQ(load_open_recording(library_, id)->inputs.size(), 4000U);
  ASSERT_TRUE(close_attempt(library_, id, {.end = AttemptEnd::interrupted, .metrics = {}, .picture_png = {}}));
  EXPECT_EQ(load_recording(library_, id)->inputs.size(), 4000U);
}

TEST_F(OpenAttemptsTest, AMarkIsOfItsAttemptAlone) {
  EXPECT_FALSE(is_running(folder_, "a")) << "before there was any";
  {
    const RunningMark a(folder_, "a");
    EXPECT_TRUE(is_running(folder_, "a"));
    EXPECT_FALSE(is_running(folder_, "b"));
    EXPECT_THROW(RunningMark(folder_, "a"), base::Failure) << "nobody makes the same attempt twice";
  }
  EXPECT_FALSE(is_running(folder_, "a"));
}

}  // namespace
}  // namespace seldinger::casedb
