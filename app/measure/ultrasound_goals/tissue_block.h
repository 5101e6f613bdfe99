// A block of tissue in front of a probe: what the goals are measured on. The face's centre is the origin, y goes
// into the body, x along the face.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "sim/imaging/ultrasound/view/ultrasound.h"

namespace seldinger::measure {

struct TissueBlock {
  volume::Volume volume;  // HU typical of the class (our judgement)
  std::vector<volume::TissueClass> classes;
  imaging::TissueVolume tissue() const { return {&volume, classes, {}}; }
};

// From 30 mm above the face; `class_at` is asked at voxel centres.
TissueBlock tissue_block(const std::function<volume::TissueClass(const glm::dvec3& lps_mm)>& class_at,
                         glm::ivec3 size_voxels = {150, 120, 30}, double voxel_mm = 2.0);
TissueBlock block_of(volume::TissueClass tissue);

}  // namespace seldinger::measure
