// Ids in places where they are not the reader's to use: every id of a library, of whatever it is, those of nothing
// and their neighbours, in every route that takes one, for two readers of every role. What is not theirs answers
// byte for byte as what is not there, headers too.
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "casedb/attempts/comments.h"
#include "casedb/cases/authoring.h"
#include "casedb/cases/permissions.h"
#include "casedb/cases/versions.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/sound_check.h"
#include "tests/web/fake_site.h"
#include "web/library_questions.h"
#include "web/routes/routes.h"

namespace seldinger::web {
namespace {

using casedb::Action;
using casedb::Relation;
using casedb::Role;

constexpr int kSites = 2, kLearnersOfSite = 12;

class SwappedIds : public testing::Test {
 protected:
  struct Reader {
    std::string name, person_id;
    Role role = Role::trainee;
    int site = 0;  // whose cohort, programme or study is theirs
  };
  struct Learner {
    std::string person_id;
    int site = 0;
    bool consents = false;
  };
  std::filesystem::path folder_ = fixtures::fresh_test_folder("web") / "library";
  std::vector<Reader> readers_;
  std::vector<Learner> learners_;
  std::map<std::string, std::string> whose_;        // by attempt; empty: a simulation of nobody
  std::map<std::string, casedb::CaseState> cases_;  // by id
  std::map<std::string, int> studies_;              // of which site, by id
  std::set<std::string> others_;                    // ids of what no route of these takes
  std::string lesion_id_, attempted_case_;

  std::string add_attempt(casedb::Library& library, const std::optional<std::string>& person_id) {
    casedb::NewAttempt attempt;
    attempt.case_id = attempted_case_;
    attempt.lesion_id = lesion_id_;
    attempt.operator_name = person_id ? casedb::kPersonOperator : "expert";
    attempt.person_id = person_id;
    attempt.started_us = 1'700'000'000'000'000 + static_cast<std::int64_t>(whose_.size());
    attempt.recording.inputs.resize(3);
    attempt.recording.hashes.resize(3);
    attempt.metrics = {{"hit", 1, 1.0, "bool", ""}};
    for (const unsigned char c : std::string_view("\x89PNG\r\n\x1a\nrest"))
      attempt.picture_png.push_back(std::byte{c});
    const std::string id = casedb::add_attempt(library, attempt).value();
    whose_[id] = person_id.value_or("");
    return id;
  }
  std::string add_case(casedb::Library& library, casedb::CaseState state) {
    casedb::NewCase made;
    made.title = "Kidney of nobody's business";
    made.origin = "import";
    made.volume = volume::make_volume({8, 8, 8}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {0.0, 0.0, 0.0});
    made.skin.vertices_lps_mm = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
    made.skin.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
    made.skin.cut = {0, 0, 0, 0};
    const std::string id = casedb::add_case(library, made);
    const std::string lesion_id = casedb::add_lesion(library, id, {{4.0, 4.0, 4.0}, 2.0, 20.0}).value();
    others_.insert(lesion_id);
    cases_[id] = state;
    if (state == casedb::CaseState::draft) {
      attempted_case_ = id;
      lesion_id_ = lesion_id;
      return id;
    }
    static_cast<void>(casedb::confirm_no_burned_in_text(library, id, std::nullopt));
    EXPECT_TRUE(
        casedb::publish_case(library, id, fixtures::sound_check(library, id), "mentor 0", true).has_value());
    if (state == casedb::CaseState::retired) {
      EXPECT_TRUE(casedb::retire_case(library, id, "mentor 0").has_value());
    }
    return id;
  }
  void SetUp() override {
    auto library = std::move(casedb::Library::open_or_create(folder_).value());
    for (const Role role : casedb::kAllRoles)
      for (int site = 0; site < kSites; ++site) {
        const std::string name = casedb::name_of(role) + " " + std::to_string(site);
        readers_.push_back({name, casedb::add_user(library, name, role, kPassword).value(), role, site});
      }
    const auto reader = [&](Role role, int site) {
      return std::find_if(readers_.begin(), readers_.end(),
                          [&](const Reader& one) { return one.role == role && one.site == site; })
          ->person_id;
    };
    std::vector<std::string> cohorts;
    for (int site = 0; site < kSites; ++site) {
      const std::string programme = "Programme " + std::to_string(site);
      cohorts.push_back(casedb::add_cohort(library, "Cohort " + std::to_string(site), programme, "").value());
      others_.insert(cohorts.back());
      ASSERT_TRUE(
          casedb::enrol(library, cohorts.back(), reader(Role::mentor, site), casedb::Post::mentor).has_value());
      ASSERT_TRUE(casedb::appoint_director(library, programme, reader(Role::director, site)).has_value());
      const std::string study = casedb::add_study(library, "Study " + std::to_string(site)).value();
      studies_[study] = site;
      ASSERT_TRUE(casedb::add_researcher(library, study, reader(Role::researcher, site)).has_value());
      ASSERT_TRUE(casedb::add_consent_text(library, study, "May we?").has_value());
    }
    add_case(library, casedb::CaseState::published);
    add_case(library, casedb::CaseState::retired);
    add_case(library, casedb::CaseState::draft);
    const auto join = [&](const Learner& one) {
      ASSERT_TRUE(
          casedb::enrol(library, cohorts[static_cast<std::size_t>(one.site)], one.person_id, casedb::Post::learner)
              .has_value());
      if (!one.consents) return;
      for (const casedb::Consent& text : casedb::list_consents(library, one.person_id))
        if (text.study_title == "Study " + std::to_string(one.site)) {
          ASSERT_TRUE(casedb::give_consent(library, one.person_id, text.text_id).has_value());
        }
    };
    for (int site = 0; site < kSites; ++site) {
      learners_.push_back({reader(Role::trainee, site), site, false});
      for (int i = 1; i < kLearnersOfSite; ++i) {
        const std::string name = "Learner No " + std::to_string(site * 100 + i) + " of them";
        learners_.push_back({casedb::add_user(library, name, Role::trainee, kPassword).value(), site, i % 2 == 0});
      }
    }
    for (const Learner& one : learners_) {
      join(one);
      for (int i = 0; i < 2; ++i) add_attempt(library, one.person_id);
    }
    for (int i = 0; i < 2; ++i) add_attempt(library, std::nullopt);
    library.act_for(casedb::Actor::person(reader(Role::mentor, 0)));
    for (const auto& [attempt_id, person_id] : whose_)
      if (person_id == learners_.front().person_id) {
        ASSERT_TRUE(casedb::add_comment(library, attempt_id, 0.0, "Well done").has_value());
      }
    for (casedb::Statement rows = library.database().prepare(
             "SELECT comment_id AS id FROM attempt_comment UNION SELECT text_id FROM consent_text");
         rows.step();)
      others_.insert(rows.text("id"));
  }
  // What somebody is to a reader, from how they were made.
  Relation to(const Reader& reader, const std::string& person_id) const {
    Relation relation;
    relation.nobodys = person_id.empty();
    relation.own = person_id == reader.person_id;
    const auto found = std::find_if(learners_.begin(), learners_.end(),
                                    [&](const Learner& one) { return one.person_id == person_id; });
    if (found == learners_.end() || found->site != reader.site) return relation;
    relation.own_cohort = reader.role == Role::mentor;
    relation.own_programme = reader.role == Role::director;
    relation.own_study = reader.role == Role::researcher && found->consents;
    return relation;
  }
  bool may(const Reader& reader, const Route& route, const std::string& id) const {
    if (route.pattern.find("{attempt_id}") != route.pattern.npos) {
      const auto found = whose_.find(id);
      return found != whose_.end() && casedb::may(reader.role, *route.who.action, to(reader, found->second));
    }
    if (route.pattern.find("{case_id}") != route.pattern.npos) {
      const auto found = cases_.find(id);
      return found != cases_.end() && casedb::may(reader.role, *route.who.action, found->second);
    }
    if (route.pattern.find("{job_id}") != route.pattern.npos) return false;  // none of these ids is a job's
    if (route.pattern.find("{study_id}") != route.pattern.npos) {
      const auto found = studies_.find(id);
      Relation relation;
      relation.own_study =
          found != studies_.end() && reader.role == Role::researcher && found->second == reader.site;
      return found != studies_.end() && casedb::may(reader.role, *route.who.action, relation);
    }
    const bool known =
        std::any_of(learners_.begin(), learners_.end(), [&](const auto& one) { return one.person_id == id; }) ||
        std::any_of(readers_.begin(), readers_.end(), [&](const auto& one) { return one.person_id == id; });
    return known && casedb::may(reader.role, *route.who.action, to(reader, id));
  }
  // Every id there is, and of each kind some that there are not: a digit away, and any.
  std::vector<std::string> ids() const {
    std::set<std::string> all = others_;
    for (const auto& [id, whose] : whose_) all.insert(id);
    for (const auto& [id, state] : cases_) all.insert(id);
    for (const auto& [id, site] : studies_) all.insert(id);
    for (const Learner& one : learners_) all.insert(one.person_id);
    for (const Reader& one : readers_) all.insert(one.person_id);
    const std::vector<std::string> there(all.begin(), all.end());
    for (std::size_t i = 0; i < there.size(); ++i) {
      std::string neighbour = there[i];
      char& digit = neighbour[35 - i % 12];
      digit = digit == '0' ? '1' : '0';
      all.insert(neighbour);
    }
    for (int i = 0; i < 20; ++i) all.insert(casedb::new_uuid());
    return {all.begin(), all.end()};
  }
};

TEST_F(SwappedIds, TenThousandOfThemLeakNothing) {
  FakeSite world;
  const HeavyWork work{
      [](casedb::Library& library, const std::string& case_id) { return fixtures::sound_check(library, case_id); },
      [](casedb::Library&, const std::string&) {
        return base::Result<reports::DrawnPictures>({"<figure></figure>", {{std::byte{1}}}});
      }};
  const auto questions = std::move(questions_of(std::move(casedb::Library::open(folder_).value()), work).value());
  Site site{*questions, world.surroundings, routes()};
  const std::vector<std::string> all = ids();
  const std::string nothing = "0190a1b2-0000-7000-8000-0000000000ff";
  int asked = 0, seen = 0, changed = 0;
  for (const Reader& reader : readers_) {
    FakeBrowser browser(site);
    ASSERT_EQ(browser.log_in(reader.name, "correct+horse%20battery").status, 303) << reader.name;
    const std::string token = form_token(browser.get("/me").body, "/me/facts");
    for (const Route& route : routes()) {
      const std::size_t hole = route.pattern.find('{');
      if (hole == route.pattern.npos) continue;
      const std::string begin(route.pattern.substr(0, hole)),
          end(route.pattern.substr(route.pattern.find('}') + 1));
      const bool is_change = route.method == "POST", is_comment = end == "/comments";
      const auto answer = [&](const std::string& id) {
        return is_change ? browser.post(begin + id + end, "at=0&text=So+it+is&token=" + token)
                         : browser.get(begin + id + end);
      };
      const std::string missing = bytes_of(answer(nothing), true);
      EXPECT_TRUE(missing.starts_with("HTTP/1.1 404"));
      for (const std::string& id : all) {
        ++asked;
        const Response response = answer(id);
        if (may(reader, route, id)) {
          EXPECT_EQ(response.status, is_comment ? 303 : 200) << reader.name << " " << begin << id << end;
          ++(is_comment ? changed : seen);
        } else {
          ASSERT_EQ(bytes_of(response, true), missing) << reader.name << " " << begin << id << end;
        }
      }
    }
  }
  EXPECT_GE(asked, 10'000);
  EXPECT_GT(seen, 500) << "a site that answers nobody leaks nothing";
  EXPECT_GT(changed, 20);
  EXPECT_EQ(
      std::move(casedb::Library::open(folder_).value()).database().integer("SELECT count(*) FROM attempt_comment"),
      changed + 2)
      << "nothing is written of what is not theirs";
}

// Ids and titles that stand in a query or a form.
TEST_F(SwappedIds, InAQueryOrAFormTheyTellAsLittle) {
  FakeSite world;
  const auto questions = std::move(questions_of(std::move(casedb::Library::open(folder_).value())).value());
  Site site{*questions, world.surroundings, routes()};
  for (const Reader& reader : readers_) {
    FakeBrowser browser(site);
    ASSERT_EQ(browser.log_in(reader.name, "correct+horse%20battery").status, 303);
    const std::string page = browser.get("/progress?cohort=no+such&curriculum=" + casedb::new_uuid()).body;
    EXPECT_EQ(
        browser
            .get("/progress?cohort=Cohort+" + std::to_string(1 - reader.site) + "&curriculum=" + casedb::new_uuid())
            .body,
        page)
        << reader.name;
    const std::string token = form_token(browser.get("/me").body, "/me/facts");
    const std::string refused = bytes_of(browser.post("/log-ins", "person=x&token=" + token), true);
    for (const Learner& one : learners_) {
      const Response response = browser.post("/log-ins", "person=" + one.person_id + "&token=" + token);
      if (reader.role != Role::admin) {
        EXPECT_EQ(bytes_of(response, true), refused) << reader.name;
      }
    }
  }
}

}  // namespace
}  // namespace seldinger::web
