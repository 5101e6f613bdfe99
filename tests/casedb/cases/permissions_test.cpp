// Who may do what, against a matrix that is written apart from the program's table: every action by every role to
// every subject.
#include "casedb/cases/permissions.h"

#include <map>
#include <string>
#include <vector>

#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

// A cell tells to what the role may do it: "all", its "own", what is "others'", nothing (""), or, where the state
// decides, in which: of a case d(raft), r(eview), p(ublished), x (retired), of a curriculum D, P, X.
struct Row {
  const char* action;
  const char *trainee, *mentor, *researcher, *director, *admin;
};
// clang-format off
constexpr Row kMatrix[] = {
    //                            trainee  mentor  researcher  director  admin
    {"see_attempt",               "own",   "all",  "all",      "",       ""},
    {"see_operator_name",         "all",   "all",  "",         "all",    "all"},
    {"practise_case",             "p",     "dp",   "p",        "p",      "p"},
    {"look_inside",               "",      "all",  "",         "",       ""},
    {"cause_event",               "",      "all",  "",         "",       ""},
    {"see_case",                  "",      "drpx", "px",       "rpx",    "px"},
    {"work_on_case",              "",      "dr",   "",         "",       ""},
    {"confirm_no_burned_in_text", "",      "all",  "",         "all",    "all"},
    {"submit_case",               "",      "all",  "",         "",       ""},
    {"approve_case",              "",      "others'", "",      "others'", ""},
    {"return_case",               "",      "all",  "",         "all",    ""},
    {"publish_reviewed_case",     "",      "all",  "",         "all",    ""},
    {"publish_unreviewed_case",   "",      "all",  "",         "",       ""},
    {"retire_case",               "own",   "own",  "own",      "own",    "all"},
    {"make_case_version",         "",      "all",  "",         "",       ""},
    {"see_curriculum",            "P",     "DPX",  "PX",       "DPX",    ""},
    {"see_own_progress",          "all",   "",     "",         "",       ""},
    {"make_curriculum",           "",      "all",  "",         "",       ""},
    {"publish_curriculum",        "",      "",     "",         "all",    ""},
    {"remove_draft_curriculum",   "",      "all",  "",         "",       ""},
    {"retire_curriculum",         "",      "",     "",         "all",    ""},
    {"set_standard",              "",      "",     "",         "others'", ""},
};
// clang-format on

const std::pair<char, Subject> kSubjects[] = {{' ', Subject()},
                                              {'d', CaseState::draft},
                                              {'r', CaseState::review},
                                              {'p', CaseState::published},
                                              {'x', CaseState::retired},
                                              {'D', CurriculumState::draft},
                                              {'P', CurriculumState::published},
                                              {'X', CurriculumState::retired}};

bool allows(const std::string& cell, char state, bool own) {
  if (cell == "all") return state == ' ';
  if (cell == "own") return state == ' ' && own;
  if (cell == "others'") return state == ' ' && !own;
  return cell.find(state) != cell.npos;
}

TEST(Permissions, AreThoseOfTheMatrix) {
  ASSERT_EQ(std::size(kPermissions), std::size(kMatrix));
  int checks = 0, allowed = 0;
  for (std::size_t i = 0; i < std::size(kMatrix); ++i) {
    const Row& row = kMatrix[i];
    ASSERT_EQ(kPermissions[i].name, row.action);
    EXPECT_FALSE(kPermissions[i].rule.empty()) << row.action;
    const std::string cells[] = {row.trainee, row.mentor, row.researcher, row.director, row.admin};
    const auto action = static_cast<Action>(i);
    for (std::size_t column = 0; column < std::size(cells); ++column) {
      const Role role = kAllRoles[column];
      for (const auto& [letter, of_state] : kSubjects)
        for (const bool own : {false, true}) {
          Subject subject = of_state;
          subject.own = own;
          const bool expected = allows(cells[column], letter, own);
          EXPECT_EQ(may(role, action, subject), expected)
              << name_of(role) << " " << row.action << " '" << letter << "'" << (own ? " own" : "");
          EXPECT_EQ(allow(role, action, subject).has_value(), expected);
          ++checks;
          allowed += expected ? 1 : 0;
        }
      EXPECT_EQ(roles_that_may(action).has(role), !cells[column].empty()) << name_of(role) << " " << row.action;
    }
  }
  EXPECT_EQ(checks, 22 * 5 * 8 * 2);
  EXPECT_GT(allowed, 100) << "a matrix that allows nothing would pass an empty table";
}

TEST(Permissions, ARefusalTellsTheRule) {
  const auto refused = allow(Role::trainee, Action::retire_curriculum);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "not_allowed");
  EXPECT_EQ(refused.error().text, "a director retires a curriculum");
}

class PermissionsOfAccounts : public testing::Test {
 protected:
  Library library_ = open_library(fresh_folder() / "library");
  std::string code(const std::string& name) {
    const auto account = account_that_may(library_, name, Action::submit_case);
    return account ? account->person_id : account.error().code;
  }
};

TEST_F(PermissionsOfAccounts, OnlyAnOpenAccountMayAnything) {
  const std::string ann = add_user(library_, "ann", Role::mentor, "a password").value();
  static_cast<void>(add_user(library_, "tim", Role::trainee, "a password").value());
  EXPECT_EQ(code("ann"), ann);
  EXPECT_EQ(code("tim"), "not_allowed");
  EXPECT_EQ(code("Ann"), "no_user") << "names are exact";
  ASSERT_TRUE(set_enabled(library_, "ann", false));
  EXPECT_EQ(code("ann"), "no_user");
}

}  // namespace
}  // namespace seldinger::casedb
