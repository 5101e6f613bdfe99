// Jobs: one after the other, by whom they were asked and no other, kept across a restart; and their pages, over a
// runner that the test leads.
#include "web/jobs/jobs.h"

#include <gmock/gmock.h>

#include <condition_variable>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>

#include "tests/fixtures/files.h"
#include "tests/fixtures/folders.h"
#include "tests/fixtures/until.h"
#include "tests/web/fake_site.h"
#include "web/site/base64url.h"

namespace seldinger::web {
namespace {

namespace fs = std::filesystem;
using casedb::Role;
using fixtures::until;
using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kAnn = "0190a1b2-0000-7000-8000-00000000aaaa", kBob = "0190a1b2-0000-7000-8000-00000000bbbb";

std::vector<std::byte> bytes(const std::string& text) {
  const auto all = std::as_bytes(std::span(text));
  return {all.begin(), all.end()};
}

// Does what the test says, when it says so.
struct Led {
  std::mutex mutex;
  std::condition_variable_any changed;
  bool may_end = true;
  int running = 0, most_running = 0;
  std::vector<std::string> ran;  // what each was asked for
  std::string files;             // what lay in the last one's
  JobEnd ending{true, "Done so", {}};

  JobRunner runner() {
    return [this](const Job& job, const fs::path& folder, const std::function<void(std::string_view)>& doing,
                  const std::stop_token& stop) {
      std::unique_lock lock(mutex);
      most_running = std::max(most_running, ++running);
      ran.push_back(job.wish.contains("title") ? job.wish.at("title") : "");
      files.clear();
      for (const JobFile& one : job.files) files += fixtures::whole_file(folder / "files" / one.name) + ";";
      doing("3 of 4, about 5 s");
      std::ofstream(folder / "results" / "answer.csv") << "1,2\n";
      changed.notify_all();
      changed.wait(lock, stop, [this] { return may_end; });
      --running;
      return may_end ? ending : JobEnd{};
    };
  }
  void let_end(bool may) {
    const std::lock_guard lock(mutex);
    may_end = may;
    changed.notify_all();
  }
};

class JobsTest : public testing::Test {
 protected:
  std::shared_ptr<Jobs> open() {
    return std::make_shared<Jobs>(
        folder_, led_.runner(), [this] { return now_us_.load(); }, limits_);
  }
  bool reaches(Jobs& jobs, const std::string& person, const std::string& id, JobState state) {
    return until([&] {
      const auto job = jobs.find(person, id);
      return job && job->state == state;
    });
  }
  fs::path folder_ = fixtures::fresh_test_folder("web") / "jobs";
  std::atomic<std::int64_t> now_us_ = 1'700'000'000'000'000;
  JobLimits limits_;
  Led led_;
};

TEST_F(JobsTest, OneRunsAtATimeInTheOrderInWhichTheyWereAsked) {
  led_.let_end(false);
  const auto jobs = open();
  std::vector<std::string> ids;
  for (const char* title : {"first", "second", "third"})
    ids.push_back(jobs->ask(kAnn, JobKind::study_report, {{"title", title}}).value());
  ASSERT_TRUE(reaches(*jobs, kAnn, ids[0], JobState::running));
  ASSERT_TRUE(until([&] { return jobs->find(kAnn, ids[0])->doing == "3 of 4, about 5 s"; }));
  EXPECT_EQ(jobs->find(kAnn, ids[1])->state, JobState::waiting);
  const auto refused = jobs->ask(kAnn, JobKind::study_report, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, "too_many_jobs");
  EXPECT_TRUE(jobs->ask(kBob, JobKind::study_report, {{"title", "another's"}}));
  led_.let_end(true);
  ASSERT_TRUE(reaches(*jobs, kAnn, ids[2], JobState::done));
  ASSERT_TRUE(until([&] { return jobs->list(kBob)[0].state == JobState::done; }));
  EXPECT_EQ(led_.ran, (std::vector<std::string>{"first", "second", "third", "another's"}));
  EXPECT_EQ(led_.most_running, 1);
  const Job done = *jobs->find(kAnn, ids[0]);
  EXPECT_EQ(done.said, "Done so");
  EXPECT_EQ(done.results, (std::vector<JobFile>{{"answer.csv", 4}}));
  EXPECT_EQ(jobs->load_result(kAnn, ids[0], 0).value(), bytes("1,2\n"));
  EXPECT_FALSE(jobs->load_result(kAnn, ids[0], 1));
  EXPECT_EQ(jobs->list(kAnn).front().job_id, ids[2]) << "newest first";
}

TEST_F(JobsTest, FilesComeInPiecesInOrder) {
  limits_.most_sent_bytes = 12;
  const auto jobs = open();
  const std::string id = jobs->ask(kAnn, JobKind::import_ct, {}).value();
  const auto send = [&](std::size_t number, const std::string& ending, std::uint64_t at, const std::string& text) {
    const auto taken = jobs->receive(kAnn, id, number, ending, at, bytes(text));
    return taken ? "" : taken.error().code;
  };
  EXPECT_EQ(jobs->all_sent(kAnn, id).error().code, "bad_piece") << "nothing came yet";
  EXPECT_EQ(send(1, "dcm", 0, "x"), "bad_piece");
  EXPECT_EQ(send(0, "dcm", 5, "x"), "bad_piece");
  for (const char* ending : {"../../x", "nhdr", "", "dcm/x", "DCM"})
    EXPECT_EQ(send(0, ending, 0, "x"), "bad_piece");
  EXPECT_EQ(send(SIZE_MAX, "dcm", 0, "x"), "bad_piece") << "its next number is 0";
  EXPECT_EQ(send(0, "other", 0, "x"), "");
  EXPECT_EQ(send(0, "nii", 0, "xyz"), "");
  EXPECT_EQ(send(1, "dcm", 0, "12345678"), "");
  EXPECT_EQ(send(0, "dcm", 0, "abc"), "") << "begun anew, by a page that was loaded again";
  EXPECT_EQ(jobs->find(kAnn, id)->files, (std::vector<JobFile>{{"0000.dcm", 3}}));
  EXPECT_EQ(send(0, "dcm", 3, "def"), "");
  EXPECT_EQ(send(1, "nii.gz", 0, "123"), "");
  EXPECT_EQ(send(0, "dcm", 6, "x"), "bad_piece") << "an older file";
  EXPECT_EQ(send(1, "nii.gz", 3, "4567"), "too_large");
  ASSERT_TRUE(jobs->all_sent(kAnn, id));
  ASSERT_TRUE(reaches(*jobs, kAnn, id, JobState::done));
  EXPECT_EQ(led_.files, "abcdef;123;");
  EXPECT_EQ(send(1, "nii.gz", 3, "x"), "bad_piece");
  EXPECT_FALSE(fs::exists(folder_ / kAnn / id / "files")) << "what was sent is gone when it has ended";
}

TEST_F(JobsTest, WhatRunsAndWhatWaitsCanBeCancelled) {
  led_.let_end(false);
  const auto jobs = open();
  const std::string running = jobs->ask(kAnn, JobKind::study_export, {}).value(),
                    waiting = jobs->ask(kAnn, JobKind::study_export, {}).value();
  ASSERT_TRUE(reaches(*jobs, kAnn, running, JobState::running));
  EXPECT_TRUE(jobs->cancel(kAnn, waiting));
  EXPECT_EQ(jobs->find(kAnn, waiting)->state, JobState::cancelled);
  EXPECT_TRUE(jobs->cancel(kAnn, running));
  ASSERT_TRUE(reaches(*jobs, kAnn, running, JobState::cancelled));
  EXPECT_TRUE(jobs->find(kAnn, running)->results.empty()) << "half a result is none";
  EXPECT_FALSE(jobs->load_result(kAnn, running, 0));
  EXPECT_TRUE(jobs->cancel(kAnn, running));
  EXPECT_TRUE(jobs->find(kAnn, running)) << "a page that is out of date removes nothing";
  EXPECT_TRUE(jobs->remove(kAnn, running));
  EXPECT_FALSE(jobs->find(kAnn, running));
  EXPECT_FALSE(fs::exists(folder_ / kAnn / running));
}

TEST_F(JobsTest, AServerThatStartsAgainSaysWhatWasInterrupted) {
  std::string done, running, waiting, receiving;
  {
    const auto jobs = open();
    done = jobs->ask(kAnn, JobKind::study_report, {{"title", "Needles"}}).value();
    ASSERT_TRUE(reaches(*jobs, kAnn, done, JobState::done));
    led_.let_end(false);
    running = jobs->ask(kAnn, JobKind::study_report, {}).value();
    ASSERT_TRUE(reaches(*jobs, kAnn, running, JobState::running));
    waiting = jobs->ask(kAnn, JobKind::study_report, {}).value();
    receiving = jobs->ask(kBob, JobKind::import_ct, {}).value();
    ASSERT_TRUE(jobs->receive(kBob, receiving, 0, "dcm", 0, bytes("abc")));
    // As a server that is killed leaves it.
    fs::copy(folder_, folder_.string() + "-killed", fs::copy_options::recursive);
  }
  const fs::path left = folder_.string() + "-killed";
  std::ofstream(left / kAnn / running / "session") << "a secret";
  Jobs killed(left, led_.runner(), [this] { return now_us_.load(); });
  EXPECT_EQ(killed.find(kAnn, running)->state, JobState::interrupted);
  EXPECT_FALSE(fs::exists(left / kAnn / running / "session"));
  EXPECT_FALSE(fs::exists(left / kAnn / running / "results"));
  EXPECT_TRUE(fs::exists(left / kAnn / done / "results" / "answer.csv"));
  led_.let_end(true);
  const std::size_t ran = led_.ran.size();
  const auto jobs = open();
  EXPECT_EQ(jobs->find(kAnn, done)->state, JobState::done);
  EXPECT_EQ(jobs->find(kAnn, done)->wish.at("title"), "Needles");
  EXPECT_TRUE(jobs->load_result(kAnn, done, 0));
  for (const auto& [person, id] : {std::pair{kAnn, running}, {kAnn, waiting}, {kBob, receiving}}) {
    EXPECT_EQ(jobs->find(person, id)->state, JobState::interrupted);
    EXPECT_THAT(jobs->find(person, id)->said, HasSubstr("stopped"));
  }
  EXPECT_FALSE(fs::exists(folder_ / kBob / receiving / "files"));
  EXPECT_EQ(led_.ran.size(), ran) << "nothing is begun again by itself";
}

TEST_F(JobsTest, OldOnesAndHalfSentOnesGo) {
  limits_.most_kept_of_one = 2;
  const auto jobs = open();
  std::vector<std::string> ids;
  for (int i = 0; i < 3; ++i) {
    ids.push_back(jobs->ask(kAnn, JobKind::study_report, {}).value());
    ASSERT_TRUE(reaches(*jobs, kAnn, ids.back(), JobState::done));
    now_us_ += 1'000'000;
  }
  EXPECT_EQ(jobs->list(kAnn).size(), 2U);
  EXPECT_FALSE(fs::exists(folder_ / kAnn / ids[0]));
  const std::string half = jobs->ask(kAnn, JobKind::import_ct, {}).value();
  now_us_ += limits_.silent_us + 1;
  EXPECT_EQ(jobs->list(kAnn)[0].state, JobState::interrupted);
  EXPECT_EQ(jobs->list(kAnn)[0].job_id, half);
  now_us_ += limits_.kept_us;
  EXPECT_TRUE(jobs->list(kAnn).empty());
  EXPECT_FALSE(fs::exists(folder_ / kAnn));
}

TEST_F(JobsTest, OldOnesGoThoughNobodyAsks) {
  limits_.looks_every = std::chrono::milliseconds(5);
  auto jobs = open();
  const std::string done = jobs->ask(kAnn, JobKind::study_report, {}).value();
  ASSERT_TRUE(reaches(*jobs, kAnn, done, JobState::done));
  const std::string half = jobs->ask(kBob, JobKind::import_ct, {}).value();
  now_us_ += limits_.silent_us + 1;
  ASSERT_TRUE(reaches(*jobs, kBob, half, JobState::interrupted));
  jobs.reset();
  now_us_ += limits_.kept_us;
  limits_.looks_every = std::chrono::hours(1);
  jobs = open();
  EXPECT_TRUE(until([&] { return !jobs->find(kAnn, done) && !jobs->find(kBob, half); })) << "at the start too";
}

// Was: a second server, even one whose port was taken, ended the first one's jobs and deleted what was sent for
// them.
TEST_F(JobsTest, AFoldersJobsAreThoseOfOneServer) {
  auto first = open();
  const std::string id = first->ask(kAnn, JobKind::import_ct, {}).value();
  ASSERT_TRUE(first->receive(kAnn, id, 0, "dcm", 0, bytes("abc")));
  {
    const auto second = open();
    EXPECT_TRUE(second->list(kAnn).empty());
    const auto asked = second->ask(kAnn, JobKind::study_report, {});
    ASSERT_FALSE(asked);
    EXPECT_THAT(asked.error().text, HasSubstr("another server"));
    FakeSite fake;
    fake.surroundings.jobs = second;
    FakeBrowser browser(*fake.site);
    browser.log_in_as(Role::mentor);
    const std::string token = form_token(browser.get("/jobs").body, "/jobs");
    const Response refused = browser.post("/jobs", "kind=import&title=&token=" + token);
    EXPECT_EQ(refused.status, 503);
    EXPECT_THAT(refused.body, HasSubstr("another server"));
  }
  EXPECT_EQ(fixtures::whole_file(folder_ / kAnn / id / "files" / "0000.dcm"), "abc");
  ASSERT_TRUE(first->all_sent(kAnn, id));
  ASSERT_TRUE(reaches(*first, kAnn, id, JobState::done));
  first.reset();
  EXPECT_TRUE(open()->find(kAnn, id)) << "the next one has them";
}

TEST_F(JobsTest, OfWhomWasErasedNothingIsWrittenAgain) {
  led_.let_end(false);
  const auto jobs = open();
  const std::string running = jobs->ask(kBob, JobKind::study_report, {{"title", "runs"}}).value();
  ASSERT_TRUE(reaches(*jobs, kBob, running, JobState::running));
  ASSERT_TRUE(until([&] { return !jobs->find(kBob, running)->doing.empty(); }));
  const std::string waiting = jobs->ask(kBob, JobKind::study_report, {{"title", "waits"}}).value();
  const std::string last = jobs->ask(kAnn, JobKind::study_report, {{"title", "another's"}}).value();
  fs::remove_all(folder_ / kBob);
  led_.let_end(true);
  ASSERT_TRUE(reaches(*jobs, kAnn, last, JobState::done));
  EXPECT_TRUE(jobs->list(kBob).empty());
  EXPECT_FALSE(fs::exists(folder_ / kBob));
  EXPECT_EQ(led_.ran, (std::vector<std::string>{"runs", "another's"}));
  fs::remove(folder_ / kAnn / last / "results" / "answer.csv");
  EXPECT_EQ(jobs->load_result(kAnn, last, 0).error().code, "no_job");
}

TEST_F(JobsTest, AStudysResultsAreOfWhoStillWorksOnIt) {
  FakeSite fake;
  fake.surroundings.jobs = open();
  const std::string person_id = "person-of-researcher";
  fake.questions.study_relations[person_id][kStudy].own_study = true;
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::researcher);
  const std::string token = form_token(browser.get("/me").body, "/me/facts");
  const std::string place =
      header_of(browser.post("/jobs", "kind=study_export&study=" + kStudy + "&token=" + token), "Location");
  ASSERT_TRUE(until([&] { return browser.get(place).body.find("answer.csv") != std::string::npos; }));
  EXPECT_EQ(browser.get(place + "/result?n=0").status, 200);
  fake.questions.study_relations[person_id][kStudy].own_study = false;
  EXPECT_EQ(browser.get(place + "/result?n=0").status, 404);
}

TEST_F(JobsTest, ADiskThatIsNearlyFullTakesNothing) {
  limits_.free_bytes = std::uint64_t{1} << 60;
  const auto jobs = open();
  const std::string id = jobs->ask(kAnn, JobKind::import_ct, {}).value();
  EXPECT_EQ(jobs->receive(kAnn, id, 0, "dcm", 0, bytes("abc")).error().code, "disk");
}

TEST_F(JobsTest, WhatARunnerThrowsIsNotTold) {
  const auto jobs = std::make_shared<Jobs>(
      folder_,
      [](const Job&, const fs::path&, const auto&, const auto&) -> JobEnd { throw std::runtime_error("/secret"); },
      [] { return std::int64_t{0}; }, limits_);
  const std::string id = jobs->ask(kAnn, JobKind::study_report, {}).value();
  ASSERT_TRUE(reaches(*jobs, kAnn, id, JobState::failed));
  EXPECT_THAT(jobs->find(kAnn, id)->said, Not(HasSubstr("secret")));
}

// Every route of a job answers its asker, and nobody else otherwise than if it were missing.
TEST_F(JobsTest, AreTheirAskersAlone) {
  const auto jobs = open();
  int answered = 0;
  for (const Role owner : casedb::kAllRoles) {
    const std::string owner_id = "person-of-" + casedb::name_of(owner);
    for (const Role role : casedb::kAllRoles) {
      FakeSite fake;
      fake.surroundings.jobs = jobs;
      FakeBrowser browser(*fake.site);
      browser.log_in_as(role);
      const std::string id = jobs->ask(owner_id, JobKind::import_ct, {{"title", "Kidney <1>"}}).value();
      const std::string token = form_token(browser.get("/me").body, "/me/facts");
      const bool own = role == owner && casedb::roles_that_may(casedb::Action::run_job).has(role);
      EXPECT_EQ(browser.get("/jobs").body.find(id) != std::string::npos, own);
      EXPECT_EQ(browser.get("/jobs.json").body.find(id) != std::string::npos, own);
      const auto ask = [&](const std::string& job_id) {
        std::vector<Response> all;
        for (const char* end : {"", "/job.json"}) all.push_back(browser.get("/jobs/" + job_id + end));
        all.push_back(
            browser.post("/jobs/" + job_id + "/files", "number=0&ending=dcm&at=0&data=YWJj&token=" + token));
        all.push_back(browser.post("/jobs/" + job_id + "/start", "token=" + token));
        if (own && job_id == id) {
          EXPECT_TRUE(reaches(*jobs, owner_id, id, JobState::done));
        }
        all.push_back(browser.get("/jobs/" + job_id + "/result?n=0"));
        all.push_back(browser.post("/jobs/" + job_id + "/cancel", "token=" + token));
        return all;
      };
      const auto there = ask(id), missing = ask(kMissingAttempt);
      for (std::size_t i = 0; i < there.size(); ++i) {
        EXPECT_EQ(missing[i].status, 404);
        EXPECT_EQ(there[i].status, own ? i + 1 < there.size() ? 200 : 303 : 404) << casedb::name_of(role) << i;
        if (!own) {
          EXPECT_EQ(bytes_of(there[i], true), bytes_of(missing[i], true)) << casedb::name_of(role) << i;
        }
        answered += own ? 1 : 0;
      }
      for (const Job& one : jobs->list(owner_id)) {
        EXPECT_TRUE(jobs->cancel(owner_id, one.job_id));
        EXPECT_TRUE(jobs->remove(owner_id, one.job_id));
      }
    }
  }
  EXPECT_EQ(answered, 3 * 6);
}

TEST_F(JobsTest, AreAskedForByWhoMayDoIt) {
  const auto jobs = open();
  led_.let_end(false);
  for (const Role role : casedb::kAllRoles)
    for (const bool own_study : {false, true}) {
      FakeSite fake;
      fake.surroundings.jobs = jobs;
      const std::string person_id = "person-of-" + casedb::name_of(role);
      fake.questions.study_relations[person_id][kStudy].own_study = own_study;
      FakeBrowser browser(*fake.site);
      browser.log_in_as(role);
      const std::string token = form_token(browser.get("/me").body, "/me/facts");
      for (const std::string kind : {"import", "study_report", "study_export", "other"}) {
        const Response asked = browser.post(
            "/jobs", "kind=" + kind + "&title=&modality=mpr&position=supine&face=refuse&study=" + kStudy +
                         "&token=" + token);
        const bool runs = casedb::roles_that_may(casedb::Action::run_job).has(role);
        const bool may =
            kind == "import" ? role == Role::mentor || role == Role::admin : role == Role::researcher && own_study;
        EXPECT_EQ(asked.status, !runs             ? 404
                                : kind == "other" ? 400
                                : may             ? 303
                                                  : 404)
            << casedb::name_of(role) << kind;
        for (const Job& one : jobs->list(person_id)) {
          EXPECT_TRUE(may) << casedb::name_of(role) << kind;
          EXPECT_TRUE(jobs->cancel(person_id, one.job_id));
          EXPECT_TRUE(until([&] { return has_ended(jobs->find(person_id, one.job_id)->state); }));
          EXPECT_TRUE(jobs->remove(person_id, one.job_id));
        }
      }
    }
}

TEST_F(JobsTest, APageTellsHowFarItIsAndWhatCameOfIt) {
  led_.ending = {true, "case <x>\nHU -1024 to 900", kPublishedCase};
  led_.let_end(false);
  FakeSite fake;
  fake.surroundings.jobs = open();
  FakeBrowser browser(*fake.site);
  browser.log_in_as(Role::mentor);
  const std::string list = browser.get("/jobs").body, token = form_token(list, "/jobs");
  EXPECT_THAT(list, HasSubstr("Import a CT"));
  const Response bad = browser.post("/jobs", "kind=import&title=" + std::string(200, 'x') + "&token=" + token);
  EXPECT_EQ(bad.status, 400);
  EXPECT_THAT(bad.body, HasSubstr("role=\"alert\""));
  const std::string place = header_of(
      browser.post("/jobs",
                   "kind=import&title=Kidney+%3C1%3E&modality=xray&position=prone&face=crop&token=" + token),
      "Location");
  ASSERT_THAT(place, HasSubstr("/jobs/"));
  const Response page = browser.get(place);
  EXPECT_THAT(page.body, HasSubstr("Kidney &lt;1&gt;"));
  EXPECT_THAT(page.body, HasSubstr("Waits for its files"));
  EXPECT_THAT(page.body, HasSubstr("webkitdirectory"));
  EXPECT_THAT(page.body, HasSubstr("<noscript>"));
  EXPECT_EQ(browser.post(place + "/start", "token=" + token).status, 409) << "nothing was sent";
  EXPECT_EQ(browser.post(place + "/files", "number=0&ending=dcm&at=0&data=****&token=" + token).status, 400);
  EXPECT_EQ(browser.post(place + "/files", "number=0&ending=dcm&at=0&data=YWJj&token=wrong").status, 403);
  EXPECT_EQ(browser.post(place + "/files", "number=0&ending=dcm&at=0&data=YWJj&token=" + token).status, 200);
  EXPECT_EQ(browser.post(place + "/start", "token=" + token).status, 200);
  ASSERT_TRUE(until([&] { return browser.get(place).body.find("value=\"0.750\"") != std::string::npos; }));
  json told = json::parse(browser.get(place + "/job.json").body);
  EXPECT_EQ(told["state"], "running");
  EXPECT_EQ(told["share_done"], 0.75);
  led_.let_end(true);
  ASSERT_TRUE(until([&] { return json::parse(browser.get(place + "/job.json").body)["state"] == "done"; }));
  const std::string end = browser.get(place).body;
  EXPECT_THAT(end, HasSubstr("case &lt;x&gt;"));
  EXPECT_THAT(end, HasSubstr("href=\"/cases/" + kPublishedCase));
  EXPECT_THAT(end, HasSubstr("answer.csv"));
  EXPECT_THAT(header_of(browser.get(place + "/result?n=0"), "Content-Disposition"), HasSubstr("attachment"));
  for (const char* bad_n : {"", "?n=1", "?n=-1", "?n=x", "?n=99999999999999999999"})
    EXPECT_EQ(browser.get(place + "/result" + bad_n).status, 404) << bad_n;
  EXPECT_THAT(end, HasSubstr("name=\"remove\" value=\"yes\""));
  EXPECT_THAT(page.body, Not(HasSubstr("name=\"remove\"")));
  EXPECT_EQ(header_of(browser.post(place + "/cancel", "token=" + token), "Location"), place);
  EXPECT_EQ(browser.get(place).status, 200) << "a page that is out of date removes nothing";
  EXPECT_EQ(header_of(browser.post(place + "/cancel", "remove=yes&token=" + token), "Location"), "/jobs");
  EXPECT_EQ(browser.get(place).status, 404);
}

TEST(Base64Url, IsReadBackAndNothingElseIs) {
  const std::pair<const char*, const char*> known[] = {
      {"", ""},           {"Zg", "f"},          {"Zm8", "fo"},         {"Zm9v", "foo"},
      {"Zm9vYg", "foob"}, {"Zm9vYmE", "fooba"}, {"Zm9vYmFy", "foobar"}};  // RFC 4648, section 10
  for (const auto& [text, plain] : known) EXPECT_EQ(bytes_from_base64url(text), bytes(plain)) << text;
  EXPECT_EQ(bytes_from_base64url("-_8"), (std::vector<std::byte>{std::byte{0xFB}, std::byte{0xFF}}));
  for (const char* bad : {"Z", "Zg==", "Zh", "Zm9", "+/8", "Zm 9v", "Zm9vZ"})
    EXPECT_FALSE(bytes_from_base64url(bad)) << bad;
}

}  // namespace
}  // namespace seldinger::web
