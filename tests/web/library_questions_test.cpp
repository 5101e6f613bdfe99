// The pages over a real library on disk: an attempt that was stored is found, shown and guarded.
#include "web/library_questions.h"

#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>
#include <map>
#include <thread>

#include "casedb/cases/authoring.h"
#include "casedb/cases/versions.h"
#include "casedb/database/audit.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/keeping/erase.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "reports/pages/case_page.h"
#include "tests/fixtures/cohort.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/sound_check.h"
#include "tests/fixtures/until.h"
#include "tests/web/fake_site.h"
#include "tests/web/raw_client.h"

namespace seldinger::web {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

casedb::Library fresh_library() {
  return std::move(casedb::Library::open_or_create(fixtures::fresh_test_folder("web") / "library").value());
}

// One case with one lesion; answers its ids.
std::pair<std::string, std::string> add_small_case(casedb::Library& library) {
  casedb::NewCase new_case;
  new_case.title = "Kidney <b>A</b>";
  new_case.origin = "import";
  new_case.volume = volume::make_volume({8, 8, 8}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {0.0, 0.0, 0.0});
  new_case.skin.vertices_lps_mm = {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 6}};
  new_case.skin.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  new_case.skin.cut = {0, 0, 0, 0};
  new_case.slices_used = 8;
  const std::string case_id = casedb::add_case(library, new_case);
  return {case_id, casedb::add_lesion(library, case_id, {{4.0, 4.0, 4.0}, 2.0, 20.0}).value()};
}

std::string add_small_attempt(casedb::Library& library, std::optional<std::string> person_id) {
  const auto [case_id, lesion_id] = add_small_case(library);
  casedb::NewAttempt attempt;
  attempt.case_id = case_id;
  attempt.lesion_id = lesion_id;
  attempt.operator_name = person_id.has_value() ? casedb::kPersonOperator : "expert";
  attempt.person_id = std::move(person_id);
  attempt.program_version = "0.1.0";
  attempt.started_us = 1700000000000000;
  attempt.duration_s = 0.5;
  for (int tick = 0; tick < 500; ++tick) {
    attempt.recording.inputs.push_back({});
    attempt.recording.hashes.push_back(static_cast<std::uint32_t>(tick));
  }
  for (int i = 0; i < 50; ++i) {
    cases::PoseSample pose;
    pose.t_s = 0.01 * i;
    pose.tip_lps_mm = {4.0, 4.0, 4.0 + 0.1 * (49 - i)};
    attempt.recording.poses.push_back(pose);
  }
  attempt.metrics = {{"hit", 1, 1.0, "bool", ""}, {"vis_joint", 1, std::nullopt, "share", "no_endpoint"}};
  attempt.steps = {{"insert", assessment::kStepsVersion, assessment::StepState::violated, 0.4, ""}};
  for (const unsigned char c : std::string_view("\x89PNG\r\n\x1a\nrest"))
    attempt.picture_png.push_back(std::byte{c});
  return casedb::add_attempt(library, attempt).value();
}

// The site over a real library, with the fakes' chance and clock.
struct RealSite {
  explicit RealSite(casedb::Library library) : questions(std::move(questions_of(std::move(library)).value())) {}
  FakeSite world;
  std::unique_ptr<Questions> questions;
  Site site{*questions, world.surroundings, routes()};
};

TEST(LibraryQuestions, ATraineeSeesOwnGradesAndTheCaseThatIsDue) {
  casedb::Library library = fresh_library();
  ASSERT_TRUE(casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).has_value());
  ASSERT_TRUE(casedb::add_user(library, "Dan", casedb::Role::director, kPassword).has_value());
  const std::string tom = casedb::add_user(library, "Tom", casedb::Role::trainee, kPassword).value();
  fixtures::make_cohort(library, "Mia", {"Tom"});
  const auto [case_id, lesion_id] = add_small_case(library);
  casedb::CaseSetting setting = casedb::find_case(library, case_id).value();
  setting.rule.criteria = {*assessment::criterion_from("hit >= 1"),
                           *assessment::criterion_from("skin_punctures <= 1")};
  ASSERT_TRUE(casedb::set_setting(library, case_id, setting).has_value());
  ASSERT_TRUE(casedb::confirm_no_burned_in_text(library, case_id, std::nullopt).has_value());
  const casedb::CaseCheck check = fixtures::sound_check(library, case_id);
  ASSERT_TRUE(casedb::publish_case(library, case_id, check, "Mia", true).has_value());
  const std::string curriculum = casedb::add_curriculum(library, "First year", "Mia").value();
  ASSERT_TRUE(casedb::add_curriculum_item(library, curriculum, case_id, 5, {}, "Mia").has_value());
  ASSERT_TRUE(casedb::publish_curriculum(library, curriculum, "Dan").has_value());
  casedb::NewAttempt attempt;
  attempt.case_id = case_id;
  attempt.lesion_id = lesion_id;
  attempt.operator_name = casedb::kPersonOperator;
  attempt.person_id = tom;
  attempt.started_us = 1700000000000000;
  attempt.recording.inputs.resize(3);
  attempt.recording.hashes.resize(3);
  attempt.metrics = {{"gap_share", 2, 0.0, "share", ""},
                     {"sample_rate_p5", 1, 1000.0, "Hz", ""},
                     {"tracking_jumps", 1, 0.0, "count", ""},
                     {"hit", setting.rule.criteria[0].version, 1.0, "bool", ""},
                     {"skin_punctures", setting.rule.criteria[1].version, 3.0, "count", ""}};
  const std::string attempt_id = casedb::add_attempt(library, attempt).value();
  RealSite real(std::move(library));
  FakeBrowser browser(real.site);
  ASSERT_EQ(browser.log_in("Tom", "correct+horse%20battery").status, 303);
  EXPECT_THAT(browser.get("/attempts").body, HasSubstr("<span class=\"no\">Not passed</span>"));
  const std::string page = browser.get("/attempts/" + attempt_id).body;
  EXPECT_THAT(page, HasSubstr("Punctured the skin 3 times; to pass: at most 1."));
  EXPECT_THAT(page, HasSubstr("Not passed: 1 of 2 criteria not met"));
  EXPECT_THAT(page, HasSubstr("provisional"));
  EXPECT_THAT(browser.get("/attempts/" + attempt_id + "/grade.json").body, HasSubstr("\"verdict\":\"failed\""));
  const std::string curricula = browser.get("/curricula").body;
  EXPECT_THAT(curricula, HasSubstr("First year"));
  const std::string progress = browser.get("/progress").body;
  EXPECT_THAT(progress, HasSubstr("Practising <span class=\"mark due\">due</span>"));
  EXPECT_THAT(progress, HasSubstr("4 attempts left"));
  EXPECT_THAT(progress, HasSubstr("0 of 1 graded attempts passed")) << "and how they learn";
  EXPECT_THAT(browser.get("/").body, HasSubstr("Punctured the skin 3 times; to pass: at most 1."));
  browser.cookies.clear();
  ASSERT_EQ(browser.log_in("Dan", "correct+horse%20battery").status, 303);
  const std::string directors = browser.get("/curricula").body;
  EXPECT_THAT(directors, HasSubstr("First year"));
  EXPECT_THAT(directors, Not(HasSubstr("Practising"))) << "a director sees no person's state";
}

TEST(LibraryQuestions, AStoredAttemptIsListedShownAndItsPictureServed) {
  casedb::Library library = fresh_library();
  ASSERT_TRUE(casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).has_value());
  const std::string attempt_id = add_small_attempt(library, std::nullopt);
  RealSite real(std::move(library));
  FakeBrowser browser(real.site);
  ASSERT_EQ(browser.log_in("mia", "correct+horse+battery").status, 303);
  EXPECT_THAT(browser.get("/attempts").body, HasSubstr("/attempts/" + attempt_id));
  const std::string page = browser.get("/attempts/" + attempt_id).body;
  for (const char* piece :
       {"Kidney &lt;b&gt;A&lt;/b&gt;", "Simulated expert", "<dd>Yes</dd>",
        "— <span class=\"why\">the needle was neither fired nor declared to be on target</span>",
        "From 4.9 mm at the start to 0.0 mm at the end",
        "Insert the needle; a patient&#39;s skin must be numb</summary>", "<span class=\"no\">✗ wrong</span>",
        "LPS (4.0, 4.0, 4.0) mm, diameter 4.0 mm"}) {
    EXPECT_THAT(page, HasSubstr(piece));
  }
  EXPECT_THAT(browser.get("/attempts/" + attempt_id + "/picture.png").body, StartsWith("\x89PNG"));
}

TEST(LibraryQuestions, TraineesSeeTheirOwnAndNobodyElses) {
  casedb::Library library = fresh_library();
  const std::string tom = casedb::add_user(library, "Tom", casedb::Role::trainee, kPassword).value();
  ASSERT_TRUE(casedb::add_user(library, "Ute", casedb::Role::trainee, kPassword).has_value());
  const std::string attempt_id = add_small_attempt(library, tom);
  RealSite real(std::move(library));
  FakeBrowser browser(real.site), other(real.site);
  ASSERT_EQ(browser.log_in("Tom", "correct+horse+battery").status, 303);
  ASSERT_EQ(other.log_in("Ute", "correct+horse+battery").status, 303);
  EXPECT_EQ(browser.get("/attempts/" + attempt_id).status, 200);
  EXPECT_EQ(other.get("/attempts/" + attempt_id).status, 404);
  EXPECT_THAT(browser.get("/attempts").body, HasSubstr(attempt_id));
  EXPECT_THAT(other.get("/attempts").body, Not(HasSubstr(attempt_id)));
}

TEST(LibraryQuestions, DisablingAnAccountElsewhereEndsItsSession) {
  casedb::Library library = fresh_library();
  ASSERT_TRUE(casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).has_value());
  auto elsewhere = casedb::Library::open(library.folder());
  ASSERT_TRUE(elsewhere.has_value());
  RealSite real(std::move(library));
  FakeBrowser browser(real.site);
  ASSERT_EQ(browser.log_in("Mia", "correct+horse+battery").status, 303);
  EXPECT_EQ(browser.get("/attempts").status, 200);
  ASSERT_TRUE(casedb::set_enabled(*elsewhere, "Mia", false).has_value());
  EXPECT_EQ(browser.get("/attempts").status, 303);
  EXPECT_EQ(browser.log_in("Mia", "correct+horse+battery").status, 403);
}

TEST(LibraryQuestions, AChangedRoleEndsItsSessions) {
  casedb::Library library = fresh_library();
  ASSERT_TRUE(casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).has_value());
  auto elsewhere = casedb::Library::open(library.folder());
  RealSite real(std::move(library));
  FakeBrowser browser(real.site);
  ASSERT_EQ(browser.log_in("Mia", "correct+horse+battery").status, 303);
  ASSERT_TRUE(casedb::set_role(*elsewhere, "Mia", casedb::Role::trainee).has_value());
  EXPECT_EQ(header_of(browser.get("/attempts"), "Location"), "/login");
  // Closed and opened again, what was begun before stays over.
  ASSERT_EQ(browser.log_in("Mia", "correct+horse+battery").status, 303);
  ASSERT_TRUE(casedb::set_enabled(*elsewhere, "Mia", false).has_value());
  ASSERT_TRUE(casedb::set_enabled(*elsewhere, "Mia", true).has_value());
  EXPECT_EQ(header_of(browser.get("/attempts"), "Location"), "/login");
}

// Before, no log-in left a trace.
TEST(LibraryQuestions, WhoLogsInAndOutAndDecidesIsInTheAuditLog) {
  casedb::Library library = fresh_library();
  const std::string mia = casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).value();
  const std::string text_id = [&] {
    static_cast<void>(casedb::add_consent_text(library, std::nullopt, "May we?").value());
    return casedb::list_consents(library, mia).front().text_id;
  }();
  static_cast<void>(add_small_attempt(library, mia));
  auto elsewhere = casedb::Library::open(library.folder());
  const std::int64_t before = casedb::list_audit(library).back().sequence;
  RealSite real(std::move(library));
  FakeBrowser browser(real.site);
  ASSERT_EQ(browser.log_in("Mia", "wrong+password").status, 403);
  ASSERT_EQ(browser.log_in("Mia", "correct+horse+battery").status, 303);
  ASSERT_TRUE(real.questions->give_consent(mia, text_id));
  EXPECT_EQ(real.questions->erase_attempts_of(mia)->attempts, 1U);
  ASSERT_EQ(browser.post("/logout", "token=" + form_token(browser.get("/attempts").body, "/logout")).status, 303);
  std::vector<std::string> told;
  for (const casedb::AuditRow& row : casedb::list_audit(*elsewhere)) {
    if (row.sequence <= before) continue;
    told.push_back(row.act + " " + row.actor + " " + row.result);
    EXPECT_EQ(row.person_id == mia, row.actor == "person");
  }
  EXPECT_THAT(told,
              ::testing::ElementsAre("log_in nobody refused", "log_in person done", "give_consent person done",
                                     "erase_attempts person done", "log_out person done"));
  EXPECT_TRUE(casedb::problems_of_audit(*elsewhere).empty());
}

// Was: 4.7 s, as long as the log-out waited.
TEST(LibraryQuestions, AChangeThatWaitsForAnotherProgramHoldsUpNoPage) {
  casedb::Library library = fresh_library();
  const std::string mia = casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).value();
  auto elsewhere = casedb::Library::open(library.folder());
  auto questions = std::move(questions_of(std::move(library)).value());
  elsewhere->database().run("BEGIN IMMEDIATE");
  std::atomic<bool> begun = false, waited = false;
  std::thread leaving([&] {
    begun = true;
    EXPECT_NO_THROW(questions->log_out(mia));
    waited = true;
  });
  EXPECT_TRUE(fixtures::until([&] { return begun.load(); }));
  fixtures::let_pass(0.1);  // it is waiting: nothing tells when that begins
  EXPECT_EQ(questions->list_accounts().size(), 1U);
  EXPECT_FALSE(waited.load()) << "the page came while the log-out waited";
  elsewhere->database().run("ROLLBACK");
  leaving.join();
}

// Before, any act had every learner graded anew when they were next asked for, 12 ms each.
TEST(LibraryQuestions, OnlyWhoIsConcernedIsGradedAnew) {
  casedb::Library library = fresh_library();
  std::vector<std::string> people;
  for (const char* name : {"Ann", "Ben", "Cem", "Dan", "Eva"})
    people.push_back(casedb::add_user(library, name, casedb::Role::trainee, kPassword).value());
  const std::string cohort = casedb::add_cohort(library, "Autumn", "Radiology", "").value();
  ASSERT_TRUE(casedb::add_consent_text(library, std::nullopt, "May we?").has_value());
  const std::string text_id = casedb::list_consents(library, people[0]).front().text_id;
  casedb::Library other = std::move(casedb::Library::open(library.folder()).value());
  const auto questions = std::move(questions_of(std::move(library)).value());
  std::map<std::string, reports::Records> kept;
  // Who is graded when everybody is asked for: whose records are not those of before.
  const auto graded = [&] {
    std::string who;
    for (std::size_t i = 0; i < people.size(); ++i) {
      const reports::Records records = questions->records_of(people[i]).records;
      if (std::exchange(kept[people[i]], records) != records) who += "ABCDE"[i];
    }
    return who;
  };
  EXPECT_EQ(graded(), "ABCDE");
  EXPECT_EQ(graded(), "");
  ASSERT_TRUE(casedb::give_consent(other, people[0], text_id).has_value());
  ASSERT_TRUE(casedb::set_password(other, "Ben", "another long word").has_value());
  ASSERT_TRUE(casedb::add_user(other, "Fay", casedb::Role::mentor, kPassword).has_value());
  static_cast<void>(add_small_case(other));
  EXPECT_EQ(graded(), "");
  ASSERT_TRUE(casedb::enrol(other, cohort, people[1], casedb::Post::learner).has_value());
  EXPECT_EQ(graded(), "B");
  static_cast<void>(add_small_attempt(other, people[2]));
  EXPECT_EQ(graded(), "C");
  ASSERT_TRUE(casedb::end_enrolment(other, cohort, people[1]).has_value());
  static_cast<void>(add_small_attempt(other, people[4]));
  EXPECT_EQ(graded(), "BE");
  ASSERT_TRUE(casedb::erase_attempts_of(other, people[2], std::nullopt).has_value());
  EXPECT_EQ(graded(), "C");
  casedb::Transaction transaction(other.database());
  casedb::audit(other, casedb::Act::publish_curriculum, {"curriculum", casedb::new_uuid()});
  transaction.commit();
  EXPECT_EQ(graded(), "ABCDE");
}

// Was: 503 after five seconds, and a try that counted as failed; nobody got in when the disk was full.
TEST(LibraryQuestions, TheRightPasswordOpensALibraryThatCannotBeWritten) {
  casedb::Library library = fresh_library();
  ASSERT_TRUE(casedb::add_user(library, "Mia", casedb::Role::mentor, kPassword).has_value());
  auto elsewhere = casedb::Library::open(library.folder());
  RealSite real(std::move(library));
  FakeBrowser browser(real.site);
  elsewhere->database().run("BEGIN IMMEDIATE");
  EXPECT_EQ(browser.log_in("Mia", "correct+horse+battery").status, 303);
  EXPECT_EQ(browser.get("/attempts").status, 200);
  EXPECT_EQ(browser.log_in("Mia", "wrong+password").status, 403);
  EXPECT_THAT(real.world.log, ::testing::Contains(HasSubstr("security: logged in; ")));
  elsewhere->database().run("ROLLBACK");
}

TEST(OpenServer, AnswersOverALibraryWithRandomThatNobodyGuesses) {
  casedb::Library library = fresh_library();
  auto opened = open_server(std::move(library), {"127.0.0.1", 0}, "3.2.1", [](const std::string&) {});
  ASSERT_TRUE(opened.has_value());
  Server server = std::move(*opened);
  std::thread thread([&] { server.run(); });
  const auto ask = [&](const std::string& path) {
    RawClient client(server.port());
    client.send("GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n");
    return client.read_all();
  };
  EXPECT_THAT(ask("/healthz"), HasSubstr("\"version\":\"3.2.1\""));
  const std::string first = form_token(ask("/login"), "/login"), second = form_token(ask("/login"), "/login");
  EXPECT_EQ(first.size(), 64U);
  EXPECT_NE(first, second);
  server.stop();
  thread.join();
}

TEST(OpenServer, RefusesOtherHosts) {
  const auto opened = open_server(fresh_library(), {"0.0.0.0", 0}, "", [](const std::string&) {});
  ASSERT_FALSE(opened.has_value());
  EXPECT_EQ(opened.error().code, "not_loopback");
}

// What passing one case shows stands on the page of each case that can be passed, and is renewed when somebody
// stores something.
TEST(LibraryQuestions, TellWhatPassingACaseTells) {
  auto library = fresh_library();
  const std::string plain = add_small_case(library).first, graded = add_small_case(library).first;
  casedb::CaseSetting setting = casedb::find_case(library, graded).value();
  setting.rule.criteria.push_back(assessment::criterion_from("hit >= 1").value());
  ASSERT_TRUE(casedb::set_setting(library, graded, setting));
  const auto questions = std::move(questions_of(std::move(library)).value());
  EXPECT_FALSE(questions->find_case(plain)->dependability.has_value());
  const auto parts = questions->find_case(graded);
  ASSERT_TRUE(parts->dependability.has_value());
  EXPECT_EQ(parts->dependability->reason, "no_data");
  EXPECT_THAT(reports::case_page({"mona", "mentor", ""}, *parts), HasSubstr("Φ is not estimated"));
  EXPECT_EQ(questions->dependability().reason, "no_data");
}

}  // namespace
}  // namespace seldinger::web
