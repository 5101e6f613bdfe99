// Organs of a CT without labels, by classical means: solid ones are even pieces of one level, in the organ's place,
// of its size, parted from all else; lungs, vertebrae and ribs are told by shape and place, great vessels are tubes
// along the spine. What is not sure is left to be what its class says (docs/decisions/0074, 0086).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "sim/base/names.h"
#include "sim/volume/classes.h"

namespace seldinger::volume {

enum class FoundOrgan : std::uint8_t {
  none,
  liver,
  spleen,
  right_kidney,
  left_kidney,
  right_lung,
  left_lung,
  vertebrae,
  ribs,
  aorta,
  vena_cava,
  bladder,
  gallbladder,
};
inline constexpr auto kFoundOrganNames = base::names<FoundOrgan>({{FoundOrgan::none, "none"},
                                                                  {FoundOrgan::liver, "liver"},
                                                                  {FoundOrgan::spleen, "spleen"},
                                                                  {FoundOrgan::right_kidney, "right_kidney"},
                                                                  {FoundOrgan::left_kidney, "left_kidney"},
                                                                  {FoundOrgan::right_lung, "right_lung"},
                                                                  {FoundOrgan::left_lung, "left_lung"},
                                                                  {FoundOrgan::vertebrae, "vertebrae"},
                                                                  {FoundOrgan::ribs, "ribs"},
                                                                  {FoundOrgan::aorta, "aorta"},
                                                                  {FoundOrgan::vena_cava, "vena_cava"},
                                                                  {FoundOrgan::bladder, "bladder"},
                                                                  {FoundOrgan::gallbladder, "gallbladder"}});

struct OrganFound {
  FoundOrgan organ = FoundOrgan::none;
  double confidence = 0.0;  // 0 to 1
  double ml = 0.0;
  int level_hu = 0;  // its median
};

// On a grid of 3 mm along the patient's axes.
struct Organs {
  Volume grid;                    // HU, averaged
  std::vector<FoundOrgan> at;     // one per voxel of the grid; those with confidence only
  std::vector<OrganFound> found;  // also those without enough confidence, which `at` does not show
};
constexpr double kOrganConfidence = 0.5;  // from here on it is named

// What is named at a point of the patient; nothing where nothing is, and beyond the CT.
std::optional<OrganFound> organ_at(const Organs& organs, const glm::dvec3& lps_mm);

// Of an organ that is named; nothing where it is not.
std::optional<int> level_of(const Organs& organs, FoundOrgan organ) noexcept;

// Classes: as many as voxels (CHECK). Same input, same answer; one thread.
Organs find_organs(const Volume& volume, const std::vector<TissueClass>& classes);

}  // namespace seldinger::volume
