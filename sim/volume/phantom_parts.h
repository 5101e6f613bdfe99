// What the built-in torso is made of: tissues with their HU, and the regions that paint it. Inside sim/volume only.
// LPS mm: x to the patient's left, y to the back, z to the head; x = 0 is the midline, z = 0 is at
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

using Shapes = std::vector<Shape>;
using Over = std::vector<std::string>;  // see Shape::over

// A point of a tube's middle line and the tube's radius there.
struct Knot {
  glm::dvec3 p_mm;
  double radius_mm;
};

void add(Shapes& shapes, const Tissue& tissue, const Geometry& geometry, const Over& over = {});
// A chain of short cylinders and spheres along a Catmull–Rom curve through the knots.
void add_tube(Shapes& shapes, const Tissue& tissue, const std::vector<Knot>& knots, const Over& over = {});
std::vector<Knot> with_radius(std::vector<Knot> knots, double radius_mm);
glm::dvec3 mirrored(const glm::dvec3& p_mm, double side);  // side: +1 left, −1 right

// In the order in which they paint.
void add_body_layers(Shapes& shapes);
void add_trunk_muscles(Shapes& shapes);
void add_lungs(Shapes& shapes);
void add_liver(Shapes& shapes);
void add_mediastinum(Shapes& shapes);
void add_upper_abdomen(Shapes& shapes);
void add_bowel(Shapes& shapes);
void add_kidneys(Shapes& shapes, Calyces calyces);
void add_great_vessels(Shapes& shapes);
void add_spine(Shapes& shapes);
void add_pelvis(Shapes& shapes);
void add_ribs(Shapes& shapes);

}  // namespace seldinger::volume::phantom
