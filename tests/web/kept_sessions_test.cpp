// Who is logged in over a real library: the next server knows them still, and nobody whose session has ended.
#include <gmock/gmock.h>

#include <filesystem>

#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/keeping/backup.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/people.h"
#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"

namespace seldinger::web {
namespace {

using casedb::Role;
namespace fs = std::filesystem;

class KeptSessions : public testing::Test {
 protected:
  fs::path scratch_ = fixtures::fresh_test_folder("web"), folder_ = scratch_ / "library";
  std::string zoe_;
  FakeSite world_;
  std::unique_ptr<Questions> questions_;
  std::optional<Site> site_;

  void SetUp() override {
    world_.now_us = 1'000'000;
    world_.surroundings.utc_us = [] { return casedb::now_us(); };
    world_.surroundings.now_us = world_.surroundings.utc_us;
    auto library = std::move(casedb::Library::open_or_create(folder_).value());
    for (const Role role : {Role::trainee, Role::mentor, Role::admin})
      ASSERT_TRUE(casedb::add_user(library, casedb::name_of(role), role, kPassword).has_value());
    zoe_ = casedb::add_user(library, "Zoe", Role::trainee, kPassword).value();
    start(folder_);
  }
  casedb::Library open() { return std::move(casedb::Library::open(folder_).value()); }
  // A server's next start: nothing of the one before it is left but the library.
  void start(const fs::path& folder) {
    site_.reset();
    questions_ = std::move(questions_of(std::move(casedb::Library::open(folder).value())).value());
    site_.emplace(*questions_, world_.surroundings, routes());
  }
  std::map<std::string, std::string> cookies_of(const std::string& name) {
    FakeBrowser browser(*site_);
    EXPECT_EQ(browser.log_in(name, "correct+horse%20battery").status, 303);
    return browser.cookies;
  }
  int status_of(const std::map<std::string, std::string>& cookies) {
    FakeBrowser browser(*site_);
    browser.cookies = cookies;
    return browser.get("/me").status;
  }
  std::int64_t rows() { return open().database().integer("SELECT count(*) FROM web_session"); }
};

TEST_F(KeptSessions, OutliveTheServer) {
  const auto trainee = cookies_of("trainee"), zoe = cookies_of("Zoe");
  EXPECT_EQ(rows(), 2);
  start(folder_);
  EXPECT_EQ(status_of(trainee), 200);
  EXPECT_EQ(status_of(zoe), 200);
  FakeBrowser browser(*site_);
  browser.cookies = trainee;
  const std::string token = form_token(browser.get("/me").body, "/logout");
  ASSERT_FALSE(token.empty());
  EXPECT_EQ(browser.post("/logout", "token=" + token).status, 303);
  EXPECT_EQ(rows(), 1);
  start(folder_);
  EXPECT_EQ(status_of(trainee), 303) << "who has left stays out";
  EXPECT_EQ(status_of(zoe), 200);
}

TEST_F(KeptSessions, AreOfOnePort) {
  const auto trainee = cookies_of("trainee");
  world_.surroundings.port = 8081;
  site_.emplace(*questions_, world_.surroundings, routes());
  EXPECT_EQ(site_->sessions.count(), 0U);
  static_cast<void>(trainee);
}

TEST_F(KeptSessions, EndWithPasswordRoleAndAccountAlsoWhileNoServerRuns) {
  const auto trainee = cookies_of("trainee"), mentor = cookies_of("mentor"), zoe = cookies_of("Zoe"),
             admin = cookies_of("admin");
  site_.reset();
  questions_.reset();
  {
    auto library = open();
    ASSERT_TRUE(casedb::set_password(library, "trainee", "another long word").has_value());
    ASSERT_TRUE(casedb::set_role(library, "mentor", Role::researcher).has_value());
    ASSERT_TRUE(casedb::set_enabled(library, "zoe", false).has_value());
    ASSERT_TRUE(casedb::set_enabled(library, "zoe", true).has_value());
  }
  start(folder_);
  EXPECT_EQ(status_of(trainee), 303);
  EXPECT_EQ(status_of(mentor), 303);
  EXPECT_EQ(status_of(zoe), 303) << "what ended does not come back with the account";
  EXPECT_EQ(status_of(admin), 200);
  site_->keep_sessions();
  EXPECT_EQ(rows(), 1) << "their rows go";
}

TEST_F(KeptSessions, ARestoredBackupKnowsNobody) {
  const auto trainee = cookies_of("trainee");
  {
    auto library = open();
    ASSERT_TRUE(casedb::back_up(library, scratch_ / "backup", "1").has_value());
  }
  ASSERT_TRUE(casedb::restore(scratch_ / "backup", scratch_ / "restored").has_value());
  start(scratch_ / "restored");
  EXPECT_EQ(site_->sessions.count(), 0U);
  EXPECT_EQ(status_of(trainee), 303);
}

TEST_F(KeptSessions, AnErasedPersonHasNone) {
  const auto zoe = cookies_of("Zoe");
  {
    auto library = open();
    ASSERT_TRUE(casedb::erase_person(library, "Zoe", std::nullopt).has_value());
  }
  EXPECT_EQ(rows(), 0);
  // A server that does not know it yet writes none of it again.
  const std::int64_t now = casedb::now_us();
  questions_->keep_sessions(8080, {{{std::string(64, 'a'), zoe_, "mark", now - 1, now, now + 1'000'000'000}}, {}});
  EXPECT_EQ(rows(), 0);
  EXPECT_EQ(status_of(zoe), 303);
}

TEST_F(KeptSessions, ACopyOfTheLibraryOpensNothing) {
  const auto trainee = cookies_of("trainee");
  const std::string id = trainee.at("seldinger_8080");
  FakeBrowser browser(*site_);
  browser.cookies = trainee;
  const std::string token = form_token(browser.get("/me").body, "/logout");
  ASSERT_EQ(id.size(), 64U);
  ASSERT_EQ(token.size(), 64U);
  for (const auto& entry : fs::recursive_directory_iterator(folder_))
    if (entry.is_regular_file()) {
      const std::string file = fixtures::whole_file(entry.path());
      EXPECT_EQ(file.find(id), std::string::npos) << entry.path();
      EXPECT_EQ(file.find(token), std::string::npos) << entry.path();
    }
  const std::string hash = open().database().text("SELECT id_hash FROM web_session");
  ASSERT_EQ(hash, world_.surroundings.sha256_hex(id));
  EXPECT_EQ(status_of({{"seldinger_8080", hash}}), 303);
  EXPECT_EQ(status_of(trainee), 200);
}

}  // namespace
}  // namespace seldinger::web
