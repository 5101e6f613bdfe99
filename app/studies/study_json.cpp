#include "app/studies/study_json.h"

#include <nlohmann/json.hpp>

#include "app/statistics/answer_json.h"
#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;
namespace study = assessment::study;

Json head_of(const casedb::StoredPlan& plan) {
  return {{"study_id", plan.study_id},
          {"plan_sha256", plan.body_hash},
          {"frozen_us", casedb::maybe(plan.frozen_us)},
          {"people", base::name_of(study::kPeopleNames, plan.plan.people)},
          {"allocation_seed_sha256", casedb::maybe(plan.plan.randomised ? plan.seed_hash : std::string())}};
}

Json json_of(const casedb::StudyEnrolment& one) {
  return {{"pseudonym", one.pseudonym},
          {"group", one.group},
          {"stratum", casedb::maybe(one.stratum)},
          {"position", one.position},
          {"enrolled_us", one.enrolled_us},
          {"consents", one.consents}};
}

Json json_of(const casedb::StudyLock& lock) {
  return {{"locked_us", lock.locked_us},
          {"actor", lock.actor},
          {"pseudonym", casedb::maybe(lock.pseudonym)},
          {"data_sha256", lock.data_hash},
          {"people", lock.people}};
}

Json json_of(const std::vector<casedb::StudyNote>& notes, const char* text, bool looks) {
  Json list = Json::array();
  for (const casedb::StudyNote& one : notes) {
    Json json = {{"number", one.number},
                 {"at_us", one.at_us},
                 {"actor", one.actor},
                 {"pseudonym", casedb::maybe(one.pseudonym)},
                 {text, one.text}};
    if (looks) json["people"] = one.people;
    list.push_back(std::move(json));
  }
  return list;
}

Json json_of(const study::GroupSum& sum) {
  return {{"name", sum.name},
          {"persons", sum.persons},
          {"with_value", sum.with_value},
          {"failures", sum.failures},
          {"censored", sum.censored},
          {"absent", sum.absent},
          {"attempts", sum.attempts},
          {"median", casedb::maybe(sum.median)}};
}

Json json_of(const std::vector<study::Compared>& outcomes, bool primary) {
  Json list = Json::array();
  for (const study::Compared& one : outcomes) {
    Json json = {{"name", one.outcome.name},
                 {"metric", one.outcome.metric},
                 {"version", one.outcome.version},
                 {"hand", casedb::maybe(one.hand)},
                 {"refused", casedb::maybe(one.refused)},
                 {"groups", Json::array({json_of(one.first), json_of(one.second)})}};
    Json left_out = Json::array(), sensitivity = Json::array();
    for (const study::LeftOut& why : one.left_out)
      left_out.push_back({{"why", why.why}, {"attempts", why.attempts}});
    for (const study::Sensitivity& other : one.sensitivity)
      sensitivity.push_back({{"kind", base::name_of(study::kOtherRuleNames, other.kind)},
                             {"rule", other.rule},
                             {"shift", casedb::maybe(other.shift)},
                             {"answer", Json::parse(json_of_answer(other.answer))}});
    json["left_out"] = std::move(left_out);
    json["answer"] = one.refused.empty() ? Json::parse(json_of_answer(one.answer)) : Json(nullptr);
    if (primary)
      json["p_holm"] = casedb::maybe(one.p_adjusted);
    else if (one.refused.empty())
      json["answer"]["p_value"] = nullptr;  // of what is exploratory none is told
    json["sensitivity"] = std::move(sensitivity);
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

std::string json_of_studies(const std::vector<casedb::Study>& studies) {
  Json list = Json::array();
  for (const casedb::Study& one : studies)
    list.push_back({{"study_id", one.study_id},
                    {"title", one.title},
                    {"consenting", one.people.consenting()},
                    {"simulated", one.people.simulated_people()}});
  return casedb::text({{"studies", list}});
}

std::string json_of_plan(const casedb::StoredPlan& plan) {
  return casedb::text(head_of(plan));
}

std::string json_of_lock(const casedb::StoredPlan& plan, const casedb::StudyLock& lock) {
  Json json = head_of(plan);
  json["lock"] = json_of(lock);
  return casedb::text(json);
}

std::string json_of_study(const casedb::Study& study, const casedb::StoredPlan& plan,
                          const std::optional<casedb::StudyLock>& lock,
                          const std::vector<casedb::StudyEnrolment>& enrolments,
                          const std::vector<casedb::StudyNote>& looks,
                          const std::vector<casedb::StudyNote>& deviations) {
  Json json = head_of(plan), people = Json::array();
  json["title"] = study.title;
  json["consenting"] = study.people.consenting();
  json["simulated"] = study.people.simulated_people();
  json["plan"] = Json::parse(plan.body);
  for (const casedb::StudyEnrolment& one : enrolments) people.push_back(json_of(one));
  json["enrolments"] = std::move(people);
  json["lock"] = lock ? json_of(*lock) : Json(nullptr);
  json["looks"] = json_of(looks, "query", true);
  json["deviations"] = json_of(deviations, "text", false);
  return casedb::text(json);
}

std::string json_of_enrolled(const Enrolled& enrolled) {
  Json people = Json::array(), refused = Json::array();
  for (const casedb::StudyEnrolment& one : enrolled.enrolments) people.push_back(json_of(one));
  for (const base::Problem& one : enrolled.refused) refused.push_back({{"code", one.code}, {"text", one.text}});
  return casedb::text({{"enrolments", people}, {"refused", refused}});
}

std::string json_of_blinded(const casedb::StoredPlan& plan, const casedb::BlindedCounts& counts) {
  Json json = head_of(plan);
  json["blinded"] = true;
  json["consenting"] = counts.people.consenting();
  json["simulated"] = counts.people.simulated_people();
  json["with_attempts"] = counts.with_attempts;
  json["attempts"] = counts.attempts;
  return casedb::text(json);
}

std::string json_of_result(const casedb::StoredPlan& plan, const study::StudyResult& result,
                           const casedb::ParticipantFlow& flow, const std::string& data_hash) {
  Json json = head_of(plan), groups = Json::array();
  json["blinded"] = false;
  json["data_sha256"] = data_hash;
  json["complete"] = result.stopped;
  for (const casedb::GroupFlow& one : flow.groups)
    groups.push_back({{"name", one.name},
                      {"allocated", one.allocated},
                      {"withdrew", one.withdrew},
                      {"attempted", one.attempted},
                      {"analysed", one.analysed}});
  json["flow"] = {{"consenting", flow.people.consenting()},
                  {"simulated", flow.people.simulated_people()},
                  {"enrolled", flow.ever_enrolled},
                  {"erased", flow.unknown},
                  {"groups", groups}};
  json["primary"] = json_of(result.primary, true);
  json["secondary"] = json_of(result.secondary, false);
  return casedb::text(json);
}

}  // namespace seldinger::app
