// People: who may log in, which names and passwords are taken, and that names stay out of the performance database.
#include <sodium.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "casedb/database/audit.h"
#include "casedb/database/uuid.h"
#include "casedb/people/facts.h"
#include "casedb/people/login_name.h"
#include "casedb/people/people.h"
#include "tests/casedb/library_samples.h"

namespace {

// What each password that was verified cost: Argon2id's parameters, as they begin its hash. The linker hands the
// calls over (--wrap).
std::vector<std::string> hash_costs;

}  // namespace

extern "C" int __real_crypto_pwhash_str_verify(const char* hash, const char* password, unsigned long long bytes);
extern "C" int __wrap_crypto_pwhash_str_verify(const char* hash, const char* password, unsigned long long bytes) {
  const std::string text(hash);
  hash_costs.push_back(text.substr(0, text.find("p=1$") + 4));
  return __real_crypto_pwhash_str_verify(hash, password, bytes);
}

namespace seldinger::casedb {
namespace {

class StorePeopleTest : public testing::Test {
 protected:
  std::filesystem::path folder_ = fresh_folder() / "library";
  Library library_ = open_library(folder_);

  std::string add(const std::string& name, Role role = Role::trainee, const std::string& password = "a password") {
    return add_user(library_, name, role, password).value();
  }
  std::string refusal(const std::string& name, const std::string& password = "a password") {
    const auto added = add_user(library_, name, Role::trainee, password);
    return added ? "none" : added.error().code;
  }
};

TEST_F(StorePeopleTest, RolesHaveNames) {
  for (const Role role : {Role::trainee, Role::mentor, Role::researcher, Role::director, Role::admin})
    EXPECT_EQ(role_from(name_of(role)), role);
  EXPECT_EQ(name_of(Role::director), "director");
  EXPECT_FALSE(role_from("king").has_value());
  EXPECT_FALSE(role_from("Admin").has_value());
}

TEST_F(StorePeopleTest, AUserLogsInWithNameAndPassword) {
  const std::string person_id = add("Ann Müller", Role::mentor, "correct horse");
  const auto account = log_in(library_, "ann Müller", "correct horse");
  ASSERT_TRUE(account.has_value());
  EXPECT_EQ(account->person_id, person_id);
  EXPECT_EQ(account->login_name, "Ann Müller");
  EXPECT_EQ(account->role, Role::mentor);
  EXPECT_TRUE(account->enabled);
  EXPECT_FALSE(log_in(library_, "Ann Müller", "correct Horse").has_value());
  EXPECT_FALSE(log_in(library_, "Ann Müller", "").has_value());
  EXPECT_FALSE(log_in(library_, "Bob", "correct horse").has_value());
  EXPECT_FALSE(log_in(library_, "", "correct horse").has_value());
  EXPECT_FALSE(log_in(library_, "' OR 1=1 --", "correct horse").has_value());
}

TEST_F(StorePeopleTest, ADisabledUserCannotLogIn) {
  add("ann");
  ASSERT_TRUE(set_enabled(library_, "ANN", false));
  EXPECT_FALSE(log_in(library_, "ann", "a password").has_value());
  EXPECT_FALSE(list_users(library_).front().enabled);
  ASSERT_TRUE(set_enabled(library_, "ann", true));
  EXPECT_TRUE(log_in(library_, "ann", "a password").has_value());
}

TEST_F(StorePeopleTest, ANewPasswordReplacesTheOld) {
  add("ann");
  add("bob");
  ASSERT_TRUE(set_password(library_, "ann", "another one"));
  EXPECT_FALSE(log_in(library_, "ann", "a password").has_value());
  EXPECT_TRUE(log_in(library_, "ann", "another one").has_value());
  EXPECT_TRUE(log_in(library_, "bob", "a password").has_value());
  EXPECT_EQ(set_password(library_, "ann", "short").error().code, "weak_password");
  EXPECT_TRUE(log_in(library_, "ann", "another one").has_value());
}

TEST_F(StorePeopleTest, UnknownUsersAreRefused) {
  EXPECT_EQ(set_password(library_, "nobody", "a password").error().code, "no_user");
  EXPECT_EQ(set_enabled(library_, "nobody", true).error().code, "no_user");
}

TEST_F(StorePeopleTest, ATakenNameChangesNothing) {
  add("ann");
  EXPECT_EQ(refusal("ann", "another one"), "name_taken");
  EXPECT_EQ(refusal("ANN", "another one"), "name_taken");
  EXPECT_EQ(list_users(library_).size(), 1U);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM person"), 1);
  EXPECT_TRUE(log_in(library_, "ann", "a password").has_value());
}

TEST_F(StorePeopleTest, PasswordsHave8CharactersTo128Bytes) {
  EXPECT_EQ(refusal("ann", ""), "weak_password");
  EXPECT_EQ(refusal("ann", "tqzkvbw"), "weak_password");
  EXPECT_EQ(refusal("ann", "äöüß"), "weak_password") << "8 bytes, and taken before";
  const std::string words = "heron lamp gravel tide ";
  std::string longest;
  while (longest.size() < 128) longest += words;
  EXPECT_EQ(refusal("ann", longest), "weak_password");
  EXPECT_TRUE(list_users(library_).empty());
  EXPECT_EQ(refusal("ann", "tqzkvbwm"), "none");
  EXPECT_EQ(refusal("bob", longest.substr(0, 128)), "none");
}

// Each was taken before. A log-in name stands for itself in any spelling.
TEST_F(StorePeopleTest, WhatIsGuessedFirstIsNoPassword) {
  for (const char* password :
       {"password",     "Passw0rd!",     "P4$$w0rd2026", "12345678",    "87654321",  "11111111",   "qwertzui",
        "1qaz2wsx3edc", "asdf1234",      "abcabcabc",    "Summer2026!", "seldinger", "Se1d!nger1", "trainee-mentor",
        "ultrasound1",  "Jane Doe 1985", "janejane",     "doe-Jane-99", "JANEDOE!",  "24121985",   "letmein123"}) {
    EXPECT_EQ(refusal("Jane Doe", password), "weak_password") << password;
    ASSERT_TRUE(list_users(library_).empty()) << password;
  }
  ASSERT_EQ(refusal("Jane Doe", "heron lamp gravel"), "none");
  for (const char* password : {"password1", "Jane2026"})
    EXPECT_EQ(set_password(library_, "Jane Doe", password).error().code, "weak_password") << password;
  EXPECT_TRUE(log_in(library_, "Jane Doe", "heron lamp gravel").has_value());
  for (const char* password :
       {"correct horse", "a long password", "9f3kq81z", "Katzenklo und Mond", "4711 Kirschbaum", "Jane likes heron",
        "ひらがなかたかなもじ", "doctor monday needle biopsy"})
    EXPECT_TRUE(set_password(library_, "Jane Doe", password)) << password;
}

TEST_F(StorePeopleTest, NamesArePrintable) {
  for (const std::string bad :
       {"", " ann", "ann ", " ", "a\nb", "a\tb", "a\x7f", "\xff", "a\xc3", "\xc0\xaf", "\xed\xa0\x80",
        "\xf4\x90\x80\x80", "a\u00a0b", "a\u200bb", "a\u202eb", "a\u2028b", "\ufeffann", "a\u3000b"}) {
    EXPECT_FALSE(is_login_name(bad)) << testing::PrintToString(bad);
    EXPECT_EQ(refusal(bad), "bad_name") << testing::PrintToString(bad);
  }
  EXPECT_FALSE(is_login_name(std::string("a\0b", 3)));
  std::string umlauts;
  for (int i = 0; i < 64; ++i) umlauts += "ü";
  for (const std::string& good : {std::string("a"), std::string("Ann Müller"), std::string("<b>'; DROP"),
                                  std::string("李小龍"), std::string(64, 'x'), umlauts})
    EXPECT_TRUE(is_login_name(good)) << good;
  EXPECT_FALSE(is_login_name(std::string(65, 'x')));
  EXPECT_FALSE(is_login_name(umlauts + "x"));
  EXPECT_TRUE(list_users(library_).empty());
}

TEST_F(StorePeopleTest, UsersAreListedOldestFirst) {
  const std::string cyd = add("cyd", Role::admin), ann = add("ann", Role::researcher), bob = add("bob");
  const auto users = list_users(library_);
  ASSERT_EQ(users.size(), 3U);
  EXPECT_EQ(users[0].person_id, cyd);
  EXPECT_EQ(users[0].role, Role::admin);
  EXPECT_EQ(users[1].person_id, ann);
  EXPECT_EQ(users[1].login_name, "ann");
  EXPECT_EQ(users[2].person_id, bob);
}

TEST_F(StorePeopleTest, NamesStayOutOfThePerformanceDatabase) {
  const std::string name = "Zaphod-Unmistakable";
  add(name, Role::trainee, "Trillian-Unmistakable");
  EXPECT_EQ(refusal(name), "name_taken");
  ASSERT_TRUE(log_in(library_, name, "Trillian-Unmistakable").has_value());
  ASSERT_TRUE(set_enabled(library_, name, false));
  { const Library closing = std::move(library_); }
  for (const auto& [file, content] : contents_of(folder_)) {
    EXPECT_EQ(content.find(name) != std::string::npos, file == "identities.sqlite") << file;
    EXPECT_EQ(content.find("Trillian-Unmistakable"), std::string::npos) << file;
  }
  library_ = open_library(folder_);
}

TEST_F(StorePeopleTest, APersonWithoutANameCannotLogIn) {  // what a crash in the middle of add_user leaves
  add("ann");
  library_.identities().run("DELETE FROM identity");
  EXPECT_FALSE(log_in(library_, "ann", "a password").has_value());
  EXPECT_FALSE(log_in(library_, "", "a password").has_value());
  EXPECT_TRUE(list_users(library_).empty());
  add("ann");
  EXPECT_TRUE(log_in(library_, "ann", "a password").has_value());
  EXPECT_EQ(list_users(library_).size(), 1U);
}

TEST_F(StorePeopleTest, ANameThatCannotBeStoredLeavesNoAccount) {
  library_.identities().run("PRAGMA query_only = ON");
  EXPECT_THROW(static_cast<void>(add_user(library_, "ann", Role::trainee, "a password")), base::Failure);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM account"), 0);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM person"), 0);
}

// Was: "add_account done" stayed of an account that was never there.
TEST_F(StorePeopleTest, AnAccountThatCouldNotBeNamedIsNotKeptAsDone) {
  const std::int64_t before = audit_head(library_).count;
  {
    Library elsewhere = open_library(folder_);
    elsewhere.identities().run("BEGIN IMMEDIATE");
    EXPECT_THROW(static_cast<void>(add_user(library_, "ann", Role::trainee, "a password")), base::Failure);
  }
  EXPECT_EQ(audit_head(library_).count, before);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM account"), 0);
  add("ann");
  EXPECT_EQ(refusal("ann"), "name_taken");
  EXPECT_EQ(audit_head(library_).count, before + 1);
  EXPECT_TRUE(problems_of_audit(library_).empty());
}

// Was: a row for each, 12 a second as fast as passwords are hashed.
TEST_F(StorePeopleTest, NamesThatNobodyHasAreKeptOnceAMinute) {
  add("ann");
  const std::int64_t before = audit_head(library_).count;
  Library elsewhere = open_library(folder_);
  const auto written = [&] { return elsewhere.database().integer("PRAGMA data_version"); };
  for (int i = 0; i < 5; ++i) {
    const std::int64_t last = written();
    EXPECT_FALSE(log_in(library_, "nobody" + std::to_string(i), "a password").has_value());
    EXPECT_NE(written(), last) << i << ": it takes as long as of a name that is there";
  }
  EXPECT_EQ(audit_head(library_).count, before + 1);
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(log_in(library_, "ann", "wrong password").has_value());
  EXPECT_EQ(audit_head(library_).count, before + 3) << "of an account that is there each is kept";
}

// Was: thrown, though name and password fit: nobody got into a full library.
TEST_F(StorePeopleTest, ALogInThatCannotBeKeptIsOneAllTheSame) {
  add("ann");
  const std::int64_t before = audit_head(library_).count;
  library_.database().run("PRAGMA query_only = ON");
  EXPECT_TRUE(log_in(library_, "ann", "a password").has_value());
  EXPECT_FALSE(log_in(library_, "ann", "wrong password").has_value());
  library_.database().run("PRAGMA query_only = OFF");
  EXPECT_EQ(audit_head(library_).count, before);
}

// A password from before there were rules for new ones goes on working.
TEST_F(StorePeopleTest, AnOldHashIsRenewedAtLogIn) {
  const std::string person_id = add("ann");
  std::array<char, crypto_pwhash_STRBYTES> weak{};
  ASSERT_EQ(crypto_pwhash_str(weak.data(), "password", 8, 1, 8 << 20), 0);
  library_.database()
      .prepare("UPDATE account SET password_hash = :hash")
      .bind("hash", std::string(weak.data()))
      .run();
  EXPECT_FALSE(log_in(library_, "ann", "passwort").has_value());
  EXPECT_EQ(library_.database().text("SELECT password_hash FROM account"), weak.data());
  EXPECT_TRUE(log_in(library_, "ann", "password").has_value());
  EXPECT_EQ(library_.database().text("SELECT substr(password_hash, 1, 31) FROM account"),
            "$argon2id$v=19$m=65536,t=2,p=1$");
  EXPECT_TRUE(log_in(library_, "ann", "password").has_value());
}

// Else who waits at the door learns which names there are: an answer without Argon2id comes a thousand times
// sooner.
TEST_F(StorePeopleTest, AnUnknownNameCostsTheSameHashAsAWrongPassword) {
  add("ann");
  const auto costs = [&](const std::string& name) {
    hash_costs.clear();
    EXPECT_FALSE(log_in(library_, name, "wrong password").has_value());
    return hash_costs;
  };
  EXPECT_EQ(costs("ann"), std::vector<std::string>{"$argon2id$v=19$m=65536,t=2,p=1$"});
  EXPECT_EQ(costs("bob"), costs("ann"));
  ASSERT_TRUE(set_enabled(library_, "ann", false));
  EXPECT_EQ(costs("ann"), costs("bob")) << "nor does it tell that an account is disabled";
}

TEST_F(StorePeopleTest, OfProcessesThatTakeANameAtOnceOneWins) {
  constexpr int kProcesses = 6;
  std::vector<pid_t> children;
  { const Library closing = std::move(library_); }  // a connection must not be carried into a child
  for (int i = 0; i < kProcesses; ++i) {
    const pid_t child = ::fork();
    ASSERT_GE(child, 0);
    if (child == 0) {
      int code = 9;
      try {
        Library library = open_library(folder_);
        const auto added = add_user(library, i % 2 == 0 ? "ann" : "ANN", Role::trainee, "a password");
        code = added ? 1 : added.error().code == "name_taken" ? 0 : 8;
      } catch (const std::exception&) {
      }
      ::_exit(code);
    }
    children.push_back(child);
  }
  int winners = 0;
  for (const pid_t child : children) {
    int status = -1;
    ::waitpid(child, &status, 0);
    ASSERT_TRUE(WIFEXITED(status));
    EXPECT_LE(WEXITSTATUS(status), 1);
    winners += WEXITSTATUS(status);
  }
  EXPECT_EQ(winners, 1);
  library_ = open_library(folder_);
  EXPECT_EQ(list_users(library_).size(), 1U);
  EXPECT_EQ(library_.database().integer("SELECT count(*) FROM person"), 1);
}

// The clock was once a year ahead and is right again. Was: `user level` answered 0 and changed nothing.
TEST_F(StorePeopleTest, AClockThatWasAheadHoldsNoChangeBack) {
  const std::string person_id = add("ann");
  const std::int64_t ahead_us = now_us() + 365 * 86'400'000'000;
  {
    Transaction transaction(library_.database());
    library_.database().run("INSERT INTO person_level VALUES ('" + person_id + "', " + std::to_string(ahead_us) +
                            ", 'student')");
    library_.database().run("INSERT INTO person_fact VALUES ('" + person_id + "', 'handedness', " +
                            std::to_string(ahead_us) + ", 'left')");
    transaction.commit();
  }
  for (const Level level : {Level::trainee, Level::consultant}) {
    ASSERT_TRUE(set_level(library_, "ann", level).has_value());
    EXPECT_EQ(list_users(library_).at(0).level.value(), level);
    // Was: stored a year ahead, so that what the list showed counted for no attempt.
    const bool counts = library_.database().integer("SELECT count(*) FROM person_level WHERE level = '" +
                                                    std::string(name_of(level)) +
                                                    "' AND since_us <= " + std::to_string(now_us())) == 1;
    EXPECT_TRUE(counts);
  }
  ASSERT_TRUE(give_fact(library_, person_id, "handedness", "right").has_value());
  EXPECT_EQ(newest_facts(list_facts(library_, person_id)).at("handedness").answer, "right");
}
}  // namespace
}  // namespace seldinger::casedb
