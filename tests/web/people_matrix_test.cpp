// Who sees whom over a real library: every role to people in every state of cohort, programme and consent. What
// each of them is to the readers is worked out here from how they were made, not asked of the store.
#include <gmock/gmock.h>

#include <algorithm>

#include "casedb/cases/permissions.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "tests/fixtures/folders.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"
#include "web/routes/routes.h"

namespace seldinger::web {
namespace {

using casedb::Action;
using casedb::Relation;
using casedb::Role;

enum class InCohort { none, own, others, left };
enum class Says { nothing, study, other_study, library, withdrawn_from_study, withdrawn_but_library };
constexpr InCohort kCohorts[] = {InCohort::none, InCohort::own, InCohort::others, InCohort::left};
constexpr Says kConsents[] = {Says::nothing,
                              Says::study,
                              Says::other_study,
                              Says::library,
                              Says::withdrawn_from_study,
                              Says::withdrawn_but_library};

struct Subject {
  std::string name, person_id, attempt_id;
  InCohort cohort = InCohort::none;
  Says says = Says::nothing;
};

class PeopleMatrix : public testing::Test {
 protected:
  casedb::Library library_ =
      std::move(casedb::Library::open_or_create(fixtures::fresh_test_folder("web") / "library").value());
  std::string case_id_, lesion_id_;
  std::vector<Subject> subjects_;
  std::map<Role, std::string> readers_;

  std::string attempt_of(const std::optional<std::string>& person_id) {
    casedb::NewAttempt attempt;
    attempt.case_id = case_id_;
    attempt.lesion_id = lesion_id_;
    attempt.operator_name = person_id ? casedb::kPersonOperator : "expert";
    attempt.person_id = person_id;
    attempt.started_us = 1700000000000000 + static_cast<std::int64_t>(subjects_.size());
    attempt.recording.inputs.resize(3);
    attempt.recording.hashes.resize(3);
    attempt.metrics = {{"hit", 1, 1.0, "bool", ""}};
    for (const unsigned char c : std::string_view("\x89PNG\r\n\x1a\nrest"))
      attempt.picture_png.push_back(std::byte{c});
    return casedb::add_attempt(library_, attempt).value();
  }
  void answer(const std::string& person_id, const std::optional<std::string>& study, bool withdraw) {
    for (const casedb::Consent& one : casedb::list_consents(library_, person_id)) {
      if (one.study_id != study) continue;
      ASSERT_TRUE(casedb::give_consent(library_, person_id, one.text_id).has_value());
      if (withdraw) {
        ASSERT_TRUE(casedb::withdraw_consent(library_, person_id, one.text_id).has_value());
      }
    }
  }
  void SetUp() override {
    casedb::NewCase made;
    made.title = "Kidney";
    made.origin = "import";
    made.volume = volume::make_volume({8, 8, 8}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {0.0, 0.0, 0.0});
    made.skin.vertices_lps_mm = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
    made.skin.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    made.skin.cut = {0, 0, 0, 0};
    case_id_ = casedb::add_case(library_, made);
    lesion_id_ = casedb::add_lesion(library_, case_id_, {{4.0, 4.0, 4.0}, 2.0, 20.0}).value();
    for (const Role role : casedb::kAllRoles)
      readers_[role] = casedb::add_user(library_, casedb::name_of(role), role, kPassword).value();
    const std::string own = casedb::add_cohort(library_, "Own", "Radiology", "").value(),
                      others = casedb::add_cohort(library_, "Others", "Surgery", "").value();
    ASSERT_TRUE(casedb::enrol(library_, own, readers_[Role::mentor], casedb::Post::mentor).has_value());
    ASSERT_TRUE(casedb::appoint_director(library_, "Radiology", readers_[Role::director]).has_value());
    const std::string study = casedb::add_study(library_, "Needles").value(),
                      other = casedb::add_study(library_, "Probes").value();
    ASSERT_TRUE(casedb::add_researcher(library_, study, readers_[Role::researcher]).has_value());
    for (const auto& text : {std::optional(study), std::optional(other), std::optional<std::string>()})
      ASSERT_TRUE(casedb::add_consent_text(library_, text, "May we?").has_value());
    for (const InCohort cohort : kCohorts)
      for (const Says says : kConsents) {
        Subject& one = subjects_.emplace_back();
        one.cohort = cohort;
        one.says = says;
        one.name = "Learner No " + std::to_string(subjects_.size()) + " of them";
        one.person_id = casedb::add_user(library_, one.name, Role::trainee, kPassword).value();
        if (cohort != InCohort::none) {
          const std::string& in = cohort == InCohort::others ? others : own;
          ASSERT_TRUE(casedb::enrol(library_, in, one.person_id, casedb::Post::learner).has_value());
        }
        if (cohort == InCohort::left) {
          ASSERT_TRUE(casedb::end_enrolment(library_, own, one.person_id).has_value());
        }
        if (says == Says::study) answer(one.person_id, study, false);
        if (says == Says::other_study) answer(one.person_id, other, false);
        if (says == Says::library || says == Says::withdrawn_but_library)
          answer(one.person_id, std::nullopt, false);
        if (says == Says::withdrawn_from_study || says == Says::withdrawn_but_library)
          answer(one.person_id, study, true);
        one.attempt_id = attempt_of(one.person_id);
      }
  }
  static Relation to(Role role, const Subject& subject) {
    Relation relation;
    relation.own_cohort = role == Role::mentor && subject.cohort == InCohort::own;
    relation.own_programme = role == Role::director && subject.cohort == InCohort::own;
    relation.own_study = role == Role::researcher && (subject.says == Says::study || subject.says == Says::library);
    return relation;
  }
};

TEST_F(PeopleMatrix, EveryRouteOfAnAttemptAnswersAsTheTableSays) {
  const std::string simulated = attempt_of(std::nullopt), own_of_trainee = attempt_of(readers_[Role::trainee]);
  FakeSite world;
  const HeavyWork work{{}, [](casedb::Library&, const std::string&) {
                         return base::Result<reports::DrawnPictures>({"", {{std::byte{1}}}});
                       }};
  const auto questions = std::move(questions_of(std::move(library_), work).value());
  Site site{*questions, world.surroundings, routes()};
  int checks = 0, allowed = 0;
  for (const Role role : casedb::kAllRoles) {
    FakeBrowser browser(site);
    ASSERT_EQ(browser.log_in_as(role).status, 303);
    std::string lists;
    for (const char* page : {"1"}) lists += browser.get(std::string("/attempts?page=") + page).body;
    const auto look = [&](const std::string& attempt_id, const Relation& relation, const std::string& name) {
      for (const Route& route : routes()) {
        const std::size_t hole = route.pattern.find("{attempt_id}");
        if (hole == route.pattern.npos || route.method != "GET") continue;
        const bool may = casedb::may(role, *route.who.action, relation);
        const std::string path = std::string(route.pattern.substr(0, hole)) + attempt_id +
                                 std::string(route.pattern.substr(hole + std::string_view("{attempt_id}").size()));
        const Response response = browser.get(path);
        EXPECT_EQ(response.status, may ? 200 : 404) << casedb::name_of(role) << " " << name << " " << path;
        if (!casedb::may(role, Action::see_operator_name, relation)) {
          EXPECT_EQ(response.body.find(name), std::string::npos) << casedb::name_of(role) << " reads " << name;
        }
        ++checks;
        allowed += may ? 1 : 0;
      }
      EXPECT_EQ(lists.find(attempt_id) != lists.npos, casedb::may(role, Action::see_attempt, relation))
          << casedb::name_of(role) << " " << name;
      EXPECT_EQ(lists.find(name) != lists.npos, casedb::may(role, Action::see_operator_name, relation))
          << casedb::name_of(role) << " " << name;
    };
    for (const Subject& subject : subjects_) look(subject.attempt_id, to(role, subject), subject.name);
    Relation nobodys, own;
    nobodys.nobodys = true;
    own.own = role == Role::trainee;
    look(simulated, nobodys, "no such name");
    if (role == Role::trainee) look(own_of_trainee, own, "<bdi>trainee</bdi>");
  }
  EXPECT_EQ(checks, (5 * (4 * 6 + 1) + 1) * 8);
  EXPECT_EQ(allowed, (1 + 6 + 6 + 8 + 2) * 8 - 8 * 4)
      << "own; the mentor's and the director's six; two consents in four cohorts, without their recordings; "
         "simulated for two roles";
}

// How far somebody is, their mentor and their director read by name, themselves too, and nobody else; the list
// holds exactly those whose page opens.
TEST_F(PeopleMatrix, HowFarSomebodyIsAnswersAsTheTableSays) {
  const auto readers = readers_;
  FakeSite world;
  const auto questions = std::move(questions_of(std::move(library_)).value());
  Site site{*questions, world.surroundings, routes()};
  int checks = 0, allowed = 0;
  for (const Role role : casedb::kAllRoles) {
    FakeBrowser browser(site);
    ASSERT_EQ(browser.log_in_as(role).status, 303);
    const Response list = browser.get("/progress");
    EXPECT_EQ(list.status, casedb::roles_that_may(Action::see_progress).has(role) ? 200 : 404);
    const auto look = [&](const std::string& person_id, const Relation& relation, const std::string& name) {
      const bool may = casedb::may(role, Action::see_progress, relation);
      for (const char* end : {"", "/record", "/progress.json"}) {
        const Response response = browser.get("/progress/" + person_id + end);
        EXPECT_EQ(response.status, may ? 200 : 404) << casedb::name_of(role) << " " << name << end;
        const bool is_page = !std::string_view(end).ends_with(".json");
        EXPECT_EQ(response.body.find(is_page || !relation.own ? name : "\"trainee\"") != std::string::npos, may)
            << casedb::name_of(role) << " " << name;
        ++checks;
        allowed += may ? 1 : 0;
      }
      EXPECT_EQ(list.body.find("/progress/" + person_id) != std::string::npos, may && !relation.own)
          << casedb::name_of(role) << " " << name;
      if (!may) {
        EXPECT_EQ(list.body.find(name), std::string::npos) << casedb::name_of(role) << " " << name;
      }
    };
    for (const Subject& subject : subjects_) look(subject.person_id, to(role, subject), subject.name);
    Relation own;
    own.own = role == Role::trainee;
    if (role == Role::trainee) look(readers.at(role), own, "<bdi>trainee</bdi>");
  }
  EXPECT_EQ(checks, (5 * 4 * 6 + 1) * 3);
  EXPECT_EQ(allowed, (6 + 6 + 1) * 3) << "the mentor's and the director's six, and the trainee";
}

// A cohort is named to its mentor and to the director of its programme, whoever its learners are; other directors
// read counts, and of a cohort of one nothing.
TEST_F(PeopleMatrix, ACohortIsNamedByWhoseItIsNotByWhoIsInIt) {
  const std::string lone = casedb::add_cohort(library_, "Remediation", "Surgery", "").value(),
                    empty = casedb::add_cohort(library_, "Begins in May", "Radiology", "").value();
  const Subject& own = *std::find_if(subjects_.begin(), subjects_.end(),
                                     [](const Subject& one) { return one.cohort == InCohort::own; });
  ASSERT_TRUE(casedb::enrol(library_, lone, own.person_id, casedb::Post::learner).has_value());
  ASSERT_TRUE(casedb::enrol(library_, empty, readers_[Role::mentor], casedb::Post::mentor).has_value());
  FakeSite world;
  const auto questions = std::move(questions_of(std::move(library_)).value());
  Site site{*questions, world.surroundings, routes()};
  for (const Role role : casedb::kAllRoles) {
    FakeBrowser browser(site);
    ASSERT_EQ(browser.log_in_as(role).status, 303);
    const Response response = browser.get("/cohorts");
    ASSERT_EQ(response.status, casedb::roles_that_may(Action::see_cohort).has(role) ? 200 : 404);
    if (response.status != 200) continue;
    const auto row = [&](const std::string& title) {
      const std::size_t at = response.body.find("<bdi>" + title + "</bdi>");
      return at == std::string::npos ? std::string()
                                     : response.body.substr(at, response.body.find("</tr>", at) - at);
    };
    for (const auto& [title, programme] : {std::pair{"Own", "Radiology"},
                                           {"Others", "Surgery"},
                                           {"Remediation", "Surgery"},
                                           {"Begins in May", "Radiology"}}) {
      const bool is_own = std::string(programme) == "Radiology";
      const bool told = is_own || casedb::may(role, Action::see_cohort_cells);
      EXPECT_EQ(!row(title).empty(), told) << casedb::name_of(role) << " " << title;
      for (const Subject& one : subjects_)
        if (!is_own || one.cohort != InCohort::own) {
          EXPECT_EQ(row(title).find(one.name), std::string::npos) << casedb::name_of(role) << " " << title;
        }
    }
    EXPECT_NE(row("Own").find(own.name), std::string::npos);
    if (role == Role::director) {
      EXPECT_NE(row("Remediation").find("withheld"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace seldinger::web
