#include "app/attempts/answers_json.h"

#include "app/attempts/course_json.h"
#include "app/hands/servo_record_json.h"
#include "casedb/database/values_json.h"
#include "casedb/json/grading_json.h"

#include <nlohmann/json.hpp>

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;
using casedb::json_of_metrics;
using casedb::maybe;
using casedb::point;
using casedb::text;

Json burned_in_json(const std::optional<casedb::BurnedInCheck>& check) {
  if (!check) return nullptr;
  return {{"checked_us", check->checked_us},
          {"person_id", maybe(check->person_id)},
          {"by_operator", check->by_operator}};
}

Json dropped_json(const std::vector<casedb::Dropped>& dropped) {
  Json list = Json::array();
  for (const casedb::Dropped& one : dropped)
    list.push_back({{"tag", one.tag}, {"keyword", one.keyword}, {"reason", one.reason}, {"count", one.count}});
  return list;
}

Json case_json(const casedb::CaseParts& parts) {
  const casedb::CaseRow& row = parts.row;
  Json matrix = Json::array();
  for (int r = 0; r < 4; ++r)
    for (int c = 0; c < 4; ++c) matrix.push_back(row.lps_from_voxel[c][r]);
  Json warnings = Json::array(), all = Json::array(), attributes = Json::object();
  for (const base::Problem& warning : row.warnings)
    warnings.push_back({{"code", warning.code}, {"text", warning.text}});
  for (const casedb::LesionRow& lesion : parts.lesions) all.push_back(casedb::json_of_lesion(lesion));
  for (const auto& [name, value] : row.attributes) attributes[name] = value;
  Json json = {{"case_id", row.case_id},
               {"title", row.title},
               {"state", casedb::name_of(row.state)},
               {"origin", row.origin},
               {"modality", casedb::name_of(row.modality)},
               {"patient_position", casedb::name_of(row.position)},
               {"size_voxels", Json::array({row.size_voxels.x, row.size_voxels.y, row.size_voxels.z})},
               {"spacing_mm", point(row.spacing_mm)},
               {"lps_from_voxel", matrix},
               {"hu_min", row.hu_min},
               {"hu_max", row.hu_max},
               {"slices_used", row.slices_used},
               {"attributes", attributes},
               {"face_state", casedb::name_of(row.face_state)},
               {"burned_in_checked", burned_in_json(row.burned_in_checked)},
               {"dropped", dropped_json(row.dropped)},
               {"lesions", all},
               {"warnings", warnings}};
  casedb::add_authoring(parts, json);
  return json;
}

Json attempts_json(const std::vector<session::SimulatedAttempt>& attempts) {
  Json list = Json::array();
  for (const session::SimulatedAttempt& attempt : attempts) {
    list.push_back({{"attempt_id", attempt.attempt_id},
                    {"operator", attempt.operator_name},
                    {"synthetic", true},
                    {"person", maybe(attempt.person)},
                    {"attempt_number", attempt.number + 1},
                    {"seed", attempt.seed},
                    {"metrics", json_of_metrics(attempt.metrics)}});
    if (attempt.grade) casedb::add_grade(*attempt.grade, list.back());
  }
  return list;
}

Json attempt_json(const casedb::AttemptRow& attempt) {
  return {{"attempt_id", attempt.attempt_id},
          {"case_id", attempt.case_id},
          {"case_title", attempt.case_title},
          {"lesion_id", attempt.lesion_id},
          {"person_id", maybe(attempt.person_id)},
          {"operator", attempt.operator_name},
          {"synthetic", attempt.synthetic()},
          {"seed", attempt.seed},
          {"instrument", base::name_of(cases::kInstrumentKindNames, attempt.instrument.kind)},
          {"modality", casedb::name_of(attempt.picture.modality)},
          {"approach", base::name_of(cases::kApproachNames, attempt.approach)},
          {"started_us", attempt.started_us},
          {"duration_s", attempt.duration_s},
          {"away_s", maybe(attempt.away_s)},
          {"end", attempt.end ? Json(casedb::name_of(*attempt.end)) : Json(nullptr)},
          {"program_version", attempt.program_version},
          {"step_version", attempt.step_version},
          {"metrics", json_of_metrics(attempt.metrics)}};
}

}  // namespace

std::string json_of_case(const casedb::CaseParts& parts) {
  return text(case_json(parts));
}

std::string json_of_cases(const std::vector<casedb::CaseParts>& cases) {
  Json list = Json::array();
  for (const casedb::CaseParts& parts : cases) {
    Json all = Json::array();
    for (const casedb::LesionRow& lesion : parts.lesions) all.push_back(casedb::json_of_lesion(lesion));
    list.push_back({{"case_id", parts.row.case_id},
                    {"title", parts.row.title},
                    {"state", casedb::name_of(parts.row.state)},
                    {"version", parts.row.version},
                    {"family_id", parts.row.family_id},
                    {"lesions", all}});
  }
  return text({{"cases", list}});
}

std::string json_of_samples(const std::vector<PointSample>& samples) {
  Json list = Json::array();
  for (const PointSample& sample : samples) {
    const Json one = {{"lps_mm", point(sample.lps_mm)},
                      {"hu_nearest", maybe(sample.hu_nearest)},
                      {"hu_trilinear", maybe(sample.hu_trilinear)},
                      {"class", maybe(sample.tissue)},
                      {"organ", maybe(sample.organ)},
                      {"confidence", maybe(sample.organ_confidence)}};
    list.push_back(one);
  }
  return text({{"samples", list}});
}

std::string json_of_lesion(const std::string& lesion_id) {
  return text({{"lesion_id", lesion_id}});
}

std::string json_of_score(const assessment::Scored& scored, const casedb::AttemptGrade* grade) {
  Json json = {{"metrics", json_of_metrics(scored.metrics)}, {"steps", json_of_steps(scored.steps)}};
  if (grade != nullptr) {
    casedb::add_grade(*grade, json);
    json["experts"] = casedb::json_of_experts(grade->experts);
  }
  return text(json);
}

std::string json_of_merged(const casedb::Merged& merged) {
  return casedb::text(
      Json{{"synthetic", true}, {"people", merged.people}, {"attempts", merged.attempts}, {"there", merged.there}});
}

std::string json_of_simulation(const std::vector<session::SimulatedAttempt>& attempts) {
  return text({{"attempts", attempts_json(attempts)}});
}

std::string json_of_attempt(const casedb::AttemptRow& attempt, const casedb::AttemptGrade& grade,
                            const std::optional<cases::ServoRecord>& servo, const Course& course) {
  Json json = attempt_json(attempt);
  casedb::add_grade(grade, json);
  json["experts"] = casedb::json_of_experts(grade.experts);
  json["servo"] = servo ? json_of_servo_record(*servo) : Json(nullptr);
  json["away_s"] = maybe(attempt.away_s);
  json["conditions"] = json_of_conditions(attempt.conditions);
  json["steps"] = json_of_steps(course.steps);
  json["events"] = json_of_events(course.events);
  return text(json);
}

std::string json_of_recompute(const Recomputed& recomputed) {
  Json differences = Json::array(), not_scored = Json::array();
  for (const Recomputed::Difference& one : recomputed.differences)
    differences.push_back({{"attempt_id", one.attempt_id},
                           {"metric_id", one.metric_id},
                           {"version", one.version},
                           {"stored", maybe(one.stored)},
                           {"now", maybe(one.now)}});
  for (const auto& [attempt_id, error] : recomputed.not_scored)
    not_scored.push_back({{"attempt_id", attempt_id}, {"code", error.code}});
  return text({{"attempts", recomputed.attempts},
               {"values", recomputed.values},
               {"added", recomputed.added},
               {"steps_added", recomputed.steps_added},
               {"not_bit_identical", recomputed.not_bit_identical},
               {"differences", differences},
               {"not_scored", not_scored}});
}

std::string json_of_attempts(const std::vector<casedb::AttemptRow>& attempts,
                             const std::vector<assessment::Grade>& grades,
                             const std::vector<casedb::OpenAttempt>& running) {
  Json list = Json::array(), open = Json::array();
  for (const casedb::OpenAttempt& attempt : running)
    open.push_back({{"attempt_id", attempt.attempt_id},
                    {"case_id", attempt.case_id},
                    {"operator", attempt.operator_name},
                    {"synthetic", attempt.synthetic()},
                    {"started_us", attempt.started_us},
                    {"stored_s", cases::kChunkSeconds * attempt.chunks}});
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    list.push_back(attempt_json(attempts[i]));
    list.back()["verdict"] = assessment::name_of(grades.at(i).verdict);
  }
  return text({{"attempts", list}, {"running", open}});
}

std::string json_of_replay(std::optional<bool> verified, std::optional<std::uint64_t> first_difference_tick,
                           const std::string& reason) {
  return text({{"verified", maybe(verified)},
               {"first_difference_tick", maybe(first_difference_tick)},
               {"reason", maybe(reason)}});
}

std::string json_of_users(const std::vector<casedb::Account>& accounts) {
  Json list = Json::array();
  for (const casedb::Account& account : accounts)
    list.push_back({{"name", account.login_name},
                    {"person_id", account.person_id},
                    {"role", casedb::name_of(account.role)},
                    {"level", account.level ? Json(casedb::name_of(*account.level)) : Json(nullptr)},
                    {"enabled", account.enabled}});
  return text({{"users", list}});
}

std::string json_of_demo(const DemoAnswer& demo) {
  Json accounts = Json::array();
  for (const auto& [name, password] : demo.passwords) accounts.push_back({{"name", name}, {"password", password}});
  Json lesion = casedb::json_of_lesion(demo.lesion);
  lesion["rule"] = demo.lesion_rule;
  lesion["depth_below_skin_mm"] = demo.lesion_depth_mm;
  Json warnings = Json::array();
  for (const base::Problem& warning : demo.found.warnings)
    warnings.push_back({{"code", warning.code}, {"text", warning.text}});
  return text({{"case_id", demo.found.case_id},
               {"title", demo.found.title},
               {"warnings", warnings},
               {"lesion", lesion},
               {"attempts", attempts_json(demo.attempts)},
               {"accounts", accounts},
               {"url", demo.url.empty() ? Json(nullptr) : Json(demo.url)}});
}

}  // namespace seldinger::app
