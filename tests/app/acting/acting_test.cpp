// The door of the commands: who acts, what proves it, and that every command that changes something asks the one
// table of permissions. Before, `case setting`, `user passwd`, `backup` and eighteen others asked nobody.
#include "app/acting/acting.h"

#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <map>
#include <set>
#include <sstream>

#include "app/acting/token_file.h"
#include "app/commands.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/versions.h"
#include "casedb/grading/curriculum.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "casedb/people/login_session.h"
#include "casedb/questionnaires/rounds.h"
#include "casedb/workshops/workshops.h"
#include "tests/casedb/library_samples.h"

namespace seldinger::app {
namespace {

namespace fs = std::filesystem;
using casedb::Action;
using casedb::CaseState;
using casedb::Role;
using casedb::Subject;

constexpr const char* kPassword = "a long password";

const Command& command_of(const std::string& name) {
  for (const Command& one : commands())
    if (name == one.name) return one;
  throw std::runtime_error(name);
}

struct Told {
  int exit_code = 0;
  std::string code, out, err;
};

// What a command asks the table, and of what: {} where neither state nor owner counts.
struct Asked {
  const char* command;
  std::vector<std::string> words;
  Action action;
  Subject subject{};
  bool of_the_trainee = false;  // theirs: own to the trainee
};

const casedb::Relation kOwnStudy{.own_study = true};
const casedb::Relation kOwnProgramme{.own_programme = true};  // the director's
const casedb::Relation kNobodys{.nobodys = true};             // of simulated people

class ActingTest : public testing::Test {
 protected:
  fs::path folder_ = fixtures::fresh_test_folder("acting");
  const std::string out_ = (folder_ / "out").string();
  fs::path made_ = folder_ / "made", library_ = folder_ / "library";
  std::string draft_, in_review_, published_, attempt_, curriculum_, text_, round_, other_round_, day_;
  std::map<Role, std::string> person_;

  void SetUp() override {
    ::setenv("XDG_STATE_HOME", (folder_ / "state").c_str(), 1);
    {
      auto library = casedb::open_library(made_);
      for (const Role role : casedb::kAllRoles) {
        person_[role] = casedb::add_user(library, casedb::name_of(role), role, kPassword).value();
        const auto account = casedb::log_in(library, casedb::name_of(role), kPassword);
        write_token(token_of(role), casedb::begin_login_session(library, *account));
      }
      fill(library);
    }
    renew();
  }
  void fill(casedb::Library& library) {
    const auto made = [&](const char* state) {
      const std::string case_id = casedb::add_case(library, casedb::sample_case());
      const std::string lesion_id = casedb::add_lesion(library, case_id, casedb::sample_lesion()).value();
      casedb::CaseSetting setting = casedb::find_case(library, case_id).value();
      setting.rule.criteria = {{"hit", 1, assessment::Comparison::at_least, 1.0, false}};
      EXPECT_TRUE(casedb::set_setting(library, case_id, setting));
      if (std::string(state) == "published") {
        auto attempt = casedb::sample_attempt(case_id, lesion_id);
        attempt.operator_name = casedb::kPersonOperator;
        attempt.person_id = person_[Role::trainee];
        attempt_ = casedb::add_attempt(library, attempt).value();
      }
      library.database().run("UPDATE training_case SET state = '" + std::string(state) + "' WHERE case_id = '" +
                             case_id + "'");
      return case_id;
    };
    draft_ = made("draft");
    in_review_ = made("draft");
    static_cast<void>(casedb::add_user(library, "submitter", Role::mentor, kPassword).value());
    ASSERT_TRUE(casedb::submit_case(library, in_review_, "submitter"));
    published_ = made("published");
    curriculum_ = casedb::add_curriculum(library, "Year 1", "mentor").value();
    for (const auto& [title, programme] : {std::pair{"Autumn", "Radiology"}, {"Spring", "Surgery"}}) {
      const std::string cohort = casedb::add_cohort(library, title, programme, "").value();
      static_cast<void>(
          casedb::add_user(library, std::string(title) + "-learner", Role::trainee, kPassword).value());
      ASSERT_TRUE(casedb::enrol(library, cohort,
                                casedb::open_account(library, std::string(title) + "-learner")->person_id,
                                casedb::Post::learner));
    }
    ASSERT_TRUE(casedb::appoint_director(library, "Radiology", person_[Role::director]));
    const std::string study = casedb::add_study(library, "Needles").value();
    ASSERT_TRUE(casedb::add_researcher(library, study, person_[Role::researcher]));
    static_cast<void>(casedb::add_consent_text(library, study, "May we?").value());
    ASSERT_TRUE(casedb::store_form(library, R"({"id": "short", "version": 1, "language": "en", "title": "Short",
        "items": [{"id": "1", "text": "Anything?", "kind": "comment"}]})"));
    round_ = casedb::open_round(library, {"Visit", "short", 1, study, {}})->code;
    other_round_ = casedb::open_round(library, {"Day", "short", 1, {}, {}})->code;
    day_ = casedb::open_workshop(library, {study, "Autumn", {{"Talk"}, {"Film"}}})->code;
    text_ = casedb::list_consents(library, person_[Role::trainee]).front().text_id;
  }
  // The library as it was made.
  void renew() {
    fs::remove_all(library_);
    fs::copy(made_, library_, fs::copy_options::recursive);
  }
  fs::path token_of(Role role) const { return folder_ / ("token-" + casedb::name_of(role)); }

  Told call(const std::string& name, std::vector<std::string> words, std::string typed = "") {
    words.insert(words.end(), {"--library", library_.string()});
    std::istringstream in(typed);
    std::streambuf* before = std::cin.rdbuf(in.rdbuf());
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    Told told;
    const Command& command = command_of(name);
    told.exit_code = command.run(Arguments(command, words));
    told.out = testing::internal::GetCapturedStdout();
    const std::string err = testing::internal::GetCapturedStderr();
    std::cin.rdbuf(before);
    told.err = err;
    const std::size_t at = err.find("error: ");
    if (at != err.npos) told.code = err.substr(at + 7, err.find(':', at + 7) - at - 7);
    return told;
  }
  casedb::AuditRow last_row() {
    auto library = casedb::open_library(library_);
    return casedb::list_audit(library).back();
  }
  std::vector<casedb::Decision> decisions(const std::string& case_id) {
    auto library = casedb::open_library(library_);
    return casedb::list_decisions(library, case_id);
  }

  // Cases, bundles, the library and what is simulated.
  std::vector<Asked> about_cases() const {
    return {
        {"import", {"nowhere.nii"}, Action::add_case},
        {"import", {"nowhere.nii", "--face", "overrule", "--reason", "knees"}, Action::overrule_face},
        {"case lesion",
         {draft_, "--center-mm", "0,0,0", "--radius-mm", "1", "--hu", "1"},
         Action::work_on_case,
         CaseState::draft},
        {"case lesion",
         {published_, "--center-mm", "0,0,0", "--radius-mm", "1", "--hu", "1"},
         Action::work_on_case,
         CaseState::published},
        {"case structure",
         {draft_, "--name", "x", "--rule", "major", "--class", "liver"},
         Action::work_on_case,
         CaseState::draft},
        {"case label", {draft_, "nowhere.nii"}, Action::work_on_case, CaseState::draft},
        {"case setting", {draft_, "--gauge", "18"}, Action::work_on_case, CaseState::draft},
        {"case confirm", {draft_, "--no-burned-in-text"}, Action::confirm_no_burned_in_text},
        {"case review", {draft_}, Action::submit_case},
        {"case review", {in_review_, "--approve"}, Action::approve_case},
        {"case review", {in_review_, "--return"}, Action::return_case},
        {"case retire", {published_}, Action::retire_case},
        {"case version", {published_}, Action::make_case_version},
        {"case delete", {draft_}, Action::erase_case, CaseState::draft},
        {"case bundle", {draft_, "--out", out_}, Action::hand_out_case},
        {"bundle export", {"--out", out_}, Action::hand_out_case},
        {"bundle import", {"nowhere"}, Action::add_case},
        {"bundle trust", {"remove", "nobody's"}, Action::keep_library},
        {"backup", {out_}, Action::keep_library},
        {"check", {"--repair"}, Action::keep_library},
        {"simulate", {"--case", "nowhere", "--operator", "expert"}, Action::simulate_attempts},
        {"simulate merge", {"nowhere"}, Action::simulate_attempts},
        {"surrogate fit", {"--case", "nowhere", "--out", "s.json"}, Action::simulate_attempts},
        {"surrogate check", {"--case", "nowhere", "--surrogate", "s.json"}, Action::simulate_attempts},
        {"recovery", {}, Action::simulate_attempts},
        {"recompute", {}, Action::keep_library},
    };
  }

  // Attempts, standards, curricula, accounts and cohorts.
  std::vector<Asked> about_people() const {
    return {
        {"export", {"--study", "Needles", "--out", out_}, Action::export_study, kOwnStudy},
        {"attempt delete", {attempt_}, Action::erase_attempts, {}, true},
        {"standard set", {draft_}, Action::set_standard},
        {"standard propose",
         {draft_, "--method", "borderline", "--csv", "nowhere.csv", "--value", "mm", "--x", "rating"},
         Action::propose_cut},
        {"standard freeze", {"nowhere"}, Action::freeze_cut},
        {"curriculum add", {"Year 2"}, Action::make_curriculum},
        {"curriculum item", {curriculum_, "--case", published_}, Action::make_curriculum},
        {"curriculum publish", {curriculum_}, Action::release_curriculum},
        {"curriculum remove", {curriculum_}, Action::remove_draft_curriculum},
        {"user add", {"new", "--role", "trainee"}, Action::manage_accounts},
        {"user passwd", {"trainee"}, Action::set_password, {}, true},
        {"user invite", {"invited", "--role", "trainee"}, Action::manage_accounts},
        {"user reset", {"trainee"}, Action::manage_accounts},
        {"user level", {"trainee", "--level", "student"}, Action::manage_accounts},
        {"user role", {"trainee", "--role", "mentor"}, Action::manage_accounts},
        {"user disable", {"trainee"}, Action::manage_accounts},
        {"user enable", {"trainee"}, Action::manage_accounts},
        {"user unlock", {"trainee"}, Action::let_in_again},
        {"user fact", {"trainee", "confidence", "4"}, Action::answer_consent, {}, true},
        {"user erase", {"trainee"}, Action::erase_person},
        // Before, a director did all of this in any programme, and so came to see anybody by name.
        {"cohort add", {"Winter", "--programme", "Radiology"}, Action::manage_cohorts, kOwnProgramme},
        {"cohort add", {"Winter", "--programme", "Surgery"}, Action::manage_cohorts},
        {"cohort enrol", {"Autumn", "--user", "Autumn-learner"}, Action::manage_cohorts, kOwnProgramme},
        {"cohort enrol", {"Autumn", "--user", "mentor", "--mentor"}, Action::manage_cohorts, kOwnProgramme},
        {"cohort enrol", {"Autumn", "--user", "Autumn-learner", "--end"}, Action::manage_cohorts, kOwnProgramme},
        {"cohort enrol", {"Autumn", "--user", "Spring-learner"}, Action::manage_cohorts},
        {"cohort enrol", {"Spring", "--user", "Autumn-learner"}, Action::manage_cohorts},
        {"cohort enrol", {"Spring", "--user", "mentor", "--mentor"}, Action::manage_cohorts},
        {"cohort enrol", {"Nothing", "--user", "mentor"}, Action::manage_cohorts},
        {"cohort direct", {"Radiology", "--user", "director"}, Action::appoint_director},
        {"cohort direct", {"Surgery", "--user", "director"}, Action::appoint_director},
    };
  }

  // Studies, reports, questionnaires, ratings, workshops and consent.
  std::vector<Asked> about_studies() const {
    return {
        {"study new", {"Probes"}, Action::manage_studies},
        {"study researcher", {"Needles", "--user", "researcher"}, Action::manage_studies},
        {"study plan", {"Needles", "nowhere.json"}, Action::plan_study, kOwnStudy},
        {"study show", {"Needles"}, Action::plan_study, kOwnStudy},
        {"study freeze", {"Needles"}, Action::plan_study, kOwnStudy},
        {"study enrol", {"Needles", "--user", "trainee"}, Action::enrol_in_study, kOwnStudy},
        {"study visits", {"Needles"}, Action::enrol_in_study, kOwnStudy},
        {"study look", {"Needles"}, Action::plan_study, kOwnStudy},
        {"study deviate", {"Needles", "two came late"}, Action::plan_study, kOwnStudy},
        {"study lock", {"Needles"}, Action::plan_study, kOwnStudy},
        {"report", {"validity", "--study", "Needles", "--out", out_ + ".html"}, Action::plan_study, kOwnStudy},
        {"report",
         {"validity", "--study", "Needles", "--out", out_ + ".html", "--data", out_ + "-data"},
         Action::export_study,
         kOwnStudy},
        {"report", {"learner", "--user", "trainee", "--out", out_ + ".html"}, Action::see_attempt, {}, true},
        {"report",
         {"learner", "--simulated", "--person", "novice-1", "--out", out_ + ".html"},
         Action::see_attempt,
         kNobodys},
        {"report", {"case", "--out", out_ + ".html"}, Action::see_case, CaseState::published},
        {"report", {"standard", "--case", draft_, "--out", out_ + ".html"}, Action::see_case, CaseState::draft},
        {"questionnaire add", {"nowhere.json"}, Action::manage_questionnaires},
        {"questionnaire open", {"short", "--title", "Another day"}, Action::manage_questionnaires},
        {"questionnaire close", {round_}, Action::manage_questionnaires},
        {"questionnaire import", {round_, "nowhere.csv", "nowhere.csv"}, Action::manage_questionnaires},
        {"questionnaire export", {round_, "--out", out_ + ".csv"}, Action::see_responses, kOwnStudy},
        {"questionnaire export", {other_round_, "--out", out_ + ".csv"}, Action::see_responses},
        {"questionnaire export", {"XXXXXX", "--out", out_ + ".csv"}, Action::see_responses},
        {"simulate answers", {round_}, Action::see_responses, kOwnStudy},
        {"simulate answers", {other_round_}, Action::see_responses},
        {"rating open", {"short", "--title", "Replays"}, Action::manage_questionnaires},
        {"rating show", {round_}, Action::see_responses, kOwnStudy},
        {"rating export", {other_round_, "--out", out_ + ".csv"}, Action::see_responses},
        {"workshop open",
         {"Needles", "--title", "Winter", "--station", "Talk", "--station", "Film"},
         Action::enrol_in_study,
         kOwnStudy},
        {"workshop admit", {day_, "--user", "trainee"}, Action::enrol_in_study, kOwnStudy},
        {"workshop tick", {day_, "--number", "1", "--station", "Talk"}, Action::enrol_in_study, kOwnStudy},
        {"workshop show", {day_}, Action::enrol_in_study, kOwnStudy},
        {"workshop close", {day_}, Action::enrol_in_study, kOwnStudy},
        {"workshop show", {"XXXXXX"}, Action::enrol_in_study},
        {"consent text", {"nowhere.txt"}, Action::manage_studies},
        {"consent give", {text_, "--user", "trainee"}, Action::answer_consent, {}, true},
        {"consent withdraw", {text_, "--user", "trainee"}, Action::answer_consent, {}, true},
        {"audit", {}, Action::read_audit},
    };
  }
};

// Every command that acts; "case publish" looks at the case's checks first (tests/e2e/acting_test.cpp).
TEST_F(ActingTest, EveryCommandThatActsAsksTheTableForEveryRole) {
  std::vector<Asked> all = about_cases();
  for (const auto& more : {about_people(), about_studies()}) all.insert(all.end(), more.begin(), more.end());
  std::set<std::string> asked{"case publish"};
  const std::int64_t before = last_row().sequence;  // the operator made what there is
  int allowed = 0, refused = 0;
  for (const Asked& one : all) {
    asked.insert(one.command);
    // Its help says whether --by may be left out.
    const Command& command = command_of(one.command);
    if (command.named) {
      EXPECT_THROW(command.run(Arguments(command, one.words)), UsageError) << one.command;
    } else if (one.action != Action::overrule_face) {
      EXPECT_NO_THROW(call(one.command, one.words, "another password\n")) << one.command;
      renew();
      fs::remove_all(out_);
    }
    for (const Role role : casedb::kAllRoles) {
      Subject subject = one.subject;
      if (one.of_the_trainee) subject.own = role == Role::trainee;
      if (one.subject.own_study) subject.own_study = role == Role::researcher;
      if (role != Role::director) subject.own_programme = false;
      std::vector<std::string> words = one.words;
      words.insert(words.end(), {"--by", casedb::name_of(role), "--token-file", token_of(role).string()});
      const Told told = call(one.command, words, "another password\n");
      const bool may = casedb::may(role, one.action, subject);
      EXPECT_EQ(told.code != "not_allowed", may)
          << one.command << " by " << casedb::name_of(role) << ": " << told.code;
      const casedb::AuditRow row = last_row();
      if (!may) {
        EXPECT_EQ(told.exit_code, kRefused) << one.command;
        EXPECT_EQ(row.result, "refused") << one.command << " by " << casedb::name_of(role);
        EXPECT_EQ(row.person_id, person_[role]) << one.command;
      }
      EXPECT_TRUE(row.sequence == before || row.actor != "operator") << one.command << ": " << row.act;
      ++(may ? allowed : refused);
      renew();
      fs::remove_all(out_);
    }
  }
  for (const Command& one : commands()) EXPECT_EQ(asked.contains(one.name), one.acts) << one.name;
  EXPECT_GT(allowed, 50);
  EXPECT_GT(refused, 100);
}

// One shell, three names, no password. Before: three decisions, as if three people had decided.
TEST_F(ActingTest, DecisionsWithoutProofAreMarkedAsTheOperators) {
  ASSERT_EQ(call("case review", {draft_, "--by", "mentor"}).exit_code, kDone);
  ASSERT_EQ(call("case review", {draft_, "--by", "director", "--approve"}).exit_code, kDone);
  const auto all = decisions(draft_);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].person_id, person_[Role::director]);
  for (const casedb::Decision& one : all) {
    EXPECT_EQ(one.by_operator, true);
    EXPECT_NE(one.who().find(" (entered by the operator)"), std::string::npos);
  }
  EXPECT_EQ(last_row().actor, "operator");
  EXPECT_EQ(last_row().person_id, person_[Role::director]);
  EXPECT_NE(call("case show", {draft_}).out.find("approved by " + all[1].pseudonym + " (entered by the operator)"),
            std::string::npos);
  EXPECT_NE(call("case show", {draft_, "--json"}).out.find("\"by_operator\": true"), std::string::npos);
}

TEST_F(ActingTest, DecisionsWithASessionOrAPasswordAreThePersons) {
  ASSERT_EQ(
      call("case review", {draft_, "--by", "mentor", "--token-file", token_of(Role::mentor).string()}).exit_code,
      kDone);
  ASSERT_EQ(call("case review", {draft_, "--by", "director", "--approve", "--password-file", "-"},
                 std::string(kPassword) + "\n")
                .exit_code,
            kDone);
  const auto all = decisions(draft_);
  ASSERT_EQ(all.size(), 2U);
  for (const casedb::Decision& one : all) {
    EXPECT_EQ(one.by_operator, false);
    EXPECT_EQ(one.who(), one.pseudonym);
  }
  EXPECT_EQ(last_row().actor, "person");
  EXPECT_EQ(call("case show", {draft_}).out.find("operator"), std::string::npos);
}

// Was: asked twice, and refused at the second time, when the password on standard input was gone.
TEST_F(ActingTest, WhoRepairsIsAskedForThePasswordOnce) {
  // The library was changed past the program (fill): its values are taken as they are.
  call("check", {"--repair", "--accept-damaged", "--by", "admin", "--password-file", "-"},
       std::string(kPassword) + "\n");
  EXPECT_EQ(last_row().act, "accept_damaged");
  EXPECT_EQ(last_row().actor, "person");
  EXPECT_EQ(last_row().person_id, person_[Role::admin]);
}

// Was: "done" before it was tried, and nothing of how it went.
TEST_F(ActingTest, WhatFailsIsNotKeptAsDone) {
  const auto kept = [&] {
    const casedb::AuditRow row = last_row();
    return row.act + " " + row.result;
  };
  library_ = folder_ / "sound";  // the other one was changed past the program
  static_cast<void>(casedb::open_library(library_));
  const std::string out = (folder_ / "out").string();
  EXPECT_EQ(call("backup", {out}).code, "");
  EXPECT_EQ(kept(), "back_up done");
  EXPECT_EQ(call("backup", {out}).code, "exists");
  EXPECT_EQ(kept(), "back_up refused");
  EXPECT_EQ(call("check", {"--repair", "--from", (folder_ / "nowhere").string()}).code, "no_backup");
  EXPECT_EQ(kept(), "repair refused");
  EXPECT_EQ(call("check", {"--repair"}).code, "");
  EXPECT_EQ(kept(), "repair done");
  EXPECT_EQ(call("recompute", {"--attempt", "0190a1b2-0000-7000-8000-0000000000ff"}).code, "no_attempt");
  EXPECT_EQ(kept(), "repair done") << "nothing was scored again";
}

TEST_F(ActingTest, AProofThatDoesNotFitIsRefusedNotTakenForNone) {
  EXPECT_EQ(call("case review", {draft_, "--by", "mentor", "--password-file", "-"}, "wrong password\n").code,
            "bad_log_in");
  EXPECT_EQ(last_row().act, "log_in");
  EXPECT_EQ(last_row().result, "refused");
  EXPECT_EQ(call("case review", {draft_, "--by", "nobody", "--password-file", "-"}, "wrong password\n").code,
            "bad_log_in");
  EXPECT_EQ(call("case review", {draft_, "--by", "mentor", "--token-file", token_of(Role::director).string()}).code,
            "no_session");
  EXPECT_EQ(call("case review", {draft_, "--by", "mentor", "--token-file", "nowhere"}).code, "no_session");
  EXPECT_THROW(call("case review", {draft_, "--password-file", "-"}), UsageError);
  static_cast<void>(testing::internal::GetCapturedStdout());
  static_cast<void>(testing::internal::GetCapturedStderr());
  EXPECT_TRUE(decisions(draft_).empty());
}

TEST_F(ActingTest, ARefusedNameMakesNoLibrary) {
  fs::remove_all(library_);
  EXPECT_EQ(call("user add", {"new", "--role", "trainee", "--by", "admin"}, "a long password\n").code,
            "no_library");
  EXPECT_FALSE(fs::exists(library_));
}

// `uid` stands for another account of the machine, which can read and write the folder.
TEST_F(ActingTest, WhoDoesNotOwnTheLibraryNeedsAProof) {
  const uid_t other = ::geteuid() + 4242;
  const Command& command = command_of("case setting");
  const auto opened = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {draft_, "--library", library_.string()});
    return open_acting(Arguments(command, words), WhereNone::refuse, other);
  };
  EXPECT_EQ(opened({}).error().code, "not_proven");
  EXPECT_EQ(opened({"--by", "mentor"}).error().code, "not_proven");
  EXPECT_EQ(last_row().act, "unproven");
  EXPECT_EQ(last_row().actor, "nobody");
  EXPECT_EQ(last_row().object_id, person_[Role::mentor]);
  EXPECT_EQ(opened({"--by", "nobody"}).error().code, "not_proven");
  auto proven = opened({"--by", "mentor", "--token-file", token_of(Role::mentor).string()});
  ASSERT_TRUE(proven);
  EXPECT_EQ(proven->actor().person_id, person_[Role::mentor]);
  EXPECT_FALSE(proven->actor().is_operator());
  // The session alone tells who it is.
  auto alone = opened({"--token-file", token_of(Role::trainee).string()});
  ASSERT_TRUE(alone);
  EXPECT_EQ(acting(*alone, Arguments(command, {draft_}), Action::work_on_case, CaseState::draft).error().code,
            "not_allowed");
  // The owner, by the file's own account; and root, who can read every byte anyway.
  EXPECT_TRUE(open_acting(Arguments(command, {draft_, "--library", library_.string()}), WhereNone::refuse, 0));
  struct stat about {};
  ASSERT_EQ(::stat((library_ / casedb::kDatabaseFile).c_str(), &about), 0);
  EXPECT_TRUE(
      open_acting(Arguments(command, {draft_, "--library", library_.string()}), WhereNone::refuse, about.st_uid));
}

// Was: a loop around `login` or --password-file tried as many passwords as are hashed.
TEST_F(ActingTest, WrongPasswordsDelayCommandsUntilSomebodyIsLetInAgain) {
  const std::string right = std::string(kPassword) + "\n";
  for (int i = 0; i < 3; ++i) EXPECT_EQ(call("login", {"mentor"}, "wrong password\n").code, "bad_log_in");
  const std::vector<std::string> review = {draft_, "--by", "mentor", "--password-file", "-"};
  for (int i = 0; i < 2; ++i) EXPECT_EQ(call("case review", review, "wrong password\n").code, "bad_log_in");
  EXPECT_EQ(call("login", {"mentor"}, right).code, "too_many_tries");
  EXPECT_EQ(call("case review", review, right).code, "too_many_tries");
  EXPECT_EQ(call("user unlock", {"mentor", "--by", "director"}).code, "not_allowed");
  EXPECT_EQ(call("user unlock", {"nobody"}).code, "no_user");
  EXPECT_EQ(call("login", {"director"}, right).exit_code, kDone) << "another name does not wait";
  ASSERT_EQ(call("user unlock", {"mentor", "--by", "admin"}).exit_code, kDone);
  EXPECT_EQ(last_row().act, "let_in_again");
  EXPECT_EQ(call("login", {"mentor"}, right).exit_code, kDone);
}

// Was: a library came from a backup without a word in its log.
TEST_F(ActingTest, ARestoreIsInTheLogOfWhatItMade) {
  library_ = folder_ / "sound";  // the other one was changed past the program
  static_cast<void>(casedb::open_library(library_));
  ASSERT_EQ(call("backup", {(folder_ / "monday").string()}).exit_code, kDone);
  library_ = folder_ / "again";
  ASSERT_EQ(call("restore", {(folder_ / "monday").string()}).exit_code, kDone);
  EXPECT_EQ(last_row().act, "restore");
  EXPECT_EQ(last_row().actor, "operator");
  EXPECT_EQ(call("check", {}).exit_code, kDone);
  EXPECT_EQ(call("restore", {(folder_ / "monday").string()}).code, "exists");
  EXPECT_TRUE(fs::exists(library_ / casedb::kDatabaseFile));
}

TEST_F(ActingTest, LogInKeepsATokenThatOnlyItsOwnerReads) {
  EXPECT_EQ(call("login", {"mentor"}, "wrong password\n").code, "bad_log_in");
  EXPECT_EQ(call("logout", {}).code, "no_session");
  ASSERT_EQ(call("login", {"mentor"}, std::string(kPassword) + "\n").exit_code, kDone);
  const fs::path file = token_file_of(library_);
  EXPECT_EQ(file.parent_path(), folder_ / "state/seldinger");
  struct stat about {};
  ASSERT_EQ(::stat(file.c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0600U);
  ASSERT_EQ(::stat(file.parent_path().c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 0777U, 0700U);
  ASSERT_EQ(call("case review", {draft_, "--by", "mentor"}).exit_code, kDone);
  // The mentor's session proves nothing of the director: it is the operator who enters that.
  ASSERT_EQ(call("case review", {draft_, "--by", "director", "--approve"}).exit_code, kDone);
  EXPECT_EQ(decisions(draft_)[0].by_operator, false);
  EXPECT_EQ(decisions(draft_)[1].by_operator, true);

  ::chmod(file.c_str(), 0644);
  EXPECT_EQ(call("case review", {in_review_, "--return", "--by", "mentor"}).code, "bad_token_file");
  ::chmod(file.c_str(), 0600);
  const fs::path aside = folder_ / "aside";
  fs::rename(file, aside);
  fs::create_symlink(aside, file);
  EXPECT_EQ(call("case review", {in_review_, "--return", "--by", "mentor"}).code, "bad_token_file");
  fs::remove(file);
  fs::rename(aside, file);
  ASSERT_EQ(call("logout", {}).exit_code, kDone);
  EXPECT_FALSE(fs::exists(file));
  EXPECT_EQ(last_row().act, "log_out");
  ASSERT_EQ(call("case review", {in_review_, "--return", "--by", "mentor"}).exit_code, kDone);
  EXPECT_EQ(decisions(in_review_).back().by_operator, true) << "logged out";
}

TEST_F(ActingTest, WhoActsHoldsInEveryFunctionThatTakesAName) {
  auto library = casedb::open_library(library_);
  library.act_for(casedb::Actor::person(person_[Role::mentor]));
  EXPECT_EQ(casedb::submit_case(library, draft_, "submitter").error().code, "not_allowed");
  EXPECT_EQ(casedb::add_curriculum(library, "X", "submitter").error().code, "not_allowed");
  library.act_for(casedb::Actor::nobody());
  EXPECT_EQ(casedb::submit_case(library, draft_, "mentor").error().code, "not_allowed");
  library.act_for(casedb::Actor::person(person_[Role::mentor]));
  EXPECT_TRUE(casedb::submit_case(library, draft_, "mentor"));
}

// Who may not see a case or an attempt is answered to its beginning as to one of nothing.
TEST_F(ActingTest, NobodyLearnsByBeginningsWhatTheyMayNotSee) {
  const auto by = [&](Role role) {
    return std::vector<std::string>{"--by", casedb::name_of(role), "--token-file", token_of(role).string()};
  };
  const auto answer = [&](const std::string& command, const std::string& named, Role role) {
    std::vector<std::string> words = {named};
    if (command == "case lesion") words.insert(words.end(), {"--remove", "x"});
    for (const std::string& one : by(role)) words.push_back(one);
    Told told = call(command, words);
    const std::size_t at = told.err.find(named);
    if (at != told.err.npos) told.err.replace(at, named.size(), "…");
    return told;
  };
  const std::string nothing(30, 'f');
  const auto begin = [](const std::string& id) { return id.substr(0, 30); };
  struct Hidden {
    std::string command, id;
    Role role;
    bool seen;
  };
  const std::vector<Hidden> all = {
      {"case lesion", draft_, Role::trainee, false},         {"case lesion", published_, Role::trainee, false},
      {"case lesion", draft_, Role::admin, false},           {"case lesion", draft_, Role::director, false},
      {"case lesion", draft_, Role::researcher, false},      {"case lesion", published_, Role::admin, true},
      {"case lesion", draft_, Role::mentor, true},           {"attempt delete", attempt_, Role::director, false},
      {"attempt delete", attempt_, Role::researcher, false}, {"attempt delete", attempt_, Role::trainee, true}};
  for (const Hidden& one : all) {
    SCOPED_TRACE(one.command + " by " + casedb::name_of(one.role));
    const Told told = answer(one.command, begin(one.id), one.role),
               of_nothing = answer(one.command, nothing, one.role);
    EXPECT_EQ(of_nothing.exit_code, kRefused);
    EXPECT_EQ(told.err == of_nothing.err && told.exit_code == of_nothing.exit_code, !one.seen)
        << told.err << of_nothing.err;
    renew();
  }
  // The operator has the files, and is told.
  EXPECT_EQ(call("case show", {begin(draft_)}).exit_code, kDone);
  EXPECT_EQ(call("case show", {draft_.substr(0, 4)}).code, "ambiguous") << "ids begin with their time";
  EXPECT_EQ(call("case show", {""}).code, "no_case");
}

}  // namespace
}  // namespace seldinger::app
