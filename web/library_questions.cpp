#include "web/library_questions.h"

#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <map>
#include <mutex>
#include <optional>
#include <span>

#include "casedb/database/credentials.h"
#include "casedb/database/sqlite.h"
#include "casedb/database/uuid.h"
#include "casedb/grading/dependability.h"
#include "casedb/grading/learning.h"
#include "casedb/people/noted_tries.h"
#include "casedb/people/simulated_people.h"
#include "reports/words/grade_words.h"
#include "sim/base/failure.h"
#include "sim/base/hex.h"

namespace seldinger::web {
namespace {

// A library's handle serves one question at a time.
struct Handle {
  explicit Handle(casedb::Library opened) : library(std::move(opened)) { library.act_for(casedb::Actor::nobody()); }
  std::mutex mutex;
  casedb::Library library;
};

// For as long as it lives a library acts for a reader.
class ActingFor {
 public:
  ActingFor(casedb::Library& library, const std::string& person_id) : library_(library) {
    library_.act_for(casedb::Actor::person(person_id));
  }
  ActingFor(const ActingFor&) = delete;
  ActingFor& operator=(const ActingFor&) = delete;
  ~ActingFor() { library_.act_for(casedb::Actor::nobody()); }

 private:
  casedb::Library& library_;
};

// What takes long to ask, until its mark is another one.
template <typename Value>
class Kept {
 public:
  template <typename Ask>
  const Value& at(const std::string& mark, const Ask& ask) {
    if (!value_ || mark_ != mark) {
      value_ = ask();
      mark_ = mark;
    }
    return *value_;
  }

 private:
  std::string mark_;
  std::optional<Value> value_;
};

constexpr std::int64_t kHour_us = 3'600'000'000;

class LibraryQuestions final : public Questions {
 public:
  LibraryQuestions(std::array<casedb::Library, 5> handles, HeavyWork work)
      : pages_(std::move(handles[0])),
        recordings_(std::move(handles[1])),
        first_(std::move(handles[2])),
        second_(std::move(handles[3])),
        changes_(std::move(handles[4])),
        work_(std::move(work)) {}

  std::optional<casedb::Account> log_in(const std::string& name, const std::string& password) override {
    std::unique_lock first(first_.mutex, std::try_to_lock);
    if (first.owns_lock()) return casedb::log_in(first_.library, name, password);
    const std::lock_guard second(second_.mutex);
    return casedb::log_in(second_.library, name, password);
  }

  void log_out(const std::string& person_id) override {
    const std::lock_guard lock(changes_.mutex);
    casedb::log_out(changes_.library, person_id);
  }

  void let_in_again(const std::string& admin_id, const std::string& name) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor admin(changes_.library, admin_id);
    static_cast<void>(casedb::let_in_again(changes_.library, name));  // an account that has gone meanwhile
  }

  std::int64_t last_let_in_again(const std::string& person_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::last_let_in_again(pages_.library, person_id);
  }

  std::vector<casedb::WebSession> list_sessions(int port) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::list_web_sessions(pages_.library, port);
  }

  void keep_sessions(int port, const casedb::WebSessionChanges& changes) override {
    const std::lock_guard lock(changes_.mutex);
    casedb::keep_web_sessions(changes_.library, port, changes);
  }

  std::optional<casedb::Account> find_account(const std::string& person_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::find_user(pages_.library, person_id);
  }

  std::vector<casedb::Account> list_accounts() override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::list_users(pages_.library);
  }

  base::Result<casedb::PasswordLink> invite_user(const std::string& admin_id, const std::string& name,
                                                 casedb::Role role) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor admin(changes_.library, admin_id);
    return casedb::invite_user(changes_.library, name, role);
  }

  base::Result<casedb::PasswordLink> make_password_link(const std::string& admin_id,
                                                        const std::string& name) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor admin(changes_.library, admin_id);
    return casedb::make_password_link(changes_.library, name);
  }

  std::optional<casedb::Account> account_of_password_link(const std::string& secret) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::account_of_password_link(pages_.library, secret);
  }

  base::Result<void> set_password_by_link(const std::string& secret, const std::string& person_id,
                                          const std::string& password) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor owner(changes_.library, person_id);
    return casedb::set_password_by_link(changes_.library, secret, password);
  }

  std::unordered_map<std::string, casedb::Relation> relations_of(const std::string& reader_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::relations_of(pages_.library, reader_id);
  }

  std::vector<casedb::Cohort> list_cohorts() override {
    const std::lock_guard lock(pages_.mutex);
    const casedb::LearningMark mark = casedb::learning_mark(pages_.library);
    return cohorts_.at(mark.act + " " + mark.attempts, [&] { return casedb::list_cohorts(pages_.library); });
  }

  std::vector<casedb::Cohort> list_members() override {
    const std::lock_guard lock(pages_.mutex);
    return members_.at(casedb::learning_mark(pages_.library).act,
                       [&] { return casedb::list_members(pages_.library); });
  }

  // Nothing that is done now is told of before the week is over.
  std::map<std::string, casedb::ToldCells> told_cells(std::int64_t now_us) override {
    const std::lock_guard lock(pages_.mutex);
    const std::int64_t hour = now_us / kHour_us;
    return told_.at(casedb::learning_mark(pages_.library).act + " " + std::to_string(hour),
                    [&] { return casedb::told_cells(casedb::list_cohort_pasts(pages_.library), hour * kHour_us); });
  }

  casedb::Relation relation_to_cohort(const std::string& reader_id, const casedb::Cohort& cohort) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::relation_to_cohort(pages_.library, reader_id, cohort.cohort_id, cohort.programme);
  }

  LearnerRecords records_of(const std::string& person_id) override {
    const std::lock_guard lock(pages_.mutex);  // one learner at a time, so that other pages come between
    return records_[person_id].at(casedb::records_mark(pages_.library, person_id), [&] {
      return LearnerRecords{casedb::is_simulated(pages_.library, person_id),
                            std::make_shared<const std::vector<casedb::CurriculumRecord>>(
                                casedb::records_of(pages_.library, person_id))};
    });
  }

  std::vector<reports::LearnerItem> learning_of(const std::string& person_id) override {
    const std::lock_guard lock(pages_.mutex);
    return reports::learner_items(pages_.library, casedb::learning_attempts_of(pages_.library, person_id));
  }

  reports::StandardTexts standard_texts(const reports::Records& records) override {
    const std::lock_guard lock(pages_.mutex);
    reports::StandardTexts texts;
    for (const casedb::CurriculumRecord& record : *records)
      for (const casedb::ItemState& item : record.items) {
        const auto standards = casedb::list_standards(pages_.library, item.case_id);
        if (!standards.empty()) texts.emplace(item.case_id, reports::experts_text(standards.front().set));
      }
    return texts;
  }

  std::vector<reports::StudyView> list_studies() override {
    const std::lock_guard lock(pages_.mutex);
    std::vector<reports::StudyView> views;
    for (casedb::Study& one : casedb::list_studies(pages_.library))
      views.push_back(study_head(pages_.library, std::move(one)));
    return views;
  }

  casedb::Relation relation_to_study(const std::string& reader_id, const std::string& study_id) override {
    const std::lock_guard lock(pages_.mutex);
    casedb::Relation relation;
    relation.own_study = casedb::is_researcher_of(pages_.library, study_id, reader_id);
    return relation;
  }

  base::Result<reports::StudyView> find_study(const std::string& study_id) override {
    const std::lock_guard lock(recordings_.mutex);  // long to read where many are in: no page waits
    casedb::Library& library = recordings_.library;
    auto study = casedb::find_study(library, study_id);
    if (!study) return study.error();
    reports::StudyView view = study_head(library, std::move(*study));
    if (view.plan && view.plan->frozen()) {
      view.flow = casedb::study_data(library, *view.plan).flow;
      view.visits = casedb::list_visits(library, *view.plan, casedb::now_us());
      view.deviations = casedb::list_deviations(library, study_id);
    } else if (view.plan) {
      view.blinded = casedb::blinded_counts(library, *view.plan);
    }
    return view;
  }

  reports::AuditView audit_of(int days) override {
    constexpr std::size_t kMostRows = 500;
    constexpr std::int64_t kDay_us = std::int64_t{24} * 3600 * 1'000'000;
    const std::lock_guard lock(recordings_.mutex);  // long to read where the log is: no page waits
    casedb::Library& library = recordings_.library;
    reports::AuditView view;
    view.days = days;
    view.rows = casedb::list_audit(library, casedb::now_us() - days * kDay_us);
    std::reverse(view.rows.begin(), view.rows.end());
    view.more = view.rows.size() > kMostRows;
    if (view.more) view.rows.resize(kMostRows);
    view.count = casedb::audit_head(library).count;
    for (const base::Problem& one : casedb::problems_of_audit(library)) view.problems.push_back(one.text);
    for (const casedb::Account& one : casedb::list_users(library))
      view.names.emplace(one.person_id, one.login_name);
    return view;
  }

  reports::AboutMe about(const std::string& person_id) override {
    const std::lock_guard lock(pages_.mutex);
    return {casedb::list_facts(pages_.library, person_id), casedb::list_consents(pages_.library, person_id)};
  }

  base::Result<void> give_facts(const std::string& person_id,
                                const std::map<std::string, std::string>& answers) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor reader(changes_.library, person_id);
    return casedb::give_facts(changes_.library, person_id, answers);
  }

  base::Result<void> give_consent(const std::string& person_id, const std::string& text_id) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor reader(changes_.library, person_id);
    return casedb::give_consent(changes_.library, person_id, text_id);
  }

  base::Result<void> withdraw_consent(const std::string& person_id, const std::string& text_id) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor reader(changes_.library, person_id);
    return casedb::withdraw_consent(changes_.library, person_id, text_id);
  }

  base::Result<casedb::Erased> erase_attempts_of(const std::string& person_id) override {
    auto library = casedb::Library::open(pages_.library.folder());  // so that no page waits
    if (!library) return library.error();
    library->act_for(casedb::Actor::person(person_id));
    return casedb::erase_attempts_of(*library, person_id, person_id);
  }

  base::Result<RoundForms> find_round(const std::string& code) override {
    const std::lock_guard lock(pages_.mutex);
    auto round = casedb::find_round(pages_.library, code);
    if (!round) return round.error();
    auto forms = casedb::find_forms(pages_.library, round->form_id, round->version);
    if (!forms) return forms.error();
    return RoundForms{std::move(*round), std::move(*forms)};
  }

  base::Result<std::string> begin_response(const std::string& code, const casedb::Respondent& respondent) override {
    const std::lock_guard lock(changes_.mutex);
    return casedb::begin_response(changes_.library, code, respondent);
  }

  base::Result<casedb::Draft> find_draft(const std::string& secret) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::find_draft(pages_.library, secret);
  }

  base::Result<void> keep_answers(const std::string& secret, const std::map<std::string, std::string>& typed,
                                  bool send) override {
    const std::lock_guard lock(changes_.mutex);
    if (const auto kept = casedb::save_draft(changes_.library, secret, typed); !kept) return kept.error();
    return send ? casedb::submit_draft(changes_.library, secret) : base::Result<void>();
  }

  base::Result<Board> find_board(const std::string& code) override {
    const std::lock_guard lock(pages_.mutex);
    auto workshop = casedb::find_workshop(pages_.library, code);
    if (!workshop) return workshop.error();
    auto participants = casedb::list_participants(pages_.library, *workshop);
    return Board{std::move(*workshop), std::move(participants)};
  }

  base::Result<casedb::RatingBench> find_rating_bench(const std::string& secret) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::find_rating_bench(pages_.library, secret);
  }

  base::Result<casedb::RatingPage> find_rating(const std::string& secret, std::size_t number) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::find_rating(pages_.library, secret, number);
  }

  base::Result<void> keep_rating(const std::string& secret, std::size_t number,
                                 const std::map<std::string, std::string>& typed, bool send) override {
    const std::lock_guard lock(changes_.mutex);
    return casedb::keep_rating(changes_.library, secret, number, typed, send);
  }

  std::size_t count_attempts(const casedb::WhoseAttempts& whose) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::count_attempts(pages_.library, whose);
  }

  std::vector<casedb::AttemptRow> list_attempts(const casedb::WhoseAttempts& whose, std::size_t first,
                                                std::size_t count) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::list_attempts(pages_.library, whose, first, count);
  }

  base::Result<casedb::AttemptRow> find_attempt(const std::string& attempt_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::find_attempt(pages_.library, attempt_id);
  }

  casedb::AttemptGrade look_at(const casedb::AttemptRow& row) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::Grader(pages_.library).look_at(row);
  }

  std::vector<casedb::StationUse> list_station_use(const std::vector<std::string>& people) override {
    const std::lock_guard lock(recordings_.mutex);  // of many attempts: no page waits
    return casedb::list_station_use(recordings_.library, people);
  }

  std::vector<casedb::StationTiming> list_station_timing() override {
    const std::lock_guard lock(recordings_.mutex);
    return casedb::list_station_timing(recordings_.library);
  }

  std::vector<casedb::AttemptComment> list_comments(const std::string& attempt_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::list_comments(pages_.library, attempt_id);
  }

  base::Result<void> add_comment(const std::string& person_id, const std::string& attempt_id, double at_s,
                                 const std::string& body) override {
    const std::lock_guard lock(changes_.mutex);
    const ActingFor reader(changes_.library, person_id);
    return casedb::add_comment(changes_.library, attempt_id, at_s, body);
  }

  std::vector<assessment::StepResult> list_steps(const std::string& attempt_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::list_steps(pages_.library, attempt_id);
  }

  std::vector<assessment::Grade> grades_of(const std::vector<casedb::AttemptRow>& rows) override {
    const std::lock_guard lock(pages_.mutex);
    casedb::Grader grader(pages_.library);
    std::vector<assessment::Grade> grades;
    for (const casedb::AttemptRow& row : rows) grades.push_back(grader.grade(row));
    return grades;
  }

  assessment::statistics::Answer dependability() override {
    // Of everybody's attempts, which are long to read: from a library of its own, so that no other page waits.
    const std::lock_guard lock(dependability_mutex_);
    if (!attempts_) {
      auto opened = casedb::Library::open(pages_.library.folder());
      if (!opened) throw base::Failure("database", "the library cannot be opened again");
      attempts_.emplace(std::move(*opened));
    }
    return dependability_.of(*attempts_);
  }

  std::vector<casedb::CaseRow> list_cases() override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::list_case_heads(pages_.library);
  }

  std::vector<reports::CurriculumView> list_curricula(const std::optional<std::string>& person_id) override {
    const std::lock_guard lock(pages_.mutex);
    std::vector<reports::CurriculumView> views;
    for (casedb::Curriculum& one : casedb::list_curricula(pages_.library)) {
      auto items =
          person_id ? casedb::states_of(pages_.library, one, *person_id) : casedb::states_of(pages_.library, one);
      views.push_back({std::move(one), std::move(items)});
    }
    return views;
  }

  base::Result<casedb::CaseParts> find_case(const std::string& case_id) override {
    std::unique_lock lock(pages_.mutex);
    auto parts = casedb::load_parts(pages_.library, case_id);
    lock.unlock();
    if (parts && !parts->row.rule.criteria.empty()) parts->dependability = dependability();
    return parts;
  }

  std::string case_mark(const std::string& case_id) override {
    const std::lock_guard lock(pages_.mutex);
    return casedb::content_mark(pages_.library, case_id);
  }

  base::Result<casedb::CaseCheck> check_case(const casedb::CaseRow& row) override {
    if (!work_.check) return base::Error{"not_checked", "cases are not checked here"};
    return heavily(work_.check, row.case_id);
  }

  base::Result<reports::DrawnPictures> pictures_of(const std::string& attempt_id) override {
    if (!work_.pictures) return base::Error{"not_drawn", "pictures of a replay are not drawn here"};
    return heavily(work_.pictures, attempt_id);
  }

  base::Result<std::vector<std::byte>> load_picture(const casedb::AttemptRow& row) override {
    const std::lock_guard lock(pages_.mutex);
    return pages_.library.load_asset(row.picture_sha256);
  }

  base::Result<cases::Mesh> load_skin(const std::string& case_id) override {
    const std::lock_guard lock(recordings_.mutex);
    const auto row = casedb::find_case(recordings_.library, case_id);
    if (!row) return row.error();
    return casedb::load_skin(recordings_.library, *row);
  }

  base::Result<cases::Recording> load_recording(const std::string& attempt_id) override {
    const std::lock_guard lock(recordings_.mutex);
    return casedb::load_recording(recordings_.library, attempt_id);
  }

  casedb::Health health() override {
    using Clock = std::chrono::steady_clock;
    const std::lock_guard lock(health_mutex_);
    if (!looked_ || Clock::now() - *looked_ >= std::chrono::seconds(1)) {
      health_ = watch_.look();
      looked_ = Clock::now();
    }
    return health_;
  }

 private:
  // With a handle of its own, so that no page waits.
  template <typename Answer>
  base::Result<Answer> heavily(
      const std::function<base::Result<Answer>(casedb::Library&, const std::string&)>& work,
      const std::string& id) {
    auto library = casedb::Library::open(pages_.library.folder());
    if (!library) return library.error();
    auto answer = work(*library, id);
    ::malloc_trim(0);  // a case took hundreds of megabytes
    return answer;
  }

  static reports::StudyView study_head(casedb::Library& library, casedb::Study study) {
    reports::StudyView view;
    view.study = std::move(study);
    if (auto plan = casedb::find_plan(library, view.study.study_id)) view.plan = std::move(*plan);
    view.enrolments = casedb::list_study_enrolments(library, view.study.study_id);
    std::erase_if(view.enrolments, [](const casedb::StudyEnrolment& one) { return !one.consents; });
    view.looks = casedb::list_looks(library, view.study.study_id);
    return view;
  }

  Handle pages_, recordings_;  // a recording is long to read: meanwhile other pages are answered
  Handle first_, second_;      // a password is long to hash
  Handle changes_;             // a change may wait for another program's
  Kept<std::vector<casedb::Cohort>> cohorts_, members_;  // under pages_.mutex, as these
  Kept<std::map<std::string, casedb::ToldCells>> told_;
  std::map<std::string, Kept<LearnerRecords>> records_;  // by person
  std::mutex dependability_mutex_;
  std::optional<casedb::Library> attempts_;  // under dependability_mutex_, as this
  casedb::KeptDependability dependability_;
  HeavyWork work_;
  std::mutex health_mutex_;
  casedb::HealthWatch watch_{pages_.library.folder()};
  casedb::Health health_ = casedb::Health::ok;
  std::optional<std::chrono::steady_clock::time_point> looked_;
};

}  // namespace

base::Result<std::unique_ptr<Questions>> questions_of(casedb::Library library, HeavyWork work) {
  auto recordings = casedb::Library::open(library.folder());
  if (!recordings.has_value()) return recordings.error();
  auto first = casedb::Library::open(library.folder());
  if (!first.has_value()) return first.error();
  auto second = casedb::Library::open(library.folder());
  if (!second.has_value()) return second.error();
  auto changes = casedb::Library::open(library.folder());
  if (!changes.has_value()) return changes.error();
  return std::unique_ptr<Questions>(
      std::make_unique<LibraryQuestions>(std::array{std::move(library), std::move(*recordings), std::move(*first),
                                                    std::move(*second), std::move(*changes)},
                                         std::move(work)));
}

base::Result<Server> open_server(casedb::Library library, const ServeOptions& options, std::string program_version,
                                 std::function<void(const std::string&)> log, HeavyWork work) {
  const std::filesystem::path jobs_folder = library.folder() / casedb::kJobsFolder;
  JobRunner jobs = std::move(work.jobs);
  auto questions = questions_of(std::move(library), std::move(work));
  if (!questions.has_value()) return questions.error();
  Surroundings surroundings;
  surroundings.now_us = [] {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::int64_t{std::chrono::duration_cast<std::chrono::microseconds>(now).count()};
  };
  surroundings.utc_us = [] { return casedb::now_us(); };
  surroundings.random_id = [] {
    std::array<std::byte, 32> bytes{};
    casedb::fill_random(bytes);
    return base::hex_from_bytes(bytes);
  };
  surroundings.sha256_hex = [](std::string_view text) {
    return casedb::sha256_hex(std::as_bytes(std::span(text.data(), text.size())));
  };
  surroundings.log = std::move(log);
  surroundings.program_version = std::move(program_version);
  if (jobs) surroundings.jobs = std::make_shared<Jobs>(jobs_folder, std::move(jobs), surroundings.utc_us);
  return Server::open(std::move(*questions), std::move(surroundings), options);
}

}  // namespace seldinger::web
