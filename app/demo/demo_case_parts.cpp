#include "app/demo/demo_case_parts.h"

#include "sim/base/check.h"
#include "sim/case/gauge.h"

namespace seldinger::app {

cases::Instrument core_needle() {
  cases::Instrument needle;
  needle.kind = cases::InstrumentKind::core;
  needle.radius_mm = cases::gauge(18)->outer_mm / 2.0;
  return needle;
}

cases::Instrument access_needle(int gauge) {
  cases::Instrument needle;
  needle.radius_mm = cases::gauge(gauge)->outer_mm / 2.0;
  return needle;
}

cases::Instrument vessel_needle(int gauge) {
  cases::Instrument needle = access_needle(gauge);
  needle.length_mm = gauge >= 21 ? 40.0 : 70.0;
  return needle;
}

cases::LesionForm sphere_form(const glm::dvec3& center_lps_mm, double radius_mm, double hu) {
  cases::LesionForm form;
  form.center_lps_mm = center_lps_mm;
  form.radii_mm = glm::dvec3(radius_mm);
  form.hu = hu;
  return form;
}

cases::LesionForm solid_form(cases::LesionKind kind, const glm::dvec3& center_lps_mm, double radius_mm, double hu) {
  cases::LesionForm form = sphere_form(center_lps_mm, radius_mm, hu);
  form.kind = kind;
  return form;
}

cases::LesionForm place_form(const glm::dvec3& center_lps_mm, const glm::dvec3& radii_mm) {
  cases::LesionForm form;
  form.outline = cases::LesionOutline::ellipsoid;
  form.center_lps_mm = center_lps_mm;
  form.radii_mm = radii_mm;
  form.adds = true;
  return form;
}

DemoStructure drawn(const char* name, cases::StructureRule rule, volume::TissueClass tissue, cases::Shape shape,
                    std::optional<double> hu) {
  DemoStructure made;
  made.row.name = name;
  made.row.rule = rule;
  made.row.tissue = tissue;
  made.row.drawn = std::move(shape);
  made.row.hu = hu;
  return made;
}

DemoStructure labelled(const char* label, cases::StructureRule rule) {
  DemoStructure made;
  made.label = made.row.name = label;
  made.row.rule = rule;
  made.row.kind = casedb::StructureKind::label;
  made.row.tissue = *volume::tissue_of_name(label);
  return made;
}

DemoStructure of_class(const char* name, cases::StructureRule rule, volume::TissueClass tissue) {
  DemoStructure made;
  made.row.name = name;
  made.row.rule = rule;
  made.row.tissue = tissue;
  made.row.kind = casedb::StructureKind::tissue_class;
  return made;
}

assessment::PassRule rule_of(std::initializer_list<const char*> pass, std::initializer_list<const char*> critical) {
  assessment::PassRule made;
  for (const bool is_critical : {false, true})
    for (const char* text : is_critical ? critical : pass) {
      auto criterion = assessment::criterion_from(text);
      CHECK(criterion.has_value());
      criterion->critical = is_critical;
      made.criteria.push_back(std::move(*criterion));
    }
  return made;
}

DemoCase liver_between_ribs() {
  DemoCase made{2, "Graded 2: liver lesion 15 mm, intercostal", DemoSource::torso, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.probe_is_chosen = true;
  made.setting.instrument = core_needle();
  made.setting.touch.tip = cases::NeedleTip::core;
  made.setting.clinic = {1.1, 190.0, "", "liver lesion, for biopsy", false};
  made.setting.rule = rule_of({"core_in_target >= 8", "capsule_punctures <= 1", "skin_punctures <= 1",
                               "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                              {"nogo_length_critical <= 0"});
  return made;
}

DemoCase kidney_cortex() {
  DemoCase made{3, "Graded 3: left lower-pole cortex, prone", DemoSource::torso_prone, {}, {}, {}};
  made.setting.modality = cases::Modality::mpr;
  made.setting.position = cases::PatientPosition::prone;
  made.setting.instrument = core_needle();
  made.setting.touch.tip = cases::NeedleTip::core;
  made.setting.clinic = {1.0, 240.0, "", "proteinuria, native kidney biopsy", false};
  made.setting.rule = rule_of({"core_in_target >= 10", "capsule_punctures <= 1", "skin_punctures <= 1",
                               "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                              {"nogo_length_critical <= 0"});
  return made;
}

DemoCase jugular_vein() {
  DemoCase made{4, "Graded 4: right internal jugular vein", DemoSource::neck, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.probe_is_chosen = true;
  made.setting.approach = cases::Approach::out_of_plane;
  made.setting.instrument = vessel_needle(18);
  made.setting.clinic = {1.2, 150.0, "", "central venous access", false};
  made.setting.rule = rule_of({"hit >= 1", "back_wall_dist >= 2", "longest_advance_between_sights <= 8",
                               "skin_punctures <= 1", "probe_suits >= 1"},
                              {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  return made;
}

DemoCase beside_a_vein() {
  DemoCase made{7, "Graded 7: liver lesion 10 mm beside a hepatic vein", DemoSource::torso, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.probe_is_chosen = true;
  made.setting.instrument = core_needle();
  made.setting.touch.tip = cases::NeedleTip::core;
  made.setting.difficulty = casedb::Difficulty::hard;
  made.setting.clinic = {1.1, 190.0, "", "liver lesion, for biopsy", false};
  made.setting.rule = rule_of({"core_in_target >= 6", "capsule_punctures <= 2", "skin_punctures <= 1",
                               "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                              {"nogo_length_critical <= 0"});
  return made;
}

DemoCase to_be_deferred(DemoCase like) {
  like.number = 8;
  like.title = "Graded 8: liver lesion, INR 2.4, platelets 38";
  like.setting.clinic.inr = 2.4;
  like.setting.clinic.platelets_per_nl = 38.0;
  like.setting.clinic.defer = true;
  like.setting.rule = rule_of({"decision_right >= 1"}, {"skin_punctures <= 0"});
  return like;
}

base::Result<void> add_parts(casedb::Library& library, const DemoCase& wanted, const std::string& case_id) {
  const auto row = casedb::find_case(library, case_id);
  if (!row) return row.error();
  const auto maps = casedb::load_label_maps(library, *row);
  if (!maps) return maps.error();
  for (DemoStructure structure : wanted.structures) {
    structure.row.case_id = case_id;
    for (const casedb::StoredLabels& map : *maps)
      for (std::size_t label = 1; label < map.labels.names.size(); ++label)
        if (!structure.label.empty() && map.labels.names[label] == structure.label) {
          structure.row.labels_sha256 = map.sha256;
          structure.row.label = static_cast<int>(label);
        }
    if (const auto added = casedb::add_structure(library, structure.row); !added) return added.error();
  }
  for (const cases::LesionForm& lesion : wanted.lesions)
    if (const auto added = casedb::add_lesion(library, case_id, lesion); !added) return added.error();
  return {};
}

}  // namespace seldinger::app
