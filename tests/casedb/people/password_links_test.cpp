// One-time links to set a password: once, in time, for an account that is as it was.
#include "casedb/people/password_links.h"

#include <algorithm>
#include <thread>

#include "casedb/database/audit.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

class PasswordLinks : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);
  std::string zoe_ = add_user(library_, "zoe", Role::trainee, "a long password").value();

  std::string used(const PasswordLink& link, const std::string& password = "my own long word") {
    const auto set = set_password_by_link(library_, link.secret, password);
    return set ? "set" : set.error().code;
  }
  PasswordLink link() { return make_password_link(library_, "Zoe").value(); }  // names compare without case
};

TEST_F(PasswordLinks, SetsAPasswordOnce) {
  const PasswordLink one = link();
  EXPECT_EQ(one.secret.size(), 64U);
  EXPECT_NE(one.secret, link().secret) << "each is another";
  const PasswordLink two = link();
  EXPECT_EQ(used(one), "no_link") << "a later one ends it";
  EXPECT_EQ(account_of_password_link(library_, two.secret)->person_id, zoe_);
  EXPECT_EQ(used(two, "short"), "weak_password");
  EXPECT_EQ(used(two), "set") << "what was refused used nothing up";
  EXPECT_EQ(used(two), "no_link");
  EXPECT_TRUE(log_in(library_, "zoe", "my own long word").has_value());
  EXPECT_FALSE(log_in(library_, "zoe", "a long password").has_value());
}

TEST_F(PasswordLinks, HoldsAsLongAsItsTimeAndTheAccountAreAsTheyWere) {
  const PasswordLink late = link();
  library_.database().run("UPDATE password_link SET ends_us = " + std::to_string(now_us() - 1));
  EXPECT_EQ(used(late), "no_link");
  const PasswordLink of_old_password = link();
  ASSERT_TRUE(set_password(library_, "zoe", "another long word").has_value());
  EXPECT_EQ(used(of_old_password), "no_link");
  const PasswordLink of_old_role = link();
  ASSERT_TRUE(set_role(library_, "zoe", Role::mentor).has_value());
  EXPECT_EQ(used(of_old_role), "no_link");
  const PasswordLink of_closed = link();
  ASSERT_TRUE(set_enabled(library_, "zoe", false).has_value());
  EXPECT_EQ(used(of_closed), "no_link");
  EXPECT_EQ(make_password_link(library_, "zoe").error().code, "no_user");
  ASSERT_TRUE(set_enabled(library_, "zoe", true).has_value());
  EXPECT_EQ(used(of_closed), "no_link") << "nor once it is open again";
  EXPECT_EQ(make_password_link(library_, "nobody").error().code, "no_user");
  for (const std::string& wrong : {std::string(), std::string("x"), std::string(64, '0')})
    EXPECT_EQ(set_password_by_link(library_, wrong, "my own long word").error().code, "no_link");
}

TEST_F(PasswordLinks, WhoIsInvitedHasNoPasswordBefore) {
  const PasswordLink tina = invite_user(library_, "tina", Role::mentor).value();
  EXPECT_EQ(invite_user(library_, "TINA", Role::mentor).error().code, "name_taken");
  EXPECT_EQ(invite_user(library_, "", Role::mentor).error().code, "bad_name");
  const Account account = account_of_password_link(library_, tina.secret).value();
  EXPECT_EQ(account.login_name, "tina");
  EXPECT_EQ(account.role, Role::mentor);
  EXPECT_NEAR(static_cast<double>(tina.ends_us - now_us()), static_cast<double>(kInvitationLife_us), 60e6);
  EXPECT_EQ(used(tina), "set");
  EXPECT_TRUE(log_in(library_, "tina", "my own long word").has_value());
  EXPECT_TRUE(problems_of_audit(library_).empty());
}

// Before the row was taken first, both had set a password, and the one who came later was in.
TEST_F(PasswordLinks, OfTwoWhoUseItAtOnceOneSetsAPassword) {
  const PasswordLink one = link();
  Library libraries[] = {open_library(folder_), open_library(folder_)};
  std::string came[2];
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 2; ++i)
    threads.emplace_back([&, i] {
      const auto set = set_password_by_link(libraries[i], one.secret, "the long word of " + std::to_string(i));
      came[i] = set ? "set" : set.error().code;
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(std::count(std::begin(came), std::end(came), "set"), 1);
  EXPECT_EQ(std::count(std::begin(came), std::end(came), "no_link"), 1);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(log_in(library_, "zoe", "the long word of " + std::to_string(i)).has_value(), came[i] == "set");
}

}  // namespace
}  // namespace seldinger::casedb
