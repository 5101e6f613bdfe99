// Cohorts, and who has to wait before the next try.
#include <map>

#include "reports/pages/cohorts_page.h"
#include "reports/pages/log_ins_page.h"
#include "reports/words/attempt_words.h"
#include "sim/base/failure.h"
#include "web/json/lists_json.h"
#include "web/routes/shelves.h"
#include "web/site/access.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

std::vector<reports::CohortView> visible_cohorts(Site& site, const Call& call) {
  const casedb::Role role = call.reader->account.role;
  const Relations relations = site.questions.relations_of(call.reader->account.person_id);
  std::map<std::string, std::string> names;
  for (const casedb::Account& one : site.questions.list_accounts()) names.emplace(one.person_id, one.login_name);
  const auto told = site.questions.told_cells(site.surroundings.utc_us());
  std::vector<reports::CohortView> views;
  for (const casedb::Cohort& cohort : site.questions.list_cohorts()) {
    // By name to who leads it or directs its programme. That each of its learners is seen elsewhere tells nothing
    // of it.
    const casedb::Relation to_cohort = site.questions.relation_to_cohort(call.reader->account.person_id, cohort);
    reports::CohortView view{cohort, casedb::may(role, casedb::Action::see_cohort, to_cohort), {}, {}, {}};
    if (view.named) {
      view.cells = casedb::cells_of(cohort);
      for (const casedb::Learner& one : cohort.learners) {
        if (!one.still) continue;
        const auto name = names.find(one.person_id);
        const bool may_read =
            casedb::may(role, casedb::Action::see_operator_name, relation_to(relations, one.person_id));
        (one.simulated ? view.simulated : view.learners)
            .push_back(name != names.end() && may_read ? name->second : reports::person_text(one.person_id));
      }
    } else if (casedb::may(role, casedb::Action::see_cohort_cells)) {
      view.cells = told.at(cohort.cohort_id).cells;
      view.cells.simulated = casedb::simulated_learners(cohort);
    } else {
      continue;
    }
    views.push_back(std::move(view));
  }
  return views;
}

Response list_cohorts(Site& site, const Call& call) {
  return list_response(reports::cohorts_page(call.reader->visitor(), visible_cohorts(site, call)));
}

Response list_cohorts_json(Site& site, const Call& call) {
  return json_response(cohorts_json(visible_cohorts(site, call)));
}

std::vector<reports::DelayedLogIn> delayed_log_ins(Site& site) {
  std::vector<reports::DelayedLogIn> delayed;
  for (const casedb::Account& one : site.questions.list_accounts())
    if (const auto wait_s = site.delays.longest_wait_s(one.login_name, site.surroundings.now_us()); wait_s > 0)
      delayed.push_back({one.person_id, one.login_name, wait_s});
  return delayed;
}

Response show_log_ins(Site& site, const Call& call) {
  return html_response(200, reports::log_ins_page(call.reader->visitor(), delayed_log_ins(site)));
}

Response show_log_ins_json(Site& site, const Call&) {
  return json_response(log_ins_json(delayed_log_ins(site)));
}

Response let_in_again(Site& site, const Call& call) {
  const auto account = site.questions.find_account(call.field("person"));
  if (!account) return refusal(404, call.reader);
  site.delays.forget(account->login_name);
  site.security.note("let in again by an admin", call.request.from, account->person_id);
  try {
    site.questions.let_in_again(call.reader->account.person_id, account->login_name);
    site.delays.heed(account->login_name, site.questions.last_let_in_again(account->person_id));
  } catch (const base::Failure& failure) {  // they are in, whatever becomes of the library
    site.log_fault(failure.code() + ": that somebody was let in again is not in the audit log");
  }
  return redirect("/log-ins");
}

constexpr std::string_view kWhoseCohorts =
    "mentor: own cohorts by name; director: own programmes by name, of others counts of at least 5 people";

constexpr Route kPeopleRoutes[] = {
    {"GET", "/cohorts", Action::see_cohort, true, kWhoseCohorts,
     "who is in which cohort, and what they did together", list_cohorts},
    {"GET", "/cohorts.json", Action::see_cohort, false, kWhoseCohorts, "the same; null is withheld",
     list_cohorts_json},
    {"GET", "/log-ins", Action::let_in_again, true, "", "who has to wait before the next try", show_log_ins},
    {"GET", "/log-ins.json", Action::let_in_again, false, "", "the same", show_log_ins_json},
    {"POST", "/log-ins", Action::let_in_again, true, "", "lets somebody try again at once: person, token",
     let_in_again, Lane::changes},
};

}  // namespace

std::span<const Route> people_routes() {
  return kPeopleRoutes;
}

}  // namespace seldinger::web
