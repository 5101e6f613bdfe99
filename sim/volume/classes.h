// Tissue classes: what a voxel is, one byte each, beside the HU. Import and scenes both compute them, so that no
// picture and no touch takes contrast for bone. See docs/decisions/0012.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "sim/base/result.h"
#include "sim/volume/volume.h"

namespace seldinger::volume {

// Stored in libraries and read by shaders: numbers stay as they are, new ones go to the end.
enum class TissueClass : std::uint8_t {
  air = 0,          // outside the body: room, couch, padding
  gas = 1,          // inside: bowel, airways
  lung = 2,         //
  fat = 3,          //
  fluid = 4,        // water, bile, urine, cyst, effusion
  soft_tissue = 5,  // any that HU cannot tell apart; unenhanced blood too
  liver = 6,        // 6 to 11: from labels only
  kidney = 7,       //
  spleen = 8,       //
  muscle = 9,       //
  skin = 10,        //
  connective = 11,  // cartilage, disc, tendon
  vessel = 12,      // blood by label, or whatever is full of contrast
  bone = 13,        //
  metal = 14,       //
};
constexpr std::size_t kTissueClasses = 15;

struct TissueAbout {
  const char* name;     // as answers write it: "soft_tissue"
  const char* told_by;  // how it is told without a label; "label" where only a label can
  const char* source;   // of the numbers
};
const TissueAbout& about(TissueClass tissue) noexcept;

// HU of a class, for what is drawn without an HU of its own: CT would show nothing of it (decision 0018).
double typical_hu(TissueClass tissue) noexcept;

// The class that a label's name means ("rib" is bone); nothing for a name that is not known.
std::optional<TissueClass> tissue_of_name(std::string_view name) noexcept;

// How many voxels are of each class.
std::array<std::size_t, kTissueClasses> count_classes(std::span<const TissueClass> classes);

// As the library stores them (compressed), and back: `damaged` when not sound or not `voxels` long.
std::vector<std::byte> bytes_from_classes(std::span<const TissueClass> classes);
base::Result<std::vector<TissueClass>> classes_from_bytes(std::span<const std::byte> bytes, std::size_t voxels);

}  // namespace seldinger::volume
