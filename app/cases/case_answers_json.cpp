#include "app/cases/case_answers_json.h"

#include <nlohmann/json.hpp>

#include "app/attempts/answers_json.h"
#include "casedb/database/values_json.h"

namespace seldinger::app {
namespace {

using Json = nlohmann::ordered_json;
using casedb::text;

Json tissue_json(const volume::TissueTold& told) {
  Json share = Json::object();
  for (std::size_t at = 0; at < told.share.size(); ++at)
    if (told.share[at] > 0.0) share[volume::about(static_cast<volume::TissueClass>(at)).name] = told.share[at];
  return {{"contrast_phase", base::name_of(volume::kContrastPhaseNames, told.contrast.phase)},
          {"brightest_hu", casedb::maybe(told.contrast.brightest_hu)},
          {"aorta_hu", casedb::maybe(told.contrast.aorta_hu)},
          {"share_of_body", share},
          {"doubts", told.doubts}};
}

// Also those that are not sure enough to be named.
Json organs_json(const std::optional<volume::Organs>& organs) {
  Json list = Json::array();
  if (organs)
    for (const volume::OrganFound& one : organs->found)
      list.push_back({{"organ", base::name_of(volume::kFoundOrganNames, one.organ)},
                      {"named", one.confidence >= volume::kOrganConfidence},
                      {"confidence", one.confidence},
                      {"ml", one.ml},
                      {"level_hu", one.level_hu}});
  return list;
}

}  // namespace

std::string json_of_structure(const std::string& structure_id) {
  return text({{"structure_id", structure_id}});
}

std::string json_of_labels(const std::vector<LabelCount>& labels, bool resampled) {
  Json list = Json::array();
  for (const LabelCount& one : labels)
    list.push_back({{"label", one.label},
                    {"name", one.name},
                    {"voxels", one.voxels},
                    {"tissue", one.tissue ? Json(volume::about(*one.tissue).name) : Json(nullptr)}});
  return text({{"labels", list}, {"resampled", resampled}});
}

std::string json_of_checks(const std::string& case_id, const casedb::CaseCheck& check) {
  Json list = Json::array();
  for (const casedb::Check& one : check.checks)
    list.push_back({{"check", one.name}, {"holds", one.holds}, {"text", one.text}});
  return text(
      {{"case_id", case_id}, {"holds", check.holds()}, {"checks", list}, {"rule_may_name", check.rule_may_name}});
}

std::string json_of_imported(const casedb::CaseParts& parts, const volume::TissueTold& tissue,
                             const std::optional<volume::Organs>& organs) {
  Json json = Json::parse(json_of_case(parts));
  json["tissue"] = tissue_json(tissue);
  json["organs"] = organs_json(organs);
  return text(json);
}

std::string json_of_needs(const std::string& case_id, cases::SightLaw sight_law, const session::CaseNeeds& needs,
                          const volume::TissueTold& tissue, const std::optional<volume::Organs>& organs) {
  Json held = Json::array(), sources = Json::array();
  for (const session::CaseNeed& one : needs.held) held.push_back({{"what", one.what}, {"bytes", one.bytes}});
  for (const session::MotionSource& one : needs.sources)
    sources.push_back({{"kind", one.kind}, {"name", one.name}, {"bytes", one.bytes}});
  return text({{"case_id", case_id},
               {"sight_law", base::name_of(cases::kSightLawNames, sight_law)},
               {"held", held},
               {"colour_doppler", {{"flow", needs.flowing}, {"not_known", needs.unknown_flow}}},
               {"displacement",
                {{"sources", sources},
                 {"count", needs.sources.size()},
                 {"most", session::kMostMotionSources},
                 {"bytes", needs.displacement_bytes},
                 {"there_ns", needs.there_ns},
                 {"back_ns", needs.back_ns}}},
               {"tissue", tissue_json(tissue)},
               {"organs", organs_json(organs)}});
}

std::string json_of_rehearsal(const std::string& case_id, const session::Rehearsal& rehearsal) {
  Json levels = Json::array(), missed = Json::array();
  for (const session::RehearsedLevel& one : rehearsal.levels)
    levels.push_back({{"operator", one.operator_name}, {"attempts", one.attempts}, {"passed", one.passed}});
  for (const session::MissedCriterion& one : rehearsal.missed)
    missed.push_back({{"criterion", assessment::text_of(one.of.criterion)},
                      {"of_the_time_limit", one.of.of_the_time_limit},
                      {"missed", one.missed}});
  return text({{"case_id", case_id},
               {"synthetic", true},
               {"people", rehearsal.people},
               {"seed", rehearsal.seed},
               {"attempts", rehearsal.attempts()},
               {"passed", rehearsal.passed()},
               {"levels", levels},
               {"missed", missed},
               {"proves", session::kRehearsalProves}});
}

std::string json_of_version(const casedb::CaseRow& row) {
  return text({{"case_id", row.case_id},
               {"family_id", row.family_id},
               {"version", row.version},
               {"state", casedb::name_of(row.state)}});
}

}  // namespace seldinger::app
