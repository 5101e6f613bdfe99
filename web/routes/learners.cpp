#include "web/routes/learners.h"

#include <algorithm>
#include <map>

#include "reports/words/attempt_words.h"
#include "web/site/access.h"

namespace seldinger::web {

using casedb::Action;

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

}  // namespace seldinger::web
