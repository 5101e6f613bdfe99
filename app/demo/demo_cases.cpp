#include "app/demo/demo_case_parts.h"
#include "sim/volume/gel_block.h"

namespace seldinger::app {
namespace {

using cases::StructureRule;
using volume::TissueClass;
using Structures = std::vector<DemoStructure>;

// A drill is about one thing, on gel: its rule asks for that and for a hit through one hole, for nothing that is
// done around a patient. The ball is where the block has it: pictures take it from the volume.
// `x_mm`, `z_mm`: the planned entry on its top, from where a straight way of 36 to 55° leads to the ball.
DemoCase drill(int number, const char* title, const char* task, DemoSource source, volume::GelBlock block,
               double x_mm, double z_mm) {
  DemoCase made{number, title, source, {}, {}, {}};
  made.setting.subject = cases::Subject::phantom;
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.instrument = access_needle(18);
  made.setting.difficulty = casedb::Difficulty::easy;
  made.setting.clinic.indication = task;
  const volume::Sphere ball = volume::gel_ball(block);
  cases::LesionForm form = sphere_form(ball.center_mm, ball.radius_mm, 0.0);
  form.adds = true;
  made.lesions = {form};
  made.setting.planned_entry_lps_mm = glm::dvec3(x_mm, 0.0, z_mm);
  return made;
}

DemoCase find_the_plane() {
  DemoCase made = drill(
      1, "Drill 1: find the plane",
      "Find the ball of water, turn the probe until the needle path and the ball lie in one picture, then hit it.",
      DemoSource::gel_plane, volume::GelBlock::find_the_plane, -16.0, 40.0);  // 36° to the face
  made.setting.rule = rule_of(
      {"hit >= 1", "advance_joint_visible_last_20_mm >= 0.5", "plane_angle_mean <= 8", "skin_punctures <= 1"}, {});
  return made;
}

DemoCase keep_the_tip() {
  DemoCase made = drill(
      2, "Drill 2: keep the tip in view",
      "The ball is 45 mm deep. Go on only while the picture shows the tip; where you lose it, stop and find it.",
      DemoSource::gel_tip, volume::GelBlock::keep_the_tip, -22.0, -14.0);
  made.setting.rule =
      rule_of({"hit >= 1", "advance_visible_share >= 0.8", "blind_advance_max <= 5", "skin_punctures <= 1"}, {});
  return made;
}

DemoCase depth_out_of_plane() {
  DemoCase made = drill(3, "Drill 3: reach depth out of plane",
                        "The needle crosses the picture. Put the probe ahead of the tip, let the tip come into it, "
                        "and so on down to the ball at 30 mm.",
                        DemoSource::gel_across, volume::GelBlock::out_of_plane, 8.0, 29.0);
  made.setting.approach = cases::Approach::out_of_plane;
  made.setting.rule = rule_of(
      {"hit >= 1", "advance_beyond_plane <= 0", "longest_advance_between_sights <= 12", "skin_punctures <= 1"}, {});
  return made;
}

// Right lower calyx of the torso and what lies about it; the pelvis is not to be entered directly.
const glm::dvec3 kCalyx{-68.0, 40.0, -50.0};
Structures about_the_calyx(double radius_mm, double urine_hu) {
  return {labelled("kidney", StructureRule::must_cross), labelled("colon", StructureRule::critical),
          labelled("lung", StructureRule::critical), labelled("pleural_recess", StructureRule::critical),
          labelled("liver", StructureRule::major),
          drawn("renal_pelvis", StructureRule::critical, TissueClass::fluid,
                cases::Ellipsoid{{-48.0, 38.0, -27.0}, {9.0, 6.0, 10.0}}, urine_hu),
          // Beside the calyx's neck, between pyramids: who aims at the calyx's end stays clear of it.
          drawn("interlobar_artery", StructureRule::critical, TissueClass::vessel,
                cases::Tube{{{-52.0, 45.0, -36.0}, {-62.0, 52.0, -41.0}, {-72.0, 54.0, -42.0}}, 1.5}),
          drawn("calyx", StructureRule::target, TissueClass::fluid, cases::Sphere{kCalyx, radius_mm}, urine_hu)};
}

DemoCase torso_liver() {
  DemoCase made{1, "Graded 1: liver lesion 25 mm, subcostal", DemoSource::torso, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.probe_is_chosen = true;
  made.setting.instrument = core_needle();
  made.setting.touch.tip = cases::NeedleTip::core;
  made.setting.difficulty = casedb::Difficulty::easy;
  made.setting.clinic = {1.0, 220.0, "", "liver lesion, for biopsy", false};
  made.setting.rule = rule_of({"core_in_target >= 10", "capsule_punctures <= 1", "skin_punctures <= 1",
                               "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                              {"nogo_length_critical <= 0"});
  made.lesions = {solid_form(cases::LesionKind::metastasis, {-80.0, -34.0, 0.0}, 12.5, 40.0)};
  made.structures = {
      labelled("liver", StructureRule::organ), labelled("gallbladder", StructureRule::critical),
      labelled("stomach", StructureRule::critical), labelled("colon", StructureRule::critical),
      labelled("small_bowel", StructureRule::critical),
      // Vessels over 4 mm across: the trunks, as the torso has them.
      drawn("portal_vein", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-2, -2, 4}, {-20, -3, 24}, {-38, -6, 40}, {-54, -3, 46}, {-76, -16, 55}}, 4.5}),
      drawn("hepatic_vein", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-22, 18, 100}, {-50, 16, 92}, {-78, 6, 76}, {-98, 0, 48}}, 3.6}),
      labelled("vena_cava", StructureRule::critical)};
  return made;
}

DemoCase dilated_calyx() {
  DemoCase made{5, "Graded 5: dilated lower-pole calyx, ultrasound", DemoSource::torso_dilated, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.further_modalities = {cases::Modality::mpr};
  made.setting.probe_is_chosen = true;
  made.setting.position = cases::PatientPosition::prone;
  made.setting.instrument = access_needle(18);
  made.setting.clinic = {1.0, 230.0, "", "obstructed kidney, nephrostomy", false};
  made.setting.rule = rule_of({"hit >= 1", "must_cross_length >= 10", "skin_punctures <= 1",
                               "advance_visible_share >= 0.8", "blind_advance_max <= 5"},
                              {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  made.lesions = {sphere_form(kCalyx, 7.5, 5.0)};
  made.structures = about_the_calyx(7.5, 5.0);
  return made;
}

DemoCase opacified_calyx() {
  DemoCase made{6, "Graded 6: opacified calyx, fluoroscopy", DemoSource::torso_opacified, {}, {}, {}};
  made.setting.modality = cases::Modality::xray;
  made.setting.position = cases::PatientPosition::prone;
  made.setting.instrument = access_needle(18);
  made.setting.clinic = {1.0, 230.0, "", "stone, access for nephrolithotomy", false};
  made.setting.rule =
      rule_of({"hit >= 1", "tip_target_axial >= -3", "tip_target_axial <= 3",
               "longest_advance_between_exposures <= 20", "view_angle_max >= 30", "fluoroscopy_time <= 60",
               "pulse_rate_max <= 7.5", "must_cross_length >= 10", "skin_punctures <= 1"},
              {"nogo_length_critical <= 0", "posterior_wall <= 0", "hand_in_beam <= 0"});
  made.lesions = {sphere_form(kCalyx, 4.0, 600.0)};
  made.structures = about_the_calyx(4.0, 600.0);
  return made;
}

// Between the ninth and the tenth rib, in front of where the recess ends: over the rib's upper border.
DemoCase torso_between_ribs() {
  DemoCase made = liver_between_ribs();
  made.lesions = {solid_form(cases::LesionKind::hcc, {-102.0, -22.0, 26.0}, 7.5, 80.0)};
  made.structures = {labelled("liver", StructureRule::organ),
                     labelled("lung", StructureRule::critical),
                     labelled("pleural_recess", StructureRule::critical),
                     labelled("intercostal_bundle", StructureRule::critical),
                     labelled("colon", StructureRule::critical),
                     labelled("gallbladder", StructureRule::critical)};
  return made;
}

DemoCase torso_cortex() {
  DemoCase made = kidney_cortex();
  made.lesions = {place_form({70.0, 53.0, -42.0}, {12.0, 7.0, 9.0})};
  made.structures = {labelled("kidney", StructureRule::organ),
                     labelled("renal_sinus", StructureRule::critical),
                     labelled("collecting_system", StructureRule::critical),
                     labelled("colon", StructureRule::critical),
                     labelled("lung", StructureRule::critical),
                     labelled("pleural_recess", StructureRule::critical)};
  return made;
}

// At the level of the cricoid, where the carotid lies in part behind the vein.
DemoCase neck_jugular_vein() {
  DemoCase made = jugular_vein();
  // The lumen where it is entered: as dark as the blood about it, not a place, which would be tissue in it.
  made.lesions = {sphere_form({-32.6, -19.7, 335.0}, 6.0, 12.0)};
  made.structures = {
      drawn("carotid", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{-22, -6, 306}, {-24, -11, 340}, {-26, -9, 372}}, 3.5}),
      drawn("jugular_vein", StructureRule::target, TissueClass::vessel,
            cases::Tube{{{-35.5, -12, 376}, {-33.5, -18, 345}, {-31.5, -22, 322}, {-29, -28, 300}}, 6.5}),
      labelled("lung", StructureRule::critical),
      labelled("airway", StructureRule::critical),
      labelled("thyroid", StructureRule::major),
      labelled("nerve", StructureRule::major)};
  return made;
}

// The middle hepatic vein's last branch; the gallbladder below.
DemoCase torso_beside_a_vein() {
  DemoCase made = beside_a_vein();
  made.lesions = {solid_form(cases::LesionKind::metastasis, {-66.0, -41.0, 53.0}, 5.0, 70.0)};
  made.structures = {drawn("hepatic_vein", StructureRule::critical, TissueClass::vessel,
                           cases::Tube{{{-42, -12, 88}, {-54, -34, 66}, {-60, -50, 44}}, 2.6}),
                     labelled("liver", StructureRule::organ), labelled("gallbladder", StructureRule::critical),
                     labelled("lung", StructureRule::critical), labelled("colon", StructureRule::critical)};
  return made;
}

}  // namespace

const std::vector<DemoCase>& drills() {
  static const std::vector<DemoCase> all = {find_the_plane(), keep_the_tip(), depth_out_of_plane()};
  return all;
}

const std::vector<DemoCase>& demo_cases() {
  static const std::vector<DemoCase> all = {
      torso_liver(),   torso_between_ribs(), torso_cortex(),        neck_jugular_vein(),
      dilated_calyx(), opacified_calyx(),    torso_beside_a_vein(), to_be_deferred(torso_between_ribs())};
  return all;
}

}  // namespace seldinger::app
