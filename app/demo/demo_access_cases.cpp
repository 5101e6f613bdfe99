// Access to vessels of groin and neck: with the graded cases, of every region that the thesis names (§4.1), and of
// bodies that these do not have.
#include "app/demo/demo_case_parts.h"

namespace seldinger::app {
namespace {

using cases::StructureRule;
using volume::TissueClass;

// In a built-in patient's frame, adult or scaled. `side`: +1 left.
std::vector<glm::dvec3> placed(double scale, double side, std::initializer_list<glm::dvec3> points) {
  std::vector<glm::dvec3> made;
  for (const glm::dvec3& p : points) made.push_back(scale * glm::dvec3(side * p.x, p.y, p.z));
  return made;
}

// Punctured below the inguinal ligament, before the head of the femur.
constexpr glm::dvec3 kVein{61.5, -43.5, -240.0}, kArtery{75.0, -48.0, -240.0};

DemoStructure femoral_vein(double scale, double side, StructureRule rule) {
  return drawn(
      "vein", rule, TissueClass::vessel,
      cases::Tube{placed(scale, side, {{58.0, -36.0, -218.0}, kVein, {64.0, -42.0, -264.0}, {70.0, -34.0, -292.0}}),
                  scale * 5.8});
}

DemoStructure femoral_artery(double scale, double side, StructureRule rule) {
  return drawn("artery", rule, TissueClass::vessel,
               cases::Tube{placed(scale, side,
                                  {{69.0, -43.0, -218.0}, kArtery, {77.0, -48.0, -266.0}, {79.0, -46.0, -292.0}}),
                           scale * 4.6});
}

// `between_sights_mm`: how far the needle may go unseen. `off_wall_mm`: the tip from the wall behind it.
DemoCase vessel(int number, const char* title, DemoSource source, const char* indication,
                const char* between_sights_mm, const char* off_wall_mm) {
  DemoCase made{number, title, source, {}, {}, {}};
  made.setting.modality = cases::Modality::ultrasound;
  made.setting.probe_is_chosen = true;
  made.setting.approach = cases::Approach::out_of_plane;
  made.setting.instrument = vessel_needle(18);
  made.setting.clinic = {1.1, 210.0, "", indication, false};
  made.setting.rule =
      rule_of({"hit >= 1", off_wall_mm, between_sights_mm, "skin_punctures <= 1", "probe_suits >= 1"},
              {"nogo_length_critical <= 0", "posterior_wall <= 0"});
  return made;
}

// A shallow vessel of 8 mm: half of the usual way unseen would be all of it.
DemoCase vein_of_a_child() {
  DemoCase made = vessel(1, "Access 1: right femoral vein, child", DemoSource::groin_child, "central venous access",
                         "longest_advance_between_sights <= 5", "back_wall_dist >= 1");
  constexpr double kChild = 0.7;
  made.setting.difficulty = casedb::Difficulty::hard;
  made.setting.instrument = vessel_needle(21);
  made.lesions = {sphere_form(placed(kChild, -1.0, {kVein}).front(), kChild * 5.5, 12.0)};
  made.structures = {femoral_artery(kChild, -1.0, StructureRule::critical),
                     femoral_vein(kChild, -1.0, StructureRule::target), labelled("nerve", StructureRule::critical),
                     labelled("small_bowel", StructureRule::critical)};
  return made;
}

DemoCase artery_of_a_lean_groin() {
  DemoCase made =
      vessel(2, "Access 2: left femoral artery, lean adult", DemoSource::groin_lean,
             "arterial access, for embolisation", "longest_advance_between_sights <= 8", "back_wall_dist >= 1");
  made.lesions = {sphere_form(kArtery, 4.3, 12.0)};
  made.structures = {femoral_vein(1.0, 1.0, StructureRule::critical),
                     femoral_artery(1.0, 1.0, StructureRule::target), labelled("nerve", StructureRule::critical),
                     labelled("small_bowel", StructureRule::critical)};
  return made;
}

DemoCase jugular_of_an_obese_neck() {
  DemoCase made = vessel(3, "Access 3: left internal jugular vein, obese adult", DemoSource::neck_obese,
                         "central venous access", "longest_advance_between_sights <= 8", "back_wall_dist >= 2");
  made.lesions = {sphere_form({32.6, -19.7, 335.0}, 5.0, 12.0)};
  made.structures = {
      drawn("carotid", StructureRule::critical, TissueClass::vessel,
            cases::Tube{{{22, -6, 306}, {24, -11, 340}, {26, -9, 372}}, 3.5}),
      drawn("jugular_vein", StructureRule::target, TissueClass::vessel,
            cases::Tube{{{35.5, -12, 376}, {33.5, -18, 345}, {31.5, -22, 322}, {29, -28, 300}}, 5.5}),
      labelled("lung", StructureRule::critical),
      labelled("airway", StructureRule::critical),
      labelled("thyroid", StructureRule::major),
      labelled("nerve", StructureRule::major)};
  return made;
}

}  // namespace

const std::vector<DemoCase>& access_cases() {
  static const std::vector<DemoCase> all = {vein_of_a_child(), artery_of_a_lean_groin(),
                                            jugular_of_an_obese_neck()};
  return all;
}

}  // namespace seldinger::app
