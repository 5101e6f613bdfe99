// Learners and how far they are: for themselves, and for who answers for them.
#include <algorithm>

#include "reports/pages/people/learner_page.h"
#include "reports/pages/people/learners_page.h"
#include "reports/words/attempt_words.h"
#include "web/routes/shelves.h"
#include "web/site/access.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

constexpr std::string_view kWhoseProgress = "trainee: own; mentor: own cohort; director: own programmes";

// Those whom the reader may see, by name, each with the cohorts in which they may be seen.
std::vector<reports::LearnerView> visible_learners(Site& site, const Reader& reader) {
  const casedb::Account& account = reader.account;
  const Relations relations = site.questions.relations_of(account.person_id);
  std::map<std::string, std::string> names;
  for (const casedb::Account& one : site.questions.list_accounts()) names.emplace(one.person_id, one.login_name);
  std::map<std::string, reports::LearnerView> learners;
  for (const casedb::Cohort& cohort : site.questions.list_members()) {
    if (!casedb::may(account.role, Action::see_cohort,
                     site.questions.relation_to_cohort(account.person_id, cohort)))
      continue;
    for (const casedb::Learner& one : cohort.learners) {
      const casedb::Relation relation = relation_to(relations, one.person_id);
      if (!one.still || !casedb::may(account.role, Action::see_progress, relation)) continue;
      reports::LearnerView& view = learners[one.person_id];
      view.person_id = one.person_id;
      const auto name = names.find(one.person_id);
      view.label = name != names.end() && casedb::may(account.role, Action::see_operator_name, relation)
                       ? name->second
                       : reports::person_text(one.person_id);
      view.cohorts.push_back(cohort.title);
    }
  }
  std::vector<reports::LearnerView> views;
  for (auto& [person_id, view] : learners) {
    LearnerRecords found = site.questions.records_of(person_id);
    view.simulated = found.simulated;
    view.records = std::move(found.records);
    views.push_back(std::move(view));
  }
  return views;
}

// A learner with nothing that the reader may not see; none: there is nobody, or they are not the reader's to see.
std::optional<reports::LearnerView> visible_learner(Site& site, const Reader& reader,
                                                    const std::string& person_id) {
  const casedb::Account& account = reader.account;
  const Relations relations = site.questions.relations_of(account.person_id);
  if (!relations.contains(person_id) ||
      !casedb::may(account.role, Action::see_progress, relation_to(relations, person_id)))
    return std::nullopt;
  reports::LearnerView view{person_id, reports::person_text(person_id), {}, false, nullptr};
  const auto named = site.questions.find_account(person_id);
  if (named && casedb::may(account.role, Action::see_operator_name, relation_to(relations, person_id)))
    view.label = named->login_name;
  for (const casedb::Cohort& cohort : site.questions.list_members()) {
    const bool seen =
        person_id == account.person_id ||
        casedb::may(account.role, Action::see_cohort, site.questions.relation_to_cohort(account.person_id, cohort));
    if (seen && std::any_of(cohort.learners.begin(), cohort.learners.end(),
                            [&](const auto& one) { return one.still && one.person_id == person_id; }))
      view.cohorts.push_back(cohort.title);
  }
  LearnerRecords found = site.questions.records_of(person_id);
  view.simulated = found.simulated;
  view.records = std::move(found.records);
  return view;
}

Response list_learners(Site& site, const Call& call) {
  reports::LearnersView view;
  view.learners = visible_learners(site, *call.reader);
  view.now_us = site.surroundings.utc_us();
  for (const reports::LearnerView& one : view.learners)
    view.cohorts.insert(view.cohorts.end(), one.cohorts.begin(), one.cohorts.end());
  std::sort(view.cohorts.begin(), view.cohorts.end());
  view.cohorts.erase(std::unique(view.cohorts.begin(), view.cohorts.end()), view.cohorts.end());
  const auto asked = form_fields(call.request.query);
  if (!asked) return refusal(400, call.reader);
  const auto value = [&](const char* name) {
    const auto found = asked->find(name);
    return found == asked->end() ? std::string() : found->second;
  };
  view.part = {value("curriculum"), value("cohort"), value("standing")};
  // What does not exist, or is not the reader's to know of, narrows nothing.
  if (std::find(view.cohorts.begin(), view.cohorts.end(), view.part.cohort) == view.cohorts.end())
    view.part.cohort.clear();
  if (!assessment::standing_from(view.part.standing)) view.part.standing.clear();
  const bool known =
      !view.learners.empty() &&
      std::any_of(view.learners.front().records->begin(), view.learners.front().records->end(),
                  [&](const auto& one) { return one.curriculum.curriculum_id == view.part.curriculum_id; });
  if (!known) view.part.curriculum_id.clear();
  return html_response(200, reports::learners_page(call.reader->visitor(), view));
}

Response show_own_progress(Site& site, const Call& call) {
  const auto view = visible_learner(site, *call.reader, call.reader->account.person_id);
  if (!view) return refusal(404, call.reader);
  return html_response(200, reports::learner_page(call.reader->visitor(), *view, true, site.surroundings.utc_us()));
}

// Who learns themselves sees that, who answers for others sees these.
Response show_progress(Site& site, const Call& call) {
  casedb::Relation own;
  own.own = true;
  return casedb::may(call.reader->account.role, Action::see_progress, own) ? show_own_progress(site, call)
                                                                           : list_learners(site, call);
}

Response show_learner(Site& site, const Call& call) {
  const auto view = visible_learner(site, *call.reader, call.id);
  if (!view) return refusal(404, call.reader);
  const bool own = call.id == call.reader->account.person_id;
  return html_response(200, reports::learner_page(call.reader->visitor(), *view, own, site.surroundings.utc_us()));
}

Response show_record(Site& site, const Call& call) {
  const auto view = visible_learner(site, *call.reader, call.id);
  if (!view) return refusal(404, call.reader);
  return html_response(
      200, reports::learner_record_page(call.reader->visitor(), *view, site.questions.standard_texts(view->records),
                                        site.surroundings.utc_us()));
}

constexpr Route kLearnerRoutes[] = {
    {"GET", "/progress", Action::see_progress, true, kWhoseProgress,
     "trainee: how far they are, what is due and why; others: who is ready, nearly, stuck, absent or lapsed, and "
     "what "
     "keeps them; ?curriculum=ID&cohort=TITLE&standing=STATE",
     show_progress},
    {"GET", "/progress/{person_id}", Action::see_progress, true, kWhoseProgress,
     "one learner: where they stand by which rule, item by item", show_learner},
    {"GET", "/progress/{person_id}/record", Action::see_progress, true, kWhoseProgress,
     "the same as a record to print and sign", show_record},
};

}  // namespace

std::span<const Route> learner_routes() {
  return kLearnerRoutes;
}

}  // namespace seldinger::web
