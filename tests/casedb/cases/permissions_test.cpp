// Who may do what, against a matrix that is written apart from the program's table: every action by every role to
// every subject.
#include "casedb/cases/permissions.h"

#include <map>
#include <string>
#include <vector>

#include "tests/casedb/library_samples.h"

namespace seldinger::casedb {
namespace {

// A cell tells to what the role may do it: alternatives, each of them "all" or whose it must be ("own", "others'",
// of the own "cohort", "programme" or "study", "nobody's", "reached", of one who "agreed"), before it the states
// where those decide: of a case d(raft), r(eview), p(ublished), x (retired), of a curriculum D, P, X. Empty:
// nothing.
struct Row {
  const char* action;
  const char *trainee, *mentor, *researcher, *director, *admin;
};
// clang-format off
constexpr Row kMatrix[] = {
    //                            trainee      mentor                 researcher          director     admin
    {"see_attempt",               "own",       "own|cohort|nobody's", "study|nobody's",   "programme", ""},
    {"see_recording",             "own",       "own|cohort|nobody's", "nobody's",         "programme", ""},
    {"see_operator_name",         "own",       "own|cohort",          "",                 "programme", ""},
    {"see_free_text",             "all",       "all",                 "",                 "all",       "all"},
    {"see_expert_replay",         "own|nobody's|agreed", "own|nobody's|agreed", "own|nobody's|agreed", "own|nobody's|agreed", "own|nobody's|agreed"},
    {"practise_case",             "p:reached", "p:reached|d:all",     "p:reached",        "p:reached", "p:reached"},
    {"skip_gates",                "",          "all",                 "",                 "",          ""},
    {"look_inside",               "",          "all",                 "",                 "",          ""},
    {"cause_event",               "",          "all",                 "",                 "",          ""},
    {"simulate_attempts",         "",          "all",                 "all",              "",          ""},
    {"comment_attempt",           "",          "cohort",              "",                 "",          ""},
    {"see_case",                  "",          "drpx:all",            "px:all",           "rpx:all",   "px:all"},
    {"see_case_notes",            "",          "all",                 "",                 "all",       ""},
    {"see_who_decided",           "",          "all",                 "",                 "all",       ""},
    {"work_on_case",              "",          "dr:all",              "",                 "",          ""},
    {"confirm_no_burned_in_text", "",          "all",                 "",                 "all",       "all"},
    {"overrule_face",             "",          "",                    "",                 "",          "all"},
    {"submit_case",               "",          "all",                 "",                 "",          ""},
    {"approve_case",              "",          "others'",             "",                 "others'",   ""},
    {"return_case",               "",          "all",                 "",                 "all",       ""},
    {"publish_reviewed_case",     "",          "others'",             "",                 "others'",   ""},
    {"publish_unreviewed_case",   "",          "all",                 "",                 "",          ""},
    {"retire_case",               "own",       "own",                 "own",              "own",       "all"},
    {"make_case_version",         "",          "all",                 "",                 "",          ""},
    {"add_case",                  "",          "all",                 "",                 "",          "all"},
    {"hand_out_case",             "",          "all",                 "",                 "all",       "all"},
    {"see_curriculum",            "P:all",     "DPX:all",             "PX:all",           "DPX:all",   ""},
    {"see_progress",              "own",       "cohort",              "",                 "programme", ""},
    {"make_curriculum",           "",          "all",                 "",                 "",          ""},
    {"publish_curriculum",        "",          "",                    "",                 "all",       ""},
    {"remove_draft_curriculum",   "",          "all",                 "",                 "",          ""},
    {"retire_curriculum",         "",          "",                    "",                 "all",       ""},
    {"see_standard_attempts",     "",          "all",                 "",                 "",          ""},
    {"set_standard",              "",          "",                    "",                 "others'",   ""},
    {"propose_cut",               "",          "all",                 "",                 "all",       ""},
    {"freeze_cut",                "",          "",                    "",                 "others'",   ""},
    {"see_cohort",                "",          "cohort",              "",                 "programme", ""},
    {"see_cohort_cells",          "",          "",                    "",                 "all",       ""},
    {"see_station_use",           "",          "",                    "",                 "programme", ""},
    {"manage_cohorts",            "",          "",                    "",                 "programme", "all"},
    {"appoint_director",          "",          "",                    "",                 "",          "all"},
    {"manage_studies",            "",          "",                    "",                 "all",       "all"},
    {"export_study",              "",          "",                    "study",            "",          ""},
    {"plan_study",                "",          "",                    "study",            "",          ""},
    {"enrol_in_study",            "",          "",                    "study",            "all",       "all"},
    {"manage_questionnaires",     "",          "all",                 "all",              "all",       "all"},
    {"see_responses",             "",          "own",                 "own|study",        "own",       ""},
    {"run_job",                   "",          "own",                 "own",              "",          "own"},
    {"answer_consent",            "own",       "own",                 "own",              "own",       "own"},
    {"let_in_again",              "",          "",                    "",                 "",          "all"},
    {"erase_attempts",            "own",       "own",                 "own",              "own",       "all"},
    {"erase_person",              "",          "",                    "",                 "",          "all"},
    {"erase_case",                "",          "d:all",               "",                 "",          "dx:all"},
    {"manage_accounts",           "",          "",                    "",                 "",          "all"},
    {"set_password",              "own",       "own",                 "own",              "own",       "all"},
    {"keep_library",              "",          "",                    "",                 "",          "all"},
    {"see_station_timing",        "",          "",                    "",                 "",          "all"},
    {"read_audit",                "",          "",                    "",                 "",          "all"},
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

// Each alone, and none.
std::vector<Relation> every_relation() {
  std::vector<Relation> all(8);
  all[1].own = all[2].own_cohort = all[3].own_programme = all[4].own_study = all[5].nobodys = all[6].reached =
      all[7].agreed = true;
  return all;
}

bool allows(std::string cell, char state, const Relation& relation) {
  for (cell += '|'; !cell.empty(); cell.erase(0, cell.find('|') + 1)) {
    std::string whose = cell.substr(0, cell.find('|'));
    if (whose.empty()) continue;
    const std::size_t colon = whose.find(':');
    const std::string states = colon == whose.npos ? " " : whose.substr(0, colon);
    if (colon != whose.npos) whose.erase(0, colon + 1);
    const bool fits = whose == "all"         ? true
                      : whose == "own"       ? relation.own
                      : whose == "others'"   ? !relation.own
                      : whose == "cohort"    ? relation.own_cohort
                      : whose == "programme" ? relation.own_programme
                      : whose == "study"     ? relation.own_study
                      : whose == "nobody's"  ? relation.nobodys
                      : whose == "agreed"    ? relation.agreed
                                             : whose == "reached" && relation.reached;
    if (fits && states.find(state) != states.npos) return true;
  }
  return false;
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
        for (const Relation& relation : every_relation()) {
          Subject subject = of_state;
          static_cast<Relation&>(subject) = relation;
          const bool expected = allows(cells[column], letter, relation);
          EXPECT_EQ(may(role, action, subject), expected)
              << name_of(role) << " " << row.action << " '" << letter << "'";
          EXPECT_EQ(allow(role, action, subject).has_value(), expected);
          ++checks;
          allowed += expected ? 1 : 0;
        }
      EXPECT_EQ(roles_that_may(action).has(role), !cells[column].empty()) << name_of(role) << " " << row.action;
    }
  }
  EXPECT_EQ(checks, static_cast<int>(std::size(kMatrix)) * 5 * 8 * 8);
  EXPECT_GT(allowed, 300) << "a matrix that allows nothing would pass an empty table";
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

// What commands ask with --by, and the window with its account: of every role and action what the table says.
TEST_F(PermissionsOfAccounts, EveryActionOfEveryRoleIsAsTheTableSays) {
  for (const Role role : kAllRoles) {
    const std::string name = name_of(role);
    static_cast<void>(add_user(library_, name, role, "a password").value());
    for (const Permission& row : kPermissions)
      for (const auto& [letter, of_state] : kSubjects)
        for (const Relation& relation : every_relation()) {
          Subject subject = of_state;
          static_cast<Relation&>(subject) = relation;
          const auto account = account_that_may(library_, name, row.action, subject);
          EXPECT_EQ(account.has_value(), may(role, row.action, subject)) << name << " " << row.name;
          if (!account) {
            EXPECT_EQ(account.error().text, row.rule);
          }
        }
  }
}

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
