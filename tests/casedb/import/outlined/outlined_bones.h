// Bones that a reader outlined by eye (outlined_bones.txt) on one slice of each real CT (enlarged 5 to 12 times,
// window −150 to 550 HU), before anything of the program was looked at; marrow is bone. Voxels are those of the
// volume as it is read, x right to left, y front to back.
#pragma once

#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace seldinger::casedb {

using Outline = std::vector<glm::dvec2>;  // in voxels, whose middles are whole numbers; closed

struct OutlinedSlice {
  std::string ct;  // below the folder of real CT
  int slice;
  glm::ivec2 low, high;           // what was looked at; high is beyond it
  std::vector<Outline> bones;     // and within them …
  std::vector<Outline> holes;     // … what is none
  std::vector<Outline> doubtful;  // what no reader would tell
};
std::vector<OutlinedSlice> outlined_slices();

}  // namespace seldinger::casedb
