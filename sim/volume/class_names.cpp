#include <utility>

#include "sim/volume/classes.h"
#include "sim/volume/label_numbering.h"

namespace seldinger::volume {
namespace {

constexpr const char* kProkop = "Prokop and Galanski, Spiral and Multislice CT of the Body (Thieme 2003)";
constexpr const char* kTried = "docs/decisions/0012, tried on four real volumes";
constexpr const char* kShape = "docs/decisions/0055";
constexpr const char* kLabel = "label";

constexpr std::array<TissueAbout, kTissueClasses> kAbout{{
    {"air", "outside the largest piece above -300 HU with its inside filled", "docs/clinical.md, Body and patient"},
    {"gas", "inside, below -400 HU; in no lung, or an airway of it", kTried},
    {"lung", "inside, below -400 HU, large, its inside mostly above -930 HU", kTried},
    {"fat", "below -30 HU, the middle between fat (-100) and tissue (40)", kProkop},
    {"fluid", "-20 to 18 HU and at least 6 mm thick, 1 ml", kTried},
    {"soft_tissue", "the rest of the inside", kProkop},
    {"liver", kLabel, kProkop},
    {"kidney", kLabel, kProkop},
    {"spleen", kLabel, kProkop},
    {"muscle", kLabel, kProkop},
    {"skin", kLabel, kProkop},
    {"connective", kLabel, kProkop},
    {"vessel", "from 200 HU, the highest of enhanced parenchyma, and no bone", kShape},
    {"bone", "from a share of 0.4 of what is bright, drains from no contrast and has bone's size and place",
     kShape},
    {"metal", "from 2500 HU, above cortical bone and enamel, and its rim", kTried},
}};

// What the built-in patients, scenes and label maps call things.
constexpr std::pair<std::string_view, TissueClass> kNames[] = {
    {"adrenal", TissueClass::soft_tissue},
    {"airway", TissueClass::gas},
    {"aorta", TissueClass::vessel},
    {"artery", TissueClass::vessel},
    {"bile", TissueClass::fluid},
    {"bladder", TissueClass::fluid},
    {"bladder_wall", TissueClass::soft_tissue},
    {"blood", TissueClass::vessel},
    {"bowel_content", TissueClass::soft_tissue},
    {"bowel_gas", TissueClass::gas},
    {"carotid_artery", TissueClass::vessel},
    {"cartilage", TissueClass::connective},
    {"clavicle", TissueClass::bone},
    {"collecting_system", TissueClass::fluid},
    {"colon", TissueClass::soft_tissue},
    {"costal_cartilage", TissueClass::connective},
    {"cyst", TissueClass::fluid},
    {"diaphragm", TissueClass::muscle},
    {"disc", TissueClass::connective},
    {"femoral_artery", TissueClass::vessel},
    {"femoral_vein", TissueClass::vessel},
    {"femur", TissueClass::bone},
    {"gallbladder", TissueClass::fluid},
    {"gel", TissueClass::soft_tissue},
    {"heart", TissueClass::muscle},
    {"hepatic_vein", TissueClass::vessel},
    {"hyoid", TissueClass::bone},
    {"intercostal_bundle", TissueClass::vessel},
    {"jugular_vein", TissueClass::vessel},
    {"larynx", TissueClass::soft_tissue},
    {"ligament", TissueClass::connective},
    {"lymph_node", TissueClass::soft_tissue},
    {"nerve", TissueClass::soft_tissue},
    {"oesophagus", TissueClass::soft_tissue},
    {"pancreas", TissueClass::soft_tissue},
    {"pelvis", TissueClass::bone},
    {"pleural_recess", TissueClass::fluid},
    {"portal_vein", TissueClass::vessel},
    {"pulmonary_vessel", TissueClass::vessel},
    {"renal_sinus", TissueClass::fat},
    {"rib", TissueClass::bone},
    {"small_bowel", TissueClass::soft_tissue},
    {"spinal_canal", TissueClass::soft_tissue},
    {"spine", TissueClass::bone},
    {"steel", TissueClass::metal},
    {"stomach", TissueClass::soft_tissue},
    {"tendon", TissueClass::connective},
    {"thyroid", TissueClass::soft_tissue},
    {"urine", TissueClass::fluid},
    {"vein", TissueClass::vessel},
    {"vena_cava", TissueClass::vessel},
    {"venous_valve", TissueClass::connective},
    {"visceral_fat", TissueClass::fat},
    {"water", TissueClass::fluid},
};

}  // namespace

const TissueAbout& about(TissueClass tissue) noexcept {
  const auto at = static_cast<std::size_t>(tissue);
  return kAbout[at < kTissueClasses ? at : 0];
}

std::optional<TissueClass> tissue_of_name(std::string_view name) noexcept {
  for (std::size_t at = 0; at < kTissueClasses; ++at)
    if (name == kAbout[at].name) return static_cast<TissueClass>(at);
  for (const auto& [known, tissue] : kNames)
    if (name == known) return tissue;
  return tissue_of_total_segmentator(name);
}

// HU of unenhanced tissue: Prokop and Galanski, Spiral and Multislice CT of the Body (Thieme 2003), as in the
// built-in torso; blood of normal haematocrit 35 to 50 HU, cortical bone from 700, lung in breath-hold about -850.
double typical_hu(TissueClass tissue) noexcept {
  using enum TissueClass;
  switch (tissue) {
    case air:
    case gas:
      return -1000.0;
    case lung:
      return -850.0;
    case fat:
      return -100.0;
    case fluid:
      return 8.0;
    case soft_tissue:
      return 40.0;
    case liver:
      return 60.0;
    case kidney:
      return 32.0;
    case spleen:
      return 50.0;
    case muscle:
      return 58.0;
    case skin:
      return 40.0;
    case connective:
      return 90.0;
    case vessel:
      return 43.0;
    case bone:
      return 700.0;
    case metal:
      return 3000.0;
  }
  return 0.0;
}

}  // namespace seldinger::volume
