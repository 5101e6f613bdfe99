// Sessions of the command line, roles that change, and the last admin.
#include "casedb/people/login_session.h"

#include "casedb/database/audit.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class LoginSessionTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string ann_ = add_user(library_, "ann", Role::mentor, "a password").value();
  std::string token_ = begin_login_session(library_, log_in(library_, "ann", "a password").value());

  bool lives() { return account_of_login_session(library_, token_).has_value(); }
  std::string last_act() {
    const auto rows = list_audit(library_);
    return rows.back().act + " " + rows.back().actor + " " + rows.back().result;
  }
};

TEST_F(LoginSessionTest, ATokenIsItsPersonsAndStandsNowhere) {
  ASSERT_EQ(token_.size(), 64U);
  EXPECT_EQ(account_of_login_session(library_, token_)->person_id, ann_);
  std::string other = token_;
  other[5] = other[5] == '0' ? '1' : '0';
  EXPECT_FALSE(account_of_login_session(library_, other));
  EXPECT_FALSE(account_of_login_session(library_, ""));
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) {
      EXPECT_EQ(fixtures::whole_file(entry.path()).find(token_), std::string::npos) << entry.path();
    }
}

TEST_F(LoginSessionTest, ItEndsWithItsTimeAndWhenTheClockWentBack) {
  library_.database().run("UPDATE login_session SET ends_us = begun_us + 1");
  EXPECT_FALSE(lives());
  library_.database().run(
      "UPDATE login_session SET begun_us = begun_us + 3600000000, ends_us = begun_us + 7200000000");
  EXPECT_FALSE(lives());
  // The next one takes it away.
  const std::string next = begin_login_session(library_, log_in(library_, "ann", "a password").value());
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM login_session"), 1);
  EXPECT_TRUE(account_of_login_session(library_, next));
}

TEST_F(LoginSessionTest, ItEndsWithPasswordRoleAndAccount) {
  ASSERT_TRUE(lives());
  ASSERT_TRUE(set_password(library_, "ann", "another password"));
  EXPECT_FALSE(lives());
  token_ = begin_login_session(library_, log_in(library_, "ann", "another password").value());
  ASSERT_TRUE(lives());
  ASSERT_TRUE(set_role(library_, "ann", Role::trainee));
  EXPECT_FALSE(lives());
  token_ = begin_login_session(library_, log_in(library_, "ann", "another password").value());
  ASSERT_TRUE(set_enabled(library_, "ann", false));
  EXPECT_FALSE(lives());
  ASSERT_TRUE(set_enabled(library_, "ann", true));
  EXPECT_FALSE(lives()) << "what ended does not come back with the account";
}

TEST_F(LoginSessionTest, WhoLogsOutHasNone) {
  EXPECT_TRUE(end_login_session(library_, token_));
  EXPECT_EQ(last_act(), "log_out person done");
  EXPECT_FALSE(lives());
  EXPECT_FALSE(end_login_session(library_, token_));
}

TEST_F(LoginSessionTest, LogInsAndFailuresAreKeptWithoutTheTypedName) {
  EXPECT_EQ(last_act(), "log_in person done");
  EXPECT_FALSE(log_in(library_, "ann", "wrong password"));
  EXPECT_EQ(last_act(), "log_in operator refused") << "at the command line";
  library_.act_for(Actor::nobody());
  EXPECT_FALSE(log_in(library_, "ann", "wrong password"));
  EXPECT_EQ(last_act(), "log_in nobody refused") << "at a server or a window";
  EXPECT_EQ(list_audit(library_).back().object_id, ann_);
  EXPECT_FALSE(log_in(library_, "zebedee quagmire", "a password"));
  EXPECT_EQ(last_act(), "log_in nobody refused");
  EXPECT_EQ(list_audit(library_).back().object_id, "");
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) {
      EXPECT_EQ(fixtures::whole_file(entry.path()).find("zebedee"), std::string::npos) << entry.path();
    }
  EXPECT_TRUE(problems_of_audit(library_).empty());
}

TEST_F(LoginSessionTest, ARoleChangesAndTheMarkOfWebSessionsWithIt) {
  const std::string mark = log_in(library_, "ann", "a password")->password_mark;
  ASSERT_TRUE(set_role(library_, "ANN", Role::director));
  EXPECT_EQ(last_act(), "set_role operator done");
  const auto account = log_in(library_, "ann", "a password");
  EXPECT_EQ(account->role, Role::director);
  EXPECT_NE(account->password_mark, mark) << "the dashboard logs out whoever began before";
  EXPECT_EQ(list_users(library_).front().password_mark, account->password_mark);
  EXPECT_EQ(set_role(library_, "eve", Role::admin).error().code, "no_user");
}

TEST_F(LoginSessionTest, TheLastAdminStaysOne) {
  static_cast<void>(add_user(library_, "adam", Role::admin, "a password").value());
  static_cast<void>(add_user(library_, "closed", Role::admin, "a password").value());
  ASSERT_TRUE(set_enabled(library_, "closed", false));
  const auto before = list_audit(library_).size();
  EXPECT_EQ(set_role(library_, "adam", Role::mentor).error().code, "last_admin");
  EXPECT_EQ(set_enabled(library_, "adam", false).error().code, "last_admin");
  EXPECT_EQ(list_audit(library_).size(), before);
  ASSERT_TRUE(set_role(library_, "adam", Role::admin)) << "the same again";
  ASSERT_TRUE(set_enabled(library_, "closed", true));
  ASSERT_TRUE(set_role(library_, "adam", Role::mentor));
  EXPECT_EQ(set_enabled(library_, "closed", false).error().code, "last_admin");
}

}  // namespace
}  // namespace seldinger::casedb
