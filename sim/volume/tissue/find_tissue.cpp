#include "sim/volume/tissue/find_tissue.h"

#include <algorithm>
#include <optional>

#include "sim/base/check.h"
#include "sim/volume/body/body_mask.h"
#include "sim/volume/tissue/class_steps.h"

namespace seldinger::volume {
namespace {

constexpr std::uint8_t kAllBone = 255;

std::vector<TissueClass> body_and_air(const Volume& volume, const std::vector<std::uint8_t>& body) {
  std::vector<TissueClass> classes(volume.hu.size());
  std::transform(body.begin(), body.end(), classes.begin(),
                 [](std::uint8_t in) { return in != 0 ? TissueClass::soft_tissue : TissueClass::air; });
  mark_air_spaces(volume, classes);
  return classes;
}

}  // namespace

void let_labels_win(const LabelMap& labels, std::vector<TissueClass>& classes,
                    std::vector<std::uint8_t>* bone_share) {
  CHECK(labels.label.size() == classes.size());
  std::vector<std::optional<TissueClass>> tissue;
  for (const std::string& name : labels.names) tissue.push_back(tissue_of_name(name));
  if (!tissue.empty()) tissue[0].reset();  // 0 is "no label"
  for (std::size_t at = 0; at < classes.size(); ++at)
    if (const auto& known = tissue[labels.label[at]]) {
      classes[at] = *known;
      if (bone_share != nullptr) (*bone_share)[at] = *known == TissueClass::bone ? kAllBone : 0;
    }
}

Tissue find_tissue(const Volume& volume, const LabelMap* labels) {
  if (labels != nullptr) CHECK(labels->label.size() == volume.hu.size());
  Tissue made;
  made.classes = body_and_air(volume, body_mask(volume));
  mark_bone_by_shape(volume, made.classes, made.bone_share);
  mark_soft_tissue(volume, made.classes);
  if (labels != nullptr) let_labels_win(*labels, made.classes, &made.bone_share);
  return made;
}

std::vector<TissueClass> tissue_classes(const Volume& volume, const LabelMap* labels) {
  return find_tissue(volume, labels).classes;
}

std::vector<TissueClass> tissue_classes_by_rule_1(const Volume& volume, const LabelMap* labels) {
  if (labels != nullptr) CHECK(labels->label.size() == volume.hu.size());
  Tissue made;
  made.classes = body_and_air(volume, body_mask_by_rule_1(volume));
  mark_hard_tissue(volume, made.classes);
  mark_soft_tissue(volume, made.classes);
  if (labels != nullptr) let_labels_win(*labels, made.classes);
  return std::move(made.classes);
}

}  // namespace seldinger::volume
