// Studies, for who works on them.
#include "web/json/lists_json.h"
#include "web/routes/shelves.h"
#include "web/routes/studies.h"

namespace seldinger::web {
namespace {

using casedb::Action;
constexpr std::string_view kOwnStudies = "researcher: own studies";

bool works_on(Site& site, const Call& call, Action action, const std::string& study_id) {
  const casedb::Account& account = call.reader->account;
  return casedb::may(account.role, action, site.questions.relation_to_study(account.person_id, study_id));
}

Response list_studies(Site& site, const Call& call) {
  return html_response(200, reports::studies_page(call.reader->visitor(), studies_of(site, *call.reader)));
}

Response list_studies_json(Site& site, const Call& call) {
  return json_response(studies_json(studies_of(site, *call.reader)));
}

Response show_study(Site& site, const Call& call) {
  if (!works_on(site, call, Action::plan_study, call.id)) return refusal(404, call.reader);
  const auto view = site.questions.find_study(call.id);
  if (!view) return refusal(404, call.reader);
  return list_response(reports::study_page(call.reader->visitor(), *view));
}

Response show_study_json(Site& site, const Call& call) {
  if (!works_on(site, call, Action::plan_study, call.id)) return refusal(404, call.reader);
  const auto view = site.questions.find_study(call.id);
  return view ? json_response(study_json(*view)) : refusal(404, call.reader);
}

constexpr Route kStudyRoutes[] = {
    {"GET", "/studies", Action::plan_study, true, kOwnStudies, "the list, oldest first", list_studies},
    {"GET", "/studies.json", Action::plan_study, false, kOwnStudies, "the same list", list_studies_json},
    {"GET", "/studies/{study_id}", Action::plan_study, true, kOwnStudies,
     "one study: its plan, who takes part by pseudonym, how far they are, who has looked; no outcome", show_study},
    {"GET", "/studies/{study_id}/study.json", Action::plan_study, false, kOwnStudies, "the same; no outcome",
     show_study_json},
};

}  // namespace

std::vector<reports::StudyView> studies_of(Site& site, const Reader& reader) {
  std::vector<reports::StudyView> views;
  for (reports::StudyView& one : site.questions.list_studies())
    if (casedb::may(reader.account.role, Action::plan_study,
                    site.questions.relation_to_study(reader.account.person_id, one.study.study_id)))
      views.push_back(std::move(one));
  return views;
}

std::span<const Route> study_routes() {
  return kStudyRoutes;
}

}  // namespace seldinger::web
