#include "web/json/lists_json.h"

#include "casedb/database/values_json.h"
#include "reports/words/dependability_words.h"
#include "reports/words/metric_words.h"

namespace seldinger::web {
namespace {

using Json = nlohmann::ordered_json;

// Of another's programme what is withheld is null.
Json count_or_null(int count) {
  return count < 0 ? Json(nullptr) : Json(count);
}

// Where somebody stands in each curriculum.
Json standings(const reports::LearnerView& learner, std::int64_t now_us) {
  Json list = Json::array();
  for (const casedb::CurriculumRecord& record : *learner.records) {
    const assessment::StandingFound found = casedb::standing_in(record, now_us);
    list.push_back({{"curriculum_id", record.curriculum.curriculum_id},
                    {"title", record.curriculum.title},
                    {"standing", assessment::name_of(found.standing)},
                    {"item", found.item ? Json(*found.item + 1) : Json(nullptr)},
                    {"last_us", casedb::maybe(found.last_us)},
                    {"misses_running", found.misses},
                    {"passes_missing", found.passes_missing}});
  }
  return list;
}

Json head_of(const reports::LearnerView& learner) {
  return {{"person_id", learner.person_id},
          {"name", learner.label},
          {"cohorts", learner.cohorts},
          {"simulated", learner.simulated}};
}

Json json_of(const casedb::ItemState& item) {
  return {{"case_id", casedb::maybe(item.case_id)},
          {"title", item.title},
          {"version", item.version},
          {"attempts", item.attempts},
          {"passes", item.passes},
          {"reached", assessment::name_of(item.progress.reached)},
          {"open", item.progress.open},
          {"due", item.progress.due},
          {"attempts_left", casedb::maybe(item.progress.attempts_left)},
          {"passes_missing", item.progress.passes_missing}};
}

// Whose study it is, how many consent, and what is planned.
Json json_of_head(const reports::StudyView& one) {
  return {{"study_id", one.study.study_id},
          {"title", one.study.title},
          {"consenting", one.study.people.consenting()},
          {"simulated", one.study.people.simulated_people()},
          {"enrolled", one.plan && one.plan->frozen() ? Json(one.enrolments.size()) : Json(nullptr)},
          {"plan_state", !one.plan ? Json(nullptr) : Json(one.plan->frozen() ? "frozen" : "draft")},
          {"looks_count", one.looks.size()}};
}

// Days, as the page has them.
Json json_of_notes(std::span<const casedb::StudyNote> notes, bool looks) {
  Json list = Json::array();
  for (const casedb::StudyNote& one : notes) {
    list.push_back(
        {{"number", one.number}, {"on", reports::utc_text(one.at_us).substr(0, 10)}, {"text", one.text}});
    if (looks) list.back()["people"] = one.people;
  }
  return list;
}

}  // namespace

std::string attempts_json(std::span<const reports::AttemptView> attempts, const reports::ListPart& part) {
  Json list = Json::array();
  for (const reports::AttemptView& one : attempts)
    list.push_back({{"attempt_id", one.row.attempt_id},
                    {"case_id", one.row.case_id},
                    {"case", one.row.case_title},
                    {"operator", one.operator_label},
                    {"synthetic", one.row.synthetic()},
                    {"started_us", one.row.started_us},
                    {"duration_s", one.row.duration_s},
                    {"verdict", assessment::name_of(one.grade.grade.verdict)}});
  return casedb::line({{"page", part.page}, {"pages", part.pages}, {"total", part.total}, {"attempts", list}});
}

std::string learners_json(std::span<const reports::LearnerView> learners, std::int64_t now_us) {
  Json list = Json::array();
  for (const reports::LearnerView& one : learners) {
    Json learner = head_of(one);
    learner["curricula"] = standings(one, now_us);
    list.push_back(std::move(learner));
  }
  return casedb::line({{"learners", list}});
}

std::string learner_json(const reports::LearnerView& learner, std::int64_t now_us) {
  Json json = head_of(learner);
  json["curricula"] = standings(learner, now_us);
  for (std::size_t i = 0; i < learner.records->size(); ++i) {
    Json items = Json::array();
    for (const casedb::ItemState& item : (*learner.records)[i].items) {
      Json state = json_of(item), graded = Json::array();
      for (const assessment::GradedAttempt& one : item.graded)
        graded.push_back({{"attempt_id", one.attempt_id},
                          {"started_us", one.started_us},
                          {"duration_s", one.duration_s},
                          {"verdict", assessment::name_of(one.verdict)},
                          {"missed", one.missed}});
      state["graded"] = std::move(graded);
      items.push_back(std::move(state));
    }
    json["curricula"][i]["items"] = std::move(items);
  }
  return casedb::line(json);
}

std::string cohorts_json(std::span<const reports::CohortView> cohorts) {
  Json list = Json::array();
  for (const reports::CohortView& one : cohorts)
    list.push_back({{"cohort_id", one.cohort.cohort_id},
                    {"title", one.cohort.title},
                    {"programme", one.cohort.programme},
                    {"site", one.cohort.site},
                    {"names", one.named ? Json(one.learners) : Json(nullptr)},
                    {"learners", count_or_null(one.cells.learners)},
                    {"attempts", count_or_null(one.cells.attempts)},
                    {"with_hit", count_or_null(one.cells.with_hit)},
                    {"hits", count_or_null(one.cells.hits)},
                    {"simulated", one.cells.simulated},
                    {"simulated_names", one.named ? Json(one.simulated) : Json(nullptr)}});
  return casedb::line({{"cohorts", list}});
}

std::string curricula_json(std::span<const reports::CurriculumView> curricula, bool own,
                           const assessment::statistics::Answer& dependability) {
  Json list = Json::array();
  for (const reports::CurriculumView& one : curricula) {
    Json items = Json::array();
    for (std::size_t i = 0; i < one.items.size(); ++i) {
      const casedb::ItemState& item = one.items[i];
      Json gates = Json::array();
      for (const assessment::Gate& gate : one.curriculum.items[i].gates)
        gates.push_back({{"item", gate.after + 1}, {"reached", assessment::name_of(gate.reached)}});
      items.push_back({{"case_id", casedb::maybe(item.case_id)},
                       {"title", item.title},
                       {"version", item.case_id.empty() ? Json(nullptr) : Json(item.version)},
                       {"gates", gates}});
      if (!own) items.back()["attempts_allowed"] = casedb::maybe(item.progress.attempts_left);
    }
    list.push_back({{"curriculum_id", one.curriculum.curriculum_id},
                    {"title", one.curriculum.title},
                    {"state", casedb::name_of(one.curriculum.state)},
                    {"items", items}});
  }
  const bool told = dependability.estimable() && !reports::withheld(dependability, casedb::Learners::people);
  return casedb::line({{"curricula", list},
                       {"dependability",
                        {{"phi", told ? Json(*dependability.estimate) : Json(nullptr)},
                         {"words", reports::dependability_text(dependability, casedb::Learners::people)}}}});
}

std::string cases_json(std::span<const casedb::CaseRow> cases) {
  Json list = Json::array();
  for (const casedb::CaseRow& one : cases)
    list.push_back({{"case_id", one.case_id},
                    {"title", one.title},
                    {"state", casedb::name_of(one.state)},
                    {"version", one.version},
                    {"modality", casedb::name_of(one.modality)}});
  return casedb::line({{"cases", list}});
}

std::string studies_json(std::span<const reports::StudyView> studies) {
  Json list = Json::array();
  for (const reports::StudyView& one : studies) list.push_back(json_of_head(one));
  return casedb::line({{"studies", list}});
}

std::string study_json(const reports::StudyView& study) {
  Json json = json_of_head(study);
  if (!study.plan) return casedb::line(json);
  json["plan"] = Json::parse(study.plan->body, nullptr, false);
  if (json["plan"].is_discarded()) json["plan"] = nullptr;  // without it there is still how far it is
  json["plan_sha256"] = study.plan->body_hash;
  if (!study.plan->frozen()) {
    json["so_far"] = {{"consenting", study.blinded.people.consenting()},
                      {"simulated", study.blinded.people.simulated_people()},
                      {"with_attempts", study.blinded.with_attempts},
                      {"attempts", study.blinded.attempts}};
    return casedb::line(json);
  }
  Json groups = Json::array(), enrolments = Json::array(), visits = Json::array();
  for (const casedb::GroupFlow& one : study.flow.groups)
    groups.push_back({{"group", one.name},
                      {"allocated", one.allocated},
                      {"withdrew", one.withdrew},
                      {"attempted", one.attempted}});
  for (const casedb::StudyEnrolment& one : study.enrolments)
    enrolments.push_back({{"pseudonym", one.pseudonym},
                          {"group", one.group},
                          {"stratum", casedb::maybe(one.stratum)},
                          {"enrolled_on", reports::utc_text(one.enrolled_us).substr(0, 10)}});
  for (const casedb::PersonVisit& one : study.visits)
    visits.push_back({{"pseudonym", one.pseudonym},
                      {"visit", one.visit},
                      {"state", base::name_of(casedb::kVisitStateNames, one.state)}});
  json["flow"] = {{"consenting", study.flow.people.consenting()},
                  {"simulated", study.flow.people.simulated_people()},
                  {"ever_enrolled", study.flow.ever_enrolled},
                  {"erased_since", study.flow.unknown},
                  {"groups", groups}};
  json["enrolments"] = enrolments;
  json["visits"] = visits;
  json["looks"] = json_of_notes(study.looks, true);
  json["deviations"] = json_of_notes(study.deviations, false);
  return casedb::line(json);
}

std::string accounts_json(std::span<const casedb::Account> accounts) {
  Json list = Json::array();
  for (const casedb::Account& one : accounts)
    list.push_back({{"person_id", one.person_id},
                    {"name", one.login_name},
                    {"role", casedb::name_of(one.role)},
                    {"open", one.enabled}});
  return casedb::line({{"accounts", list}});
}

std::string log_ins_json(std::span<const reports::DelayedLogIn> delayed) {
  Json list = Json::array();
  for (const reports::DelayedLogIn& one : delayed)
    list.push_back({{"person_id", one.person_id}, {"name", one.login_name}, {"wait_s", one.wait_s}});
  return casedb::line({{"waiting", list}});
}

std::string audit_json(const reports::AuditView& view) {
  Json list = Json::array();
  for (const casedb::AuditRow& one : view.rows)
    list.push_back({{"sequence", one.sequence},
                    {"at_us", one.at_us},
                    {"actor", one.actor},
                    {"person_id", casedb::maybe(one.person_id)},
                    {"act", one.act},
                    {"object", one.object},
                    {"object_id", casedb::maybe(one.object_id)},
                    {"result", one.result},
                    {"hash", one.hash}});
  return casedb::line({{"days", view.days},
                       {"count", view.count},
                       {"more", view.more},
                       {"problems", view.problems},
                       {"rows", list}});
}

std::string about_json(const reports::AboutMe& about) {
  Json facts = Json::array(), consents = Json::array();
  for (const casedb::FactGiven& one : about.facts)
    facts.push_back({{"fact", one.fact_id}, {"answer", one.answer}, {"given_us", one.given_us}});
  for (const casedb::Consent& one : about.consents)
    consents.push_back({{"text_id", one.text_id},
                        {"study", one.study_id ? Json(one.study_title) : Json(nullptr)},
                        {"version", one.version},
                        {"sha256", one.body_hash},
                        {"given_us", casedb::maybe(one.given_us)},
                        {"withdrawn_us", casedb::maybe(one.withdrawn_us)},
                        {"stands", one.stands()}});
  return casedb::line({{"facts", facts}, {"consents", consents}});
}

}  // namespace seldinger::web
