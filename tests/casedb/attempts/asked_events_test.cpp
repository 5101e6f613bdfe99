// What a mentor lets happen in an attempt that is being made: each is taken once, in their order, and it goes with
// the attempt.
#include "casedb/attempts/asked_events.h"

#include <gtest/gtest.h>

#include "casedb/database/audit.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

using cases::EventKind;

class AskedEventsTest : public testing::Test {
 protected:
  AskedEventsTest() {
    const std::string case_id = add_case(library_, sample_case());
    sample_ = sample_attempt(case_id, add_lesion(library_, case_id, sample_lesion()).value());
    attempt_id_ = open_attempt(library_, sample_).value();
  }
  Library library_ = open_library(fresh_folder());
  NewAttempt sample_;
  std::string attempt_id_;
};

TEST_F(AskedEventsTest, AreTakenOnceInTheirOrder) {
  EXPECT_FALSE(take_asked_event(library_, attempt_id_));
  ASSERT_TRUE(ask_event(library_, attempt_id_, EventKind::cough));
  ASSERT_TRUE(ask_event(library_, attempt_id_, EventKind::bleeding));
  EXPECT_EQ(take_asked_event(library_, attempt_id_), EventKind::cough);
  ASSERT_TRUE(ask_event(library_, attempt_id_, EventKind::cough));
  EXPECT_EQ(take_asked_event(library_, attempt_id_), EventKind::bleeding);
  EXPECT_EQ(take_asked_event(library_, attempt_id_), EventKind::cough);
  EXPECT_FALSE(take_asked_event(library_, attempt_id_));
  EXPECT_EQ(list_audit(library_).back().act, "cause_event");
}

TEST_F(AskedEventsTest, AreOfAMentorAndOfAnOpenAttempt) {
  for (const EventKind kind : {EventKind::none, EventKind::sign_in, EventKind::pain_bone, EventKind::paused})
    EXPECT_EQ(ask_event(library_, attempt_id_, kind).error().code, "bad_event");
  EXPECT_EQ(ask_event(library_, add_attempt(library_, sample_).value(), EventKind::cough).error().code,
            "no_attempt");
  EXPECT_FALSE(take_asked_event(library_, attempt_id_));
}

TEST_F(AskedEventsTest, GoWithTheAttempt) {
  ASSERT_TRUE(ask_event(library_, attempt_id_, EventKind::cough));
  for (const cases::RecordingChunk& chunk : cases::chunks_from_recording(sample_.recording))
    ASSERT_TRUE(add_chunk(library_, attempt_id_, chunk));
  ASSERT_TRUE(close_attempt(library_, attempt_id_, sample_));
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM asked_event"), 0);
}

}  // namespace
}  // namespace seldinger::casedb
