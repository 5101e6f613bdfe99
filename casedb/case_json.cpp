#include "casedb/case_json.h"

#include <nlohmann/json.hpp>

#include "assessment/grading/rule_json.h"
#include "casedb/grading.h"
#include "casedb/structure_json.h"

namespace seldinger::casedb {
namespace {

using Json = nlohmann::ordered_json;

Json point(const glm::dvec3& p) {
  return Json::array({p.x, p.y, p.z});
}

template <typename T>
Json maybe(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

}  // namespace

CaseParts load_parts(Library& library, CaseRow row) {
  CaseParts parts;
  parts.lesions = list_lesions(library, row.case_id);
  parts.structures = list_structures(library, row.case_id);
  parts.decisions = list_decisions(library, row.case_id);
  parts.provisional = !has_standard(library, row);
  parts.row = std::move(row);
  return parts;
}

base::Result<CaseParts> load_parts(Library& library, const std::string& case_id) {
  auto row = find_case(library, case_id);
  if (!row) return row.error();
  return load_parts(library, std::move(*row));
}

Json json_of_lesion(const LesionRow& lesion) {
  const cases::LesionForm& form = lesion.form;
  Json json = {{"lesion_id", lesion.lesion_id},
               {"center_mm", point(form.center_lps_mm)},
               {"radius_mm", lesion.lesion.radius_mm},
               {"hu", form.hu},
               {"kind", cases::kLesionKindNames[static_cast<std::size_t>(form.kind)]},
               {"adds", form.adds},
               {"edge_mm", form.edge_mm}};
  if (form.kind == cases::LesionKind::ellipsoid) json["radii_mm"] = point(form.radii_mm);
  if (form.kind == cases::LesionKind::irregular) {
    json["roughness"] = form.roughness;
    json["seed"] = form.seed;
  }
  return json;
}

Json json_of_structure(const StructureRow& structure) {
  Json json = {{"structure_id", structure.structure_id},
               {"name", structure.name},
               {"rule", cases::name_of(structure.rule)},
               {"tissue", volume::about(structure.tissue).name},
               {"by", name_of(structure.kind)}};
  if (structure.kind == StructureKind::drawn) {
    json["geometry"] = Json::parse(json_of_shape(structure.drawn));
    json["hu"] = maybe(structure.hu);
  }
  if (structure.kind == StructureKind::label) json["label"] = structure.label;
  return json;
}

Json json_of_instrument(const cases::Instrument& instrument) {
  Json json = {{"kind", name_of(instrument.kind)},
               {"length_mm", instrument.length_mm},
               {"outer_diameter_mm", 2.0 * instrument.radius_mm}};
  if (instrument.kind == cases::InstrumentKind::core) {
    json["throw_mm"] = instrument.throw_mm;
    json["notch_mm"] = instrument.notch_mm;
    json["dead_tip_mm"] = instrument.dead_tip_mm;
  }
  return json;
}

Json json_of_rule_of(const assessment::PassRule& rule) {
  return Json::parse(assessment::json_of_rule(rule)).at("criteria");
}

void add_authoring(const CaseParts& parts, Json& json) {
  const CaseRow& row = parts.row;
  Json further = Json::array(), structures = Json::array(), decisions = Json::array();
  for (const cases::Modality one : row.further_modalities) further.push_back(name_of(one));
  for (const StructureRow& one : parts.structures) structures.push_back(json_of_structure(one));
  for (const Decision& one : parts.decisions)
    decisions.push_back({{"decision", name_of(one.kind)},
                         {"by", one.pseudonym},
                         {"decided_us", one.decided_us},
                         {"note", one.note}});
  const auto review = review_of(parts.decisions);
  json["version"] = row.version;
  json["family_id"] = row.family_id;
  json["audience"] = row.own_cohort_only ? "own_cohort" : "everyone";
  json["reviewed_by"] = review ? Json(review->pseudonym) : Json(nullptr);
  json["decisions"] = decisions;
  json["further_modalities"] = further;
  json["subject"] = name_of(row.subject);
  json["approach"] = name_of(row.approach);
  json["instrument"] = json_of_instrument(row.instrument);
  json["clinic"] = {{"inr", maybe(row.clinic.inr)},
                    {"platelets_per_nl", maybe(row.clinic.platelets_per_nl)},
                    {"allergy", row.clinic.allergy},
                    {"indication", row.clinic.indication},
                    {"decision", row.clinic.defer ? "defer" : "proceed"}};
  json["motion"] = {{"breath_depth", row.motion.breath_depth},
                    {"breath_period_s", row.motion.breath_period_s},
                    {"breath_irregularity", row.motion.breath_irregularity},
                    {"tissue", row.motion.yields ? "yields" : "still"}};
  json["planned_entry_mm"] = row.planned_entry_lps_mm ? point(*row.planned_entry_lps_mm) : Json(nullptr);
  json["difficulty"] = kDifficultyNames[static_cast<std::size_t>(row.difficulty)];
  json["time_limit_s"] = maybe(row.time_limit_s);
  json["attempt_limit"] = maybe(row.attempt_limit);
  json["rule"] = json_of_rule_of(row.rule);
  json["provisional"] = parts.provisional;
  json["structures"] = structures;
}

}  // namespace seldinger::casedb
