#include "app/acting/names.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <unordered_map>

#include "app/cli/command.h"
#include "app/cli/words.h"
#include "casedb/attempts/attempt_history.h"
#include "casedb/attempts/attempts.h"
#include "casedb/cases/cases.h"
#include "casedb/cases/permissions.h"
#include "casedb/grading/curriculum.h"
#include "casedb/people/cohorts.h"
#include "casedb/people/consent.h"
#include "sim/base/ascii.h"

namespace seldinger::app {
namespace {

using casedb::Action;
using casedb::Role;

// As every id is written: 8-4-4-4-12 hexadecimal digits.
bool is_whole_id(std::string_view text) {
  return text.size() == 36 && text[8] == '-' && text[13] == '-' && text[18] == '-' && text[23] == '-';
}

// Who looks for something; none: the operator, who has the files.
struct Looking {
  std::optional<Role> role;  // none beside a person: nobody, or an account that is closed
  std::optional<std::string> person_id;
  bool all = false;

  bool may(Action action, const casedb::Subject& subject = {}) const {
    return all || (role && casedb::may(*role, action, subject));
  }
};

Looking who_looks(casedb::Library& library) {
  Looking looking;
  looking.all = library.actor().is_operator();
  if (looking.all || !library.actor().person_id) return looking;
  looking.person_id = library.actor().person_id;
  for (const casedb::Account& one : casedb::list_users(library))
    if (one.person_id == looking.person_id && one.enabled) looking.role = one.role;
  return looking;
}

std::vector<Called> cases_seen(casedb::Library& library, const Looking& looking) {
  std::vector<Called> seen;
  for (const casedb::CaseRow& row : casedb::list_case_heads(library))
    if (looking.may(Action::see_case, row.state)) seen.push_back({row.case_id, row.title});
  return seen;
}

std::vector<Called> lesions_seen(casedb::Library& library, const Looking& looking, const std::string& case_id) {
  std::vector<Called> seen;
  const std::vector<Called> cases = cases_seen(library, looking);
  const bool sees_case =
      std::any_of(cases.begin(), cases.end(), [&](const Called& one) { return one.id == case_id; });
  if (sees_case)
    for (const casedb::LesionRow& lesion : casedb::list_lesions(library, case_id))
      seen.push_back({lesion.lesion_id, {}});
  return seen;
}

// Those that were interrupted too.
std::vector<Called> attempts_seen(casedb::Library& library, const Looking& looking) {
  std::vector<Called> seen;
  std::unordered_map<std::string, casedb::Relation> relations;
  if (looking.person_id) relations = casedb::relations_of(library, *looking.person_id);
  const auto keep = [&](const std::string& attempt_id, const std::optional<std::string>& person_id) {
    casedb::Relation whose;
    whose.nobodys = !person_id;
    if (person_id)
      if (const auto found = relations.find(*person_id); found != relations.end()) whose = found->second;
    if (looking.may(Action::see_attempt, whose) || looking.may(Action::erase_attempts, whose))
      seen.push_back({attempt_id, {}});
  };
  for (const casedb::AttemptKey& key : casedb::list_attempt_keys(library)) keep(key.attempt_id, key.person_id);
  for (const casedb::OpenAttempt& open : casedb::list_open_attempts(library)) keep(open.attempt_id, open.person_id);
  return seen;
}

std::vector<Called> studies_seen(casedb::Library& library, const Looking& looking) {
  std::vector<Called> seen;
  for (const casedb::Study& one : casedb::list_studies(library)) {
    casedb::Relation whose;
    whose.own_study = looking.person_id && casedb::is_researcher_of(library, one.study_id, *looking.person_id);
    if (looking.may(Action::manage_studies) || looking.may(Action::export_study, whose))
      seen.push_back({one.study_id, one.title});
  }
  return seen;
}

std::vector<Called> cohorts_seen(casedb::Library& library, const Looking& looking) {
  std::vector<Called> seen;
  for (const casedb::Cohort& one : casedb::list_cohorts(library)) {
    casedb::Relation whose;
    if (looking.person_id)
      whose = casedb::relation_to_cohort(library, *looking.person_id, one.cohort_id, one.programme);
    if (looking.may(Action::see_cohort, whose) || looking.may(Action::manage_cohorts, whose))
      seen.push_back({one.cohort_id, one.title});
  }
  return seen;
}

std::vector<Called> curricula_seen(casedb::Library& library, const Looking& looking) {
  std::vector<Called> seen;
  for (const casedb::Curriculum& one : casedb::list_curricula(library))
    if (looking.may(Action::see_curriculum, one.state)) seen.push_back({one.curriculum_id, one.title});
  return seen;
}

// What is named so in a synopsis, and the code of what is not there.
struct Kind {
  std::string_view name;
  const char* unknown;
};
constexpr Kind kKinds[] = {{"CASE", "no_case"},   {"LESION", "no_lesion"}, {"ATTEMPT", "no_attempt"},
                           {"STUDY", "no_study"}, {"COHORT", "no_cohort"}, {"CURRICULUM", "no_curriculum"}};

std::vector<Called> seen_of(casedb::Library& library, const Looking& looking, std::string_view kind,
                            const std::string& case_id) {
  if (kind == "CASE") return cases_seen(library, looking);
  if (kind == "LESION") return lesions_seen(library, looking, case_id);
  if (kind == "ATTEMPT") return attempts_seen(library, looking);
  if (kind == "STUDY") return studies_seen(library, looking);
  if (kind == "COHORT") return cohorts_seen(library, looking);
  return curricula_seen(library, looking);
}

base::Error ambiguous(const std::vector<std::string>& ids) {
  constexpr std::size_t kMostShown = 5;
  std::string text = std::to_string(ids.size()) + " have this name or begin with it:";
  for (std::size_t i = 0; i < std::min(ids.size(), kMostShown); ++i) text += (i == 0 ? " " : ", ") + ids[i];
  if (ids.size() > kMostShown) text += ", …";
  return {"ambiguous", text};
}

}  // namespace

base::Result<std::string> id_of(std::string_view typed, const std::vector<Called>& known) {
  if (typed.empty()) return std::string();
  const std::string wanted = base::lower(typed);
  std::vector<std::string> of_title, begin_so;
  for (const Called& one : known) {
    if (one.id == typed) return one.id;
    const std::string id = base::lower(one.id), title = base::lower(one.title);
    if (title == wanted) of_title.push_back(one.id);
    if (id.starts_with(wanted) || title.starts_with(wanted)) begin_so.push_back(one.id);
  }
  const std::vector<std::string>& found = of_title.empty() ? begin_so : of_title;
  if (found.size() > 1) return ambiguous(found);
  return found.empty() ? std::string() : found.front();
}

base::Result<void> settle_names(casedb::Library& library, const Arguments& arguments) {
  std::optional<Looking> looking;
  std::string case_id;
  for (const Kind& kind : kKinds)  // a lesion is one of its case's, which comes before it
    for (const TypedName& one : arguments.names(kind.name)) {
      errors_are_of(kind.unknown, one.what, one.typed);
      std::string id = one.typed;
      if (!is_whole_id(id)) {
        if (!looking) looking = who_looks(library);
        const auto found = id_of(one.typed, seen_of(library, *looking, kind.name, case_id));
        if (!found) return error_of(one.what, one.typed, found.error());
        if (!found->empty()) id = *found;
      }
      if (kind.name == "CASE") case_id = id;
      arguments.settle(one, id);
    }
  return {};
}

}  // namespace seldinger::app
