// Accounts over a real library: an admin makes one-time links, and people set their own passwords with them.
#include <gmock/gmock.h>

#include <filesystem>

#include "casedb/database/audit.h"
#include "casedb/database/sqlite.h"
#include "casedb/people/people.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"

namespace seldinger::web {
namespace {

using casedb::Role;
using ::testing::HasSubstr;
using ::testing::Not;

class Accounts : public testing::Test {
 protected:
  std::filesystem::path folder_ = fixtures::fresh_test_folder("web") / "library";
  FakeSite world_;
  std::unique_ptr<Questions> questions_;
  std::optional<Site> site_;
  std::optional<FakeBrowser> admin_;

  void SetUp() override {
    {
      auto library = open();
      for (const Role role : {Role::trainee, Role::admin})
        ASSERT_TRUE(casedb::add_user(library, casedb::name_of(role), role, kPassword).has_value());
    }
    questions_ = std::move(questions_of(open()).value());
    site_.emplace(*questions_, world_.surroundings, routes());
    admin_.emplace(*site_);
    admin_->log_in_as(Role::admin);
  }
  casedb::Library open() { return std::move(casedb::Library::open_or_create(folder_).value()); }
  // The path of the link that the admin's form answers; empty: it was refused.
  std::string link_of(const std::string& form) {
    const std::string token = form_token(admin_->get("/accounts").body, "/accounts");
    const std::string page = admin_->post("/accounts", form + "&token=" + token).body;
    const std::size_t at = page.find("/password?link=");
    return at == page.npos ? "" : page.substr(at, std::string("/password?link=").size() + 64);
  }
  std::string id_of(const std::string& name) {
    auto library = open();
    for (const casedb::Account& one : casedb::list_users(library))
      if (one.login_name == name) return one.person_id;
    return {};
  }
  static std::string use(FakeBrowser& browser, const std::string& link, const std::string& password) {
    const Response response = browser.post(
        "/password", "link=" + link.substr(link.find('=') + 1) + "&password=" + password + "&again=" + password);
    return std::to_string(response.status) + " " + header_of(response, "Location");
  }
};

TEST_F(Accounts, WhoIsInvitedSetsTheirOwnPasswordOnce) {
  const std::string link = link_of("name=tina&role=trainee");
  ASSERT_FALSE(link.empty());
  EXPECT_THAT(admin_->get("/accounts").body, Not(HasSubstr("/password?link="))) << "it is shown once";
  FakeBrowser tina(*site_);
  EXPECT_THAT(tina.get(link).body, HasSubstr("<bdi>tina</bdi>"));
  EXPECT_EQ(use(tina, link, "short"), "400 ");
  EXPECT_EQ(
      tina.post("/password", "link=" + link.substr(link.find('=') + 1) + "&password=one+long+word&again=another")
          .status,
      400);
  EXPECT_EQ(use(tina, link, "my+own+long+word"), "303 /login");
  EXPECT_EQ(use(tina, link, "another+long+word"), "404 ") << "once";
  EXPECT_EQ(tina.get(link).status, 404);
  EXPECT_EQ(tina.log_in("tina", "my+own+long+word").status, 303);
  EXPECT_EQ(tina.get("/me").status, 200);
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) {
      EXPECT_EQ(fixtures::whole_file(entry.path()).find(link.substr(link.find('=') + 1)), std::string::npos)
          << entry.path();
    }
  auto library = open();
  const auto log = casedb::list_audit(library);
  const auto acts = [&](const std::string& act) {
    return std::count_if(log.begin(), log.end(), [&](const auto& row) { return row.act == act; });
  };
  EXPECT_EQ(acts("make_password_link"), 1);
  EXPECT_EQ(acts("set_password"), 1);
  EXPECT_EQ(
      std::find_if(log.begin(), log.end(), [](const auto& row) { return row.act == "set_password"; })->person_id,
      id_of("tina"))
      << "in their own name";
}

TEST_F(Accounts, ALinkEndsWithItsTimeAnotherLinkAPasswordAndTheAccount) {
  const std::string form = "person=" + id_of("trainee");
  FakeBrowser trainee(*site_);
  const std::string first = link_of(form), second = link_of(form);
  EXPECT_EQ(trainee.get(first).status, 404);
  EXPECT_EQ(trainee.get(second).status, 200);
  open().database().run("UPDATE password_link SET ends_us = 1");
  EXPECT_EQ(trainee.get(second).status, 404);
  const std::string third = link_of(form);
  {
    auto library = open();
    ASSERT_TRUE(casedb::set_password(library, "trainee", "another long word").has_value());
  }
  EXPECT_EQ(trainee.get(third).status, 404);
  const std::string fourth = link_of(form);
  EXPECT_EQ(trainee.get(fourth).status, 200);
  {
    auto library = open();
    ASSERT_TRUE(casedb::set_enabled(library, "trainee", false).has_value());
  }
  EXPECT_EQ(trainee.get(fourth).status, 404);
  EXPECT_TRUE(link_of(form).empty()) << "of a closed account none is made";
}

TEST_F(Accounts, ThePasswordHoldsUntilTheLinkIsUsedAndSessionsEndThen) {
  FakeBrowser trainee(*site_), other(*site_);
  trainee.log_in_as(Role::trainee);
  const std::string link = link_of("person=" + id_of("trainee"));
  EXPECT_EQ(trainee.get("/me").status, 200);
  EXPECT_EQ(use(other, link, "my+own+long+word"), "303 /login");
  EXPECT_EQ(trainee.get("/me").status, 303);
  EXPECT_EQ(trainee.log_in_as(Role::trainee).status, 403);
  EXPECT_EQ(trainee.log_in("trainee", "my+own+long+word").status, 303);
}

TEST_F(Accounts, WhatCannotBeIsRefused) {
  EXPECT_TRUE(link_of("name=trainee&role=trainee").empty()) << "the name is taken";
  EXPECT_TRUE(link_of("name=&role=trainee").empty());
  EXPECT_TRUE(link_of("name=king&role=king").empty());
  EXPECT_TRUE(link_of("person=nobody").empty());
  FakeBrowser anybody(*site_);
  EXPECT_EQ(anybody.get("/password?link=" + std::string(64, '0')).status, 404);
  EXPECT_EQ(anybody.get("/password").status, 200);
  EXPECT_EQ(anybody.get("/accounts").status, 303);
}

}  // namespace
}  // namespace seldinger::web
