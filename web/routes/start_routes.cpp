// Where somebody lands after logging in: what there is for them to do now.
#include <algorithm>

#include "casedb/cases/versions.h"
#include "reports/pages/people/start_page.h"
#include "web/routes/learners.h"
#include "web/routes/said.h"
#include "web/routes/shelves.h"
#include "web/routes/studies.h"
#include "web/site/access.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;
using casedb::Role;

constexpr std::size_t kNewest = 50;  // attempts that are looked through
constexpr std::size_t kMostTold = 5;

std::vector<casedb::AttemptRow> newest_attempts(Site& site, const Reader& reader, const Relations& relations) {
  auto rows = site.questions.list_attempts(attempts_seen(reader.account.role, relations), 0, kNewest);
  // The question was right already; this holds it to the table.
  std::erase_if(
      rows, [&](const casedb::AttemptRow& row) { return !may_see_attempt(reader.account.role, relations, row); });
  return rows;
}

Response start_trainee(Site& site, const Reader& reader) {
  const std::string& person_id = reader.account.person_id;
  const auto rows = newest_attempts(site, reader, site.questions.relations_of(person_id));
  reports::TraineeStart start;
  start.records = site.questions.records_of(person_id).records;
  if (!rows.empty())
    start.last =
        reports::AttemptView{rows.front(), reader.account.login_name, site.questions.look_at(rows.front())};
  for (const casedb::AttemptRow& row : rows) {
    for (reports::CommentView& one : comments_of(site, row.attempt_id)) {
      if (start.said.size() == kMostTold) break;
      start.said.push_back({row.attempt_id, row.case_title, std::move(one)});
    }
  }
  return html_response(200, reports::trainee_start_page(reader.visitor(), start));
}

// What each case in review waits for, and whether that is the reader's to do.
std::vector<reports::CaseInReview> cases_in_review(Site& site, const casedb::Account& account) {
  std::vector<reports::CaseInReview> reviews;
  for (const casedb::CaseRow& row : site.questions.list_cases()) {
    if (row.state != casedb::CaseState::review || !may_see_case(account.role, row)) continue;
    const auto parts = site.questions.find_case(row.case_id);
    if (!parts) continue;
    const bool approved = casedb::review_of(parts->decisions).has_value();
    // Whose it is to the next step: who submitted a case does not approve it, who made it does not publish it.
    const bool own =
        std::any_of(parts->decisions.begin(), parts->decisions.end(), [&](const casedb::Decision& one) {
          const bool counts =
              one.kind == casedb::DecisionKind::submitted || (approved && one.kind == casedb::DecisionKind::made);
          return counts && one.person_id == account.person_id;
        });
    const bool may = casedb::may(account.role, approved ? Action::publish_reviewed_case : Action::approve_case,
                                 casedb::Subject::whose(own));
    reviews.push_back({row.case_id, row.title, approved, may});
  }
  return reviews;
}

// Those of other people that did not pass, as far as the reader may say something of them.
std::vector<reports::AttemptView> uncommented(Site& site, const Reader& reader) {
  const Role role = reader.account.role;
  const Relations relations = site.questions.relations_of(reader.account.person_id);
  auto rows = newest_attempts(site, reader, relations);
  std::erase_if(rows, [&](const casedb::AttemptRow& row) {
    return !casedb::may(role, Action::comment_attempt, relation_to(relations, row.person_id));
  });
  const auto grades = site.questions.grades_of(rows);
  const AccountOf account_of = [&](const std::string& person_id) { return site.questions.find_account(person_id); };
  std::vector<reports::AttemptView> views;
  for (std::size_t i = 0; i < rows.size() && views.size() < kMostTold; ++i)
    if (grades.at(i).verdict == assessment::Verdict::failed &&
        site.questions.list_comments(rows[i].attempt_id).empty())
      views.push_back({rows[i], operator_label(role, relations, rows[i], account_of)});
  return views;
}

Response start_leader(Site& site, const Reader& reader) {
  reports::LeaderStart start;
  start.learners = visible_learners(site, reader);
  start.reviews = cases_in_review(site, reader.account);
  if (casedb::roles_that_may(Action::comment_attempt).has(reader.account.role))
    start.uncommented = uncommented(site, reader);
  if (casedb::may(reader.account.role, Action::release_curriculum))
    for (const reports::CurriculumView& one : site.questions.list_curricula(std::nullopt))
      if (one.curriculum.state == casedb::CurriculumState::draft) start.drafts.push_back(one.curriculum.title);
  start.now_us = site.surroundings.utc_us();
  return html_response(200, reports::leader_start_page(reader.visitor(), start));
}

Response start_admin(Site& site, const Reader& reader) {
  reports::AdminStart start;
  start.health = site.questions.health();
  start.program_version = site.surroundings.program_version;
  for (const casedb::Account& one : site.questions.list_accounts()) {
    ++(one.enabled ? start.open_accounts : start.closed_accounts);
    start.delayed += site.delays.longest_wait_s(one.login_name, site.surroundings.now_us()) > 0 ? 1 : 0;
  }
  return html_response(200, reports::admin_start_page(reader.visitor(), start));
}

Response start(Site& site, const Call& call) {
  if (call.reader == nullptr) return redirect("/login");
  switch (call.reader->account.role) {
    case Role::trainee:
      return start_trainee(site, *call.reader);
    case Role::mentor:
    case Role::director:
      return start_leader(site, *call.reader);
    case Role::researcher:
      return html_response(200,
                           reports::researcher_start_page(call.reader->visitor(), studies_of(site, *call.reader)));
    case Role::admin:
      return start_admin(site, *call.reader);
  }
  return refusal(404, call.reader);
}

constexpr Route kStartRoutes[] = {
    {"GET", "/", kOpen, true, "", "what there is to do, by role; not logged in: goes on to /login", start},
};

}  // namespace

std::span<const Route> start_routes() {
  return kStartRoutes;
}

}  // namespace seldinger::web
