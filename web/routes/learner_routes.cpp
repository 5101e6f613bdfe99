// Learners and how far they are: for themselves, and for who answers for them.
#include <algorithm>

#include "reports/pages/people/learner_page.h"
#include "reports/pages/people/learners_page.h"
#include "web/json/lists_json.h"
#include "web/routes/learners.h"
#include "web/routes/shelves.h"
#include "web/site/site.h"

namespace seldinger::web {
namespace {

using casedb::Action;

constexpr std::string_view kWhoseProgress = "trainee: own; mentor: own cohort; director: own programmes";

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
  return list_response(reports::learners_page(call.reader->visitor(), view));
}

Response show_learner(Site& site, const Call& call, const std::string& person_id) {
  const auto view = visible_learner(site, *call.reader, person_id);
  if (!view) return refusal(404, call.reader);
  const bool own = person_id == call.reader->account.person_id;
  return html_response(
      200, reports::learner_page(call.reader->visitor(), *view, site.questions.learning_of(person_id), own,
                                 site.surroundings.utc_us()));
}

Response show_learner_json(Site& site, const Call& call, const std::string& person_id) {
  const auto view = visible_learner(site, *call.reader, person_id);
  return view ? json_response(learner_json(*view, site.surroundings.utc_us())) : refusal(404, call.reader);
}

bool learns(const Call& call) {
  casedb::Relation own;
  own.own = true;
  return casedb::may(call.reader->account.role, Action::see_progress, own);
}

// Who learns themselves sees that, who answers for others sees these.
Response show_progress(Site& site, const Call& call) {
  return learns(call) ? show_learner(site, call, call.reader->account.person_id) : list_learners(site, call);
}

Response show_progress_json(Site& site, const Call& call) {
  return learns(call)
             ? show_learner_json(site, call, call.reader->account.person_id)
             : json_response(learners_json(visible_learners(site, *call.reader), site.surroundings.utc_us()));
}

Response show_that_learner_json(Site& site, const Call& call) {
  return show_learner_json(site, call, call.id);
}

Response show_that_learner(Site& site, const Call& call) {
  return show_learner(site, call, call.id);
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
     "what holds them up; ?curriculum=ID&cohort=TITLE&standing=STATE",
     show_progress},
    {"GET", "/progress.json", Action::see_progress, false, kWhoseProgress,
     "trainee: how far they are, attempt by attempt; others: where each stands", show_progress_json},
    {"GET", "/progress/{person_id}", Action::see_progress, true, kWhoseProgress,
     "one learner: where they stand by which rule, item by item, and how they learn", show_that_learner},
    {"GET", "/progress/{person_id}/progress.json", Action::see_progress, false, kWhoseProgress,
     "the same, attempt by attempt", show_that_learner_json},
    {"GET", "/progress/{person_id}/record", Action::see_progress, true, kWhoseProgress,
     "the same as a record to print and sign", show_record},
};

}  // namespace

std::span<const Route> learner_routes() {
  return kLearnerRoutes;
}

}  // namespace seldinger::web
