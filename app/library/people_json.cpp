#include "app/library/people_json.h"

#include <cstdio>
#include <nlohmann/json.hpp>

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;

std::string document(const Json& json) {
  return json.dump(2) + "\n";
}

Json time_or_null(const std::optional<std::int64_t>& time_us) {
  return time_us ? Json(*time_us) : Json(nullptr);
}

Json head_of(const casedb::Cohort& cohort) {
  const casedb::CohortCells cells = casedb::cells_of(cohort);
  return {{"cohort_id", cohort.cohort_id}, {"title", cohort.title},      {"programme", cohort.programme},
          {"site", cohort.site},           {"learners", cells.learners}, {"attempts", cells.attempts},
          {"simulated", cells.simulated}};
}

}  // namespace

std::string json_of_made(const char* key, const std::string& id) {
  return document({{key, id}});
}

std::string json_of_cohorts(const std::vector<casedb::Cohort>& cohorts) {
  Json list = Json::array();
  for (const casedb::Cohort& one : cohorts) list.push_back(head_of(one));
  return document({{"cohorts", list}});
}

std::string json_of_cohort(const casedb::Cohort& cohort, const std::vector<casedb::Enrolment>& enrolments,
                           const std::map<std::string, std::string>& names) {
  Json json = head_of(cohort), list = Json::array();
  for (const casedb::Enrolment& one : enrolments) {
    const auto name = names.find(one.person_id);
    list.push_back({{"person_id", one.person_id},
                    {"name", name == names.end() ? Json(nullptr) : Json(name->second)},
                    {"pseudonym", one.pseudonym},
                    {"synthetic", one.simulated},
                    {"post", casedb::name_of(one.post)},
                    {"from_us", one.from_us},
                    {"to_us", time_or_null(one.to_us)}});
  }
  json["enrolments"] = list;
  return document(json);
}

std::string json_of_consents(const std::vector<casedb::Consent>& consents) {
  Json list = Json::array();
  for (const casedb::Consent& one : consents)
    list.push_back({{"text_id", one.text_id},
                    {"study_id", one.study_id ? Json(*one.study_id) : Json(nullptr)},
                    {"study", one.study_id ? Json(one.study_title) : Json(nullptr)},
                    {"version", one.version},
                    {"sha256", one.body_hash},
                    {"newest", one.newest},
                    {"given_us", time_or_null(one.given_us)},
                    {"withdrawn_us", time_or_null(one.withdrawn_us)},
                    {"stands", one.stands()}});
  return document({{"consents", list}});
}

std::string json_of_given_facts(const std::vector<casedb::FactGiven>& facts) {
  Json list = Json::array();
  for (const casedb::FactGiven& one : facts)
    list.push_back({{"fact", one.fact_id}, {"answer", one.answer}, {"given_us", one.given_us}});
  return document({{"facts", list}});
}

void warn_of_what_is_left(const casedb::Erased& erased) {
  if (!erased.overwritten)
    std::fputs(
        "Another program has the library open: until the last program closes it, its log still holds old bytes.\n",
        stderr);
  if (erased.kept_copies > 0)
    std::fprintf(stderr,
                 "%zu copies of older schemas beside the databases could not be deleted and still hold what was "
                 "erased.\n",
                 erased.kept_copies);
}

std::string json_of_erased(const casedb::Erased& erased) {
  return document({{"attempts", erased.attempts},
                   {"files", erased.assets},
                   {"old_copies", erased.old_copies},
                   {"kept_copies", erased.kept_copies},
                   {"overwritten", erased.overwritten}});
}

}  // namespace seldinger::app
