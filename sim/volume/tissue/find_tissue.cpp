#include "sim/volume/tissue/find_tissue.h"

#include <algorithm>
#include <optional>

#include "sim/base/check.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace {

constexpr std::uint8_t kAllBone = 255;

void let_labels_win(const LabelMap& labels, Tissue& tissue_of) {
  std::vector<TissueClass>& classes = tissue_of.classes;
  std::vector<std::optional<TissueClass>> tissue;
  for (const std::string& name : labels.names) tissue.push_back(tissue_of_name(name));
  if (!tissue.empty()) tissue[0].reset();  // 0 is "no label"
  for (std::size_t at = 0; at < classes.size(); ++at)
    if (const auto& known = tissue[labels.label[at]]) {
      classes[at] = *known;
      tissue_of.bone_share[at] = *known == TissueClass::bone ? kAllBone : 0;
    }
}

std::vector<TissueClass> body_and_air(const Volume& volume, const std::vector<std::uint8_t>& body) {
  std::vector<TissueClass> classes(volume.hu.size());
  std::transform(body.begin(), body.end(), classes.begin(),
                 [](std::uint8_t in) { return in != 0 ? TissueClass::soft_tissue : TissueClass::air; });
  mark_air_spaces(volume, classes);
  return classes;
}

}  // namespace

Tissue find_tissue(const Volume& volume, const LabelMap* labels) {
  if (labels != nullptr) CHECK(labels->label.size() == volume.hu.size());
  Tissue made;
  made.classes = body_and_air(volume, body_mask(volume));
  mark_bone_by_shape(volume, made.classes, made.bone_share);
  mark_soft_tissue(volume, made.classes);
  if (labels != nullptr) let_labels_win(*labels, made);
  return made;
}

std::vector<TissueClass> tissue_classes(const Volume& volume, const LabelMap* labels) {
  return find_tissue(volume, labels).classes;
}

std::vector<TissueClass> tissue_classes_by_rule_1(const Volume& volume, const LabelMap* labels) {
  if (labels != nullptr) CHECK(labels->label.size() == volume.hu.size());
  Tissue made;
  made.classes = body_and_air(volume, body_mask_by_rule_1(volume));
  made.bone_share.resize(made.classes.size());
  mark_hard_tissue(volume, made.classes);
  mark_soft_tissue(volume, made.classes);
  if (labels != nullptr) let_labels_win(*labels, made);
  return std::move(made.classes);
}

}  // namespace seldinger::volume
