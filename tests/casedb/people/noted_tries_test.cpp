// Log-ins of commands: as slow as those of dashboard and window, by what the audit log holds.
#include "casedb/people/noted_tries.h"

#include "casedb/database/audit.h"
#include "casedb/people/login_delays.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class NotedTriesTest : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string ann_ = add_user(library_, "ann", Role::mentor, "a password").value();

  std::string by_command(const std::string& name, const std::string& password) {
    const auto account = log_in_by_command(library_, name, password);
    return account ? "in" : account.error().code;
  }
};

// Was: as many as are hashed, twelve a second.
TEST_F(NotedTriesTest, FiveWrongPasswordsDelayTheNextTryAlsoOfTheNextProgram) {
  for (int i = 0; i < 5; ++i) EXPECT_EQ(by_command(i % 2 == 0 ? "ann" : "ANN", "wrong"), "bad_log_in") << i;
  const std::size_t rows = list_audit(library_).size();
  EXPECT_EQ(by_command("ann", "a password"), "too_many_tries");
  Library other = open_library(library_.folder());
  EXPECT_EQ(log_in_by_command(other, "Ann", "a password").error().code, "too_many_tries");
  EXPECT_EQ(list_audit(library_).size(), rows) << "what was not tried does not lengthen the wait";
  ASSERT_TRUE(let_in_again(library_, "aNN"));
  EXPECT_EQ(list_audit(library_).back().act, "let_in_again");
  EXPECT_EQ(by_command("ann", "a password"), "in");
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(by_command("ann", "wrong"), "bad_log_in") << i << ": who was in begins anew";
  EXPECT_EQ(by_command("ann", "wrong"), "too_many_tries");
  EXPECT_EQ(let_in_again(library_, "nobody").error().code, "no_user");
}

TEST_F(NotedTriesTest, WhoFailsAtTheDashboardDelaysNoCommand) {
  Library server = open_library(library_.folder());
  server.act_for(Actor::nobody());
  for (int i = 0; i < 6; ++i) EXPECT_FALSE(log_in(server, "ann", "wrong"));
  EXPECT_EQ(by_command("ann", "a password"), "in");
}

TEST_F(NotedTriesTest, AClockThatWasAheadDelaysNobody) {
  for (int i = 0; i < 6; ++i) {
    library_.database().run(
        "INSERT INTO audit SELECT count + 1, 32503680000000000, 'operator', NULL, 'log_in', 'person', '" + ann_ +
        "', 'refused', hash FROM audit_head");
    library_.database().run("UPDATE audit_head SET count = count + 1");
  }
  EXPECT_EQ(by_command("ann", "a password"), "in");
}

TEST_F(NotedTriesTest, SomebodyLetInAgainIsHeededOnceByADashboardThatRuns) {
  LoginDelays delays;
  for (int i = 0; i < 5; ++i) delays.begin("ann", "here", 1);
  EXPECT_EQ(last_let_in_again(library_, ann_), 0);
  EXPECT_FALSE(delays.heed("ann", last_let_in_again(library_, ann_)));
  EXPECT_GT(delays.begin("ann", "here", 1), 0);
  ASSERT_TRUE(let_in_again(library_, "ann"));
  EXPECT_TRUE(delays.heed("Ann", last_let_in_again(library_, ann_)));
  for (int i = 0; i < 5; ++i) EXPECT_EQ(delays.begin("ann", "here", 1), 0);
  EXPECT_FALSE(delays.heed("ann", last_let_in_again(library_, ann_)));
  EXPECT_GT(delays.begin("ann", "here", 1), 0);
}

}  // namespace
}  // namespace seldinger::casedb
