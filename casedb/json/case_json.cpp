#include "casedb/json/case_json.h"

#include "assessment/grading/rule_json.h"
#include "casedb/cases/setting_table.h"
#include "casedb/cases/structure_json.h"
#include "casedb/database/values_json.h"
#include "casedb/grading/grading.h"

namespace seldinger::casedb {
namespace {

using Json = nlohmann::ordered_json;

Json json_of_composed(Composed what, const CaseSetting& setting) {
  switch (what) {
    case Composed::further_modalities: {
      Json further = Json::array();
      for (const cases::Modality one : setting.further_modalities) further.push_back(name_of(one));
      return further;
    }
    case Composed::gauge:
      return 2.0 * setting.instrument.radius_mm;
    case Composed::planned_entry:
      return setting.planned_entry_lps_mm ? point(*setting.planned_entry_lps_mm) : Json(nullptr);
    case Composed::pass_rule:
      return json_of_rule_of(setting.rule);
  }
  return nullptr;
}

Json json_of_field(const SettingField& field, const CaseSetting& setting) {
  return std::visit(OfKind{[&](const NumberField& one) -> Json { return one.get(setting); },
                           [&](const MaybeNumberField& one) { return maybe(one.get(setting)); },
                           [&](const MaybeWholeField& one) { return maybe(one.get(setting)); },
                           [&](const TextField& one) -> Json { return one.get(setting); },
                           [&](const ChoiceField& one) -> Json { return one.get(setting); },
                           [&](const SwitchField& one) -> Json { return one.get(setting) ? one.yes : one.no; },
                           [&](const ComposedField& one) { return json_of_composed(one.what, setting); }},
                    field);
}

void add_setting(const CaseSetting& setting, Json& json) {
  for (const SettingRow& row : kSettingRows) {
    if (row.json == nullptr) continue;
    if (row.of_core_needles && setting.instrument.kind != cases::InstrumentKind::core) continue;
    const std::string_view path = row.json;
    const std::size_t slash = path.find('/');
    Json& group = slash == path.npos ? json : json[std::string(path.substr(0, slash))];
    const auto* composed = std::get_if<ComposedField>(&row.field);
    if (composed != nullptr && composed->what == Composed::gauge)
      group["length_mm"] = nullptr;  // keeps its place before the diameter
    group[std::string(slash == path.npos ? path : path.substr(slash + 1))] = json_of_field(row.field, setting);
  }
}

}  // namespace

CaseParts load_parts(Library& library, CaseRow row) {
  CaseParts parts;
  parts.lesions = list_lesions(library, row.case_id);
  parts.structures = list_structures(library, row.case_id);
  parts.decisions = list_decisions(library, row.case_id);
  parts.received = find_received(library, row.case_id);
  if (const auto stored = find_preparation(library.database(), row.case_id)) parts.preparation = stored->settings;
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
               {"kind", base::name_of(cases::kLesionKindNames, form.kind)},
               {"outline", base::name_of(cases::kLesionOutlineNames, form.outline)},
               {"adds", form.adds},
               {"edge_mm", form.edge_mm}};
  if (form.outline == cases::LesionOutline::ellipsoid) json["radii_mm"] = point(form.radii_mm);
  if (form.outline == cases::LesionOutline::irregular) {
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

Json json_of_rule_of(const assessment::PassRule& rule) {
  return Json::parse(assessment::json_of_rule(rule)).at("criteria");
}

Json json_of_received(const std::optional<Received>& received) {
  if (!received) return nullptr;
  return {{"received_us", received->received_us},
          {"signing_key", maybe(received->signing_key)},
          {"trusted_as", maybe(received->trusted_as)},
          {"sender_says",
           {{"state", name_of(received->state)},
            {"face_state", name_of(received->face_state)},
            {"burned_in_checked_us", maybe(received->burned_in_checked_us)}}}};
}

Json json_of_preparation(const std::optional<Preparation>& preparation) {
  if (!preparation) return nullptr;
  Json json = Json::object();
  for (const PreparationRow& row : kPreparationRows) json[row.name] = (*preparation).*row.value;
  return json;
}

void add_authoring(const CaseParts& parts, Json& json) {
  const CaseRow& row = parts.row;
  Json structures = Json::array(), decisions = Json::array();
  for (const StructureRow& one : parts.structures) structures.push_back(json_of_structure(one));
  for (const Decision& one : parts.decisions)
    decisions.push_back({{"decision", name_of(one.kind)},
                         {"by", one.pseudonym},
                         {"by_operator", one.by_operator ? Json(*one.by_operator) : Json(nullptr)},
                         {"decided_us", one.decided_us},
                         {"note", one.note}});
  const auto review = review_of(parts.decisions);
  json["version"] = row.version;
  json["family_id"] = row.family_id;
  json["audience"] = row.own_cohort_only ? "own_cohort" : "everyone";
  json["reviewed_by"] = review ? Json(review->who()) : Json(nullptr);
  json["decisions"] = decisions;
  json["received"] = json_of_received(parts.received);
  add_setting(row, json);
  json["provisional"] = parts.provisional;
  json["preparation"] = json_of_preparation(parts.preparation);
  json["structures"] = structures;
}

}  // namespace seldinger::casedb
