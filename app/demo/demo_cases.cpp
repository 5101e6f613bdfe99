#include "app/demo/demo_cases.h"

#include "sim/base/check.h"
#include "sim/case/gauge.h"
#include "sim/volume/gel_block.h"

namespace seldinger::app {
namespace {

using cases::StructureRule;
using volume::TissueClass;
using Structures = std::vector<DemoStructure>;
constexpr auto kAsCt = std::nullopt;

cases::Instrument core() {
  cases::Instrument needle;
  needle.kind = cases::InstrumentKind::core;  // throw 22, notch 18, dead tip 4 mm
  needle.radius_mm = cases::gauge(18)->outer_mm / 2.0;
  return needle;
}

cases::Instrument access(int gauge) {
  cases::Instrument needle;
  needle.radius_mm = cases::gauge(gauge)->outer_mm / 2.0;
  return needle;
}

cases::LesionForm sphere(const glm::dvec3& center_lps_mm, double radius_mm, double hu) {
  cases::LesionForm form;
  form.center_lps_mm = center_lps_mm;
  form.radii_mm = glm::dvec3(radius_mm);
  form.hu = hu;
  return form;
}

// A tumour, as the pictures draw it.
cases::LesionForm solid(cases::LesionKind kind, const glm::dvec3& center_lps_mm, double radius_mm, double hu) {
  cases::LesionForm form = sphere(center_lps_mm, radius_mm, hu);
  form.kind = kind;
  return form;
}

DemoStructure drawn(const char* name, StructureRule rule, TissueClass tissue, cases::Shape shape,
                    std::optional<double> hu) {
  DemoStructure made;
  made.row.name = name;
  made.row.rule = rule;
  made.row.tissue = tissue;
  made.row.drawn = std::move(shape);
  made.row.hu = hu;
  return made;
}

DemoStructure labelled(const char* label, StructureRule rule) {
  DemoStructure made;
  made.label = made.row.name = label;
  made.row.rule = rule;
  made.row.kind = casedb::StructureKind::label;
  made.row.tissue = *volume::tissue_of_name(label);
  return made;
}

DemoStructure of_class(const char* name, StructureRule rule, TissueClass tissue) {
  DemoStructure made;
  made.row.name = name;
  made.row.rule = rule;
  made.row.tissue = tissue;
  made.row.kind = casedb::StructureKind::tissue_class;
  return made;
}

assessment::PassRule rule(std::initializer_list<const char*> pass, std::initializer_list<const char*> critical) {
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

// A drill is about one thing, on gel: its rule asks for that and for a hit through one hole, for nothing that is
// done around a patient. The ball is where the block has it: pictures take it from the volume.
// `x_mm`, `z_mm`: the planned entry on its top, from where a straight way of 45 to 55° leads to the ball.
DemoCase drill(int number, const char* title, const char* task, DemoSource source, volume::GelBlock block,
               double x_mm, double z_mm) {
  DemoCase made{number, title, source, {}, {}, {}};
  made.setting.subject = cases::Subject::phantom;
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.instrument = access(18);
  made.setting.difficulty = casedb::Difficulty::easy;
  made.setting.clinic.indication = task;
  const volume::Sphere ball = volume::gel_ball(block);
  cases::LesionForm form = sphere(ball.center_mm, ball.radius_mm, 0.0);
  form.adds = true;
  made.lesions = {form};
  made.setting.planned_entry_lps_mm = glm::dvec3(x_mm, 0.0, z_mm);
  return made;
}

DemoCase find_the_plane() {
  DemoCase made = drill(
      1, "Drill 1: find the plane",
      "Find the ball of water, turn the probe until the needle's way and the ball lie in one picture, then hit it.",
      DemoSource::gel_plane, volume::GelBlock::find_the_plane, -15.0, 29.0);
  made.setting.rule = rule(
      {"hit >= 1", "advance_joint_visible_last_20_mm >= 0.5", "plane_angle_mean <= 8", "skin_punctures <= 1"}, {});
  return made;
}

DemoCase keep_the_tip() {
  DemoCase made = drill(
      2, "Drill 2: keep the tip in view",
      "The ball is 45 mm deep. Go on only while the picture shows the tip; where you lose it, stop and find it.",
      DemoSource::gel_tip, volume::GelBlock::keep_the_tip, -22.0, -14.0);
  made.setting.rule =
      rule({"hit >= 1", "advance_visible_share >= 0.8", "blind_advance_max <= 5", "skin_punctures <= 1"}, {});
  return made;
}

DemoCase depth_out_of_plane() {
  DemoCase made = drill(3, "Drill 3: reach depth out of plane",
                        "The needle crosses the picture. Put the probe ahead of the tip, let the tip come into it, "
                        "and so on down to the ball at 30 mm.",
                        DemoSource::gel_across, volume::GelBlock::out_of_plane, 8.0, 29.0);
  made.setting.approach = cases::Approach::out_of_plane;
  made.setting.rule = rule(
      {"hit >= 1", "advance_beyond_plane <= 0", "longest_advance_between_sights <= 12", "skin_punctures <= 1"}, {});
  return made;
}

// Right lower calyx of the torso and what lies about it; the pelvis is not to be entered directly.
const glm::dvec3 kCalyx{-68.0, 40.0, -50.0};
Structures about_the_calyx(double radius_mm, double urine_hu) {
  return {labelled("kidney", StructureRule::must_cross),
          labelled("colon", StructureRule::critical),
          labelled("lung", StructureRule::critical),
          labelled("pleural_recess", StructureRule::critical),
          labelled("liver", StructureRule::major),
          drawn("renal_pelvis", StructureRule::critical, TissueClass::fluid,
                cases::Ellipsoid{{-48.0, 38.0, -27.0}, {9.0, 6.0, 10.0}}, urine_hu),
          drawn("calyx", StructureRule::target, TissueClass::fluid, cases::Sphere{kCalyx, radius_mm}, urine_hu)};
}

DemoCase torso_liver() {
  DemoCase made{1, "Graded 1: liver lesion 25 mm, subcostal", DemoSource::torso, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.instrument = core();
  made.setting.difficulty = casedb::Difficulty::easy;
  made.setting.clinic = {1.0, 220.0, "", "lesion of the liver, to be told by biopsy", false};
  made.setting.rule = rule({"core_in_target >= 10", "capsule_punctures <= 1", "skin_punctures <= 1",
                            "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                           {"nogo_length_critical <= 0"});
  made.lesions = {solid(cases::LesionKind::metastasis, {-90.0, -28.0, -18.0}, 12.5, 40.0)};
  made.structures = {
      labelled("liver", StructureRule::organ), labelled("gallbladder", StructureRule::critical),
      labelled("stomach", StructureRule::critical), labelled("colon", StructureRule::critical),
      labelled("small_bowel", StructureRule::critical),
      // Vessels over 4 mm across: the trunks, as the torso has them.
      drawn("portal_vein", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-2, -2, 4}, {-20, -3, 24}, {-38, -6, 40}, {-54, -3, 46}, {-76, -16, 55}}, 4.5}, kAsCt),
      drawn("hepatic_vein", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-22, 18, 100}, {-50, 16, 92}, {-78, 6, 76}, {-98, 0, 48}}, 3.6}, kAsCt),
      labelled("vena_cava", StructureRule::critical)};
  return made;
}

DemoCase contrast_liver() {
  DemoCase made{2, "Graded 2: liver lesion 15 mm, intercostal", DemoSource::contrast_liver, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.instrument = core();
  made.setting.clinic = {1.1, 190.0, "", "lesion of the liver, to be told by biopsy", false};
  made.setting.rule = rule({"core_in_target >= 8", "capsule_punctures <= 1", "skin_punctures <= 1",
                            "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                           {"nogo_length_critical <= 0"});
  made.lesions = {solid(cases::LesionKind::hcc, {-115.0, -5.0, -98.0}, 7.5, 80.0)};
  made.structures = {
      of_class("lung", StructureRule::critical, TissueClass::lung),
      // Potential spaces and a bundle that this CT does not show: along the ribs that it does.
      drawn("pleural_recess", StructureRule::critical, TissueClass::soft_tissue,
            cases::Tube{{{-131, -36, -68}, {-140, -16, -68}, {-144, 8, -70}, {-144, 32, -74}}, 5.0}, kAsCt),
      drawn("intercostal_bundle", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-143, -10, -82}, {-139.5, -20, -92}, {-137, -25, -97}, {-134.5, -34.5, -107}}, 2.0},
            130.0),
      drawn("liver", StructureRule::organ, TissueClass::soft_tissue,
            cases::Ellipsoid{{-80.0, -10.0, -90.0}, {60.0, 72.0, 60.0}}, kAsCt)};
  return made;
}

DemoCase kidney_cortex() {
  DemoCase made{3, "Graded 3: left lower-pole cortex, prone", DemoSource::abdomen_pelvis, {}, {}, {}};
  made.setting.modality = cases::Modality::mpr;
  made.setting.position = cases::PatientPosition::prone;
  made.setting.instrument = core();
  made.setting.clinic = {1.0, 240.0, "", "proteinuria, native kidney biopsy", false};
  made.setting.rule = rule({"core_in_target >= 10", "capsule_punctures <= 1", "skin_punctures <= 1",
                            "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                           {"nogo_length_critical <= 0"});
  cases::LesionForm cortex;  // no lesion: where the sample comes from, as the CT shows it
  cortex.outline = cases::LesionOutline::ellipsoid;
  cortex.center_lps_mm = {66.0, 79.0, -624.0};
  cortex.radii_mm = {12.0, 7.0, 9.0};
  cortex.adds = true;
  made.lesions = {cortex};
  made.structures = {drawn("kidney", StructureRule::organ, TissueClass::kidney,
                           cases::Ellipsoid{{61.5, 72.0, -604.0}, {27.0, 17.5, 42.0}}, kAsCt),
                     drawn("renal_sinus", StructureRule::critical, TissueClass::fat,
                           cases::Ellipsoid{{57.0, 65.0, -604.0}, {9.0, 6.0, 15.0}}, kAsCt),
                     of_class("colon_gas", StructureRule::critical, TissueClass::gas),
                     of_class("lung", StructureRule::critical, TissueClass::lung)};
  return made;
}

DemoCase jugular_vein() {
  DemoCase made{4, "Graded 4: right internal jugular vein", DemoSource::thorax_inlet, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.approach = cases::Approach::out_of_plane;
  made.setting.instrument = access(18);
  made.setting.clinic = {1.2, 150.0, "", "central venous access", false};
  made.setting.rule =
      rule({"hit >= 1", "back_wall_dist >= 2", "longest_advance_between_sights <= 8", "skin_punctures <= 1"},
           {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  // The lumen where it is entered.
  made.lesions = {sphere({-22.1, -210.2, 83.0}, 6.0, 12.0)};
  made.structures = {
      drawn("carotid", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-9.5, -216, 91}, {-9.7, -212.4, 88}, {-10.5, -187.5, 78}, {-12, -178, 66}}, 3.5}, 45.0),
      drawn("jugular_vein", StructureRule::target, TissueClass::vessel,
            cases::Tube{{{-19.5, -228, 91}, {-20.2, -221.4, 88}, {-24, -199, 78}, {-26, -190, 66}}, 6.0}, 43.0),
      of_class("lung", StructureRule::critical, TissueClass::lung)};
  return made;
}

DemoCase dilated_calyx() {
  DemoCase made{5, "Graded 5: dilated lower-pole calyx, ultrasound", DemoSource::torso_dilated, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.position = cases::PatientPosition::prone;
  made.setting.instrument = access(18);
  made.setting.clinic = {1.0, 230.0, "", "obstructed kidney, nephrostomy", false};
  made.setting.rule = rule({"hit >= 1", "must_cross_length >= 10", "skin_punctures <= 1",
                            "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                           {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  made.lesions = {sphere(kCalyx, 7.5, 5.0)};
  made.structures = about_the_calyx(7.5, 5.0);
  return made;
}

DemoCase opacified_calyx() {
  DemoCase made{6, "Graded 6: opacified calyx, fluoroscopy", DemoSource::torso_opacified, {}, {}, {}};
  made.setting.modality = cases::Modality::xray;
  made.setting.position = cases::PatientPosition::prone;
  made.setting.instrument = access(18);
  made.setting.clinic = {1.0, 230.0, "", "stone, access for nephrolithotomy", false};
  made.setting.rule =
      rule({"hit >= 1", "tip_target_axial >= -3", "tip_target_axial <= 3",
            "longest_advance_between_exposures <= 20", "view_angle_max >= 30", "fluoroscopy_time <= 60",
            "pulse_rate_max <= 7.5", "must_cross_length >= 10", "skin_punctures <= 1"},
           {"nogo_length_critical <= 0", "posterior_wall <= 0", "hand_in_beam <= 0"});
  made.lesions = {sphere(kCalyx, 4.0, 600.0)};
  made.structures = about_the_calyx(4.0, 600.0);
  return made;
}

DemoCase beside_a_vein() {
  DemoCase made{7, "Graded 7: liver lesion 10 mm beside a hepatic vein", DemoSource::contrast_liver, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.instrument = core();
  made.setting.difficulty = casedb::Difficulty::hard;
  made.setting.clinic = {1.1, 190.0, "", "lesion of the liver, to be told by biopsy", false};
  made.setting.rule = rule({"core_in_target >= 6", "capsule_punctures <= 2", "skin_punctures <= 1",
                            "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                           {"nogo_length_critical <= 0"});
  made.lesions = {solid(cases::LesionKind::metastasis, {-79.0, -34.0, -84.0}, 5.0, 70.0)};
  made.structures = {
      drawn("hepatic_vein", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-74, -46, -84}, {-70, -36, -80}, {-60, -8, -74}, {-46, 22, -66}}, 3.0}, 150.0),
      drawn("liver", StructureRule::organ, TissueClass::soft_tissue,
            cases::Ellipsoid{{-80.0, -10.0, -90.0}, {60.0, 72.0, 60.0}}, kAsCt),
      of_class("lung", StructureRule::critical, TissueClass::lung)};
  return made;
}

DemoCase to_be_deferred() {
  DemoCase made = contrast_liver();
  made.number = 8;
  made.title = "Graded 8: liver lesion, INR 2.4, platelets 38";
  made.setting.clinic.inr = 2.4;
  made.setting.clinic.platelets_per_nl = 38.0;
  made.setting.clinic.defer = true;
  made.setting.rule = rule({"decision_right >= 1"}, {"skin_punctures <= 0"});
  return made;
}

}  // namespace

const std::vector<DemoCase>& drills() {
  static const std::vector<DemoCase> all = {find_the_plane(), keep_the_tip(), depth_out_of_plane()};
  return all;
}

const std::vector<DemoCase>& demo_cases() {
  static const std::vector<DemoCase> all = {torso_liver(),   contrast_liver(),  kidney_cortex(), jugular_vein(),
                                            dilated_calyx(), opacified_calyx(), beside_a_vein(), to_be_deferred()};
  return all;
}

}  // namespace seldinger::app
