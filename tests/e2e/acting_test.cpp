// Four eyes at the command line, with the program itself: the script that passed them alone, and how three people
// do it.
#include "tests/fixtures/command_library.h"
#include "tests/fixtures/folders.h"

namespace seldinger {
namespace {

using Json = nlohmann::json;

class ActingCommands : public testing::Test {
 protected:
  fixtures::CommandLibrary library_{fixtures::fresh_folder("acting_commands")};

  std::string next_version(const std::string& of, const std::string& by) {
    return library_.ask("case version " + of + " --by " + by)["case_id"];
  }
  std::string shown(const std::string& case_id) { return library_.call("case show " + case_id).out; }
};

TEST_F(ActingCommands, OneShellNoLongerLooksLikeThreePeople) {
  const std::string demo = library_.demo()["case_id"];
  for (const char* user : {"mona --role mentor", "rolf --role mentor", "dora --role director"})
    library_.done(std::string("user add ") + user);

  // Nobody is asked for a password. Before: three decisions under three names, and no log.
  const std::string alone = next_version(demo, "mona");
  library_.done("case setting " + alone + " --pass 'hit >= 1'");
  library_.done("case review " + alone + " --by mona");
  library_.done("case review " + alone + " --approve --by rolf");
  library_.done("case publish " + alone + " --by dora");
  const Json marked = library_.ask("case show " + alone)["decisions"];
  ASSERT_EQ(marked.size(), 4U);
  for (const Json& one : marked) EXPECT_EQ(one["by_operator"], true) << one;
  EXPECT_NE(shown(alone).find("published by " + marked[3]["by"].get<std::string>() + " (entered by the operator)"),
            std::string::npos)
      << shown(alone);

  // Each has logged in.
  const std::string folder = library_.folder().string();
  for (const char* user : {"mona", "rolf", "dora"})
    library_.done(std::string("login ") + user + " --token-file '" + folder + "/" + user + "'");
  const auto by = [&](const std::string& user) {
    return " --by " + user + " --token-file '" + folder + "/" + user + "'";
  };
  const std::string together = library_.ask("case version " + demo + by("mona"))["case_id"];
  library_.done("case setting " + together + " --pass 'hit >= 1'" + by("mona"));
  library_.done("case review " + together + by("mona"));
  EXPECT_EQ(library_.call("case review " + together + " --approve" + by("mona")).exit_code, 3) << "two people";
  library_.done("case review " + together + " --approve" + by("rolf"));
  library_.done("case publish " + together + by("dora"));
  const Json own = library_.ask("case show " + together)["decisions"];
  ASSERT_EQ(own.size(), 4U);
  for (const Json& one : own) EXPECT_EQ(one["by_operator"], false) << one;
  EXPECT_EQ(shown(together).find("operator"), std::string::npos) << shown(together);

  const Json audit = library_.ask("audit");
  int operators = 0, persons = 0;
  for (const Json& row : audit["audit"])
    if (row["act"] == "publish_case" && row["object_id"] == alone)
      operators += row["actor"] == "operator" ? 1 : 0;
    else if (row["act"] == "publish_case" && row["object_id"] == together)
      persons += row["actor"] == "person" ? 1 : 0;
  EXPECT_EQ(operators, 1);
  EXPECT_EQ(persons, 1);
  EXPECT_EQ(audit["audit"].back()["sequence"], audit["count"]);
  for (const char* name : {"mona", "rolf", "dora"}) EXPECT_EQ(audit.dump().find(name), std::string::npos);
  library_.done("check --audit-head " + std::to_string(audit["count"].get<int>()) + ":" +
                audit["head"].get<std::string>());
  EXPECT_EQ(library_.call("check --audit-head 1:" + audit["head"].get<std::string>()).exit_code, 1);
  EXPECT_EQ(library_.call("audit --since 2026-13-01").exit_code, 2);
  EXPECT_TRUE(library_.ask("audit --since 2999-01-01")["audit"].empty());
}

TEST_F(ActingCommands, RolesChangeAndAccountsOpenAgain) {
  fixtures::CommandLibrary& library = library_;
  for (const char* user : {"adam --role admin", "tina --role trainee"})
    library.done(std::string("user add ") + user + " --new-library");
  const std::string token = " --token-file '" + library.folder().string() + "/tina'";
  library.done("login tina" + token);
  library.done("user fact tina confidence 4 --by tina" + token);
  library.done("user role tina --role mentor");
  EXPECT_EQ(library.call("user fact tina confidence 5 --by tina" + token).exit_code, 3) << "the session has ended";
  library.done("user disable tina");
  EXPECT_EQ(library.call("login tina" + token).exit_code, 3);
  library.done("user enable tina");
  library.done("login tina" + token);
  for (const char* words : {"user role adam --role mentor", "user disable adam"})
    EXPECT_NE(library.call(words).err.find("error: last_admin: "), std::string::npos) << words;
  const Json users = library.ask("user list")["users"];
  EXPECT_EQ(users[0]["role"], "admin");
  EXPECT_EQ(users[1]["role"], "mentor");
}

}  // namespace
}  // namespace seldinger
