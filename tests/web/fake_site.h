// A library in memory and a world whose clock and chance the test sets.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "sim/base/failure.h"
#include "sim/base/hash.h"
#include "web/routes/routes.h"
#include "web/site/questions.h"
#include "web/site/site.h"

namespace seldinger::web {

class FakeQuestions final : public Questions {
 public:
  std::optional<casedb::Account> log_in(const std::string& name, const std::string& password) override {
    ++log_ins;
    if (during_log_in) during_log_in();
    const auto found = passwords.find(name);
    if (found == passwords.end() || found->second != password) return std::nullopt;
    for (const casedb::Account& account : list_accounts()) {
      if (account.login_name == name && account.enabled) return account;
    }
    return std::nullopt;
  }
  void log_out(const std::string& person_id) override {
    if (during_log_out) during_log_out();
    const std::lock_guard lock(mutex);
    logged_out.push_back(person_id);
  }
  void let_in_again(const std::string&, const std::string& name) override {
    const std::lock_guard lock(mutex);
    let_in.push_back(name);
  }
  std::int64_t last_let_in_again(const std::string& person_id) override {
    const std::lock_guard lock(mutex);
    const auto found = unlocked.find(person_id);
    return found == unlocked.end() ? 0 : found->second;
  }
  std::vector<casedb::WebSession> list_sessions(int) override {
    const std::lock_guard lock(mutex);
    std::vector<casedb::WebSession> all;
    for (const auto& [id_hash, session] : sessions) all.push_back(session);
    return all;
  }
  void keep_sessions(int, const casedb::WebSessionChanges& changes) override {
    const std::lock_guard lock(mutex);
    ++session_writes;
    if (refuse_sessions) throw base::Failure("disk", "the disk is full");
    for (const casedb::WebSession& one : changes.kept) sessions[one.id_hash] = one;
    for (const std::string& id_hash : changes.ended) sessions.erase(id_hash);
  }
  std::optional<casedb::Account> find_account(const std::string& person_id) override {
    for (const casedb::Account& account : list_accounts()) {
      if (account.person_id == person_id) return account;
    }
    return std::nullopt;
  }
  std::vector<casedb::Account> list_accounts() override {
    fail_if_asked();
    const std::lock_guard lock(mutex);
    return accounts;
  }
  base::Result<casedb::PasswordLink> invite_user(const std::string& admin_id, const std::string& name,
                                                 casedb::Role role) override {
    done.push_back(admin_id + " invites " + name + " as " + casedb::name_of(role));
    return casedb::PasswordLink{std::string(64, 'b'), 1'772'373'909'123'456};
  }
  base::Result<casedb::PasswordLink> make_password_link(const std::string& admin_id,
                                                        const std::string& name) override {
    done.push_back(admin_id + " makes a link for " + name);
    return casedb::PasswordLink{std::string(64, 'b'), 1'772'373'909'123'456};
  }
  std::optional<casedb::Account> account_of_password_link(const std::string&) override { return std::nullopt; }
  base::Result<void> set_password_by_link(const std::string&, const std::string&, const std::string&) override {
    return base::Error{"no_link", "this link is no longer valid; ask for another"};
  }
  std::unordered_map<std::string, casedb::Relation> relations_of(const std::string& reader_id) override {
    std::unordered_map<std::string, casedb::Relation> all;
    if (const auto known = relations.find(reader_id); known != relations.end()) all = known->second;
    for (const casedb::Account& account : list_accounts()) all.emplace(account.person_id, casedb::Relation{});
    all[reader_id].own = true;
    return all;
  }
  std::vector<casedb::Cohort> list_cohorts() override { return cohorts; }
  std::vector<casedb::Cohort> list_members() override { return cohorts; }
  std::map<std::string, casedb::ToldCells> told_cells(std::int64_t) override {
    std::map<std::string, casedb::ToldCells> all = told;
    for (const casedb::Cohort& cohort : cohorts) all[cohort.cohort_id];
    return all;
  }
  casedb::Relation relation_to_cohort(const std::string& reader_id, const casedb::Cohort& cohort) override {
    const auto known = cohort_relations.find(reader_id);
    if (known == cohort_relations.end()) return {};
    const auto found = known->second.find(cohort.cohort_id);
    return found == known->second.end() ? casedb::Relation{} : found->second;
  }
  LearnerRecords records_of(const std::string& person_id) override {
    const auto found = records.find(person_id);
    return {simulated.contains(person_id),
            std::make_shared<const std::vector<casedb::CurriculumRecord>>(
                found == records.end() ? std::vector<casedb::CurriculumRecord>() : found->second)};
  }
  std::vector<reports::StudyView> list_studies() override { return studies; }
  casedb::Relation relation_to_study(const std::string& reader_id, const std::string& study_id) override {
    const auto known = study_relations.find(reader_id);
    if (known == study_relations.end()) return {};
    const auto found = known->second.find(study_id);
    return found == known->second.end() ? casedb::Relation{} : found->second;
  }
  base::Result<reports::StudyView> find_study(const std::string& study_id) override {
    for (const reports::StudyView& one : studies)
      if (one.study.study_id == study_id) return one;
    return base::Error{"no_study", "there is no such study"};
  }
  reports::AuditView audit_of(int days) override {
    reports::AuditView view = audit;
    view.days = days;
    return view;
  }
  std::vector<reports::LearnerItem> learning_of(const std::string& person_id) override {
    const auto found = learning.find(person_id);
    return found == learning.end() ? std::vector<reports::LearnerItem>() : found->second;
  }
  reports::StandardTexts standard_texts(const reports::Records&) override { return {}; }
  reports::AboutMe about(const std::string& person_id) override {
    const std::lock_guard lock(mutex);
    asked_about = person_id;
    return about_me;
  }
  base::Result<void> give_facts(const std::string& person_id,
                                const std::map<std::string, std::string>& answers) override {
    done.push_back("facts of " + person_id);
    for (const auto& [fact_id, answer] : answers) {
      if (const auto fit = casedb::checked_answer(fact_id, answer); !fit) return fit.error();
      done.push_back(fact_id + " = " + answer);
    }
    return {};
  }
  base::Result<void> give_consent(const std::string& person_id, const std::string& text_id) override {
    done.push_back(person_id + " gives " + text_id);
    return {};
  }
  base::Result<void> withdraw_consent(const std::string& person_id, const std::string& text_id) override {
    done.push_back(person_id + " withdraws " + text_id);
    return {};
  }
  base::Result<casedb::Erased> erase_attempts_of(const std::string& person_id) override {
    done.push_back("erased " + person_id);
    return erased;
  }
  base::Result<RoundForms> find_round(const std::string&) override {
    return base::Error{"no_round", "no questionnaire has that code"};
  }
  base::Result<std::string> begin_response(const std::string&, const casedb::Respondent&) override {
    return base::Error{"no_round", "no questionnaire has that code"};
  }
  base::Result<casedb::Draft> find_draft(const std::string&) override {
    return base::Error{"no_draft", "there are no answers that were begun here"};
  }
  base::Result<Board> find_board(const std::string&) override {
    return base::Error{"no_workshop", "there is no workshop with that code"};
  }
  base::Result<void> keep_answers(const std::string&, const std::map<std::string, std::string>&, bool) override {
    return base::Error{"no_draft", "there are no answers that were begun here"};
  }
  base::Result<casedb::RatingBench> find_rating_bench(const std::string&) override {
    return base::Error{"no_rater", "nobody rates with that key"};
  }
  base::Result<casedb::RatingPage> find_rating(const std::string&, std::size_t) override {
    return base::Error{"no_rater", "nobody rates with that key"};
  }
  base::Result<void> keep_rating(const std::string&, std::size_t, const std::map<std::string, std::string>&,
                                 bool) override {
    return base::Error{"no_rater", "nobody rates with that key"};
  }
  std::size_t count_attempts(const casedb::WhoseAttempts& whose) override { return seen(whose).size(); }
  std::vector<casedb::AttemptRow> list_attempts(const casedb::WhoseAttempts& whose, std::size_t first,
                                                std::size_t count) override {
    const auto rows = seen(whose);
    first = std::min(first, rows.size());
    count = std::min(count, rows.size() - first);
    const auto from = rows.begin() + static_cast<std::ptrdiff_t>(first);
    return {from, from + static_cast<std::ptrdiff_t>(count)};
  }
  base::Result<casedb::AttemptRow> find_attempt(const std::string& attempt_id) override {
    fail_if_asked();
    for (const casedb::AttemptRow& row : attempts) {
      if (row.attempt_id == attempt_id) return row;
    }
    return base::Error{"no_attempt", "there is no such attempt"};
  }
  casedb::AttemptGrade look_at(const casedb::AttemptRow&) override { return grade; }
  std::vector<casedb::StationUse> list_station_use(const std::vector<std::string>& people) override {
    const std::lock_guard lock(mutex);
    stations_asked_for = people;
    return station_use;
  }
  std::vector<casedb::StationTiming> list_station_timing() override { return station_timing; }
  std::vector<casedb::AttemptComment> list_comments(const std::string&) override { return comments; }
  base::Result<void> add_comment(const std::string& person_id, const std::string& attempt_id, double at_s,
                                 const std::string& body) override {
    done.push_back(person_id + " says " + body + " of " + attempt_id + " at " + std::to_string(at_s));
    return {};
  }
  std::vector<assessment::StepResult> list_steps(const std::string&) override { return {}; }
  std::vector<assessment::Grade> grades_of(const std::vector<casedb::AttemptRow>& rows) override {
    return std::vector<assessment::Grade>(rows.size(), grade.grade);
  }
  std::vector<reports::CurriculumView> list_curricula(const std::optional<std::string>& person_id) override {
    const std::lock_guard lock(mutex);
    curricula_asked_for = person_id;
    return curricula;
  }
  assessment::statistics::Answer dependability() override {
    return assessment::statistics::not_estimable("g_theory", "no_data", 0);
  }
  std::vector<casedb::CaseRow> list_cases() override { return cases; }
  base::Result<casedb::CaseParts> find_case(const std::string& case_id) override {
    for (const casedb::CaseRow& row : cases)
      if (row.case_id == case_id) return casedb::CaseParts{row, {}, {}, decisions, {}, {}, true};
    return base::Error{"no_case", "there is no such case"};
  }
  std::string case_mark(const std::string&) override {
    const std::lock_guard lock(mutex);
    return mark;
  }
  casedb::Health health() override {
    if (during_health) during_health();
    return health_now;
  }
  base::Result<casedb::CaseCheck> check_case(const casedb::CaseRow&) override {
    ++case_checks;
    if (during_check) during_check();
    if (check_refusal) return *check_refusal;
    return casedb::CaseCheck{{{"lesion_present", false, "there is no lesion"}}, {"hit"}, case_mark("")};
  }
  base::Result<std::vector<std::byte>> load_picture(const casedb::AttemptRow&) override { return picture; }
  base::Result<reports::DrawnPictures> pictures_of(const std::string& attempt_id) override {
    ++pictures_made;
    if (pictures_refusal) return *pictures_refusal;
    return reports::DrawnPictures{"<p class=\"pictures\">" + attempt_id + "</p>", {picture, {std::byte{2}}}};
  }
  base::Result<cases::Mesh> load_skin(const std::string&) override { return skin; }
  base::Result<cases::Recording> load_recording(const std::string&) override {
    if (recording) return *recording;
    return base::Error{"damaged", "the recording is damaged"};
  }

  // Readers have lanes of their own: what a question changes, and what a test changes while the server runs.
  std::mutex mutex;
  std::string mark = "as drawn";  // of every case
  std::atomic<casedb::Health> health_now = casedb::Health::ok;
  std::vector<casedb::Account> accounts;
  std::map<std::string, std::string> passwords;                                        // by log-in name
  std::map<std::string, std::unordered_map<std::string, casedb::Relation>> relations;  // by reader
  std::vector<casedb::Cohort> cohorts;
  std::map<std::string, casedb::ToldCells> told;                                    // by cohort; none: all withheld
  std::map<std::string, std::map<std::string, casedb::Relation>> cohort_relations;  // by reader and cohort
  std::map<std::string, std::vector<casedb::CurriculumRecord>> records;             // by person
  std::map<std::string, std::vector<reports::LearnerItem>> learning;                // by person
  std::set<std::string> simulated;
  std::vector<reports::StudyView> studies;
  std::map<std::string, std::map<std::string, casedb::Relation>> study_relations;  // by reader and study
  reports::AuditView audit;
  casedb::Erased erased;
  reports::AboutMe about_me;
  std::string asked_about;
  std::vector<std::string> logged_out, let_in;
  std::map<std::string, casedb::WebSession> sessions;  // as a library keeps them
  int session_writes = 0;
  bool refuse_sessions = false;
  std::map<std::string, std::int64_t> unlocked;  // by person, as the audit log numbers it
  std::vector<std::string> done;                 // what was changed, in words
  std::vector<casedb::AttemptRow> attempts;      // newest first
  std::vector<casedb::CaseRow> cases;            // oldest first
  std::vector<casedb::Decision> decisions;       // of every case
  casedb::AttemptGrade grade;                    // of every attempt
  std::optional<cases::Recording> recording;     // of every attempt; none: it is damaged
  std::vector<casedb::AttemptComment> comments;  // of every attempt
  std::vector<reports::CurriculumView> curricula;
  std::optional<std::string> curricula_asked_for;
  std::vector<casedb::StationUse> station_use;
  std::vector<std::string> stations_asked_for;  // person ids
  std::vector<casedb::StationTiming> station_timing;
  std::vector<std::byte> picture;
  std::function<void()> fault;  // thrown from questions about attempts and accounts
  std::function<void()> during_log_in, during_log_out, during_health;
  std::function<void()> during_check;
  std::optional<base::Error> check_refusal;
  std::optional<base::Error> pictures_refusal;
  cases::Mesh skin;  // of every case
  std::atomic<int> log_ins = 0, case_checks = 0, pictures_made = 0;

 private:
  void fail_if_asked() const {
    if (fault) fault();
  }
  std::vector<casedb::AttemptRow> seen(const casedb::WhoseAttempts& whose) const {
    fail_if_asked();
    std::vector<casedb::AttemptRow> rows;
    for (const casedb::AttemptRow& row : attempts)
      if (row.person_id ? std::find(whose.people.begin(), whose.people.end(), *row.person_id) != whose.people.end()
                        : whose.nobodys)
        rows.push_back(row);
    return rows;
  }
};

inline constexpr const char* kPassword = "correct horse battery";
inline const std::string kOwnAttempt = "0190a1b2-0000-7000-8000-0000000000a1";
inline const std::string kOthersAttempt = "0190a1b2-0000-7000-8000-0000000000a2";
inline const std::string kNobodysAttempt = "0190a1b2-0000-7000-8000-0000000000a3";
inline const std::string kSomebody = "0190a1b2-0000-7000-8000-0000000000b1";  // a person, to whoever is given one
inline const std::string kMissingAttempt = "0190a1b2-0000-7000-8000-0000000000ff";

// Of each state: the number's last digit.
inline const std::string kDraftCase = "0190a1b2-0000-7000-8000-0000000000c0";
inline const std::string kReviewCase = "0190a1b2-0000-7000-8000-0000000000c1";
inline const std::string kPublishedCase = "0190a1b2-0000-7000-8000-0000000000c2";
inline const std::string kRetiredCase = "0190a1b2-0000-7000-8000-0000000000c3";

inline const std::string kStudy = "0190a1b2-0000-7000-8000-0000000000d1";

inline casedb::CaseRow case_row(const std::string& id, casedb::CaseState state) {
  casedb::CaseRow row;
  row.case_id = row.family_id = id;
  row.title = "Case, a " + casedb::name_of(state);
  row.state = state;
  return row;
}

inline casedb::AttemptRow attempt_row(const std::string& id, std::optional<std::string> person_id) {
  casedb::AttemptRow row;
  row.attempt_id = id;
  row.case_title = "Case of " + id.substr(34);
  row.operator_name = person_id.has_value() ? casedb::kPersonOperator : "novice";
  row.person_id = std::move(person_id);
  row.picture_sha256 = std::string(64, 'a');
  row.metrics = {{"hit", 1, 1.0, "bool", ""}, {"vis_joint", 1, std::nullopt, "share", "no_endpoint"}};
  return row;
}

// One account a role, named after it, and a second trainee. "Own" of each role is kOwnAttempt given to that person.
inline void fill(FakeQuestions& questions) {
  using casedb::Role;
  for (const Role role : {Role::trainee, Role::mentor, Role::researcher, Role::director, Role::admin}) {
    const std::string name = casedb::name_of(role);
    questions.accounts.push_back({"person-of-" + name, name, role, true});
    questions.passwords[name] = kPassword;
  }
  questions.accounts.push_back({"person-of-other-zzz999", "Other Trainee", Role::trainee, true});
  // The second trainee is in the mentor's cohort, the director's programme, and consents to the researcher's study.
  questions.relations["person-of-mentor"]["person-of-other-zzz999"].own_cohort = true;
  questions.relations["person-of-director"]["person-of-other-zzz999"].own_programme = true;
  questions.relations["person-of-researcher"]["person-of-other-zzz999"].own_study = true;
  questions.cases = {
      case_row(kDraftCase, casedb::CaseState::draft), case_row(kReviewCase, casedb::CaseState::review),
      case_row(kPublishedCase, casedb::CaseState::published), case_row(kRetiredCase, casedb::CaseState::retired)};
  for (const auto state :
       {casedb::CurriculumState::draft, casedb::CurriculumState::published, casedb::CurriculumState::retired}) {
    reports::CurriculumView& view = questions.curricula.emplace_back();
    view.curriculum.title = "A " + casedb::name_of(state) + " curriculum";
    view.curriculum.state = state;
  }
  questions.studies.emplace_back().study = {kStudy, "Needles in phantoms", {3, false}};
  questions.grade.experts.attempt_ids = {kMissingAttempt};
  questions.grade.experts.id = "C-1";
  questions.attempts = {attempt_row(kOwnAttempt, "person-of-trainee"),
                        attempt_row(kOthersAttempt, "person-of-other-zzz999"),
                        attempt_row(kNobodysAttempt, std::nullopt)};
  for (const unsigned char c : std::string_view("\x89PNG\r\n\x1a\nrest")) questions.picture.push_back(std::byte{c});
}

inline std::string fake_hash(std::string_view text) {
  std::string out;
  for (std::uint64_t part = 0; part < 4; ++part) {
    std::uint64_t value = base::hash_bytes(std::as_bytes(std::span(text.data(), text.size())), part);
    for (int i = 0; i < 16; ++i, value >>= 4) out += "0123456789abcdef"[value & 15];
  }
  return out;
}

// A site, its world, and a browser that keeps cookies.
struct FakeSite {
  FakeSite() {
    fill(questions);
    surroundings.now_us = [this] { return now_us.load(); };
    // 2026-03-01 14:05:09, and what has passed since the site began.
    surroundings.utc_us = [this] { return 1'772'373'909'123'456 - 1'000'000 + now_us.load(); };
    surroundings.random_id = [this] { return fake_hash("random " + std::to_string(++ids)); };
    surroundings.sha256_hex = fake_hash;
    surroundings.log = [this](const std::string& line) {
      const std::lock_guard lock(log_mutex);
      log.push_back(line);
    };
    surroundings.program_version = "9.8.7";
    surroundings.port = 8080;
    site.emplace(questions, surroundings, routes());
  }
  FakeSite(const FakeSite&) = delete;
  FakeSite& operator=(const FakeSite&) = delete;

  FakeQuestions questions;
  Surroundings surroundings;
  std::atomic<std::int64_t> now_us = 1000000;
  std::atomic<int> ids = 0;
  std::mutex log_mutex;
  std::vector<std::string> log;
  std::optional<Site> site;
};

// The site with one attempt of somebody who is this to the reader.
inline void give(FakeSite& fake, casedb::Role role, const casedb::Relation& relation) {
  const std::string reader = "person-of-" + casedb::name_of(role);
  const std::string other = "person-of-other-zzz999";
  fake.questions.relations.clear();
  fake.questions.relations[reader][relation.own ? reader : other] = relation;
  if (!relation.nobodys) fake.questions.relations[reader][kSomebody] = relation;
  fake.questions.study_relations.clear();
  fake.questions.study_relations[reader][kStudy] = relation;
  fake.questions.recording.emplace().poses.resize(2);
  fake.questions.attempts = {attempt_row(
      kOwnAttempt, relation.nobodys ? std::nullopt : std::optional<std::string>(relation.own ? reader : other))};
}

inline std::string header_of(const Response& response, const std::string& name) {
  std::string all;
  for (const auto& [one, value] : response.headers) {
    if (one == name) all += (all.empty() ? "" : "\n") + value;
  }
  return all;
}

// The value of the hidden token field of the form with this action.
inline std::string form_token(const std::string& html, const std::string& action) {
  const std::size_t form = html.find("action=\"" + action + "\"");
  if (form == html.npos) return "";
  const std::string before = "name=\"token\" value=\"";
  const std::size_t at = html.find(before, form);
  if (at == html.npos) return "";
  return html.substr(at + before.size(), html.find('"', at + before.size()) - at - before.size());
}

class FakeBrowser {
 public:
  explicit FakeBrowser(Site& site) : site_(site) {}

  Request request(const std::string& method, const std::string& path) const {
    Request out;
    out.method = method;
    out.path = path.substr(0, path.find('?'));
    out.query = out.path.size() == path.size() ? "" : path.substr(out.path.size() + 1);
    out.headers["host"] = "127.0.0.1:8080";
    out.from = from;
    if (method == "POST") {
      out.headers["origin"] = "null";  // what browsers send under our own referrer policy
      out.headers["sec-fetch-site"] = "same-origin";
      out.headers["content-type"] = "application/x-www-form-urlencoded";
    }
    std::string all;
    for (const auto& [name, value] : cookies) all += (all.empty() ? "" : "; ") + name + "=" + value;
    if (!all.empty()) out.headers["cookie"] = all;
    return out;
  }
  Response send(const Request& asked) {
    Response response = site_.answer(asked);
    for (const auto& [name, value] : response.headers) {
      if (name != "Set-Cookie") continue;
      const std::size_t equals = value.find('='), end = value.find(';');
      const std::string cookie_name = value.substr(0, equals);
      if (value.find("Max-Age=0") != value.npos) {
        cookies.erase(cookie_name);
      } else {
        cookies[cookie_name] = value.substr(equals + 1, end - equals - 1);
      }
    }
    return response;
  }
  Response get(const std::string& path) { return send(request("GET", path)); }
  Response post(const std::string& path, const std::string& body) {
    Request asked = request("POST", path);
    asked.body = body;
    return send(asked);
  }
  Response log_in(const std::string& name, const std::string& password) {
    const std::string token = form_token(get("/login").body, "/login");
    return post("/login", "name=" + name + "&password=" + password + "&token=" + token);
  }
  // Logged in as the account named after a role.
  Response log_in_as(casedb::Role role) { return log_in(casedb::name_of(role), "correct+horse%20battery"); }

  std::map<std::string, std::string> cookies;
  std::string from = "127.0.0.1";

 private:
  Site& site_;
};

}  // namespace seldinger::web
