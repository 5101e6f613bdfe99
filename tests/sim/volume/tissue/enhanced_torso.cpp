#include "tests/sim/volume/tissue/enhanced_torso.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim/base/rng.h"

namespace seldinger::volume {
namespace {

// HU unenhanced, in the arterial phase and in the excretory one; the portal phase is the torso's own. Blood of an
// early angiogram 350 to 450, after 5 minutes about 95; parenchyma: Bae, Radiology 2010;256:32, figures 3 to 6.
const std::map<std::string, std::array<double, 3>>& phase_hu() {
  static const std::map<std::string, std::array<double, 3>> table{
      {"aorta", {42, 400, 95}},    {"artery", {42, 390, 95}},           {"heart", {42, 360, 95}},
      {"vena_cava", {40, 70, 95}}, {"pulmonary_vessel", {42, 380, 95}}, {"intercostal_bundle", {42, 200, 95}},
      {"vein", {40, 60, 95}},      {"portal_vein", {40, 80, 95}},       {"hepatic_vein", {40, 60, 92}},
      {"liver", {58, 66, 85}},     {"spleen", {48, 140, 85}},           {"pancreas", {42, 110, 70}},
      {"kidney", {33, 190, 115}},  {"collecting_system", {5, 5, 700}},
  };
  return table;
}
constexpr double kMedullaHu = 160.0, kArterialMedullaHu = 70.0;

double hu_of(const Shape& shape, TorsoPhase phase) {
  const auto found = phase_hu().find(shape.class_name);
  if (phase == TorsoPhase::portal || found == phase_hu().end()) return shape.hu;
  if (phase == TorsoPhase::arterial && shape.class_name == "kidney" && shape.hu == kMedullaHu)
    return kArterialMedullaHu;
  return found->second[phase == TorsoPhase::none ? 0 : phase == TorsoPhase::arterial ? 1 : 2];
}

bool is_bone(const std::string& name) {
  return name == "rib" || name == "spine" || name == "pelvis";
}

// At 1 mm. The last one made is kept: tests ask for one phase after the other.
const EnhancedTorso& fine_torso(const TorsoOptions& options) {
  static EnhancedTorso made;
  static TorsoOptions of;
  if (!made.volume.hu.empty() && of.phase == options.phase && of.metal == options.metal && of.body == options.body)
    return made;
  AnalyticVolume shapes = phantom_shapes({.spacing_mm = glm::dvec3(1, 1, 1), .body = options.body});
  enhance(shapes, options.phase, options.metal);
  made = {};
  made.volume = rasterize(shapes, made.truth);
  of = options;
  return made;
}

}  // namespace

void enhance(AnalyticVolume& shapes, TorsoPhase phase, bool metal) {
  for (Shape& shape : shapes.shapes) shape.hu = hu_of(shape, phase);
  if (!metal) return;
  shapes.shapes.push_back({Cylinder{{-14, 30, -32}, {-14, 70, -32}, 3.0}, 3071.0, "steel"});
  shapes.shapes.push_back({Sphere{{-40, -30, 30}, 1.5}, 3071.0, "steel"});
}

std::string name_of(TorsoPhase phase) {
  switch (phase) {
    case TorsoPhase::none:
      return "none";
    case TorsoPhase::arterial:
      return "arterial";
    case TorsoPhase::portal:
      return "portal";
    case TorsoPhase::excretory:
      return "excretory";
  }
  return {};
}

ContrastPhase told_as(TorsoPhase phase) {
  switch (phase) {
    case TorsoPhase::none:
      return ContrastPhase::none;
    case TorsoPhase::arterial:
      return ContrastPhase::early;
    case TorsoPhase::portal:
      return ContrastPhase::venous;
    case TorsoPhase::excretory:
      return ContrastPhase::late;
  }
  return {};
}

EnhancedTorso enhanced_torso(const TorsoOptions& options) {
  const EnhancedTorso& fine = fine_torso(options);
  const glm::ivec3 by = options.spacing_mm, n = fine.volume.size_voxels / by;
  const glm::dvec3 origin_mm(fine.volume.lps_from_voxel[3]);
  EnhancedTorso made;
  made.volume = make_volume(n, glm::dvec3(by), glm::dmat3(1.0), origin_mm + (glm::dvec3(by) - 1.0) / 2.0);
  made.truth.names = fine.truth.names;
  made.truth.label.resize(made.volume.hu.size());
  made.bone_share.resize(made.volume.hu.size());
  std::vector<std::uint8_t> bone;
  for (const std::string& name : fine.truth.names) bone.push_back(is_bone(name) ? 1 : 0);
  const double voxels = by.x * by.y * by.z;
  for (int k = 0; k < n.z; ++k)
    for (int j = 0; j < n.y; ++j)
      for (int i = 0; i < n.x; ++i) {
        double hu = 0.0, bones = 0.0;
        std::array<int, 256> count{};
        for (int z = 0; z < by.z; ++z)
          for (int y = 0; y < by.y; ++y)
            for (int x = 0; x < by.x; ++x) {
              const std::size_t at = fine.volume.index(i * by.x + x, j * by.y + y, k * by.z + z);
              hu += fine.volume.hu[at];
              bones += bone[fine.truth.label[at]];
              ++count[fine.truth.label[at]];
            }
        const std::size_t at = made.volume.index(i, j, k);
        made.bone_share[at] = static_cast<float>(bones / voxels);
        made.truth.label[at] =
            static_cast<std::uint8_t>(std::max_element(count.begin(), count.end()) - count.begin());
        const double sd_hu = made.truth.label[at] == 0 ? options.noise_sd_hu / 2.0 : options.noise_sd_hu;
        made.volume.hu[at] = static_cast<std::int16_t>(
            std::clamp(std::round(hu / voxels + sd_hu * base::normal_at(7, at)), double{kAirHu}, 32767.0));
      }
  return made;
}

TorsoScore score(const EnhancedTorso& torso, const Tissue& found) {
  double both = 0.0, all = 0.0;
  struct Share {
    double voxels = 0.0, bone = 0.0;
    double of() const { return bone / voxels; }
  } rib, vessel, ducts;
  for (std::size_t at = 0; at < found.classes.size(); ++at) {
    const double share = found.bone_share[at] / 255.0, truth = double{torso.bone_share[at]};
    both += std::min(share, truth);
    all += share + truth;
    const std::string& name = torso.truth.names[torso.truth.label[at]];
    const bool great = name == "aorta" || name == "artery" || name == "heart" || name == "vena_cava" ||
                       name == "vein" || name == "portal_vein" || name == "hepatic_vein" ||
                       name == "pulmonary_vessel";
    for (auto& [counted, to] : {std::pair(name == "rib", &rib), std::pair(great, &vessel),
                                std::pair(name == "collecting_system", &ducts)}) {
      if (!counted) continue;
      to->voxels += 1.0;
      to->bone += found.classes[at] == TissueClass::bone ? 1.0 : 0.0;
    }
  }
  return {2.0 * both / all, rib.of(), vessel.of(), ducts.of(), rib.voxels, vessel.voxels};
}

}  // namespace seldinger::volume
