// Sessions: they end by idleness, age and log-out, not with the server, and their ids are not kept.
#include "web/site/sessions.h"

#include <gtest/gtest.h>

#include <map>

#include "sim/base/failure.h"
#include "tests/web/fake_site.h"

namespace seldinger::web {
namespace {

class SessionsTest : public ::testing::Test {
 protected:
  SessionsTest() {
    surroundings.now_us = [this] { return now_us; };
    surroundings.utc_us = [this] { return now_us + utc_from_now_us; };
    surroundings.random_id = [this] { return "random-" + std::to_string(++ids); };
    surroundings.sha256_hex = fake_hash;
  }
  // What a server that begins now finds of the one before it.
  std::vector<casedb::WebSession> kept() const {
    std::vector<casedb::WebSession> all;
    for (const auto& [id_hash, one] : library) all.push_back(one);
    return all;
  }
  // How many rows were written.
  std::size_t keep(Sessions& of) {
    std::size_t rows = 0;
    of.keep([&](const casedb::WebSessionChanges& changes) {
      rows = changes.kept.size() + changes.ended.size();
      for (const auto& one : changes.kept) library[one.id_hash] = one;
      for (const auto& id_hash : changes.ended) library.erase(id_hash);
    });
    return rows;
  }
  std::map<std::string, casedb::WebSession> library;
  std::int64_t now_us = 5, utc_from_now_us = 1'700'000'000'000'000;
  int ids = 0;
  Surroundings surroundings;
  Sessions sessions{surroundings};
};

TEST_F(SessionsTest, EachHasItsOwnIdAndFormToken) {
  const std::string a = sessions.begin("ann"), b = sessions.begin("bob");
  EXPECT_NE(a, b);
  EXPECT_EQ(sessions.find(a)->person_id, "ann");
  EXPECT_EQ(sessions.find(b)->person_id, "bob");
  EXPECT_NE(sessions.find(a)->form_token, sessions.find(b)->form_token);
  EXPECT_FALSE(sessions.find("random-1x").has_value());
  EXPECT_FALSE(sessions.find("").has_value());
}

TEST_F(SessionsTest, TheHashUnderWhichItIsKeptOpensNothing) {
  const std::string id = sessions.begin("ann");
  EXPECT_FALSE(sessions.find(fake_hash(id)).has_value());
}

TEST_F(SessionsTest, EndsAfterThirtyMinutesWithoutUse) {
  const std::string id = sessions.begin("ann");
  now_us += kSessionIdle_us - 1;
  EXPECT_TRUE(sessions.find(id).has_value());  // used: the half hour begins anew
  now_us += kSessionIdle_us - 1;
  EXPECT_TRUE(sessions.find(id).has_value());
  now_us += kSessionIdle_us;
  EXPECT_FALSE(sessions.find(id).has_value());
  now_us -= kSessionIdle_us;
  EXPECT_FALSE(sessions.find(id).has_value());  // and stays ended
}

TEST_F(SessionsTest, EndsAfterTwelveHoursHoweverMuchItIsUsed) {
  const std::string id = sessions.begin("ann");
  const std::int64_t begun_us = now_us;
  while (now_us - begun_us < kSessionLife_us - kSessionIdle_us) {
    now_us += kSessionIdle_us / 2;
    ASSERT_TRUE(sessions.find(id).has_value());
  }
  now_us = begun_us + kSessionLife_us - 1;
  EXPECT_TRUE(sessions.find(id).has_value());
  now_us = begun_us + kSessionLife_us;
  EXPECT_FALSE(sessions.find(id).has_value());
}

TEST_F(SessionsTest, EndsByLogOutAlone) {
  const std::string a = sessions.begin("ann"), b = sessions.begin("ann"), c = sessions.begin("bob");
  sessions.end(a);
  EXPECT_FALSE(sessions.find(a).has_value());
  EXPECT_TRUE(sessions.find(b).has_value());
  EXPECT_TRUE(sessions.find(c).has_value());
}

TEST_F(SessionsTest, AreBoundedAndTheOldestMakesRoom) {
  const std::string first = sessions.begin("ann");
  for (std::size_t i = 1; i < kMaxSessionsOfOne; ++i) ++now_us, sessions.begin("ann");
  EXPECT_TRUE(sessions.find(first).has_value());
  ++now_us;
  const std::string last = sessions.begin("ann");
  EXPECT_FALSE(sessions.find(first).has_value());
  EXPECT_TRUE(sessions.find(last).has_value());
  for (std::size_t i = 0; i < kMaxSessions + 10; ++i) ++now_us, sessions.begin(std::to_string(i));
  EXPECT_EQ(sessions.count(), kMaxSessions);
}

TEST_F(SessionsTest, TheNextServerGoesOnWithThem) {
  const std::string a = sessions.begin("ann", "mark"), b = sessions.begin("bob");
  const std::string token = sessions.find(a)->form_token;
  EXPECT_EQ(keep(sessions), 2U);
  EXPECT_EQ(library.at(fake_hash(a)).ends_us - library.at(fake_hash(a)).begun_us, kSessionLife_us);
  sessions.end(b);
  EXPECT_EQ(keep(sessions), 1U);
  now_us += kSessionIdle_us / 2;
  utc_from_now_us += now_us;  // the machine started again: its monotonic clock did too
  now_us = 0;
  Sessions next(surroundings, kept());
  ASSERT_TRUE(next.find(a).has_value());
  EXPECT_EQ(next.find(a)->person_id, "ann");
  EXPECT_EQ(next.find(a)->password_mark, "mark");
  EXPECT_EQ(next.find(a)->form_token, token) << "a page that was open goes on as well";
  EXPECT_FALSE(next.find(b).has_value());
}

TEST_F(SessionsTest, TheirTimeGoesOnWhileNoServerRuns) {
  const std::string id = sessions.begin("ann");
  keep(sessions);
  now_us += kSessionIdle_us - 1;
  EXPECT_TRUE(Sessions(surroundings, kept()).find(id).has_value());
  now_us += 1;
  Sessions late(surroundings, kept());
  EXPECT_FALSE(late.find(id).has_value());
  EXPECT_EQ(keep(late), 1U) << "and the row goes";
  EXPECT_TRUE(library.empty());
}

TEST_F(SessionsTest, AreWrittenAtMostOnceAMinute) {
  const std::string id = sessions.begin("ann");
  EXPECT_EQ(keep(sessions), 1U);
  for (int i = 0; i < 59; ++i) {
    now_us += 1'000'000;
    sessions.find(id);
    EXPECT_EQ(keep(sessions), 0U);
  }
  now_us += 1'000'000;
  EXPECT_EQ(keep(sessions), 0U) << "not used since";
  sessions.find(id);
  EXPECT_EQ(keep(sessions), 1U);
  EXPECT_EQ(library.at(fake_hash(id)).seen_us, now_us + utc_from_now_us);
}

TEST_F(SessionsTest, WhatCouldNotBeWrittenIsWrittenTheNextTime) {
  const std::string a = sessions.begin("ann"), b = sessions.begin("bob");
  keep(sessions);
  sessions.end(a);
  const std::string c = sessions.begin("cid");
  EXPECT_THROW(sessions.keep([](const auto&) { throw base::Failure("disk", "full"); }), base::Failure);
  EXPECT_FALSE(sessions.find(a).has_value());
  EXPECT_EQ(keep(sessions), 2U);
  EXPECT_EQ(library.count(fake_hash(a)), 0U);
  EXPECT_EQ(library.count(fake_hash(c)), 1U);
  EXPECT_EQ(library.count(fake_hash(b)), 1U);
}

}  // namespace
}  // namespace seldinger::web
