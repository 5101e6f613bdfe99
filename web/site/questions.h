// What the pages ask. Called from several threads at once; throws base::Failure when the library is gone.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "casedb/attempts/attempts.h"
#include "casedb/attempts/comments.h"
#include "casedb/attempts/stations.h"
#include "casedb/cases/case_checks.h"
#include "casedb/cases/cases.h"
#include "casedb/grading/grading.h"
#include "casedb/json/case_json.h"
#include "casedb/keeping/erase.h"
#include "casedb/keeping/health.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/password_links.h"
#include "casedb/people/people.h"
#include "casedb/people/relations.h"
#include "casedb/people/told_cells.h"
#include "casedb/people/web_sessions.h"
#include "casedb/questionnaires/responses.h"
#include "casedb/ratings/rating_rounds.h"
#include "casedb/workshops/workshops.h"
#include "reports/pages/attempt_page.h"
#include "reports/pages/curricula_page.h"
#include "reports/pages/me_page.h"
#include "reports/pages/people/audit_page.h"
#include "reports/pages/people/learner_page.h"
#include "reports/pages/people/studies_page.h"

namespace seldinger::web {

// A round of a questionnaire, and its version in every language.
struct RoundForms {
  casedb::Round round;
  std::vector<casedb::StoredForm> forms;
};

struct LearnerRecords {
  bool simulated = false;
  reports::Records records;
};

// A workshop's day, and who came.
struct Board {
  casedb::Workshop workshop;
  std::vector<casedb::Participant> participants;
};

class Questions {
 public:
  virtual ~Questions() = default;

  virtual std::optional<casedb::Account> log_in(const std::string& name, const std::string& password) = 0;
  virtual void log_out(const std::string& person_id) = 0;  // kept in the audit log
  // By an admin: kept in the audit log, for other programs of this library too.
  virtual void let_in_again(const std::string& admin_id, const std::string& name) = 0;
  virtual std::int64_t last_let_in_again(const std::string& person_id) = 0;  // as casedb does
  // Who is logged in at this port, kept for the next start (casedb/people/web_sessions.h). Throws where nothing can
  // be written.
  virtual std::vector<casedb::WebSession> list_sessions(int port) = 0;
  virtual void keep_sessions(int port, const casedb::WebSessionChanges& changes) = 0;
  virtual std::optional<casedb::Account> find_account(const std::string& person_id) = 0;
  virtual std::vector<casedb::Account> list_accounts() = 0;

  // One-time links to set a password (casedb/people/password_links.h), by an admin and by whoever has one.
  virtual base::Result<casedb::PasswordLink> invite_user(const std::string& admin_id, const std::string& name,
                                                         casedb::Role role) = 0;
  virtual base::Result<casedb::PasswordLink> make_password_link(const std::string& admin_id,
                                                                const std::string& name) = 0;
  virtual std::optional<casedb::Account> account_of_password_link(const std::string& secret) = 0;
  virtual base::Result<void> set_password_by_link(const std::string& secret, const std::string& person_id,
                                                  const std::string& password) = 0;

  // What everybody is to the reader; who is missing is nothing to them.
  virtual std::unordered_map<std::string, casedb::Relation> relations_of(const std::string& reader_id) = 0;
  virtual std::vector<casedb::Cohort> list_cohorts() = 0;  // by programme and title
  virtual std::vector<casedb::Cohort> list_members() = 0;  // the same, without what they did
  // Of every cohort, by id: casedb::told_cells.
  virtual std::map<std::string, casedb::ToldCells> told_cells(std::int64_t now_us) = 0;
  virtual casedb::Relation relation_to_cohort(const std::string& reader_id, const casedb::Cohort& cohort) = 0;

  // How far somebody is in each published curriculum, and whether they are a simulated person. Kept until
  // casedb::records_mark changes.
  virtual LearnerRecords records_of(const std::string& person_id) = 0;
  // What they did, case by case, for charts.
  virtual std::vector<reports::LearnerItem> learning_of(const std::string& person_id) = 0;
  // How the standard of each case that they learn is called, by case id.
  virtual reports::StandardTexts standard_texts(const reports::Records& records) = 0;

  // Oldest first; of each its plan, who is in and the looks, no more.
  virtual std::vector<reports::StudyView> list_studies() = 0;
  virtual casedb::Relation relation_to_study(const std::string& reader_id, const std::string& study_id) = 0;
  virtual base::Result<reports::StudyView> find_study(const std::string& study_id) = 0;  // `no_study`

  // The last `days` of the audit log, newest first and 500 at most, and whether the whole log stands. Takes
  // milliseconds for each thousand rows of it.
  virtual reports::AuditView audit_of(int days) = 0;

  virtual reports::AboutMe about(const std::string& person_id) = 0;
  // All of them or none: as casedb::give_facts refuses.
  virtual base::Result<void> give_facts(const std::string& person_id,
                                        const std::map<std::string, std::string>& answers) = 0;
  virtual base::Result<void> give_consent(const std::string& person_id, const std::string& text_id) = 0;
  virtual base::Result<void> withdraw_consent(const std::string& person_id, const std::string& text_id) = 0;
  // On their own wish; takes seconds: the library is written anew.
  virtual base::Result<casedb::Erased> erase_attempts_of(const std::string& person_id) = 0;

  // Questionnaires, answered by nobody in particular: as casedb/questionnaires refuses.
  virtual base::Result<RoundForms> find_round(const std::string& code) = 0;
  virtual base::Result<std::string> begin_response(const std::string& code,
                                                   const casedb::Respondent& respondent) = 0;
  virtual base::Result<casedb::Draft> find_draft(const std::string& secret) = 0;
  // Keeps what was typed, and sends all of it.
  virtual base::Result<void> keep_answers(const std::string& secret,
                                          const std::map<std::string, std::string>& typed, bool send) = 0;

  // Replays, rated by whoever has a key: as casedb/ratings refuses.
  virtual base::Result<casedb::RatingBench> find_rating_bench(const std::string& secret) = 0;
  virtual base::Result<casedb::RatingPage> find_rating(const std::string& secret, std::size_t number) = 0;
  virtual base::Result<void> keep_rating(const std::string& secret, std::size_t number,
                                         const std::map<std::string, std::string>& typed, bool send) = 0;

  virtual base::Result<Board> find_board(const std::string& code) = 0;  // `no_workshop`

  virtual std::size_t count_attempts(const casedb::WhoseAttempts& whose) = 0;
  virtual std::vector<casedb::AttemptRow> list_attempts(const casedb::WhoseAttempts& whose, std::size_t first,
                                                        std::size_t count) = 0;              // newest first
  virtual base::Result<casedb::AttemptRow> find_attempt(const std::string& attempt_id) = 0;  // `no_attempt`
  virtual casedb::AttemptGrade look_at(const casedb::AttemptRow& row) = 0;
  virtual std::vector<assessment::Grade> grades_of(const std::vector<casedb::AttemptRow>& rows) = 0;  // in order
  virtual std::vector<casedb::CaseRow> list_cases() = 0;                              // oldest first
  virtual base::Result<casedb::CaseParts> find_case(const std::string& case_id) = 0;  // `no_case`
  // As they reach a person, or nobody; oldest first.
  virtual std::vector<reports::CurriculumView> list_curricula(const std::optional<std::string>& person_id) = 0;
  // Of passing, by what people did (casedb/grading/dependability.h).
  virtual assessment::statistics::Answer dependability() = 0;
  // casedb::content_mark: another one when a check would look at something else.
  virtual std::string case_mark(const std::string& case_id) = 0;
  // Takes seconds: the case is built. `not_checked` where the server has nobody who looks.
  virtual base::Result<casedb::CaseCheck> check_case(const casedb::CaseRow& row) = 0;
  // Which stations those people used for what; how well all of them keep time. Both may take a tenth of a second.
  virtual std::vector<casedb::StationUse> list_station_use(const std::vector<std::string>& people) = 0;
  virtual std::vector<casedb::StationTiming> list_station_timing() = 0;
  virtual std::vector<casedb::AttemptComment> list_comments(const std::string& attempt_id) = 0;
  virtual base::Result<void> add_comment(const std::string& person_id, const std::string& attempt_id, double at_s,
                                         const std::string& body) = 0;
  virtual std::vector<assessment::StepResult> list_steps(
      const std::string& attempt_id) = 0;  // in order; may be none
  virtual base::Result<std::vector<std::byte>> load_picture(const casedb::AttemptRow& row) = 0;
  // What was on the screen at the telling moments. Takes seconds: case and attempt are run again.
  // `not_drawn` where the server has nobody who draws.
  virtual base::Result<reports::DrawnPictures> pictures_of(const std::string& attempt_id) = 0;
  virtual base::Result<cases::Mesh> load_skin(const std::string& case_id) = 0;
  virtual base::Result<cases::Recording> load_recording(const std::string& attempt_id) = 0;
  virtual casedb::Health health() = 0;  // as it was a second ago at most
};

}  // namespace seldinger::web
