// What the built-in patients are made of: tissues with their HU, and what paints each part of them. Inside
// sim/volume only. LPS mm: x to the patient's left, y to the back, z to the head; x = 0 is the midline, z = 0 is at
// L1, the supine skin runs from y = −114 (belly) to 114 (back).
#pragma once

#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "sim/volume/phantom.h"

namespace seldinger::volume::phantom {

// HU: unenhanced tissues after Prokop and Galanski, Spiral and Multislice CT of the Body (Thieme 2003); enhanced
// organs and vessels are judgement for the portal-venous phase (about 70 s after injection), where vessels show.
struct Tissue {
  const char* name;  // the label, and the tissue's class
  double hu;
};
constexpr Tissue kSkin{"skin", 40.0};
constexpr Tissue kFat{"fat", -100.0};
constexpr Tissue kMuscle{"muscle", 60.0};
constexpr Tissue kVisceralFat{"visceral_fat", -95.0};
constexpr Tissue kRibCortex{"rib", 700.0};
constexpr Tissue kRibMarrow{"rib", 250.0};
constexpr Tissue kCartilage{"costal_cartilage", 110.0};
constexpr Tissue kIntercostalBundle{"intercostal_bundle", 130.0};
constexpr Tissue kSpineCortex{"spine", 700.0};
constexpr Tissue kSpineMarrow{"spine", 220.0};
constexpr Tissue kDisc{"disc", 90.0};
constexpr Tissue kSpinalCanal{"spinal_canal", 25.0};
constexpr Tissue kPelvisCortex{"pelvis", 700.0};
constexpr Tissue kPelvisMarrow{"pelvis", 200.0};
constexpr Tissue kLung{"lung", -850.0};
constexpr Tissue kPulmonaryVessel{"pulmonary_vessel", 120.0};
constexpr Tissue kPleuralRecess{"pleural_recess", 15.0};  // a film of fluid between two leaves
constexpr Tissue kDiaphragm{"diaphragm", 60.0};
constexpr Tissue kHeart{"heart", 130.0};
constexpr Tissue kLiver{"liver", 110.0};
constexpr Tissue kPortalVein{"portal_vein", 165.0};
constexpr Tissue kHepaticVein{"hepatic_vein", 160.0};
constexpr Tissue kGallbladder{"gallbladder", 8.0};
constexpr Tissue kSpleen{"spleen", 120.0};
constexpr Tissue kPancreas{"pancreas", 95.0};
constexpr Tissue kAdrenal{"adrenal", 70.0};
constexpr Tissue kKidneyCortex{"kidney", 175.0};
constexpr Tissue kKidneyMedulla{"kidney", 160.0};
constexpr Tissue kRenalSinus{"renal_sinus", -80.0};
constexpr Tissue kUrine{"collecting_system", 5.0};
constexpr Tissue kOpacifiedUrine{"collecting_system", 600.0};
constexpr Tissue kAorta{"aorta", 150.0};
constexpr Tissue kArtery{"artery", 145.0};
constexpr Tissue kVenaCava{"vena_cava", 130.0};
constexpr Tissue kVein{"vein", 140.0};
constexpr Tissue kStomach{"stomach", 80.0};
constexpr Tissue kColon{"colon", 60.0};
constexpr Tissue kSmallBowel{"small_bowel", 85.0};
constexpr Tissue kBowelContent{"bowel_content", 30.0};
constexpr Tissue kBowelGas{"bowel_gas", -950.0};

// Of groin and neck alone.
constexpr Tissue kValve{"venous_valve", 60.0};  // two leaflets
constexpr Tissue kNerve{"nerve", 35.0};
constexpr Tissue kLigament{"ligament", 90.0};
constexpr Tissue kLymphNode{"lymph_node", 60.0};
constexpr Tissue kFemurCortex{"femur", 800.0};
constexpr Tissue kFemurMarrow{"femur", 220.0};
constexpr Tissue kFemurShaftMarrow{"femur", -40.0};  // yellow marrow
constexpr Tissue kSacrumCortex{"sacrum", 500.0};
constexpr Tissue kSacrumMarrow{"sacrum", 180.0};
constexpr Tissue kJoint{"cartilage", 60.0};
constexpr Tissue kBladderWall{"bladder_wall", 45.0};
constexpr Tissue kBladder{"bladder", 8.0};
constexpr Tissue kJugular{"jugular_vein", 140.0};
constexpr Tissue kCarotid{"carotid_artery", 145.0};
constexpr Tissue kFemoralVein{"femoral_vein", 140.0};
constexpr Tissue kFemoralArtery{"femoral_artery", 145.0};
constexpr Tissue kThroatMuscle{"larynx", 60.0};
constexpr Tissue kHyoid{"hyoid", 450.0};
constexpr Tissue kAirway{"airway", -1000.0};
constexpr Tissue kAirwayCartilage{"cartilage", 110.0};
constexpr Tissue kThyroid{"thyroid", 110.0};  // iodine of its own
constexpr Tissue kOesophagus{"oesophagus", 45.0};
constexpr Tissue kClavicleCortex{"clavicle", 750.0};
constexpr Tissue kClavicleMarrow{"clavicle", 250.0};

using Shapes = std::vector<Shape>;
using Over = std::vector<std::string>;  // see Shape::over

constexpr double kTall_mm = 3000.0;  // half axis of what runs through both ends: tapers by 0.2 % over a torso

// A point of a tube's middle line and the tube's radius there.
struct Knot {
  glm::dvec3 p_mm;
  double radius_mm;
};

void add(Shapes& shapes, const Tissue& tissue, const Geometry& geometry, const Over& over = {});
// A chain of short cylinders and spheres along a Catmull–Rom curve through the knots.
void add_tube(Shapes& shapes, const Tissue& tissue, const std::vector<Knot>& knots, const Over& over = {});
// Cortex, and marrow inside it.
void add_bone(Shapes& shapes, const Tissue& cortex, const Tissue& marrow, std::vector<Knot> knots,
              double cortex_mm);
void add_bone(Shapes& shapes, const Tissue& cortex, const Tissue& marrow, const Ellipsoid& lens, double cortex_mm);
// Two leaflets in a vein that runs along z; they lean from its wall towards its middle.
void add_valve(Shapes& shapes, const Tissue& vein, const glm::dvec3& at_mm, double radius_mm);
std::vector<Knot> with_radius(std::vector<Knot> knots, double radius_mm);
glm::dvec3 mirrored(const glm::dvec3& p_mm, double side);  // side: +1 left, −1 right

// mm from the outside inwards.
struct Inset {
  double lateral_mm = 0.0, front_mm = 0.0, back_mm = 0.0;
};
// What a body has less of subcutaneous fat than the adult, in each region; < 0: more. Then all of it is scaled.
struct Physique {
  double scale = 1.0;
  Inset torso{};
  double groin_mm = 0.0, neck_mm = 0.0;
  bool prone = false;
};

// In the order in which they paint.
void add_body_layers(Shapes& shapes, const Inset& less_fat);
void add_trunk_muscles(Shapes& shapes);
void add_lungs(Shapes& shapes);
void add_liver(Shapes& shapes);
void add_mediastinum(Shapes& shapes);
void add_upper_abdomen(Shapes& shapes);
void add_bowel(Shapes& shapes, bool prone);
void add_kidneys(Shapes& shapes, Calyces calyces);
void add_great_vessels(Shapes& shapes);
void add_spine(Shapes& shapes);
void add_pelvis(Shapes& shapes);
void add_ribs(Shapes& shapes);
void add_iliac_wings(Shapes& shapes);
void add_groin_bones(Shapes& shapes);
void add_neck_bones(Shapes& shapes);
// Whole regions.
void add_groin(Shapes& shapes, double less_fat_mm);
void add_neck(Shapes& shapes, double less_fat_mm);

}  // namespace seldinger::volume::phantom
