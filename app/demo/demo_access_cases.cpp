// Access to vessels of groin and neck: with the graded cases, of every region that the thesis names (§4.1), and of
// bodies that these do not have.
#include "app/demo/demo_case_parts.h"

namespace seldinger::app {
namespace {

using cases::StructureRule;
using volume::TissueClass;

// Below the inguinal ligament, before the head of the femur, as punctures of the groin are made. `side`: +1 left.
constexpr double kPuncture_z_mm = -240.0;
std::vector<glm::dvec3> of_side(double side, std::initializer_list<glm::dvec3> points) {
  std::vector<glm::dvec3> made;
  for (const glm::dvec3& p : points) made.emplace_back(side * p.x, p.y, p.z);
  return made;
}

DemoStructure femoral_vein(double side, StructureRule rule) {
  return drawn("vein", rule, TissueClass::vessel,
               cases::Tube{of_side(side, {{58.0, -36.0, -218.0},
                                          {61.5, -43.5, kPuncture_z_mm},
                                          {64.0, -42.0, -264.0},
                                          {70.0, -34.0, -292.0}}),
                           5.8});
}

DemoStructure femoral_artery(double side, StructureRule rule) {
  return drawn("artery", rule, TissueClass::vessel,
               cases::Tube{of_side(side, {{69.0, -43.0, -218.0},
                                          {75.0, -48.0, kPuncture_z_mm},
                                          {77.0, -48.0, -266.0},
                                          {79.0, -46.0, -292.0}}),
                           4.6});
}

DemoCase vessel(int number, const char* title, DemoSource source) {
  DemoCase made{number, title, source, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.probe_is_chosen = true;
  made.setting.approach = cases::Approach::out_of_plane;
  made.setting.clinic = {1.1, 210.0, "", "", false};
  return made;
}

DemoCase vein_of_an_obese_groin() {
  DemoCase made = vessel(1, "Access 1: right femoral vein, obese adult", DemoSource::groin_obese);
  made.setting.instrument = access_needle(18);
  made.setting.clinic.indication = "venous access, for a filter";
  made.setting.rule = rule_of({"hit >= 1", "back_wall_dist >= 2", "longest_advance_between_sights <= 8",
                               "skin_punctures <= 1", "probe_suits >= 1"},
                              {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  made.lesions = {sphere_form({-61.5, -43.5, kPuncture_z_mm}, 5.5, 12.0)};
  made.structures = {femoral_artery(-1.0, StructureRule::critical), femoral_vein(-1.0, StructureRule::target),
                     labelled("nerve", StructureRule::critical), labelled("small_bowel", StructureRule::critical)};
  return made;
}

DemoCase artery_of_a_lean_groin() {
  DemoCase made = vessel(2, "Access 2: left femoral artery, lean adult", DemoSource::groin_lean);
  made.setting.instrument = access_needle(18);
  made.setting.clinic.indication = "arterial access, for embolisation";
  made.setting.rule = rule_of({"hit >= 1", "back_wall_dist >= 1", "longest_advance_between_sights <= 8",
                               "skin_punctures <= 1", "probe_suits >= 1"},
                              {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  made.lesions = {sphere_form({75.0, -48.0, kPuncture_z_mm}, 4.3, 12.0)};
  made.structures = {femoral_vein(1.0, StructureRule::critical), femoral_artery(1.0, StructureRule::target),
                     labelled("nerve", StructureRule::critical), labelled("small_bowel", StructureRule::critical)};
  return made;
}

// A child is the adult, smaller.
constexpr double kChild = 0.7;
std::vector<glm::dvec3> of_child(std::initializer_list<glm::dvec3> points) {
  std::vector<glm::dvec3> made;
  for (const glm::dvec3& p : points) made.push_back(kChild * p);
  return made;
}

DemoCase jugular_of_a_child() {
  DemoCase made = vessel(3, "Access 3: left internal jugular vein, child", DemoSource::neck_child);
  made.setting.difficulty = casedb::Difficulty::hard;
  made.setting.instrument = access_needle(21);
  made.setting.clinic.indication = "central venous access";
  made.setting.rule = rule_of({"hit >= 1", "back_wall_dist >= 1", "longest_advance_between_sights <= 8",
                               "skin_punctures <= 1", "probe_suits >= 1"},
                              {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  made.lesions = {sphere_form(kChild * glm::dvec3(32.6, -19.7, 335.0), kChild * 5.0, 12.0)};
  made.structures = {
      drawn("carotid", StructureRule::critical, TissueClass::vessel,
            cases::Tube{of_child({{22, -6, 306}, {24, -11, 340}, {26, -9, 372}}), kChild * 3.5}),
      drawn("jugular_vein", StructureRule::target, TissueClass::vessel,
            cases::Tube{of_child({{35.5, -12, 376}, {33.5, -18, 345}, {31.5, -22, 322}, {29, -28, 300}}),
                        kChild * 5.5}),
      labelled("lung", StructureRule::critical),
      labelled("airway", StructureRule::critical),
      labelled("thyroid", StructureRule::major),
      labelled("nerve", StructureRule::major)};
  return made;
}

}  // namespace

const std::vector<DemoCase>& access_cases() {
  static const std::vector<DemoCase> all = {vein_of_an_obese_groin(), artery_of_a_lean_groin(),
                                            jugular_of_a_child()};
  return all;
}

}  // namespace seldinger::app
